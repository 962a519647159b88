"""Intervals by hand: t from a printed table."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.sound.calibration.latency_estimate import Floats, LatencyEstimate, estimate_of, inliers

VALUES = np.array([10.0, 10.1, 10.2, 10.3, 10.4])  # mean 10.2, SD 0.1581


def test_the_interval_is_students() -> None:
    found = estimate_of([VALUES])
    assert found is not None
    assert found.value_ms == pytest.approx(10.2)
    assert found.count == 5
    assert found.sd_ms == pytest.approx(0.1581, abs=1e-4)
    assert found.half_ms == pytest.approx(2.776 * 0.1581 / 5**0.5, rel=0.02)  # t(4)
    assert found.low_ms == pytest.approx(10.2 - found.half_ms)


def test_values_that_hang_together_count_for_fewer() -> None:
    half = estimate_of([np.tile(VALUES, 4)], effective=0.5)
    assert half is not None
    assert half.half_ms == pytest.approx(2.262 * np.std(np.tile(VALUES, 4), ddof=1) / 10**0.5, rel=0.02)  # t(9)


def test_openings_that_differ_rule_the_interval() -> None:
    found = estimate_of([VALUES, VALUES + 1.0, VALUES + 2.0])
    assert found is not None
    assert found.value_ms == pytest.approx(11.2)
    assert found.half_ms == pytest.approx(4.303 * 1.0 / 3**0.5, rel=0.04)  # t(2)


def test_what_does_not_belong_is_left_out() -> None:
    found = estimate_of([np.array([*VALUES, 60.0, -35.0])])
    assert found is not None
    assert found.value_ms == pytest.approx(10.2)
    assert found.count == 5
    assert inliers(np.array([1.0, 1.0, 1.0, 1.5])).all()  # that they all but agree makes no outlier of the fourth


@pytest.mark.parametrize("rounds", [[], [np.empty(0)], [np.array([1.0]), np.array([2.0])]])
def test_too_few_values_are_no_estimate(rounds: list[Floats]) -> None:
    assert estimate_of(rounds) is None


def test_a_wide_interval_is_doubted() -> None:
    wide, narrow = estimate_of([VALUES * 30]), estimate_of([VALUES])
    assert wide is not None
    assert narrow is not None
    assert not wide.trusted
    assert narrow.trusted


@given(st.lists(st.floats(-50, 50), min_size=3, max_size=30), st.floats(-200, 200))
def test_a_shift_of_all_shifts_only_the_value(values: list[float], by: float) -> None:
    here, there = estimate_of([np.array(values)]), estimate_of([np.array(values) + by])
    assert here is not None
    assert there is not None
    if here.count == there.count:  # a value on the very edge may fall to either side by rounding
        assert there.value_ms - here.value_ms == pytest.approx(by, abs=1e-6)
        assert there.half_ms == pytest.approx(here.half_ms, abs=1e-6)


def test_what_is_known_is_taken_off() -> None:
    rest = LatencyEstimate(10.0, 9.0, 11.0, 1.0, 8).doubted("a").less(4.0).remarked("b")
    assert rest == LatencyEstimate(6.0, 5.0, 7.0, 1.0, 8, ("a",), ("b",))
