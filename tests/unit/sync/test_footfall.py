"""Footfalls of a heel whose height is drawn by hand."""

import numpy as np
import pytest

from station.sync.walking.footfall import heel_steps

RATE_HZ = 120.0


def heel(*corners: tuple[float, float]) -> np.ndarray:
    """Heights through corners (seconds, metres), straight between them."""
    times, heights = zip(*corners, strict=True)
    height: np.ndarray = np.interp(np.arange(round(times[-1] * RATE_HZ)) / RATE_HZ, times, heights)
    return height


def test_a_foot_falls_where_the_heel_stops_sinking() -> None:
    height = heel((0.0, 0.02), (0.5, 0.02), (0.8, 0.3), (1.1, 0.02), (1.6, 0.02))
    steps = heel_steps(height, RATE_HZ)
    assert steps.contact_s == pytest.approx([1.1], abs=0.02)  # the mean over five samples rounds the corner


def test_each_swing_ends_in_one_footfall() -> None:
    one = [(0.0, 0.02), (0.5, 0.02), (0.8, 0.3), (1.1, 0.02)]
    corners = [(t + 1.1 * k, h) for k in range(4) for t, h in one]
    assert heel_steps(heel(*corners), RATE_HZ).contact_s == pytest.approx([1.1, 2.2, 3.3], abs=0.02)


def test_a_heel_that_rolls_lower_touches_first_and_is_lowest_later() -> None:
    height = heel((0.0, 0.02), (0.5, 0.3), (0.8, 0.04), (0.9, 0.04), (1.1, 0.0), (1.5, 0.03), (1.8, 0.3), (2.0, 0.3))
    steps = heel_steps(height, RATE_HZ)
    assert steps.contact_s == pytest.approx([0.8], abs=0.02)
    assert steps.low_s == pytest.approx([1.1], abs=0.02)


def test_a_foot_that_stands_before_the_recording_has_not_fallen_in_it() -> None:
    assert len(heel_steps(heel((0.0, 0.0), (0.4, 0.0), (0.8, 0.3), (0.9, 0.3)), RATE_HZ).contact_s) == 0


@pytest.mark.parametrize("height", [np.zeros(0), np.zeros(2), np.full(500, 0.05)], ids=["none", "two", "standing"])
def test_who_does_not_move_takes_no_step(height: np.ndarray) -> None:
    assert len(heel_steps(height, RATE_HZ).contact_s) == 0


def test_trembling_is_no_step() -> None:
    tremble = 0.02 * np.sin(np.arange(600) / 3)
    assert len(heel_steps(tremble, RATE_HZ).contact_s) == 0
