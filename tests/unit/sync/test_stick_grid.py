"""Two sensors on one grid: what comes late, is lost, or is turned."""

import math

import numpy as np
import pytest

from station.core.events import SensorMounted, SensorSamples
from station.core.imu import ImuSample, Mounting
from station.core.pieces import Limb
from station.sync.drill.stick_grid import GAP_NS, STEP_NS, StickGrid, StickStep

SD_S = 0.01


def mounted(*limbs: Limb) -> StickGrid:
    grid = StickGrid(SD_S)
    for limb in limbs:
        grid.mounted(SensorMounted(0, limb.name, Mounting(limb)))
    return grid


def samples(limb: Limb, times_s: np.ndarray, rate: bool = True) -> SensorSamples:
    """Acceleration x grows by 1 a second, the rate about y is 5 rad/s."""
    turns = (0.0, 5.0, 0.0) if rate else None
    row = tuple(ImuSample(round(t * 1e9), (t, 0.0, 9.8), turns) for t in times_s.tolist())
    return SensorSamples(row[-1].at_ns, limb.name, row)


RIGHT, LEFT = Limb.RIGHT_HAND, Limb.LEFT_HAND


def test_a_line_stays_a_line_at_each_rate() -> None:
    """A mean that is even about its step leaves a straight line as it is."""
    grid = mounted(RIGHT, LEFT)
    steps: list[StickStep] = []
    for begin in np.arange(0.0, 2.0, 0.05):
        steps += grid.handle(samples(RIGHT, begin + np.arange(10) / 200))
        steps += grid.handle(samples(LEFT, begin + 0.0007 + np.arange(50) / 1000))
    inner = steps[5:]
    at_s = np.array([step.at_ns for step in inner]) / 1e9
    values = np.array([step.values for step in inner])
    assert np.abs(values[:, [0, 6]] - at_s[:, None]).max() < 0.0008
    assert np.allclose(values[:, [4, 10]], 5.0)
    assert all(step.present.all() for step in inner)
    assert np.diff([step.at_ns for step in steps]).tolist() == [STEP_NS] * (len(steps) - 1)


def test_any_chunks_give_the_same_steps() -> None:
    def steps(size: int) -> list[StickStep]:
        grid, found = mounted(RIGHT), list[StickStep]()
        for begin in range(0, 400, size):
            found += grid.handle(samples(RIGHT, np.arange(begin, min(begin + size, 400)) / 200))
        return found

    ones, many = steps(1), steps(37)
    assert [s.at_ns for s in ones] == [s.at_ns for s in many]
    assert np.allclose([s.values for s in ones], [s.values for s in many])


def test_one_step_waits_for_what_follows_it() -> None:
    steps = mounted(RIGHT).handle(samples(RIGHT, np.arange(100) / 200))
    assert steps[-1].at_ns / 1e9 == pytest.approx(99 / 200 - 3 * SD_S, abs=STEP_NS / 1e9)


def test_a_stick_that_falls_silent_is_missing_and_not_waited_for() -> None:
    grid = mounted(RIGHT, LEFT)
    grid.handle(samples(LEFT, np.arange(100) / 200))
    steps = [s for k in range(30) for s in grid.handle(samples(RIGHT, k * 0.05 + np.arange(10) / 200))]
    late = [step for step in steps if step.at_ns > 0.6e9]
    assert len(late) > 60
    assert all(step.present[:6].all() and not step.present[6:].any() for step in late)


def test_without_a_gyroscope_the_rates_are_missing() -> None:
    steps = mounted(RIGHT).handle(samples(RIGHT, np.arange(100) / 200, rate=False))
    assert steps[10].present.tolist() == [True] * 3 + [False] * 9


def test_a_long_gap_is_not_filled() -> None:
    grid = mounted(RIGHT)
    grid.handle(samples(RIGHT, np.arange(100) / 200))
    assert len(grid.handle(samples(RIGHT, 3600 + np.arange(100) / 200))) < 2 * GAP_NS / STEP_NS


def test_a_sensor_of_no_hand_tells_nothing() -> None:
    grid = mounted(Limb.UNKNOWN)
    assert grid.handle(samples(Limb.UNKNOWN, np.arange(100) / 200)) == []
    assert StickGrid(SD_S).handle(samples(RIGHT, np.arange(100) / 200)) == []


def test_the_mounting_turns_what_is_measured() -> None:
    """A sensor upside down, half a turn about y: its x is the stick's −x, its z the stick's −z."""
    grid = StickGrid(SD_S)
    grid.mounted(SensorMounted(0, RIGHT.name, Mounting(RIGHT, turn=(0.0, 0.0, 1.0, 0.0))))
    times = np.arange(100) / 200
    row = tuple(ImuSample(round(t * 1e9), (1.0, 0.0, -9.8), (2.0, 5.0, 0.0)) for t in times.tolist())
    values = grid.handle(SensorSamples(row[-1].at_ns, RIGHT.name, row))[20].values
    assert values[:6] == pytest.approx([-1.0, 0.0, 9.8, -2.0, 5.0, 0.0], abs=1e-9)


def test_a_stick_rolled_in_the_hand_is_levelled_by_its_mean_force() -> None:
    """Rolled by 40° about its length, gravity points to its left too, and a turn about y shows on y and z."""
    sine, cosine = math.sin(math.radians(40)), math.cos(math.radians(40))
    row = tuple(ImuSample(k * 5_000_000, (0.0, 9.8 * sine, 9.8 * cosine), (0.0, cosine, -sine)) for k in range(100))
    values = mounted(RIGHT).handle(SensorSamples(row[-1].at_ns, RIGHT.name, row))[20].values
    assert values[:6] == pytest.approx([0.0, 0.0, 9.8, 0.0, 1.0, 0.0], abs=1e-9)


def test_a_sensor_that_vanished_is_not_waited_for() -> None:
    grid = mounted(RIGHT, LEFT)
    grid.handle(samples(LEFT, np.arange(20) / 200))
    assert grid.handle(samples(RIGHT, np.arange(40) / 200))[-1].at_ns < 0.1e9
    grid.lost(LEFT.name)
    assert grid.handle(samples(RIGHT, 0.2 + np.arange(4) / 200))[-1].at_ns > 0.15e9
