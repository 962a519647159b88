"""When each sample was measured, in session time, though samples come in clumps, late, and not all of them.

The sensor's own count of time or of samples says how far apart they lie (`sample_counters`); the line under their
arrivals (`arrival_line`) says where that is in session time, and how fast the sensor's clock runs. Where the sensor
counts nothing the samples are counted, and some that were lost show in that all that follow come late.

What is left is the least delay of all, from the measurement to our reading of it: the same for every sample.
Measured against truth in `tests/unit/devices/imu/test_sample_clock.py`.
"""

from collections.abc import Sequence

from station.core.units import NS_PER_S
from station.devices.imu.arrival_line import ArrivalLine
from station.devices.imu.imu_reading import Reading, Ticks
from station.devices.imu.sample_counters import Counter, counter_for

_CATCH_UP = 0.25
"""Where a time must be taken back, samples stand this much of their true distance apart until it is made up, for a
clock never goes back (our choice)."""


class SampleClock:
    """Session times for the samples of one sensor."""

    def __init__(self, ticks: Ticks, rates_hz: Sequence[float] = (), after_ns: int | None = None) -> None:
        """`rates_hz` are all that the sensor can be set to, none where nobody knows; no time is before `after_ns`."""
        self.samples = 0
        """How many samples were timed."""
        self._ticks, self._rates_hz = ticks, rates_hz
        self._counter: Counter | None = None
        self._line = ArrivalLine(1.0, 1.0)
        self._lost = 0
        self.last_ns = after_ns
        """The newest of all times so far."""
        self._suspect: Reading | None = None

    @property
    def lost(self) -> int:
        """How many samples did not come, or came with a time that cannot be."""
        return self._lost + (0 if self._counter is None else self._counter.lost)

    @property
    def rate_hz(self) -> float | None:
        """How many samples a second the sensor sends, losses included; None until a few have come."""
        period_ns = None if self._counter is None else self._counter.period_ns(self._line)
        return NS_PER_S / period_ns if period_ns else None

    def stamps(self, readings: Sequence[Reading]) -> list[int | None]:
        """The session times of readings that came together, rising; None for one whose time cannot be.

        All are taken in before any is timed: the last of them, which waited least, tells of the first.
        """
        placed = [self._place(reading) for reading in readings]
        self._line.draw()
        return [
            None if place is None else self._stamp(place[0], place[1], reading.at_ns)
            for place, reading in zip(placed, readings, strict=True)
        ]

    def _place(self, reading: Reading) -> tuple[int, int] | None:
        """The position of `reading`, and how far it lies behind the one before."""
        if self._counter is None:
            self._counter, self._line = self._begun(reading)
        step = self._counter.step(reading, self._line)
        if step is None and self._suspect is not None:
            step = self._begin_anew(self._suspect, reading)
        if step is None:
            self._suspect = reading  # it is missing, and counted when the next one comes
            return None
        self._suspect = None
        self._line.add(self._counter.position, reading.at_ns)
        self.samples += 1
        return self._counter.position, step

    def _begin_anew(self, suspect: Reading, reading: Reading) -> int | None:
        """Where two readings in a row agree with each other and not with those before, the device's clock was set."""
        counter, line = self._begun(suspect)
        if counter.step(suspect, line) is None:
            return None
        line.add(counter.position, suspect.at_ns)
        step = counter.step(reading, line)
        if step is not None:
            self._lost = self.lost + 1
            self._counter, self._line = counter, line
        return step

    def _stamp(self, position: int, step: int, came_ns: int) -> int:
        at_ns = min(self._line.at(position), came_ns)
        if self.last_ns is not None:
            at_ns = max(at_ns, self.last_ns + max(1, round(_CATCH_UP * self._line.slope * step)))
        self.last_ns = at_ns
        return at_ns

    def _begun(self, first: Reading) -> tuple[Counter, ArrivalLine]:
        counter = counter_for(first, self._ticks, self._rates_hz)
        return counter, counter.new_line()
