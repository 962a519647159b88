"""Means, spreads and their intervals, by hand and against scipy."""

import numpy as np
import pytest

from station.scoring.analysis.timing_spread import spread, standard_error
from station.scoring.matching.slow_drift import local_trend, robust_sd


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
    """Eight strokes in three slots are no more than three moments: too few for an interval."""
    assert standard_error(np.arange(8.0), np.array([0, 0, 0, 1, 1, 1, 2, 2])) is None


def test_standard_error_of_alternating_values_by_hand() -> None:
    """±3 in turn, 16 slots: mean 0, variance 16·9/15; a negative lag-1 is not believed: √(9.6/16)."""
    error = standard_error(np.tile([3.0, -3.0], 8), np.arange(16))
    assert error is not None
    assert error.value == pytest.approx((9.6 / 16) ** 0.5)
    assert error.freedom == pytest.approx(15)


@pytest.mark.parametrize("rho", [0.0, 0.3])
def test_intervals_hold_the_truth_as_often_as_they_say(rho: float) -> None:
    """2000 rows of an autoregression with mean 0: 95 % of the intervals hold it.

    The binomial SD is 0.5 %, and the bias of a lag-1 from 80 values costs up to 2 %.
    """
    rng = np.random.default_rng(5)
    held = 0
    for _ in range(2000):
        noise = rng.normal(0, 1, 80)
        values = np.empty(80)
        values[0] = noise[0]
        for k in range(1, 80):
            values[k] = rho * values[k - 1] + (1 - rho * rho) ** 0.5 * noise[k]
        ends = spread(values, np.arange(80)).ci_ms
        assert ends is not None
        held += ends[0] <= 0 <= ends[1]
    assert 0.915 <= held / 2000 <= 0.985


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
