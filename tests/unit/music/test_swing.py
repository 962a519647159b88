"""Ticks by hand: a pair of eighths is a quarter of 107520 ticks, its offbeat at ratio r lies at r/(r+1) of it."""

import pytest

from station.music.swing import Swing
from station.music.tempo import MeterChange
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, TRIPLET, notes, ticks


@pytest.mark.parametrize(
    ("ratio", "offbeat"),
    [(1.0, 53760), (1.5, 64512), (2.0, 71680), (3.0, 80640), (1.4, 62720), (1.8, 69120)],
)
def test_offbeats_lie_exactly_at_the_ratio(ratio: float, offbeat: int) -> None:
    found = ticks('hihat = "xxxx xxxx"', f"swing_ratio = {ratio}")
    assert found[:4] == [0, offbeat, QUARTER, QUARTER + offbeat]


def test_sixteenths_under_swung_eighths_move_in_proportion() -> None:
    found = ticks('hihat = "xxxx ---- ---- ----"', "swing_ratio = 2.0")
    assert found == [0, TRIPLET, 2 * TRIPLET, 2 * TRIPLET + TRIPLET // 2]


def test_sixteenths_swing_alone() -> None:
    found = ticks('hihat = "xxxx ---- ---- ----"', 'swing_ratio = 2.0\nswing_unit = "1/16"')
    assert found == [0, EIGHTH * 2 // 3, EIGHTH, EIGHTH + EIGHTH * 2 // 3]


def test_triplets_and_parentheses_stay() -> None:
    assert ticks('snare = "ooo --- --- ---"', "swing_ratio = 2.0") == [0, TRIPLET, 2 * TRIPLET]
    assert ticks('snare = "(oo) x- -- --"', "swing_ratio = 2.0") == [0, EIGHTH, QUARTER]


def test_swung_eighths_of_ratio_two_are_triplets() -> None:
    swung = ticks('snare = "oo oo oo oo"', "swing_ratio = 2.0")
    assert swung == ticks('snare = "o-o o-o o-o o-o"')


def test_a_bar_that_pairs_do_not_fill_ends_straight() -> None:
    found = ticks('hihat = "xxxxxxx"', 'meter = "7/8"\nswing_ratio = 2.0')
    assert found[-2:] == [2 * QUARTER + 71680, 3 * QUARTER]


def test_a_diddle_in_a_swung_cell_shares_it() -> None:
    found = ticks('snare = "-t -- -- --"', "swing_ratio = 2.0")
    assert found == [71680, 71680 + (QUARTER - 71680) // 2]


def test_a_buzz_lasts_to_the_swung_end() -> None:
    (note,) = notes('snare = "b- -- -- --"', "swing_ratio = 2.0")
    assert note.duration_ticks == 71680


def test_ratio_as_written_not_as_binary_fraction() -> None:
    assert Swing(1.1).swung(EIGHTH, MeterChange(0, 4, 4)) == 56320  # 107520 * 11/21
    assert Swing(1.1).swung(SIXTEENTH, MeterChange(0, 4, 4)) == 28160
