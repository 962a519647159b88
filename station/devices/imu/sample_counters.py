"""How far apart the samples of a sensor lie, by what it says itself: its own clock, a counter, or nothing.

A counter gives each sample a position, in the device's nanoseconds or in samples; `arrival_line` says when that was.
"""

from collections import deque
from statistics import median_low
from typing import Protocol

from station.core.units import NS_PER_MS, NS_PER_S, NS_PER_US
from station.devices.imu.arrival_line import ArrivalLine
from station.devices.imu.imu_reading import Reading, Ticks

_STRAYS = 0.01
"""How far a sensor's clock may be from the true rate: a ceramic resonator's ± 0.5 %, twice over (our choice)."""
_SHORTEST_NS, _LONGEST_NS = 100 * NS_PER_US, 500 * NS_PER_MS
"""Time between two samples: none here sends more than 10,000 a second, nor a useful one fewer than 2 (our choice)."""
_APART_NS = NS_PER_S
"""A sample whose clock says that it lies so far from when it came was damaged, or its clock was set anew (our choice:
longer than a radio holds samples back)."""
_WRAP_NS = 2**32 * NS_PER_US
"""A microcontroller's count of µs begins again after 71 minutes (Arduino's `micros`)."""
_INDICES = 256
_LONGEST_GAP_MS = 60_000
_FEW = 16
"""After so many samples the time between two is known well enough to count by (our choice)."""
_STEPS = 31
"""The time between two samples is the median of so many: losses are fewer than half of them."""
_LATE = 0.8
"""Samples without a counter are late by one that was lost, or by more, if they come so many sample times after they
were due: less is jitter (our choice, near 1, for a line a little too low makes nobody late)."""
_PATIENCE = 2
"""They count as lost when all that follow come late for so many times as long as it has taken, at the longest of late,
until one came in time (our choice)."""
_FORGETS = 0.99
"""How much of that longest is left with each that comes in time (our choice: a burst is forgotten in some hundreds)."""


class Counter(Protocol):
    """Gives the samples of one sensor their positions; `lost` counts those that are missing between them."""

    position: int
    lost: int

    def new_line(self) -> ArrivalLine:
        """A line for such positions."""
        ...

    def step(self, reading: Reading, line: ArrivalLine) -> int | None:
        """How many positions `reading` lies after the one before; None, and nothing counted, where that cannot be."""
        ...

    def period_ns(self, line: ArrivalLine) -> float | None:
        """Session time from one sample to the next; None until a few have come."""
        ...


class DeviceClock:
    """Positions are ns by the device's own clock, which it tells in µs."""

    def __init__(self) -> None:
        self.position = 0
        self.lost = 0
        self._base_ns = 0
        self._steps: deque[int] = deque(maxlen=_STEPS)
        self._period_ns = 0

    def new_line(self) -> ArrivalLine:
        """A line on which both clocks run alike, but for what crystals and resonators stray."""
        return ArrivalLine(1.0 - _STRAYS, 1.0 + _STRAYS)

    def step(self, reading: Reading, line: ArrivalLine) -> int | None:
        """By the device's clock; it must not go back, unless it began anew, nor be far from when the sample came."""
        if reading.ticks is None:
            return None
        position = reading.ticks * NS_PER_US + self._base_ns
        if line.is_new:
            self.position = position
            return 0
        wraps = _WRAP_NS if position - self.position < -_WRAP_NS // 2 else 0
        step = position + wraps - self.position
        if step <= 0 or abs(line.at(position + wraps) - reading.at_ns) > _APART_NS:
            return None
        self._base_ns += wraps
        self.position += step
        self._count(step)
        return step

    def _count(self, step: int) -> None:
        self._steps.append(step)
        if self._period_ns:
            self.lost += max(0, round(step / self._period_ns) - 1)
        if len(self._steps) == _STEPS:
            self._period_ns = median_low(self._steps)
            self._steps.clear()

    def period_ns(self, line: ArrivalLine) -> float | None:
        """The median, stretched to session time."""
        return self._period_ns * line.slope or None


class SampleCount:
    """Positions are samples, counted by an index, by a clock too coarse to place them, or one by one."""

    def __init__(self, ticks: Ticks) -> None:
        self.position = 0
        self.lost = 0
        self._kind = ticks
        self._ticks: int | None = None
        self._since = 0  # samples since one came in time
        self._longest = 1.0  # how many these were of late, at the most
        self._least_late = 0.0

    def new_line(self) -> ArrivalLine:
        """A line whose slope, the time between two samples, is to be found out."""
        return ArrivalLine(_SHORTEST_NS, _LONGEST_NS)

    def step(self, reading: Reading, line: ArrivalLine) -> int | None:
        """How many samples; None for one that came twice."""
        before, self._ticks = self._ticks, reading.ticks
        if line.is_new:
            return 0
        late = (reading.at_ns - line.at(self.position + 1)) / line.slope if self.position >= _FEW else 0.0
        step = 1
        if before is not None and reading.ticks is not None:
            step = self._by_ticks(reading.ticks - before, late, line.slope)
        elif self.position >= _FEW:
            step += self._missing(late, line.slope)
        if step < 1:
            return None
        self.position += step
        self.lost += step - 1
        return step

    def _by_ticks(self, ticks: int, late: float, period_ns: float) -> int:
        """Steps by what the device counts; `late` by how many samples it came after the next was due."""
        if self._kind is Ticks.INDEX_OF_256:
            rounds = max(0, round((late + 1 - ticks % _INDICES) / _INDICES))
            return ticks % _INDICES + rounds * _INDICES
        if self.position < _FEW:
            return 1
        if not 0 < ticks < _LONGEST_GAP_MS:  # its clock was set
            return 1 + self._missing(late, period_ns)
        return max(1, round(ticks * NS_PER_MS / period_ns))

    def _missing(self, late: float, period_ns: float) -> int:
        """How many samples must have been lost, for all have come `late` since."""
        if late * period_ns > _APART_NS:
            return round(late)
        if late < _LATE:
            self._longest = max(self._since + 1, _FORGETS * self._longest)
            self._since = 0
            return 0
        self._least_late = late if self._since == 0 else min(late, self._least_late)
        self._since += 1
        if self._since <= _PATIENCE * self._longest + _FEW / 2:
            return 0
        self._since = 0
        return round(self._least_late)

    def period_ns(self, line: ArrivalLine) -> float | None:
        """The line's slope."""
        return line.slope if self.position >= _FEW else None


def counter_of(ticks: Ticks) -> Counter:
    """The counter for what a protocol says of time."""
    return DeviceClock() if ticks is Ticks.MICROSECONDS else SampleCount(ticks)
