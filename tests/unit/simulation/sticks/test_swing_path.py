"""Quintic paths, against their defining properties and a published formula."""

import numpy as np
import pytest

from station.simulation.sticks.swing_path import Knot, along, knot_between, smooth_steps


def test_reach_is_minimum_jerk() -> None:
    # Flash & Hogan 1985, eq. 3: x = d·(10 s³ − 15 s⁴ + 6 s⁵)
    s = np.array([i / 10 for i in range(11)])
    assert along([Knot(0, 0.0), Knot(1, 0.4)], s) == pytest.approx(0.4 * (10 * s**3 - 15 * s**4 + 6 * s**5))


def test_passes_its_knots_with_their_speeds_and_accelerations() -> None:
    knots = [Knot(0.0, 1.0, 2.0, -3.0), Knot(0.3, 0.5, -1.0, 4.0), Knot(1.0, 0.0, 0.5, 0.0)]
    step = 1e-4
    for knot in knots[:2]:
        near = along(knots, np.array([knot.at_s + step * i for i in range(4)]))
        assert near[0] == pytest.approx(knot.place)
        assert (near[1] - near[0]) / step == pytest.approx(knot.speed, abs=2e-3)
        assert (near[2] - 2 * near[1] + near[0]) / step**2 == pytest.approx(knot.push, abs=0.25)  # jerk · step


def test_contact_is_one_parabolic_push() -> None:
    # constant jerk's integral: acceleration 6 s(1−s)·Δv/T, so half way it is 1.5 Δv/T
    v, e, lasts = 5.0, 0.5, 0.004
    knots = [Knot(0, 0.0, -v), Knot(lasts, -(1 - e) * v * lasts / 2, e * v)]
    step = 1e-5
    around = along(knots, lasts / 2 + step * np.array([-1.0, 0.0, 1.0]))
    push = (around[0] - 2 * around[1] + around[2]) / step**2
    assert push == pytest.approx(1.5 * (1 + e) * v / lasts, rel=1e-3)


def test_stays_before_the_first_knot_and_after_the_last() -> None:
    assert along([Knot(1, 3.0), Knot(2, 4.0)], np.array([0.0, 3.0])).tolist() == [3.0, 4.0]
    assert along([Knot(1, 3.0)], np.array([0.0, 3.0])).tolist() == [3.0, 3.0]


def test_steps_wait_between_moves() -> None:
    moved = smooth_steps([(0, 0, 1.0), (1, 2, 5.0), (4, 5, 2.0)], np.array([0.5, 1.5, 3.0, 4.5, 6.0]))
    assert moved == pytest.approx([1.0, 3.0, 5.0, 3.5, 2.0])


def test_knot_between_leaves_the_path_as_it_is() -> None:
    first, second = Knot(1.0, 0.3, -1.0, 5.0), Knot(1.5, 0.0, 2.0, -8.0)
    at = np.array([1.0, 1.1, 1.2, 1.35, 1.45, 1.5])
    middle = knot_between(first, second, 0.4)
    assert middle.at_s == pytest.approx(1.2)
    assert along([first, middle, second], at) == pytest.approx(along([first, second], at))
