"""MusicXML of other programs: what the reader makes of it, counted by hand from the MusicXML 4.0 reference."""

import io
import zipfile
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.format_table import read_part
from station.music.formats.music_xml.music_xml_format import MUSIC_XML
from station.music.formats.music_xml.reading.music_xml_reader import read_music_xml
from station.music.formats.music_xml.xml_instruments import XmlInstrument
from station.music.loudness_marks import LoudnessMark
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange

_SHARED = Path(__file__).parents[3].parent / "shared" / "data" / "charts" / "musicxml"
_NUMBERS = {"kick": 36, "snare": 38, "stick": 37, "hat": 42, "open": 46, "foot": 44, "crash": 49, "ride": 51}


_PITCHED = (
    b"<score-partwise><part id='P'><measure><note><pitch><step>C</step><octave>4</octave></pitch><duration>1</duration>"
    b"</note></measure></part></score-partwise>"
)


def _score(
    *measures: str, names: str = "", head: str = "", time: str = "<beats>4</beats><beat-type>4</beat-type>"
) -> bytes:
    instruments = "".join(f'<score-instrument id="{n}"><instrument-name>{n}</instrument-name></score-instrument>'
                          for n in _NUMBERS)  # fmt: skip
    midi = "".join(
        f'<midi-instrument id="{n}"><midi-channel>10</midi-channel><midi-unpitched>{number + 1}</midi-unpitched>'
        "</midi-instrument>"
        for n, number in _NUMBERS.items()
    )
    first = f"<attributes><divisions>12</divisions><time>{time}</time><clef><sign>percussion</sign></clef></attributes>"
    bars = "".join(
        measure
        if measure.startswith("<measure")
        else f'<measure number="{i + 1}">{"" if i else first}{measure}</measure>'
        for i, measure in enumerate(measures)
    )
    return (
        f'<score-partwise version="4.0">{head}<part-list><score-part id="P1"><part-name>Drums{names}</part-name>'
        f'{instruments}{midi}</score-part></part-list><part id="P1">{bars}</part></score-partwise>'
    ).encode()


def _note(name: str, duration: int, more: str = "", kind: str = "quarter", before: str = "", voice: int = 1) -> str:
    return (
        f"<note>{before}<unpitched><display-step>C</display-step><display-octave>5</display-octave></unpitched>"
        f'<duration>{duration}</duration><instrument id="{name}"/><voice>{voice}</voice><type>{kind}</type>{more}'
        "</note>"
    )


def _grace(name: str) -> str:
    return f'<note><grace slash="yes"/><unpitched/><instrument id="{name}"/><voice>1</voice><type>eighth</type></note>'


def _rest(duration: int, voice: int = 1) -> str:
    return f"<note><rest/><duration>{duration}</duration><voice>{voice}</voice></note>"


def _read(*measures: str, **more: str) -> DrumPart:
    return read_music_xml(_score(*measures, **more), "file.musicxml")


def _struck(part: DrumPart) -> list[tuple[float, Piece]]:
    return [(note.tick / PPQ, note.piece) for note in part.score]


def test_voices_chords_and_triplets() -> None:
    triplet = "<time-modification><actual-notes>3</actual-notes><normal-notes>2</normal-notes></time-modification>"
    part = _read(
        _note("hat", 12) + _note("snare", 12, before="<chord/>") + _note("hat", 4, triplet, "eighth") * 3 + _rest(24)
        + "<backup><duration>48</duration></backup>" + _note("kick", 24, voice=2)
        + "<forward><duration>12</duration></forward>" + _note("kick", 12, voice=2)
    )  # fmt: skip
    ticks = [(note.tick, note.piece) for note in part.score]
    third = PPQ // 3
    assert ticks == [
        (0, Piece.KICK), (0, Piece.SNARE), (0, Piece.HIHAT), (PPQ, Piece.HIHAT), (PPQ + third, Piece.HIHAT),
        (PPQ + 2 * third, Piece.HIHAT), (3 * PPQ, Piece.KICK),
    ]  # fmt: skip
    assert part.score.end_tick == 4 * PPQ
    assert [note.limb for note in part.score if note.piece is Piece.KICK] == [Limb.RIGHT_FOOT] * 2


def test_signs_of_a_note() -> None:
    def notations(inner: str) -> str:
        return f"<notations>{inner}</notations>"

    part = _read(
        _note("snare", 12, notations("<articulations><accent/></articulations>"))
        + _note("snare", 12, '<notehead parentheses="yes">normal</notehead>')
        + _note("hat", 12, notations("<technical><half-muted/></technical>") + "<lyric><text>L</text></lyric>")
        + _note("foot", 12, notations("<technical><open/></technical>")),
        _note("crash", 6, notations('<articulations><other-articulation smufl="pictChokeCymbal"/></articulations>'))
        + _note("open", 12, notations("<technical><fingering>R</fingering></technical>"))
        + _note("ride", 12, "<notehead>diamond</notehead>")
        + _note("stick", 12, notations("<articulations><staccato/></articulations>")),
    )
    accent, ghost, half, splash, choked, opened, bell, stick = part.score
    assert (accent.dynamic, ghost.dynamic, half.openness, half.limb) == (
        Dynamic.ACCENT,
        Dynamic.GHOST,
        0.5,
        Limb.LEFT_HAND,
    )
    assert (splash.piece, splash.articulation) == (Piece.HIHAT_PEDAL, Articulation.SPLASH)
    assert (choked.choke_ticks, opened.openness, opened.limb) == (PPQ // 2, 1.0, Limb.RIGHT_HAND)
    assert (bell.zone, stick.articulation) == (Zone.BELL, Articulation.CROSS_STICK)
    assert accent.velocity > splash.velocity > ghost.velocity
    assert part.lost == ("staccato signs: 1, the first in bar 2",)


@pytest.mark.parametrize(("velocity", "snare"), [("", Dynamic.ACCENT), (' dynamics="90"', Dynamic.NORMAL)])
def test_an_accent_is_a_chords_unless_each_note_says_how_loud_it_is(velocity: str, snare: Dynamic) -> None:
    """Notation programs have articulations on chords, and write them with the first note."""
    accent = "<notations><articulations><accent/></articulations></notations>"
    ghost = '<notehead parentheses="yes">normal</notehead>'
    chord = (
        _note("hat", 12, accent) + _note("snare", 12, before="<chord/>") + _note("foot", 12, ghost, before="<chord/>")
    )
    part = _read(chord.replace("<note>", f"<note{velocity}>"))
    dynamics = {note.piece: note.dynamic for note in part.score}
    assert dynamics == {Piece.HIHAT: Dynamic.ACCENT, Piece.SNARE: snare, Piece.HIHAT_PEDAL: Dynamic.GHOST}


def test_flams_and_drags() -> None:
    part = _read(_grace("snare") + _note("snare", 12) + _grace("snare") * 2 + _note("snare", 36))
    flam, main, first, second, drag = part.score
    assert [n.ornament for n in (flam, main, first, second, drag)] == [Ornament.FLAM] * 2 + [Ornament.DRAG] * 3
    assert flam.lead_ms > 0 == main.lead_ms
    assert first.lead_ms > second.lead_ms > 0
    assert (flam.tick, second.tick, drag.tick) == (0, PPQ, PPQ)


def test_slashes_and_buzzes() -> None:
    def tremolo(marks: int, kind: str = "single") -> str:
        return f'<notations><ornaments><tremolo type="{kind}">{marks}</tremolo></ornaments></notations>'

    part = _read(
        _note("snare", 6, tremolo(1), "eighth") + _rest(6) + _note("snare", 12, tremolo(2))
        + _note("snare", 12, tremolo(0, "unmeasured") + '<tie type="start"/>')
        + _note("snare", 12, tremolo(0, "unmeasured") + '<tie type="stop"/>')
    )  # fmt: skip
    quarter = PPQ // 4
    assert [(n.tick, n.ornament) for n in part.score][:6] == [
        (0, Ornament.DIDDLE), (quarter, Ornament.DIDDLE), (PPQ, Ornament.ROLL), (PPQ + quarter, Ornament.ROLL),
        (PPQ + 2 * quarter, Ornament.ROLL), (PPQ + 3 * quarter, Ornament.ROLL),
    ]  # fmt: skip
    (buzz,) = list(part.score)[6:]
    assert (buzz.articulation, buzz.tick, buzz.duration_ticks) == (Articulation.BUZZ, 2 * PPQ, 2 * PPQ)


def test_a_tie_is_no_stroke() -> None:
    part = _read(_note("crash", 48, '<tie type="start"/>', "whole"), _note("crash", 48, '<tie type="stop"/>', "whole"))
    assert _struck(part) == [(0, Piece.CRASH_1)]


def test_velocities() -> None:
    loud = "<direction><direction-type><dynamics><ff/></dynamics></direction-type></direction>"
    sound = '<sound dynamics="50"/>'
    exact = _note("snare", 12).replace("<note>", '<note dynamics="100">')
    part = _read(exact + loud + _note("snare", 12) + sound + _note("snare", 24))
    assert [n.velocity for n in part.score] == [90, 112, 45]
    assert part.score.loudness == (LoudnessMark(PPQ, "ff"),)


def test_hairpins_end_with_a_mark() -> None:
    def wedge(kind: str) -> str:
        return f'<direction><direction-type><wedge type="{kind}"/></direction-type></direction>'

    part = _read(wedge("crescendo") + _note("snare", 24) + wedge("stop") + _note("snare", 24))
    assert part.score.loudness == (LoudnessMark(0, "<"), LoudnessMark(2 * PPQ, "f"))


def test_tempo_and_beat() -> None:
    mark = (
        "<direction><direction-type><metronome><beat-unit>quarter</beat-unit><beat-unit-dot/>"
        "<per-minute>60</per-minute></metronome></direction-type></direction>"
    )
    part = _read(
        mark + _note("snare", 18) + '<sound tempo="120"/>' + _note("snare", 18),
        time="<beats>6</beats><beat-type>8</beat-type>",
    )
    assert part.score.tempo_map.tempos == (TempoChange(0, 666_667), TempoChange(3 * PPQ // 2, 500_000))
    assert part.beat_ticks == 3 * PPQ // 2


def test_meters() -> None:
    other = "<attributes><time><beats>2+2+3</beats><beat-type>8</beat-type></time></attributes>"
    mixed = (
        "<attributes><time><beats>3</beats><beat-type>8</beat-type><beats>2</beats><beat-type>4</beat-type></time>"
        "</attributes>"
    )
    part = _read(_rest(48) + "", other + _note("snare", 42), mixed + _note("snare", 42))
    assert part.score.tempo_map.meters == (
        MeterChange(0, 4, 4),
        MeterChange(4 * PPQ, 7, 8, (2, 2, 3)),
        MeterChange(15 * PPQ // 2, 7, 8, (3, 4)),
    )


def test_bars_without_a_meter_are_as_long_as_what_stands_in_them() -> None:
    part = _read(_note("kick", 36) + _note("snare", 24), _note("kick", 24), time="<senza-misura/>")
    assert [str(part.score.tempo_map.meter_at(tick)) for tick in (0, 5 * PPQ)] == ["5/4", "2/4"]
    assert part.lost == ("music without a meter, each bar as long as what stands in it: 1, the first in bar 1",)


def test_a_pick_up_is_a_bar_of_its_own() -> None:
    part = _read(_note("snare", 12), _note("snare", 48))
    assert part.score.tempo_map.meters == (MeterChange(0, 1, 4), MeterChange(PPQ, 4, 4))


def test_swing_moves_what_is_in_no_tuplet() -> None:
    swing = "<sound><swing><first>3</first><second>2</second></swing></sound>"
    part = _read(swing + _note("hat", 6) * 2 + _note("hat", 36))
    assert part.swing == Swing(1.5, PPQ // 2)
    assert [(n.tick, n.swing_ticks) for n in part.score][1] == (round(PPQ * 0.6), round(PPQ * 0.1))


@pytest.mark.parametrize(
    ("words", "swing"),
    [
        ("Swing", Swing(2.0, PPQ // 2)),
        ("Medium swing", Swing(2.0, PPQ // 2)),
        ("Half-time shuffle", Swing(2.0, PPQ // 4)),
        ("Swing 16ths", Swing(2.0, PPQ // 4)),
        ("Straight 8ths", Swing()),
        ("Sultans of Swing", Swing()),
    ],
)
def test_swing_in_words_alone(words: str, swing: Swing) -> None:
    """As MuseScore 3.2.3 exports its tempo text and its swing text: no `<swing>` beside them."""
    mark = (
        f'<direction><direction-type><words>{words}</words></direction-type><sound tempo="120"/></direction>'
        f"<direction><direction-type><words>{words}</words></direction-type></direction>"
    )
    part = _read(mark + _note("hat", 3) * 2 + _note("hat", 6) + _note("hat", 36))
    assert part.swing == swing


def test_a_swing_with_a_number_is_not_overruled_by_its_words() -> None:
    mark = (
        "<direction><direction-type><words>Swing</words></direction-type>"
        "<sound><swing><first>3</first><second>2</second></swing></sound></direction>"
    )
    assert _read(mark + _note("hat", 6) * 2 + _note("hat", 36)).swing == Swing(1.5, PPQ // 2)


@pytest.mark.parametrize("sign", ["<open-string/>", "<harmonic><natural/></harmonic>", "<open/>"])
def test_every_small_circle_opens_a_hihat(sign: str) -> None:
    """MuseScore 3.2.3 exports its open sign and its circle as those of strings."""
    circle = f"<notations><technical>{sign}</technical></notations>"
    part = _read(_note("hat", 12, circle) + _note("hat", 12) + _note("snare", 24, circle))
    assert [(n.piece, n.openness) for n in part.score] == [
        (Piece.HIHAT, 1.0),
        (Piece.HIHAT, 0.0),
        (Piece.SNARE, None),
    ]


@pytest.mark.parametrize(("sign", "openness"), [("pictHalfOpen2", 0.5), ("pictOpen", 1.0), ("guitarClosePedal", 0.0)])
def test_pictures_say_how_open_a_hihat_is(sign: str, openness: float) -> None:
    """Signs of SMuFL's ranges for percussion and pedals, which MusicXML has as another articulation."""
    other = f'<notations><articulations><other-articulation smufl="{sign}"/></articulations></notations>'
    part = _read(_note("hat", 24, other) + _note("snare", 24, other))
    assert part.score[0].openness == openness
    assert part.lost == ("other-articulation signs: 1, the first in bar 1",)


def test_repeats_and_sections_are_written_out() -> None:
    verse = "<direction><direction-type><rehearsal>verse</rehearsal></direction-type></direction>"
    back = '<barline location="right"><repeat direction="backward"/></barline>'
    part = _read(verse + _note("kick", 48) + back, _note("snare", 48))
    assert _struck(part) == [(0, Piece.KICK), (4, Piece.KICK), (8, Piece.SNARE)]
    assert [(s.name, s.first_bar, s.last_bar) for s in part.sections] == [("verse", 0, 0), ("verse", 1, 2)]


def test_bare_coda_signs_and_words() -> None:
    """D.C. al coda as programs write it that have no `sound` for it."""
    coda = "<direction><direction-type><coda/></direction-type></direction>"
    da_capo = "<direction><direction-type><words>D.C. al Coda</words></direction-type></direction>"
    part = _read(_note("kick", 48) + coda, _note("snare", 48) + da_capo, coda + _note("hat", 48))
    assert _struck(part) == [(0, Piece.KICK), (4, Piece.SNARE), (8, Piece.KICK), (12, Piece.HIHAT)]


def test_a_repeated_bar_sounds() -> None:
    style = '<attributes><measure-style><measure-repeat type="start">1</measure-repeat></measure-style></attributes>'
    part = _read(_note("kick", 48), style + _rest(48))
    assert _struck(part) == [(0, Piece.KICK), (4, Piece.KICK)]


def test_a_slash_is_no_stroke_but_where_an_instrument_says_which() -> None:
    slash = "<notehead>slash</notehead>"
    part = _read(_note("nobody", 24, slash) + _note("kick", 24, slash))
    assert _struck(part) == [(2, Piece.KICK)]
    assert part.lost == ("slashes, where drummers play as they like: 1, the first in bar 1",)


def test_title_and_author() -> None:
    head = (
        "<work><work-title>A Groove</work-title></work>"
        '<identification><creator type="composer">Somebody</creator></identification>'
    )
    part = _read(_note("kick", 48), head=head)
    assert (part.score.title, part.author) == ("A Groove", "Somebody")


def test_timewise_is_the_same_music() -> None:
    part = _score(_note("kick", 48), _note("snare", 48)).decode()
    opening, _, rest = part.partition('<part id="P1">')
    bars = rest.partition("</part>")[0].replace("</measure>", "</part></measure>")
    for number in "12":
        bars = bars.replace(f'<measure number="{number}">', f'<measure number="{number}"><part id="P1">')
    timewise = (opening + bars + "</score-timewise>").replace("score-partwise", "score-timewise")
    assert _struck(read_music_xml(timewise.encode(), "file")) == [(0, Piece.KICK), (4, Piece.SNARE)]


def test_compressed_files() -> None:
    container = (
        '<container><rootfiles><rootfile full-path="score.xml"/><rootfile full-path="s.pdf"'
        ' media-type="application/pdf"/></rootfiles></container>'
    )
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("META-INF/container.xml", container)
        archive.writestr("score.xml", _score(_note("kick", 48)))
    assert MUSIC_XML.recognises(data.getvalue())
    assert _struck(read_music_xml(data.getvalue(), "file.mxl")) == [(0, Piece.KICK)]


def test_notes_without_instruments_are_known_by_their_line() -> None:
    low = _note("unknown", 24).replace(">C</display-step><display-octave>5", ">F</display-step><display-octave>4")
    cross = _note("unknown", 24, "<notehead>x</notehead>").replace("<display-step>C", "<display-step>G")
    part = _read(low + cross)
    assert _struck(part) == [(0, Piece.KICK), (2, Piece.HIHAT)]


_HEADS_AND_PLACES = ((("G", 5), "x"), (("F", 4), "normal"), (("C", 5), "normal"), (("C", 5), "slashed"))
_GENERAL_MIDI = ((("F", 2), "normal"), (("C", 2), "normal"), (("D", 2), "normal"), (("A", 4), "normal"))


@pytest.mark.parametrize(
    ("pitches", "pieces"),
    [
        (_HEADS_AND_PLACES, [Piece.HIHAT, Piece.KICK, Piece.SNARE, Piece.SNARE]),
        (_GENERAL_MIDI, [Piece.FLOOR_TOM_2, Piece.KICK, Piece.SNARE, Piece.PERCUSSION]),
    ],
    ids=["lines of the staff", "numbers of General MIDI"],
)
@pytest.mark.parametrize(
    ("name", "sign"), [("P", "percussion"), ("Drum Set", "G")], ids=["known by its clef", "known by its name"]
)
def test_pitched_notes_of_a_kit(
    pitches: tuple[tuple[tuple[str, int], str], ...], pieces: list[Piece], name: str, sign: str
) -> None:
    """General MIDI 1 has its kick at C2, 36, its snare at D2, 38, its low floor tom at F2, 41, its cabasa at A4, 69."""
    notes = "".join(
        f"<note><pitch><step>{step}</step><octave>{octave}</octave></pitch><duration>1</duration>"
        f"<notehead>{head}</notehead></note>"
        for (step, octave), head in pitches
    )
    part = read_music_xml(
        f'<score-partwise><part-list><score-part id="P"><part-name>{name}</part-name></score-part></part-list>'
        f'<part id="P"><measure number="1"><attributes><divisions>1</divisions><clef><sign>{sign}</sign></clef>'
        f"</attributes>{notes}</measure></part></score-partwise>".encode(),
        "file.musicxml",
    )
    assert _struck(part) == list(enumerate(pieces))


@pytest.mark.parametrize(
    ("instrument", "strike"),
    [
        (XmlInstrument("Snare (Electric)", "", 40), NoteMeaning(Piece.SNARE)),
        (XmlInstrument("", "", 40), NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT)),
        (XmlInstrument("Rim Shot", "", 38), NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT)),
        (XmlInstrument("Side Stick", "", 37), NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK)),
        (XmlInstrument("Tom 5", "", 41), NoteMeaning(Piece.FLOOR_TOM_2)),
        (XmlInstrument("Hi-Hat Open", "", 46), NoteMeaning(Piece.HIHAT, Zone.BOW, openness=1.0)),
        (XmlInstrument("Ride (Bell)", "", None), NoteMeaning(Piece.RIDE, Zone.BELL)),
        (XmlInstrument("open high conga", "", 63), NoteMeaning(Piece.PERCUSSION)),
        (XmlInstrument("", "metal.cymbal.splash", None), NoteMeaning(Piece.SPLASH, Zone.EDGE)),
        (XmlInstrument("Pedal Hi-Hat", "", None), NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0)),
        (XmlInstrument("Mid Tom", "", None), NoteMeaning(Piece.TOM_2)),
        (XmlInstrument("Tom (medium)", "", None), NoteMeaning(Piece.TOM_2)),
        (XmlInstrument("Low-Mid Tom", "", None), NoteMeaning(Piece.TOM_3)),
        (XmlInstrument("Drumset", "", None), None),
    ],
)
def test_what_instruments_are(instrument: XmlInstrument, strike: NoteMeaning | None) -> None:
    """Names and numbers as MuseScore, Finale and Sibelius write them."""
    assert instrument.meaning() == strike


@pytest.mark.parametrize(
    ("data", "place", "fault"),
    [
        (b"<html/>", "line 1", "score-partwise"),
        (_score(_note("kick", 48)).replace(b"<duration>48", b"<duration>1e9"), "bar 1", "duration"),
        (_score(_note("kick", 48)).replace(b"<divisions>12", b"<divisions>0"), "bar 1", "divisions"),
        (_score(_note("kick", 48)).replace(b"<beats>4", b"<beats>0"), "bar 1", "beats"),
        (_score(_note("kick", 48)).replace(b"<duration>48", b"<duration>999999999"), "bar 1", "longer"),
        (_score(), "", "no part"),
        (_score(_rest(48)).replace(b"percussion", b"G"), "", "no drums"),
        (_PITCHED, "", "pitched"),
        (b"PK\x03\x04 no zip", "", "zip"),
    ],
)  # fmt: skip
def test_what_is_refused(data: bytes, place: str, fault: str) -> None:
    with pytest.raises(BadInput, match=fault) as caught:
        read_music_xml(data, "file.musicxml")
    assert (caught.value.source, caught.value.place) == ("file.musicxml", place)


@pytest.mark.skipif(not _SHARED.is_dir(), reason="no charts of others here")
def test_a_suite_of_another_program() -> None:
    """Lilypond's MusicXML test suite, 73a: percussion on two staves beside timpani, without any instrument."""
    part = read_part(_SHARED / "73a-Percussion.xml")
    cymbals = [(n.tick // PPQ, n.piece) for n in part.score if n.piece is not Piece.PERCUSSION]
    assert cymbals == [(0, Piece.CRASH_1), (3, Piece.CRASH_1), (4, Piece.CRASH_1)]
    assert len(part.score) == 6
    assert part.lost[0] == "the other parts: Timpani"
