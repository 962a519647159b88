"""MusicXML keeps what its table says it keeps: of all shipped lessons, and of parts that nobody would write."""

from dataclasses import replace
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.pieces import HAND_PIECES, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.music_format import Feature
from station.music.formats.music_xml.music_xml_format import KEEPS, MUSIC_XML
from station.music.formats.music_xml.writing.music_xml_writer import write_music_xml
from station.music.grace_strokes import with_graces
from station.music.loudness_marks import LoudnessMark
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.parts_alike import differences, kept_differences
from tests.shipped_lesson import shipped_lessons

_SLICES = 12


@cache
def _lesson_parts() -> dict[str, DrumPart]:
    return {lesson.name: part_of(lesson) for lesson in shipped_lessons()}


@pytest.mark.parametrize("at", range(_SLICES))
def test_shipped_lessons_come_back(at: int) -> None:
    parts = list(_lesson_parts().items())[at::_SLICES]
    assert {name: found for name, part in parts if (found := kept_differences(MUSIC_XML, part))} == {}


def test_next_to_nothing_of_shipped_lessons_is_lost() -> None:
    """A tempo or a diddle that is said to be lost would make the test above hold of nothing."""
    lost = {(name, loss.feature) for name, part in _lesson_parts().items() for loss in write_music_xml(part).lost}
    assert {feature for _, feature in lost} <= {Feature.SWING, Feature.GRACE_SPACING}
    assert len(lost) <= 2


# --- parts at random --------------------------------------------------------------------------------------------------

_METERS = st.sampled_from([(4, 4, ()), (3, 4, ()), (6, 8, ()), (7, 8, (2, 2, 3)), (5, 4, (3, 2)), (3, 8, ())])
_HANDS = st.sampled_from([Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.UNKNOWN])
_FEET = st.sampled_from([Limb.RIGHT_FOOT, Limb.LEFT_FOOT, Limb.UNKNOWN])
_NAMES = st.text(st.characters(codec="utf-8", exclude_categories=["Cs"]), max_size=20)


@st.composite
def _notes(draw: st.DrawFn, ticks: int) -> list[Note]:
    division = draw(st.sampled_from([1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 1024]))
    tick = draw(st.integers(0, ticks * division // PPQ - 1)) * PPQ // division
    piece = draw(st.sampled_from(list(Piece)))
    note = Note(
        tick,
        piece,
        draw(st.sampled_from(list(Zone))),
        draw(st.integers(1, 127)),
        draw(st.sampled_from(list(Articulation))),
        draw(st.sampled_from(list(Dynamic))),
        draw(_HANDS if piece in HAND_PIECES else _FEET),
        draw(st.sampled_from([None, 0.0, 0.5, 1.0, 0.3])) if piece is Piece.HIHAT else None,
        draw(st.sampled_from(list(Ornament))) if piece in HAND_PIECES else Ornament.NONE,
    )
    if note.articulation is Articulation.BUZZ:
        note = replace(note, duration_ticks=PPQ // draw(st.sampled_from([1, 2, 3])), ornament=Ornament.ROLL)
    elif draw(st.booleans()) and note.ornament is Ornament.NONE:
        note = replace(note, choke_ticks=PPQ // draw(st.sampled_from([1, 2, 4])))
    if note.ornament in (Ornament.DIDDLE, Ornament.ROLL) and note.articulation is not Articulation.BUZZ:
        return [note, replace(note, tick=tick + PPQ // draw(st.sampled_from([4, 6, 8])))]
    return with_graces(note)


def _apart(groups: list[list[Note]], end: int) -> list[Note]:
    """The notes of those groups that strike no piece when another does: no hand strikes twice at once."""
    taken: set[tuple[int, Piece]] = set()
    found: list[Note] = []
    for group in groups:
        places = {(note.tick, note.piece) for note in group}
        if not places & taken and all(note.tick < end for note in group):
            taken |= places
            found += group
    return found


@st.composite
def _parts(draw: st.DrawFn) -> DrumPart:
    beats, unit, groups = draw(_METERS)
    meter = MeterChange(0, beats, unit, groups)
    other = draw(_METERS)
    bars = draw(st.integers(1, 3))
    end = bars * meter.bar_ticks
    meters = [meter, *([MeterChange(end, *other)] if draw(st.booleans()) else [])]
    if len(meters) > 1:
        end += meters[1].bar_ticks
    tempos = [
        TempoChange(draw(st.integers(0, end - 1)) if i else 0, draw(st.integers(60_000, 3_000_000))) for i in range(3)
    ]
    notes = _apart(draw(st.lists(_notes(end), max_size=12)), end)
    score = Score.from_notes(notes, TempoMap.build(tempos, meters), end, draw(_NAMES))
    marks = sorted(draw(st.sets(st.integers(0, 16), max_size=4)))
    loudness = tuple(
        LoudnessMark(mark * end // 17, draw(st.sampled_from(["p", "f", "mf", "<", ">"]))) for mark in marks
    )
    loudness = tuple(mark for i, mark in enumerate(loudness) if not i or mark.sign != loudness[i - 1].sign)
    swing = draw(st.sampled_from([Swing(), Swing(2.0), Swing(1.5), Swing(1.4, PPQ // 4), Swing(1.5, PPQ // 8)]))
    sections = (PartSection(draw(_NAMES), 0, draw(st.integers(0, bars - 1))),) if draw(st.booleans()) else ()
    return DrumPart(
        replace(score, loudness=loudness), draw(_NAMES), draw(_NAMES),
        draw(st.sampled_from([PPQ, PPQ // 2, 3 * PPQ // 2, 5 * PPQ])), swing, sections,
    )  # fmt: skip


@settings(max_examples=60)
@given(_parts())
def test_what_is_not_said_to_be_lost_comes_back(part: DrumPart) -> None:
    assert kept_differences(MUSIC_XML, part) == []


@settings(max_examples=30)
@given(_parts())
def test_what_was_read_once_comes_back_whole(part: DrumPart) -> None:
    """A second time nothing is lost but what MusicXML has no word for."""
    once = MUSIC_XML.read(write_music_xml(part).data, "once")
    written = write_music_xml(once)
    assert (
        differences(once, MUSIC_XML.read(written.data, "twice"), set(KEEPS) - {x.feature for x in written.lost}) == []
    )
