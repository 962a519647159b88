"""Expected: worked out by hand from the rule that a limit is reached again and never passed."""

import math

import pytest

from station.sync.strokes.gyro_limit import GyroLimit


def reached(*rates_dps: float) -> list[bool]:
    limit = GyroLimit()
    return [limit.is_reached((0.0, math.radians(-each), 0.1)) for each in rates_dps]


@pytest.mark.parametrize("scale", [250.0, 500.0, 1000.0])
def test_a_full_scale_that_is_reached_again_is_the_limit(scale: float) -> None:
    end = scale * 32767 / 32768
    assert reached(100, end, 20, -scale, end, 90) == [False, False, False, True, True, False]


@pytest.mark.parametrize("scale", [2000.0, 4000.0])
def test_the_widest_are_the_limit_at_once(scale: float) -> None:
    assert reached(scale * 0.999, 50, scale) == [True, False, True]


def test_a_full_scale_that_was_passed_is_none() -> None:
    assert reached(1000, 1000, 2000, 2600, 2000, 1000) == [False, True, True, False, False, False]


def test_another_number_must_stand_still() -> None:
    assert reached(1150, 1150, 1150, 300, 1150, 1200, 1150) == [False, False, True, False, True, False, False]


def test_a_stick_at_rest_reaches_nothing() -> None:
    assert not any(reached(*[0.0] * 9, *[150.0] * 9))
