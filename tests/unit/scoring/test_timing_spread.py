"""Means, spreads and their intervals, by hand and against scipy."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.scoring.analysis.timing_spread import slope, spread, standard_error
from station.scoring.matching.slow_drift import local_trend, robust_sd
from tests.fakes.autoregression import autoregression

Floats = NDArray[np.float64]


def test_spread_by_hand() -> None:
    """−10, 0, 10, 20: mean 5, sum of squares 500, SD √(500/3)."""
    summed = spread(np.array([-10.0, 0.0, 10.0, 20.0]), np.arange(4))
    assert (summed.count, summed.mean_ms) == (4, 5.0)
    assert summed.sd_ms == pytest.approx((500 / 3) ** 0.5)


def test_no_data_is_none() -> None:
    empty = spread(np.array([]), np.array([], np.int64))
    assert (empty.count, empty.mean_ms, empty.sd_ms, empty.ci_ms) == (0, None, None, None)
    one = spread(np.array([3.0]), np.array([7]))
    assert (one.count, one.mean_ms, one.sd_ms, one.ci_ms) == (1, 3.0, None, None)


def test_strokes_of_one_slot_count_once() -> None:
    """Sixteen strokes in seven slots are no more than seven moments: too few for an interval."""
    slots = np.repeat(np.arange(7), [3, 3, 2, 2, 2, 2, 2])
    assert standard_error(np.arange(16.0), slots) is None
    assert spread(np.arange(16.0), slots).ci_ms is None


def test_what_alternates_has_a_sure_mean() -> None:
    """±3 in turn has the mean 0 or 3/16, by where it stops: nearer than 16 independent values tell, √(9.6/16)."""
    error = standard_error(np.tile([3.0, -3.0], 8), np.arange(16))
    assert error is not None
    assert error.value < 0.77 / 2


def share_held(values: Floats, slots: NDArray[np.int64], truth: float = 0.0) -> float:
    """The share of the rows' intervals that hold the true mean."""
    ends = [spread(row, slots).ci_ms for row in values]
    return float(np.mean([end is not None and end[0] <= truth <= end[1] for end in ends]))


@pytest.mark.parametrize(("rho", "slots"), [(0.0, 20), (0.0, 300), (0.3, 40), (0.6, 90), (0.8, 180), (0.8, 600)])
def test_intervals_hold_the_truth_as_often_as_they_say(rho: float, slots: int) -> None:
    """Twenty independent slots' worth or more, n(1 − ρ)/(1 + ρ) ≥ 20; of 1500 rows the binomial SD is 0.6 %."""
    assert 0.93 <= share_held(autoregression(1500, slots, rho, 5), np.arange(slots)) <= 0.97


@pytest.mark.parametrize(("rho", "slots"), [(0.0, 8), (0.3, 8), (0.6, 12), (0.6, 40), (0.8, 16), (0.8, 64)])
def test_few_slots_have_wide_intervals_rather_than_wrong_ones(rho: float, slots: int) -> None:
    """Less than twenty independent slots' worth: at least 93 %, less two binomial SDs of 1500 rows."""
    assert share_held(autoregression(1500, slots, rho, 6), np.arange(slots)) >= 0.93 - 2 * 0.006


def test_intervals_of_slots_with_several_strokes() -> None:
    """One to three strokes a slot: half of the variance is the slot's (lag-1 .6), half each stroke's own."""
    rng = np.random.default_rng(7)
    slots = np.repeat(np.arange(120), rng.integers(1, 4, 120))
    values = autoregression(1500, 120, 0.6, 8)[:, slots] + rng.normal(0, 1, (1500, len(slots)))
    assert 0.93 <= share_held(values, slots) <= 0.97


def test_intervals_of_a_clock_and_a_hand() -> None:
    """Asynchronies after Wing & Kristofferson and Vorberg & Wing: a quarter of each error is taken back.

    σ_C 15 ms and σ_M 6 ms (HUMANS) at 180 strokes: 27 independent ones' worth.
    """
    rng = np.random.default_rng(9)
    clock, hand = rng.normal(0, 15, (1200, 240)), rng.normal(0, 6, (1200, 240))
    behind, off = np.zeros(1200), np.empty((1200, 240))
    for k in range(240):
        off[:, k] = behind + hand[:, k]
        behind = behind - 0.25 * off[:, k] + clock[:, k]
    assert 0.93 <= share_held(off[:, 60:], np.arange(180)) <= 0.97


def test_slope_by_hand() -> None:
    """Through (0, 1), (1, 3), (2, 2): deviations −1, 0, 1 times −1, 1, 0 make 1, over 2."""
    found = slope(np.arange(3.0), np.array([1.0, 3.0, 2.0]))
    assert found is not None
    assert found.value == pytest.approx(0.5)
    assert found.ci is None
    assert slope(np.ones(9), np.arange(9.0)) is None


@pytest.mark.parametrize(("rho", "slots"), [(0.0, 12), (0.0, 64), (0.6, 24), (0.6, 90), (0.8, 180)])
def test_intervals_of_a_slope(rho: float, slots: int) -> None:
    """Beside a straight line deviations that hang together; few of them may be surer than they say."""
    at = np.arange(float(slots))
    found = [slope(at, 0.1 * at + row) for row in autoregression(1200, slots, rho, 12)]
    held = [one is not None and one.ci is not None and one.ci[0] <= 0.1 <= one.ci[1] for one in found]
    assert 0.93 <= np.mean(held) <= 0.985


def test_robust_sd_of_normal_values() -> None:
    values = np.random.default_rng(2).normal(0, 4, 20_000)
    assert robust_sd(values) == pytest.approx(4, rel=0.03)
    assert robust_sd(values[:3]) is None


def test_trend_follows_a_line_exactly_and_ignores_one_outlier() -> None:
    times = np.arange(60.0)
    values = 2.0 + 0.5 * times
    spoilt = values.copy()
    spoilt[30] += 30
    assert local_trend(times, values, 8, 1.0) == pytest.approx(values)
    assert local_trend(times, spoilt, 8, 1.0)[np.arange(60) != 30] == pytest.approx(
        values[np.arange(60) != 30], abs=1e-6
    )
