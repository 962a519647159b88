"""Cycles run on over bars and repetitions: ticks by hand, an eighth is 53760."""

import pytest

from station.core.pieces import Limb, Ornament, Piece
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, WHOLE, faults


def lesson(text: str) -> Lesson:
    reading = parse_lesson('title = "T"\ntempo_bpm = 60\n' + text, "t", "t")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def struck(found: Lesson, piece: Piece) -> list[int]:
    return [n.tick for n in found.score if n.piece is piece]


FIVE_OVER_FOUR = """
[[grid]]
times = 2
kick = "oooo | %"
[[grid.cycle]]
meter = "5/8"
cowbell = "x--x-"
"""


def test_five_eighths_run_over_four_bars_of_four() -> None:
    """32 eighths hold six rounds of five and two eighths of a seventh, of which the first is struck."""
    found = lesson(FIVE_OVER_FOUR)
    rounds = [5 * EIGHTH * i for i in range(7)]
    assert struck(found, Piece.COWBELL) == [t for r in rounds for t in (r, r + 3 * EIGHTH)][:13]
    assert struck(found, Piece.KICK) == [i * QUARTER for i in range(16)]
    assert found.score.end_tick == 4 * WHOLE
    assert [str(m) for m in found.score.tempo_map.meters] == ["4/4"]


def test_a_cycle_begins_anew_with_each_grid() -> None:
    found = lesson(FIVE_OVER_FOUR + FIVE_OVER_FOUR)
    first = [t for t in struck(found, Piece.COWBELL) if t < 4 * WHOLE]
    assert [t - 4 * WHOLE for t in struck(found, Piece.COWBELL) if t >= 4 * WHOLE] == first


def test_a_grid_of_cycles_alone_says_its_bars() -> None:
    found = lesson(
        '[grid]\nbars = 3\n[[grid.cycle]]\nmeter = "3/4"\nsnare = "o--"\n[[grid.cycle]]\nmeter = "5/4"\nkick = "o"'
    )
    assert found.score.bar_count == 3
    assert struck(found, Piece.SNARE) == [3 * QUARTER * i for i in range(4)]
    assert struck(found, Piece.KICK) == [0, 5 * QUARTER, 10 * QUARTER]


def test_a_round_may_have_several_bars_and_a_sticking() -> None:
    found = lesson('[grid]\nbars = 2\n[[grid.cycle]]\nmeter = "3/8"\nsnare = "oo- | o--"\nsticking = "RL- | R--"')
    assert [(n.tick // EIGHTH, n.limb) for n in found.score] == [
        *((0, Limb.RIGHT_HAND), (1, Limb.LEFT_HAND), (3, Limb.RIGHT_HAND)),
        *((6, Limb.RIGHT_HAND), (7, Limb.LEFT_HAND), (9, Limb.RIGHT_HAND)),
        *((12, Limb.RIGHT_HAND), (13, Limb.LEFT_HAND), (15, Limb.RIGHT_HAND)),
    ]


def test_a_cycle_swings_with_the_bars_of_its_grid() -> None:
    """Every other eighth of the 4/4 is late by a sixth of a quarter, whichever eighth of the cycle it is."""
    found = lesson('swing_ratio = 2\n[grid]\nbars = 1\n[[grid.cycle]]\nmeter = "3/8"\nride = "x--"')
    assert struck(found, Piece.RIDE) == [0, QUARTER + 71680, 3 * QUARTER]


def test_a_cycle_is_cut_off_at_the_end() -> None:
    """Of 16 sixteenths the fourth round of five holds one: the buzz ends with the bar, the diddle has one stroke."""
    buzz = lesson('[grid]\nbars = 1\n[[grid.cycle]]\nmeter = "5/16"\nsnare = "b~~~~"')
    assert [n.duration_ticks // SIXTEENTH for n in buzz.score] == [5, 5, 5, 1]
    diddle = lesson('[grid]\nbars = 1\n[[grid.cycle]]\nmeter = "7/8"\nsnare = "t"')
    assert [(n.tick, n.ornament) for n in diddle.score] == [
        (0, Ornament.DIDDLE),
        (7 * EIGHTH // 2, Ornament.DIDDLE),
        (7 * EIGHTH, Ornament.NONE),
    ]


def test_loudness_reaches_a_cycle_in_every_repetition() -> None:
    found = lesson('[grid]\nbars = 1\ntimes = 2\nloudness = "p-ff"\n[[grid.cycle]]\nmeter = "3/4"\nkick = "ooo"')
    assert [n.velocity for n in found.score] == [57, 57, 113, 113] * 2


HEAD = 'title = "T"\n[[grid]]\nsnare = "oooo"\n[[grid]]\n'


@pytest.mark.parametrize(
    ("grid", "line", "column", "words"),
    [
        ('kick = "o"\n[[grid.cycle]]\nsnare = "o"', 6, 1, "meter is missing"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/8"', 6, 1, "no line to play"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/8"\nsnare = "ooooq"', 8, 14, "'q' is no letter"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/8"\nsnare = "oooo"', 8, 10, "4 cells do not fill a 5/8 bar"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/9"\nsnare = "ooooo"', 7, 9, "expected a meter"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/8"\nsnair = "ooooo"', 8, 1, "no such line: snair"),
        ('kick = "o"\n[[grid.cycle]]\nmeter = "5/8"\nsnare = "o"\nsticking = "B"', 9, 13, "B says both hands"),
        (
            'kick = "o"\n[[grid.cycle]]\nmeter = "1/4"\nride = "x"\n[[grid.cycle]]\nmeter = "2/4"\nsnare = "ooo"',
            11,
            10,
            "3 cells do not fill a 2/4 bar",
        ),
        (
            '[[grid.cycle]]\nmeter = "5/8"\nsnare = "ooooo"',
            4,
            1,
            "bars is missing; expected how many bars the cycles run",
        ),
        ('bars = 2\nkick = "o | o | o"', 5, 8, "2, but the lines have 3"),
    ],
)
def test_each_fault_is_told_once_at_its_place(grid: str, line: int, column: int, words: str) -> None:
    (fault,) = faults(HEAD + grid)
    assert (fault.line, fault.column) == (line, column), fault
    assert words in fault.text
