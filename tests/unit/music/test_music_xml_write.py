"""What the writer puts into MusicXML, element by element as the 4.0 reference has them, and what it says is lost."""

import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element, fromstring

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.format_table import read_part, writer_for
from station.music.formats.music_format import Feature
from station.music.formats.music_xml.music_xml_format import MUSIC_XML
from station.music.formats.music_xml.writing.music_xml_writer import write_music_xml
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.parts_alike import kept_differences

_LESSONS = ("dragadiddle-toms", "flam-paradiddle", "hip-hop-1", "jazz-ballad-1", "meter-change-1", "press-roll-swell",
            "second-line-1", "splashes-off-the-beat", "stops-1", "crescendo-fill-1", "motown-1")  # fmt: skip
"""Between them every sign; all lessons come back in `tests/property`."""


def _part(*notes: Note, tempo_map: TempoMap | None = None, swing: Swing | None = None) -> DrumPart:
    return DrumPart(Score.from_notes(notes, tempo_map or TempoMap(), 4 * PPQ, "A title"), swing=swing or Swing())


def _written(part: DrumPart) -> Element:
    return fromstring(write_music_xml(part).data)


def _hand(tick: int, piece: Piece = Piece.SNARE, **more: object) -> Note:
    return replace(Note(tick, piece, limb=Limb.RIGHT_HAND), **more)  # type: ignore[arg-type]


def _texts(element: Element, path: str) -> list[str]:
    return [found.text or "" for found in element.iterfind(path)]


@pytest.mark.parametrize("name", _LESSONS)
def test_lessons_with_every_sign_come_back(name: str) -> None:
    assert kept_differences(MUSIC_XML, part_of(find_lesson(name))) == []


def test_hands_and_feet_are_voices_that_fill_the_bar() -> None:
    root = _written(_part(_hand(0), _hand(PPQ), Note(2 * PPQ, Piece.KICK, limb=Limb.RIGHT_FOOT)))
    lengths = {"1": 0, "2": 0}
    for note in root.iter("note"):
        lengths[note.findtext("voice", "")] += int(note.findtext("duration", "0"))
    divisions = int(root.findtext(".//divisions", "0"))
    assert lengths == {"1": 4 * divisions, "2": 4 * divisions}
    assert root.findtext(".//backup/duration") == str(4 * divisions)
    assert {n.findtext("stem") for n in root.iter("note") if n.findtext("voice") == "1"} == {"up", None}
    assert _texts(root, ".//midi-unpitched") == ["37", "39"]
    assert _texts(root, ".//instrument-name") == ["Bass drum", "Snare drum"]


@pytest.mark.parametrize(
    ("meter", "beams"),
    [
        (MeterChange(0, 7, 8), [2, 2, 3]),  # where nobody says, as on screen and paper
        (MeterChange(0, 7, 8, (3, 2, 2)), [3, 2, 2]),
        (MeterChange(0, 6, 8), [3, 3]),
        (MeterChange(0, 3, 8), [3]),
    ],
)
def test_eighths_are_beamed_by_the_beats_that_the_sheet_shows(meter: MeterChange, beams: list[int]) -> None:
    tempo_map = TempoMap.build([], [meter])
    eighths = [_hand(k * PPQ // 2) for k in range(meter.beats)]
    root = _written(DrumPart(Score.from_notes(eighths, tempo_map, meter.bar_ticks, "x")))
    signs = [sign for note in root.iter("note") for sign in _texts(note, "beam")]
    ends = [i + 1 for i, sign in enumerate(signs) if sign == "end"]
    assert [end - start for start, end in zip([0, *ends], ends, strict=False)] == beams


def test_values_and_beams_of_a_beat() -> None:
    """A dotted eighth and a sixteenth, then a triplet of eighths."""
    ticks = [0, 3 * PPQ // 4, PPQ, PPQ + PPQ // 3, PPQ + 2 * PPQ // 3]
    notes = [n for n in _written(_part(*map(_hand, ticks))).iter("note") if n.find("rest") is None]
    assert [n.findtext("type") for n in notes] == ["eighth", "16th", "eighth", "eighth", "eighth"]
    assert [len(n.findall("dot")) for n in notes] == [1, 0, 0, 0, 0]
    assert [_texts(n, "beam") for n in notes[:2]] == [["begin"], ["end", "backward hook"]]
    assert [n.findtext("time-modification/actual-notes") for n in notes] == [None, None, "3", "3", "3"]
    assert [[t.get("type") for t in n.iter("tuplet")] for n in notes[2:]] == [["start"], [], ["stop"]]


def test_signs_of_strokes() -> None:
    diddle = _hand(0, ornament=Ornament.DIDDLE)
    buzz = _hand(PPQ, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=3 * PPQ // 2)
    crash = _hand(3 * PPQ, Piece.CRASH_1, zone=Zone.EDGE, dynamic=Dynamic.ACCENT, velocity=117, choke_ticks=PPQ // 2)
    root = _written(_part(diddle, replace(diddle, tick=PPQ // 4), buzz, crash))
    struck = [n for n in root.iter("note") if n.find("rest") is None]
    assert [(t.get("type"), t.text) for t in root.iter("tremolo")] == [
        ("single", "1"), ("unmeasured", "0"), ("unmeasured", "0")
    ]  # fmt: skip
    assert [[tie.get("type") for tie in n.findall("tie")] for n in struck] == [[], ["start"], ["stop"], []]
    assert struck[-1].get("dynamics") == "130"
    assert struck[-1].find("notations/articulations/accent") is not None
    assert [e.get("smufl") for e in root.iter("other-articulation")] == ["pictChokeCymbal"]
    assert _texts(root, ".//fingering") == ["R", "R", "R"]


def test_grace_notes_stand_before_their_stroke() -> None:
    flam, drag = _hand(0, ornament=Ornament.FLAM), _hand(PPQ, ornament=Ornament.DRAG)
    notes = list(_written(_part(*with_graces(flam), *with_graces(drag))).iter("note"))
    assert [n.find("grace") is not None for n in notes[:5]] == [True, False, True, True, False]
    assert [g.get("slash") for n in notes[:4] for g in n.findall("grace")] == ["yes", None, None]


def test_tempo_meter_and_swing() -> None:
    tempo_map = TempoMap.build([TempoChange(0, 666_667)], [MeterChange(0, 7, 8, (2, 2, 3))])
    root = _written(_part(_hand(0), tempo_map=tempo_map, swing=Swing(1.4, PPQ // 4)))
    assert (root.findtext(".//beats"), root.findtext(".//beat-type")) == ("2+2+3", "8")
    assert (root.findtext(".//beat-unit"), root.findtext(".//per-minute")) == ("quarter", "90")
    swing = root.find(".//swing")
    assert swing is not None
    assert [child.text for child in swing] == ["7", "5", "16th"]


def test_a_bar_that_does_not_swing_is_under_the_word_straight() -> None:
    later = replace(_hand(round(0.6 * PPQ)), swing_ticks=round(0.1 * PPQ))
    even = _hand(4 * PPQ + PPQ // 2)
    part = _part(later, even, swing=Swing(1.5))
    root = _written(replace(part, score=replace(part.score, end_tick=8 * PPQ)))
    assert [[e.tag for e in swing] for swing in root.iter("swing")] == [["first", "second", "swing-type"], ["straight"]]


def test_nothing_is_hidden_in_the_file() -> None:
    """No comments, no fields for programs: every text stands on the page or is a word of the format."""
    data = write_music_xml(part_of(find_lesson("stops-1"))).data
    assert b"<!--" not in data
    tags = {element.tag for element in fromstring(data).iter()}
    assert not tags & {
        "miscellaneous",
        "miscellaneous-field",
        "encoding",
        "footnote",
        "level",
        "play",
        "listen",
        "link",
    }


def test_what_is_lost_is_said() -> None:
    hat = _hand(0, Piece.HIHAT, zone=Zone.BOW, openness=0.3)
    off = _hand(PPQ + 1234)
    part = replace(_part(hat, off), said_beat_ticks=5 * PPQ, sections=(PartSection("", 0, 0),), author="a\x00b")
    lost = {loss.feature: loss.text for loss in write_music_xml(part).lost}
    assert {Feature.OPENNESS, Feature.TIMES, Feature.BEAT, Feature.SECTIONS, Feature.AUTHOR} <= set(lost)
    assert lost[Feature.TIMES].startswith("bar 1: ")
    assert kept_differences(MUSIC_XML, part) == []


def test_a_meter_without_a_note_value_is_refused() -> None:
    with pytest.raises(BadInput, match="5/6"):
        write_music_xml(_part(_hand(0), tempo_map=TempoMap.build([], [MeterChange(0, 5, 6)])))


def test_an_mxl_is_a_zip_file_whose_container_names_the_score(tmp_path: Path) -> None:
    """As the MusicXML reference has it: `mimetype` first and not packed; MuseScore opens no other."""
    part = part_of(find_lesson("rock-1"))
    path = tmp_path / "rock-1.mxl"
    form = writer_for(path)
    assert form.write is not None
    path.write_bytes(form.write(part).data)
    with zipfile.ZipFile(path) as archive:
        kind = archive.infolist()[0]
        assert (kind.filename, kind.compress_type) == ("mimetype", zipfile.ZIP_STORED)
        assert archive.read("mimetype") == b"application/vnd.recordare.musicxml"
        root_file = fromstring(archive.read("META-INF/container.xml")).find("rootfiles/rootfile")
        assert root_file is not None
        assert root_file.get("media-type") == "application/vnd.recordare.musicxml+xml"
        assert archive.read(root_file.get("full-path", "")) == write_music_xml(part).data
    assert kept_differences(form, part) == []
    assert len(read_part(path).score) == len(part.score)
