""".chart files written by hand from the documentation (GuitarGame_ChartFormats); what they mean is read off by hand."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.clone_hero.clone_hero_format import read_chart_part
from station.music.formats.format_table import read_part

_SHARED = Path("../shared/data/charts/clonehero/test.chart")


def _chart(
    track: str,
    sync: str = "0 = TS 4\n0 = B 120000",
    events: str = "",
    name: str = "ExpertDrums",
    song: str = 'Name = "Song"\nArtist = "Band"\nCharter = "Ann"\nResolution = 192',
) -> str:
    parts = {"Song": song, "SyncTrack": sync, "Events": events, name: track}
    return "".join(f"[{head}]\n{{\n{body}\n}}\n" for head, body in parts.items())


def _read(text: str, encoding: str = "utf-8") -> DrumPart:
    return read_chart_part(text.encode(encoding), "song.chart")


def _strokes(part: DrumPart) -> list[tuple[float, Piece]]:
    return [(n.tick / PPQ, n.piece) for n in part.score if not n.lead_ms]


def test_lanes_are_toms_unless_a_cymbal_is_marked() -> None:
    lanes = ["0 = N 0 0", *(f"{192 * i} = N {i} 0" for i in (1, 2, 3, 4))]
    marked = [line for i in (2, 3, 4) for line in (f"{192 * (i + 3)} = N {i} 0", f"{192 * (i + 3)} = N {i + 64} 0")]
    part = _read(_chart("\n".join([*lanes, *marked])))
    drums = [Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1]
    cymbals = [Piece.HIHAT, Piece.RIDE, Piece.CRASH_1]
    assert _strokes(part) == [(float(i), piece) for i, piece in enumerate([*drums, *cymbals])]
    assert (part.score.title, part.author, part.about) == ("Song", "Band", "Charted by Ann.")
    assert not part.lost
    assert part.score.end_tick == 8 * PPQ


def test_ghosts_accents_and_flams_are_of_their_notes() -> None:
    part = _read(_chart("0 = N 1 0\n0 = N 40 0\n192 = N 1 0\n192 = N 34 0\n192 = N 2 0\n384 = N 1 0\n384 = N 109 0"))
    main = [n for n in part.score if not n.lead_ms]
    assert [(n.piece, n.dynamic, n.velocity) for n in main] == [
        (Piece.SNARE, Dynamic.GHOST, 32),
        (Piece.SNARE, Dynamic.ACCENT, 116),
        (Piece.TOM_1, Dynamic.NORMAL, 80),
        (Piece.SNARE, Dynamic.NORMAL, 80),
    ]
    assert [(n.tick, n.ornament, n.dynamic) for n in part.score if n.lead_ms] == [
        (2 * PPQ, Ornament.FLAM, Dynamic.GHOST)
    ]
    assert main[-1].ornament is Ornament.FLAM


def test_the_second_kick_is_the_left_foots() -> None:
    part = _read(_chart("0 = N 0 0\n48 = N 32 0"))
    assert [(n.tick, n.piece, n.limb) for n in part.score] == [
        (0, Piece.KICK, Limb.UNKNOWN),
        (PPQ // 4, Piece.KICK, Limb.LEFT_FOOT),
    ]


def test_five_lanes_are_two_cymbals_and_three_drums() -> None:
    part = _read(_chart("\n".join(f"{192 * i} = N {i} 0" for i in range(6))))
    kit = [Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.TOM_2, Piece.CRASH_1, Piece.FLOOR_TOM_1]
    assert _strokes(part) == [(float(i), piece) for i, piece in enumerate(kit)]


def test_a_long_note_of_five_lanes_and_a_roll_lane_over_one_note_are_buzz_rolls() -> None:
    long = _read(_chart("0 = N 1 384\n768 = N 5 0")).score[0]
    lane = _read(_chart("0 = N 1 0\n0 = N 0 0\n0 = S 65 384\n384 = N 1 0")).score[1]
    for buzz in (long, lane):
        assert (buzz.piece, buzz.articulation, buzz.duration_ticks) == (Piece.SNARE, Articulation.BUZZ, 2 * PPQ)


def test_a_roll_lane_over_several_notes_leaves_them_and_says_so() -> None:
    part = _read(_chart("0 = N 1 0\n48 = N 1 0\n96 = N 1 0\n0 = S 65 144"))
    assert [n.articulation for n in part.score] == [Articulation.NORMAL] * 3
    assert part.lost == ("1 roll lanes over several notes: the notes stand as charted",)


def test_a_roll_lane_over_two_lanes_is_no_buzz_roll_of_the_first() -> None:
    """A double roll alternates between two lanes (S 66), one note in each of which may be all that is charted."""
    part = _read(_chart("0 = N 1 0\n96 = N 3 0\n0 = S 66 192"))
    assert [(n.piece, n.articulation) for n in part.score] == [
        (Piece.SNARE, Articulation.NORMAL),
        (Piece.TOM_2, Articulation.NORMAL),
    ]
    assert part.lost[-1:] == ("1 roll lanes over several notes: the notes stand as charted",)


def test_a_roll_lane_over_a_cymbal_is_one_stroke_and_says_so() -> None:
    part = _read(_chart("0 = N 4 0\n0 = N 68 0\n0 = S 65 192"))
    assert [(n.piece, n.articulation) for n in part.score] == [(Piece.CRASH_1, Articulation.NORMAL)]
    assert part.lost == ("rolls on cymbals and the kick: one stroke stands for each",)


@pytest.mark.parametrize("event", ['E "mix 3 drums0d"', "E mix_3_drums0d", 'E "[mix 3 drums0d]"'])
def test_a_disco_flip_puts_snare_and_hi_hat_right(event: str) -> None:
    notes = "0 = N 2 0\n0 = N 66 0\n192 = N 1 0\n384 = N 2 0\n384 = N 66 0"
    part = _read(_chart(f'0 = {event}\n{notes}\n384 = E "mix 3 drums0"\n0 = E "mix 2 drums0"'))
    assert _strokes(part) == [(0, Piece.SNARE), (1, Piece.HIHAT), (2, Piece.HIHAT)]


def test_tempos_meters_and_sections() -> None:
    sync = "0 = TS 6 3\n0 = B 90500\n576 = TS 3\n576 = A 1000\n576 = B 120000"
    events = '0 = E "section Intro A"\n570 = E "[prc_chorus]"\n1152 = E "end"\n600 = E "lyric x"'
    part = _read(_chart("0 = N 1 0", sync, events))
    assert [(t.tick, t.us_per_quarter) for t in part.score.tempo_map.tempos] == [(0, 662983), (3 * PPQ, 500000)]
    assert [str(m) for m in part.score.tempo_map.meters] == ["6/8", "3/4"]
    assert part.beat_ticks == 3 * PPQ // 2
    assert part.sections == (PartSection("Intro A", 0, 0), PartSection("chorus", 1, 1))
    assert part.score.end_tick == 6 * PPQ


def test_the_fullest_difficulty_is_read_and_named() -> None:
    part = _read(_chart("0 = N 1 0", name="HardDrums"))
    assert len(part.score) == 1
    assert "no notes for Expert: this is Hard" in part.lost


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_every_encoding_and_line_end_of_editors_reads(encoding: str) -> None:
    song = 'Name = "Für "Elise""\nResolution=480'
    part = _read(_chart("  0 = N 0 0", song=song).replace("\n", "\r\n"), encoding)
    assert part.score.title == 'Für "Elise"'
    assert len(part.score) == 1


def test_lines_that_say_nothing_are_counted() -> None:
    part = _read(_chart("0\x1f = N 0 0\n// a comment\n-5 = N 1 0\n99999999999999999999 = N 1 0\n192 = N 77 0\n192 = X"))
    assert len(part.score) == 1
    assert any(line.startswith("3 lines of the drums that say nothing, the first is line ") for line in part.lost)


def test_a_chart_without_cymbal_marks_says_so() -> None:
    assert any("no cymbal is marked" in line for line in _read(_chart("0 = N 2 0")).lost)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "song.chart: line 1: not a .chart file"),
        ("\0\1\2", "not a .chart file"),
        (_chart("0 = N 1 0", name="ExpertSingle"), r"no drum notes: .* found \[Song\]"),
        (_chart("0 = N 1 0", song="Resolution = 0"), "a Resolution of '0'"),
        (_chart("0 = N 1 0", sync="0 = B 0"), "line 10: a tempo of '0'"),
        (_chart("0 = N 1 0", sync="0 = TS 0"), "a meter of '0'"),
        (_chart("0 = N 1 0", sync="0 = TS 4 900"), "a meter of '4 900'"),
        (_chart("99999999 = N 1 0"), "more than 20000 quarter notes"),
        (_chart("\n".join(f"{i} = N 1 0" for i in range(40_100))), "more than 40000 drum notes"),
    ],
)
def test_what_is_no_chart_is_refused_with_its_place(text: str, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        _read(text)


def test_yargs_feature_check_reads_as_it_says() -> None:
    """Counted in the file by `grep`: 4 four-lane drums and cymbals in its first two bars of drums."""
    if not _SHARED.exists():
        pytest.skip(f"{_SHARED} is not here")
    part = read_part(_SHARED)
    assert (part.score.title, part.author) == (".chart Feature Check", "Test")
    first = [(n.tick * 480 // PPQ, n.piece) for n in part.score][:9]
    pieces = [
        *(Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1),
        *(Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.KICK, Piece.KICK),
    ]
    assert first == [(3840 + 240 * i, piece) for i, piece in enumerate(pieces)]
    assert [str(m) for m in part.score.tempo_map.meters] == ["4/4", "5/8", "3/16", "4/4"]
    assert part.sections[0] == PartSection("Section 1", 4, 7)
