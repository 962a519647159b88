"""How far apart the samples of a sensor lie, by what it says itself: its own clock, a counter, or nothing.

A counter gives each sample a position, in the device's nanoseconds or in samples; `arrival_line` says when that was.
"""

from collections.abc import Sequence
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
_WRAP = 2**32
"""Where a microcontroller's count of µs begins again, after 71 minutes (Arduino's `micros`)."""
_STEPS = 31
"""The time between two samples is the median of so many: losses are fewer than half of them."""

_INDICES = 256
_FEW = 16
"""After so many samples the time between two is known well enough to count by (our choice)."""
_SURE = 100
"""After so many it is known to a few percent, losses included: enough to tell which of a sensor's rates it is."""
_NEAR, _TRUE = 0.1, 0.001
"""A rate that is measured so near one of the sensor's own is that one, and true to so much: ten times what a crystal
strays (our choice). Without this, losses would pass for a slower clock."""
_TOGETHER = 0.5
"""Samples that come within so many sample times waited for one another: the last of them waited least."""
_LATE = 0.9
"""Samples without a counter are late by one that was lost, or by more, if they come so many sample times after they
were due: less is jitter (our choice, near 1, for a line a little too low makes nobody late)."""
_PATIENCE, _AT_LEAST = 1.2, 4
"""They count as lost when all that follow come late so many times as often as it happened at the longest of late, and
so many times more: the quickest of several that found no loss in 25 s of exponential waits where there was none."""
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
    """Positions are ns by the device's own clock, of which a tick is `tick_ns`."""

    def __init__(self, tick_ns: int) -> None:
        self.position = 0
        self.lost = 0
        self._tick_ns = tick_ns
        self._base_ns = 0
        self._late_ns = 0.0
        self._steps: list[int] = []
        self._period_ns = 0

    def new_line(self) -> ArrivalLine:
        """A line on which both clocks run alike, but for what crystals and resonators stray."""
        return ArrivalLine(1.0 - _STRAYS, 1.0 + _STRAYS)

    def step(self, reading: Reading, line: ArrivalLine) -> int | None:
        """By the device's clock; it must not go back, unless it began anew, nor be far from when the sample came."""
        if reading.ticks is None:
            return None
        position = reading.ticks * self._tick_ns + self._base_ns
        if line.is_new:
            self.position = position
            return 0
        round_ns = _WRAP * self._tick_ns
        wrapped_ns = round_ns if position - self.position < -round_ns // 2 else 0
        step = position + wrapped_ns - self.position
        late_ns = reading.at_ns - line.at(position + wrapped_ns)
        if step <= 0 or (abs(late_ns) > _APART_NS and not self._waited(step, late_ns)):
            return None
        self._late_ns = late_ns
        self._base_ns += wrapped_ns
        self.position += step
        self._count(step)
        return step

    def _waited(self, step: int, late_ns: float) -> bool:
        """Whether a sample so late follows the one before and was held up with it: lateness that begins, or goes down.

        Were the clock wrong it would grow from sample to sample.
        """
        return step <= _LONGEST_NS and late_ns > 0 and (self._late_ns <= _APART_NS or late_ns <= self._late_ns)

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
    """Positions are samples, counted by the index that they carry, or one by one."""

    def __init__(self, rates_hz: Sequence[float]) -> None:
        """`rates_hz` are all that the sensor can be set to, none where nobody knows."""
        self.position = 0
        self.lost = 0
        self._rates_hz = rates_hz
        self._index: int | None = None
        self._came_ns = 0
        self._late = 0.0  # by how many sample times the newest is late
        self._lates = 0  # how often in a row the last of those that came together was late
        self._longest = 0.0  # how often it was of late, at the most
        self._least_late = 0.0

    def new_line(self) -> ArrivalLine:
        """A line whose slope, the time between two samples, is to be found out."""
        return ArrivalLine(_SHORTEST_NS, _LONGEST_NS)

    def step(self, reading: Reading, line: ArrivalLine) -> int | None:
        """How many samples; None for one that came twice."""
        before, self._index = self._index, reading.ticks
        if line.is_new:
            self._came_ns = reading.at_ns
            return 0
        if reading.ticks is None or before is None:
            step = 1 + self._missing(reading.at_ns, line)
        else:
            step = self._by_index(reading.ticks - before, reading.at_ns, line)
        if step < 1:
            return None
        if self.position < _SURE <= self.position + step:
            self._settle(line)
        self.position += step
        self.lost += step - 1
        return step

    def _by_index(self, ahead: int, at_ns: int, line: ArrivalLine) -> int:
        """By an index that went round as often as the time since the last sample says."""
        due = (at_ns - line.at(self.position)) / line.slope if self.position >= _FEW else 0.0
        rounds = max(0, round((due - ahead % _INDICES) / _INDICES))
        return ahead % _INDICES + rounds * _INDICES

    def _settle(self, line: ArrivalLine) -> None:
        """Know the sensor's rate, where it is one of a few."""
        for rate_hz in self._rates_hz:
            if abs(rate_hz * line.slope / NS_PER_S - 1.0) < _NEAR:
                line.narrow((1.0 - _TRUE) * NS_PER_S / rate_hz, (1.0 + _TRUE) * NS_PER_S / rate_hz)

    def _missing(self, at_ns: int, line: ArrivalLine) -> int:
        """How many samples must have been lost before the one that comes at `at_ns`, for all have come late since."""
        missing = 0
        if self.position >= _FEW and (at_ns - self._came_ns) / line.slope > _TOGETHER:
            missing = self._judge(self._late, line.slope)
        self._came_ns = at_ns
        self._late = (at_ns - line.at(self.position + 1 + missing)) / line.slope
        return missing

    def _judge(self, late: float, period_ns: float) -> int:
        """How many are missing, once the last of those that came together has come so `late`."""
        if late < _LATE:
            self._longest = max(self._lates, _FORGETS * self._longest)
            self._lates = 0
            return 0
        self._least_late = late if self._lates == 0 else min(late, self._least_late)
        self._lates += 1
        if self._lates <= _PATIENCE * self._longest + _AT_LEAST and late * period_ns < _APART_NS:
            return 0
        self._lates = 0
        return round(self._least_late)

    def period_ns(self, line: ArrivalLine) -> float | None:
        """The line's slope."""
        return line.slope if self.position >= _FEW else None


_TICK_NS = {Ticks.MICROSECONDS: NS_PER_US, Ticks.MILLISECONDS: NS_PER_MS}


def counter_for(reading: Reading, ticks: Ticks, rates_hz: Sequence[float] = ()) -> Counter:
    """The counter for samples such as `reading`, of a protocol that counts `ticks` where it counts at all."""
    tick_ns = _TICK_NS.get(ticks)
    return SampleCount(rates_hz) if tick_ns is None or reading.ticks is None else DeviceClock(tick_ns)
