"""Each planted habit, with nothing else: expected sizes are the specification's own, or worked out beside the test."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music import passages
from station.music.score import Score
from station.simulation.student_spec import FAULTS, parse_spec
from station.simulation.virtual_student import VirtualPerformance, play
from tests.fakes import scores


def _shift_ms(played: VirtualPerformance) -> NDArray[np.float64]:
    """Asynchrony of every row, grace strokes included; nothing is missed here."""
    at_ns = played.performance.hits["at_ns"][played.truth.hit_of_note]
    return np.asarray((at_ns - played.score.onset_ns) / NS_PER_MS)


def _level_db(played: VirtualPerformance) -> NDArray[np.float64]:
    """Level of every row against what is written, by the formula of HUMANS ("Velocity and ears")."""
    struck = played.performance.hits["velocity"][played.truth.hit_of_note].astype(float)
    return np.asarray(40 * np.log10(struck / played.score.notes["velocity"]))


def _assert_only(values: NDArray[np.float64], rows: NDArray[np.bool_], size: float, atol: float = 1e-5) -> None:
    assert rows.any()
    np.testing.assert_allclose(values[rows], size, atol=atol)
    np.testing.assert_allclose(values[~rows], 0.0, atol=1e-5)


def test_without_a_fault_a_bare_student_plays_what_is_written() -> None:
    score = scores.rock_beat(4)
    played = play(score, parse_spec("seed=1"))
    assert not _shift_ms(played).any()
    assert (played.performance.hits["velocity"][played.truth.hit_of_note] == score.notes["velocity"]).all()


def test_late_kick() -> None:
    score = scores.rock_beat(2)
    _assert_only(_shift_ms(play(score, parse_spec("fault=late_kick:20"))), score.notes["piece"] == Piece.KICK, 20.0)


def test_slow_hihat_foot() -> None:
    score = scores.swing_ride(2)
    rows = score.notes["piece"] == Piece.HIHAT_PEDAL
    _assert_only(_shift_ms(play(score, parse_spec("fault=slow_hihat_foot:30"))), rows, 30.0)


def test_rush_fills_runs_ahead_and_comes_back() -> None:
    """Eight slots of one fill: the n-th is ahead by 14·n/4.5, 4.5 being the mean of 1 … 8."""
    score = scores.beat_and_fill(2)
    shift = _shift_ms(play(score, parse_spec("fault=rush_fills:14")))
    rows = passages.fills(score)
    np.testing.assert_allclose(shift[rows], np.tile([-14 * n / 4.5 for n in range(1, 9)], 2), atol=1e-5)
    assert shift[rows].mean() == pytest.approx(-14)
    assert not shift[~rows].any()


def test_drag_slow() -> None:
    score = scores.swing_ride(2)  # waits of a beat, ⅔ and ⅓ of it: the median is ⅔
    notes = score.notes
    rows = np.isin(notes["tick"] % (4 * PPQ), (PPQ, 3 * PPQ))
    _assert_only(_shift_ms(play(score, parse_spec("fault=drag_slow:25"))), rows, 25.0)


def test_uneven_doubles() -> None:
    score = scores.double_strokes(2)
    rows = np.arange(len(score)) % 2 == 1
    _assert_only(_shift_ms(play(score, parse_spec("fault=uneven_doubles:18"))), rows, -18.0)


def test_wide_flams_moves_the_grace_strokes_alone() -> None:
    score = scores.flams(2)
    _assert_only(_shift_ms(play(score, parse_spec("fault=wide_flams:40"))), score.is_grace, -40.0)


def test_straight_swing_lessens_the_ratio() -> None:
    """Written 2:1 at 120 bpm: 333.3 ms into the beat. Played 1.5:1 that is 300 ms."""
    score = scores.swing_ride(2)
    shift = _shift_ms(play(score, parse_spec("fault=straight_swing:0.5")))
    _assert_only(shift, passages.swung(score).flags, 300 - 1000 / 3, atol=1e-3)


def test_straight_swing_ends_at_straight() -> None:
    score = scores.swing_ride(1)
    shift = _shift_ms(play(score, parse_spec("fault=straight_swing:2.5")))
    assert shift.min() == pytest.approx(250 - 1000 / 3, abs=1e-3)


def test_weak_left() -> None:
    """6 dB softer is a velocity of 10^(−6/40) = 0.708 of what is written; whole velocities are off by 0.3 dB here."""
    score = scores.double_strokes(2)
    level = _level_db(play(score, parse_spec("fault=weak_left:6")))
    _assert_only(level, score.notes["limb"] == Limb.LEFT_HAND, -6.0, atol=0.3)


CRAFT = {"open_hats", "late_grabs", "short_buzz"}
"""Habits beyond time and loudness: `test_student_craft`."""


def test_loud_ghosts_and_flat_accents() -> None:
    score = scores.rock_beat(2)
    level = _level_db(play(score, parse_spec("fault=loud_ghosts:8,fault=flat_accents:5")))
    np.testing.assert_allclose(level[score.notes["dynamic"] == Dynamic.GHOST], 8.0, atol=0.3)
    np.testing.assert_allclose(level[score.notes["dynamic"] == Dynamic.ACCENT], -5.0, atol=0.3)
    assert not level[score.notes["dynamic"] == Dynamic.NORMAL].any()


@pytest.mark.parametrize("name", sorted(set(FAULTS) - CRAFT))
def test_a_habit_is_seen_through_human_noise(name: str) -> None:
    """Played twice with one seed, once with the habit, the strokes concerned differ by its size and no other does."""
    size = {"ms": 30.0, "dB": 6.0, "ratio": 0.5}[FAULTS[name].unit]
    score = _exercise(name)
    human = "seed=4,sd_ms=10,velocity_sd=0"
    plain, habitual = (play(score, parse_spec(text)) for text in (human, f"{human},fault={name}:{size}"))
    change = (
        _level_db(habitual) - _level_db(plain) if FAULTS[name].unit == "dB" else _shift_ms(habitual) - _shift_ms(plain)
    )
    assert np.count_nonzero(np.abs(change) > 1e-6) == habitual.habit_strokes[name] > 0
    assert {"fault": name, "size": size, "unit": FAULTS[name].unit, "strokes": habitual.habit_strokes[name]} in (
        habitual.truth_document()["faults"]  # type: ignore[operator]
    )


def _exercise(name: str) -> Score:
    return {
        "rush_fills": scores.beat_and_fill(4),
        "drag_slow": scores.swing_ride(8),
        "straight_swing": scores.swing_ride(8),
        "slow_hihat_foot": scores.swing_ride(8),
        "uneven_doubles": scores.double_strokes(4),
        "weak_left": scores.double_strokes(4),
        "wide_flams": scores.flams(8),
    }.get(name, scores.rock_beat(8))
