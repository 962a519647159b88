"""What was played into a grid, against the cells that a teacher would click: ticks and milliseconds by hand.

Times are written in 960ths of a beat: at 120 beats a minute it lasts 500 ms, so that a millisecond is 1.92 of them and
a sixteenth 240.
"""

from dataclasses import replace

import pytest

from station.core.events import Hit
from station.core.pieces import Articulation, Dynamic, Limb, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.drills.editing.draft import Draft
from station.drills.editing.grid_page import PageBar, PageCell, PageGrid, PageLine
from station.drills.editing.lesson_edits import REST, LineAt, PlayedStroke, PlayIn, Quantise, SetStroke
from station.drills.editing.play_in import played_in
from station.drills.editing.played_hits import heard_dynamic, played_strokes
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_timing import GridTiming
from station.drills.grid.stroke_settings import Velocities
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoMap

U = PPQ // 960
MS = 1.92
SNARE, HATS, KICK = (LineAt(0, piece) for piece in (Piece.SNARE, Piece.HIHAT, Piece.KICK))
FOUR = MeterChange(0, 4, 4)


def _grid(bars: int = 2, meter: MeterChange = FOUR, lines: tuple[PageLine, ...] = ()) -> PageGrid:
    return PageGrid("", None, 1, (GridFrame(meter, PPQ),) * bars, lines)


def _timing(swing: Swing | None = None, meter: MeterChange = FOUR) -> GridTiming:
    return GridTiming(120.0, (meter,), PPQ, swing or Swing())


def _strokes(*at: float, line: LineAt = SNARE, letter: str = "o", velocity: int = 80) -> tuple[PlayedStroke, ...]:
    return tuple(PlayedStroke(line, tick * U, letter, velocity) for tick in at)


def _written(
    strokes: tuple[PlayedStroke, ...], quantise: Quantise | None = None, **about: object
) -> list[tuple[int, float, str]]:
    """Bar, tick and letter of what is written."""
    grid = about.pop("grid", None) or _grid()
    timing = about.pop("timing", None) or _timing()
    assert isinstance(grid, PageGrid)
    assert isinstance(timing, GridTiming)
    edit = PlayIn(0, 0, grid.bar_count - 1, strokes, quantise or Quantise(), over=True)
    return [(stroke.bar, stroke.tick / U, stroke.letter) for stroke in played_in(edit, grid, timing).edits]


def test_strokes_go_to_the_nearest_cell() -> None:
    assert _written(_strokes(0, 230, 590, 3840 + 960 - 100)) == [
        (0, 0, "o"),
        (0, 240, "o"),
        (0, 480, "o"),
        (1, 960, "o"),
    ]


def test_a_stroke_before_the_first_beat_or_before_the_end_falls_on_the_first_beat() -> None:
    assert _written(_strokes(-40)) == [(0, 0, "o")]
    assert _written(_strokes(2 * 3840 - 40)) == [(0, 0, "o")]
    assert _written(_strokes(-200)) == [(1, 3840 - 240, "o")]  # nearer to the last sixteenth of the loop


def test_three_cells_a_beat_are_triplets() -> None:
    assert _written(_strokes(0, 330, 630), Quantise(3)) == [(0, 0, "o"), (0, 320, "o"), (0, 640, "o")]


def test_five_cells_lie_where_the_reader_cuts_them() -> None:
    assert _written(_strokes(190, 390), Quantise(5)) == [(0, 192, "o"), (0, 384, "o")]


def test_swung_strokes_fall_on_their_straight_cells() -> None:
    """Swing 2: the off-beat eighth sounds at 640 of 960, the second sixteenth of the beat at half of that."""
    shuffle = _timing(Swing(2.0))
    assert _written(_strokes(0, 640, 960, 1600), Quantise(2), timing=shuffle) == [
        (0, 0, "o"),
        (0, 480, "o"),
        (0, 960, "o"),
        (0, 1440, "o"),
    ]
    assert _written(_strokes(600), Quantise(2), timing=_timing()) == [(0, 480, "o")]
    assert _written(_strokes(320, 640), Quantise(3), timing=shuffle) == [(0, 320, "o"), (0, 640, "o")]


def test_groups_have_their_cells_by_how_long_they_are() -> None:
    """7/8 as 3+2+2 at four cells a quarter: sixteenths throughout, 240 ticks each."""
    seven = MeterChange(0, 7, 8, (3, 2, 2))
    got = _written(_strokes(230, 1450, 3100), grid=_grid(1, seven), timing=_timing(meter=seven))
    assert got == [(0, 240, "o"), (0, 1440, "o"), (0, 3120, "o")]
    plain = MeterChange(0, 7, 8)
    assert _written(_strokes(2880, 3130), grid=_grid(1, plain), timing=_timing(meter=plain)) == [
        (0, 2880, "o"),
        (0, 3120, "o"),
    ]


def test_of_two_strokes_in_a_cell_the_louder_stays() -> None:
    soft, loud = _strokes(0, letter="x", line=HATS, velocity=60), _strokes(40, letter="X", line=HATS, velocity=110)
    assert _written(soft + loud) == [(0, 0, "X")]
    assert _written(_strokes(-70) + _strokes(70, letter="O", velocity=100)) == [(0, 0, "O")]  # 73 ms apart: no flam


def test_a_soft_stroke_just_before_a_louder_one_is_a_flam() -> None:
    grace = _strokes(960 - 30 * MS, letter="g", velocity=30)
    assert _written(grace + _strokes(960)) == [(0, 960, "f")]
    assert _written(grace + _strokes(960, letter="O", velocity=110)) == [(0, 960, "F")]


def test_a_grace_stroke_that_falls_into_the_cell_before_is_one_all_the_same() -> None:
    """Both strokes 35 ms early: the grace stroke lies 65 ms before the beat, the cell before begins at 62.5."""
    assert _written(_strokes(960 - 65 * MS, letter="g", velocity=30) + _strokes(960 - 35 * MS)) == [(0, 960, "f")]


def test_a_flam_over_the_start_of_the_loop() -> None:
    assert _written(_strokes(-25 * MS, letter="g", velocity=30) + _strokes(5 * MS)) == [(0, 0, "f")]


def test_two_soft_strokes_before_a_louder_one_are_a_drag() -> None:
    graces = _strokes(1920 - 110 * MS, 1920 - 55 * MS, letter="g", velocity=30)
    assert _written(graces + _strokes(1920, letter="O", velocity=110)) == [(0, 1920, "D")]


def test_no_flam_where_the_other_hand_is_busy() -> None:
    flam = _strokes(960 - 30 * MS, letter="g", velocity=30) + _strokes(960)
    hats = _strokes(960, line=HATS, letter="x")
    assert sorted(_written(flam + hats)) == [(0, 960, "o"), (0, 960, "x")]
    kick = _strokes(960, line=KICK)
    assert sorted(_written(flam + kick)) == [(0, 960, "f"), (0, 960, "o")]


def test_fast_written_strokes_on_their_cells_are_no_flams() -> None:
    """Thirty-seconds at 240: 31 ms apart, soft and loud, each exactly on its cell."""
    fast = replace(_timing(), tempo_bpm=240.0)
    strokes = _strokes(0, letter="g", velocity=30) + _strokes(120, letter="O", velocity=110)
    assert _written(strokes, Quantise(8), timing=fast) == [(0, 0, "g"), (0, 120, "O")]


def _late(strength: float, keeps: bool, *at: float) -> list[int]:
    edit = PlayIn(0, 0, 1, _strokes(*at), Quantise(4, strength, keeps), over=True)
    return [ms for _, ms in played_in(edit, _grid(), _timing()).late_ms]


def test_what_strength_leaves_is_kept_as_timing() -> None:
    """240 ± 38.4 ticks are 20 ms off."""
    assert _late(0.0, True, 240 - 38.4, 480 + 38.4) == [-20, 20]
    assert _late(0.5, True, 240 - 38.4, 480 + 38.4) == [-10, 10]
    assert _late(1.0, True, 240 - 38.4) == [0]
    assert _late(0.0, False, 240 - 38.4) == []
    assert _late(0.0, True, -38.4) == [-20]
    coarse = PlayIn(0, 0, 1, _strokes(960 + 400), Quantise(1, 0.0, True), over=True)
    assert [ms for _, ms in played_in(coarse, _grid(), _timing()).late_ms] == [60]  # 208 ms: as far as timing goes


def test_playing_in_takes_the_place_of_what_stood_there_or_goes_over_it() -> None:
    cells = tuple(PageCell(480 * i * U, 480 * U, letter) for i, letter in enumerate("o-o-o---"))
    bar, cycle = PageBar(cells), LineAt(0, Piece.COWBELL, cycle=0)
    grid = _grid(2, lines=(PageLine(SNARE, (bar, bar)), PageLine(cycle, (bar, bar))))
    edit = PlayIn(0, 1, 1, _strokes(960, letter="O"))
    assert played_in(edit, grid, _timing()).edits == (
        SetStroke(SNARE, 1, 0, REST),
        SetStroke(SNARE, 1, 1920 * U, REST),
        SetStroke(SNARE, 1, 960 * U, "O"),
    )
    assert played_in(replace(edit, over=True), grid, _timing()).edits == (SetStroke(SNARE, 1, 960 * U, "O"),)


def test_bars_that_are_not_there_are_left_out() -> None:
    assert played_in(PlayIn(0, 5, 9, _strokes(0)), _grid(2), _timing()).edits == ()
    assert played_in(PlayIn(0, 1, 9, _strokes(0), over=True), _grid(2), _timing()).edits == (
        SetStroke(SNARE, 1, 0, "o"),
    )


# --- from a kit -------------------------------------------------------------------------------------------------------


def _hit(piece: Piece, zone: Zone = Zone.HEAD, velocity: int = 80, **more: object) -> Hit:
    return Hit(500 * NS_PER_MS, piece, zone, velocity, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("hit", "letter"),
    [
        (_hit(Piece.SNARE), "o"),
        (_hit(Piece.SNARE, velocity=120), "O"),
        (_hit(Piece.SNARE, velocity=25), "g"),
        (_hit(Piece.SNARE, Zone.RIM, articulation=Articulation.CROSS_STICK), "x"),
        (_hit(Piece.SNARE, Zone.RIM, articulation=Articulation.RIM_SHOT), "r"),
        (_hit(Piece.HIHAT, Zone.BOW, openness=0.0), "x"),
        (_hit(Piece.HIHAT, Zone.BOW, openness=0.45), "h"),
        (_hit(Piece.HIHAT, Zone.BOW, openness=1.0, velocity=120), "O"),
        (_hit(Piece.HIHAT, Zone.EDGE), "e"),
        (_hit(Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=Articulation.CHICK, openness=0.0), "x"),
        (_hit(Piece.RIDE, Zone.BELL), "b"),
        (_hit(Piece.CRASH_1, Zone.EDGE), "x"),
    ],
)
def test_zones_openness_and_articulations_have_their_letters(hit: Hit, letter: str) -> None:
    (stroke,) = played_strokes([hit], 0, [], TempoMap.constant(120.0), Velocities())
    assert (stroke.letter, stroke.line, stroke.at_ticks) == (letter, LineAt(0, hit.piece), PPQ)
    assert stroke.velocity == hit.velocity


def test_a_stroke_goes_to_the_line_that_is_there() -> None:
    left, right = (LineAt(0, Piece.SNARE, limb) for limb in (Limb.LEFT_HAND, Limb.RIGHT_HAND))
    tempo, usual = TempoMap.constant(120.0), Velocities()

    def line_of(hit: Hit, *lines: LineAt) -> LineAt:
        return played_strokes([hit], 0, lines, tempo, usual)[0].line

    assert line_of(_hit(Piece.SNARE), left) == left
    assert line_of(_hit(Piece.SNARE, limb=Limb.RIGHT_HAND), left, right) == right
    assert line_of(_hit(Piece.SNARE), LineAt(1, Piece.SNARE), LineAt(0, Piece.SNARE, cycle=0)) == SNARE


def test_borders_lie_midway_and_a_hand_near_one_stays_what_it_was() -> None:
    """Ghost 32, normal 80, accent 116: the borders are 56 and 98, and 4 either way."""
    usual = Velocities()
    heard = [heard_dynamic(v, Piece.SNARE, usual, None) for v in (55, 56, 97, 98)]
    assert heard == [Dynamic.GHOST, Dynamic.NORMAL, Dynamic.NORMAL, Dynamic.ACCENT]
    assert heard_dynamic(59, Piece.SNARE, usual, Dynamic.GHOST) is Dynamic.GHOST
    assert heard_dynamic(60, Piece.SNARE, usual, Dynamic.GHOST) is Dynamic.NORMAL
    assert heard_dynamic(52, Piece.SNARE, usual, Dynamic.NORMAL) is Dynamic.NORMAL
    assert heard_dynamic(51, Piece.SNARE, usual, Dynamic.NORMAL) is Dynamic.GHOST
    assert heard_dynamic(94, Piece.SNARE, usual, Dynamic.ACCENT) is Dynamic.ACCENT
    assert heard_dynamic(93, Piece.SNARE, usual, Dynamic.ACCENT) is Dynamic.NORMAL


def test_each_grid_has_its_own_tempo_swing_and_dynamics() -> None:
    text = """tempo_bpm = 90
dynamics = {ghost = 20}
[[grid]]
name = "A"
snare = "not a line at all"
[[grid]]
name = "B"
tempo_bpm = 120
swing_ratio = 2
snare = "o"
[[grid]]
like = "A"
bars = "no number"
"""
    first, second, third = Draft.of(text).timings
    assert [timing.tempo_bpm for timing in (first, second, third)] == [90, 120, 90]
    assert [timing.swing.ratio for timing in (first, second, third)] == [1, 2, 1]
    assert first.velocities.of(Piece.SNARE, Dynamic.GHOST) == 20
