"""The samples of two sticks' sensors, each with its own clock and rate, made one series of even steps.

Every step is a mean of the samples near it, weighted by a Gaussian of their distance: the low-pass that the model went
through as well, however a sensor's samples are spaced. It is even about the step and so delays nothing, but a step can
be told only when what follows it has come: `REACH` standard deviations later. A stick from which nothing came near a
step is missing there; one that fell silent is not waited for.
"""

from collections.abc import Sequence
from math import exp, hypot
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.events import SensorMounted, SensorSamples
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.sync.drill.drill_model import AXES, CHANNELS, HANDS
from station.sync.strokes.stick_axes import rows_of

Array = NDArray[np.float64]

STEP_NS = 10_000_000
"""A hundred steps a second: a stroke of 10 Hz, the fastest hand (HUMANS, Fujii 2009), has ten."""
REACH = 3.0
"""Beyond so many standard deviations samples do not count (1 % of the weight at the edge)."""
SILENT_NS = 300_000_000
"""A stick so far behind the other is not waited for: ten of Bluetooth's slowest intervals (our choice)."""
GAP_NS = 2_000_000_000
"""After so long without a sample the steps between are left out (our choice)."""
LEVELS_NS = 3_000_000_000
"""The way up is the mean force of so long: some strokes, whose own forces cancel out (our choice)."""
_WIDTH = len(CHANNELS)


class StickStep(NamedTuple):
    """One step: `values` (12,) as `StickSignals.channels` has them, and which of them are `present` (12,)."""

    at_ns: int
    values: Array
    present: NDArray[np.bool_]


class _Level:
    """Turns a stick about its length until its mean force has no part to the left: the way up, however it is held."""

    def __init__(self) -> None:
        self._kept = exp(-STEP_NS / LEVELS_NS)
        self._left = self._up = 0.0

    def turned(self, values: Array) -> Array:
        """`values` (6,) of one more step, levelled."""
        self._left = self._kept * self._left + values[1]
        self._up = self._kept * self._up + values[2]
        return levelled(values, (self._left, self._up))


def levelled(values: Array, left_up: Sequence[float] | Array) -> Array:
    """One stick's channels (…, 6), turned about x until the mean force `left_up` (2,) would point up alone."""
    left, up = left_up
    length = hypot(left, up)
    if not length:
        return values
    turn = np.array([[up, -left], [left, up]]) / length
    found = values.copy()
    for pair in (slice(1, 3), slice(4, 6)):
        found[..., pair] = values[..., pair] @ turn.T
    return found


class _Stick:
    """The samples of one stick that are still needed."""

    def __init__(self) -> None:
        self.level = _Level()
        self.time_ns = np.empty(0, np.int64)
        self.values = np.empty((0, _WIDTH))
        self.has_rate = True

    def add(self, time_ns: NDArray[np.int64], values: Array) -> None:
        fresh = time_ns > (self.time_ns[-1] if len(self.time_ns) else -(2**62))
        self.time_ns = np.concatenate([self.time_ns, time_ns[fresh]])
        self.values = np.concatenate([self.values, values[fresh]])

    def forget(self, before_ns: int) -> None:
        first = int(np.searchsorted(self.time_ns, before_ns))
        if first < len(self.time_ns):
            self.time_ns, self.values = self.time_ns[first:], self.values[first:]

    def at(self, step_ns: int, sd_ns: float) -> Array | None:
        """The weighted mean about a step, None where nothing was measured near it."""
        first, last = np.searchsorted(self.time_ns, (step_ns - REACH * sd_ns, step_ns + REACH * sd_ns))
        if first == last:
            return None
        weights = np.exp(-0.5 * ((self.time_ns[first:last] - step_ns) / sd_ns) ** 2)
        return np.asarray(weights @ self.values[first:last] / weights.sum())


class StickGrid:
    """Turns the samples of the sensors that are mounted on sticks into steps of both, smoothed by `smoothing_s`."""

    def __init__(self, smoothing_s: float) -> None:
        self._sd_ns = smoothing_s * NS_PER_S
        self._mountings: dict[str, Mounting] = {}
        self._sticks: dict[Limb, _Stick] = {}
        self._begin_ns: int | None = None
        self._next_ns = 0

    def mounted(self, event: SensorMounted) -> None:
        """From now on the sensor is mounted so; what it measured before no longer counts."""
        before = self._mountings.get(event.device)
        for limb in {event.mounting.limb, before.limb if before else Limb.UNKNOWN}:
            self._sticks.pop(limb, None)
        self._mountings[event.device] = event.mounting
        self._sticks |= {each.limb: _Stick() for each in self._mountings.values() if each.limb not in self._sticks}

    def lost(self, device: str) -> None:
        """The sensor vanished: its stick is not waited for."""
        before = self._mountings.pop(device, None)
        if before is not None:
            self._sticks.pop(before.limb, None)

    def handle(self, event: SensorSamples) -> list[StickStep]:
        """The steps that are whole now; none while the sensor's hand is unknown."""
        mounting = self._mountings.get(event.device)
        if mounting is None or mounting.limb not in HANDS or not event.samples:
            return []
        stick = self._sticks[mounting.limb]
        stick.has_rate = event.samples[0].rate_rad_s is not None
        time_ns = np.array([sample.at_ns for sample in event.samples], np.int64)
        stick.add(time_ns, _in_stick(event, mounting))
        if self._begin_ns is None:
            self._begin_ns = int(time_ns[0])
            self._next_ns = -(-self._begin_ns // STEP_NS) * STEP_NS
        return self._steps()

    def _steps(self) -> list[StickStep]:
        assert self._begin_ns is not None
        ends = [int(stick.time_ns[-1]) if len(stick.time_ns) else self._begin_ns for stick in self._sticks.values()]
        awaited = min(end for end in ends if end > max(ends) - SILENT_NS)
        until_ns = awaited - int(REACH * self._sd_ns)
        if until_ns - self._next_ns > GAP_NS:
            self._next_ns = until_ns // STEP_NS * STEP_NS
        steps = [self._step(at_ns) for at_ns in range(self._next_ns, until_ns + 1, STEP_NS)]
        self._next_ns += STEP_NS * len(steps)
        for stick in self._sticks.values():
            stick.forget(self._next_ns - int(REACH * self._sd_ns))
        return steps

    def _step(self, at_ns: int) -> StickStep:
        values, present = np.zeros(len(HANDS) * _WIDTH), np.zeros(len(HANDS) * _WIDTH, bool)
        for index, hand in enumerate(HANDS):
            stick = self._sticks.get(hand)
            found = None if stick is None else stick.at(at_ns, self._sd_ns)
            if stick is not None and found is not None:
                first = index * _WIDTH
                values[first : first + _WIDTH] = stick.level.turned(found)
                present[first : first + (_WIDTH if stick.has_rate else AXES)] = True
        return StickStep(at_ns, values, present)


def _in_stick(event: SensorSamples, mounting: Mounting) -> Array:
    """What a sensor measured, turned into its stick's axes, (n, 6); a rate that it does not send is 0."""
    still = (0.0,) * AXES
    rows = [(*sample.acceleration_m_s2, *(sample.rate_rad_s or still)) for sample in event.samples]
    turn = np.array(rows_of(mounting.turn))
    return np.asarray((np.array(rows).reshape(-1, 2, AXES) @ turn.T).reshape(-1, _WIDTH))
