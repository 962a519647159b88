"""Trends and medians. Expected values are by hand, or numpy's and a plain least-squares fit's."""

import numpy as np
import pytest

from station.scoring.matching.slow_drift import half_width, local_trend, median, robust_sd


@pytest.mark.parametrize("count", [1, 2, 3, 10, 11])
def test_median_is_numpys(count: int) -> None:
    values = np.random.default_rng(count).normal(size=count)
    assert median(values) == float(np.median(values))


def test_robust_sd_of_a_normal_sample_with_a_tenth_astray() -> None:
    values = np.random.default_rng(0).normal(0, 2, 4000)
    values[:400] = 100
    assert robust_sd(values) == pytest.approx(2, rel=0.2)
    assert robust_sd(values[:3]) is None


def test_a_trend_is_the_line_through_each_window() -> None:
    rng = np.random.default_rng(1)
    times, values = np.cumsum(rng.random(40)), rng.normal(size=40)
    for width in (4, 16):
        said = local_trend(times, values, width, scale=1e9)  # so wide a scale that nothing is weighed down
        for i in range(40):
            window = slice(max(i - width, 0), i + width + 1)
            slope, level = np.polyfit(times[window], values[window], 1)
            assert said[i] == pytest.approx(level + slope * times[i], abs=1e-9)


def test_strays_weigh_next_to_nothing() -> None:
    times = np.arange(60.0)
    values = 3 + 0.5 * times
    values[::10] += 50
    assert local_trend(times, values, 16, scale=2.0) == pytest.approx(3 + 0.5 * times, abs=0.5)


def test_windows_are_four_seconds_and_sixteen_values_at_most() -> None:
    assert half_width(np.arange(0, 100, 0.1)) == 16
    assert half_width(np.arange(0.0, 100.0, 0.5)) == 8
    assert half_width(np.arange(0.0, 300.0, 3.0)) == 4
    assert half_width(np.zeros(0)) == 16
