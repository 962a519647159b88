"""Tempo and meter over score time: exact conversion between ticks, nanoseconds and bars.

Tempo is kept as MIDI keeps it, in whole microseconds a quarter note, so that a tick's time is the rational
`us_per_quarter * ticks / PPQ` summed over the segments. Segment starts are kept in units of 1/PPQ microseconds
(integers, exact); only the last step to nanoseconds rounds, by at most half a nanosecond. Because a tick lasts far
longer than a nanosecond at any legal tempo, ticks -> ns -> ticks is the identity.
"""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.errors import BadInput
from station.core.units import NS_PER_S, NS_PER_US, PPQ

DEFAULT_US_PER_QUARTER = 500_000
MIN_BPM, MAX_BPM = 10.0, 1000.0
"""Our choice: below a quarter note lasts six seconds, above no drummer follows; files outside still read."""

MOST_PICKUP = 3 / 4
"""Of a bar: three beats before a bar of four; seven eighths before it are a meter of their own (our choice)."""

_US_PER_MINUTE = 60_000_000
_MOST_DECIMALS = 10
"""They tell any two tempos to `MAX_BPM` apart."""


@dataclass(frozen=True, slots=True)
class TempoChange:
    """From `tick` on, a quarter note lasts `us_per_quarter` microseconds."""

    tick: int
    us_per_quarter: int

    @classmethod
    def from_bpm(cls, tick: int, tempo_bpm: float) -> "TempoChange":
        """A change to `tempo_bpm` quarter notes a minute, rounded to whole microseconds as MIDI does."""
        return cls(tick, round(_US_PER_MINUTE / tempo_bpm))

    @property
    def tempo_bpm(self) -> float:
        """Quarter notes a minute."""
        return _US_PER_MINUTE / self.us_per_quarter

    def short_bpm(self, beat_quarters: float = 1.0) -> float:
        """Beats of `beat_quarters` a minute, with the fewest decimals that mean this tempo.

        At 72 a quarter lasts 833 333 whole microseconds: 72, though these alone would be 72.0000288.
        """
        exact = self.tempo_bpm / beat_quarters
        near = (round(exact, decimals) for decimals in range(_MOST_DECIMALS))
        return next((b for b in near if b and self._is(b * beat_quarters)), exact)

    def _is(self, tempo_bpm: float) -> bool:
        return TempoChange.from_bpm(self.tick, tempo_bpm) == self


_MOST_DECIMALS = 9
"""So many tell all tempi of whole microseconds apart."""


METER_UNITS = (1, 2, 4, 8, 16, 32, 64, 128)
"""The notes that a meter of a file may count in (our choice: down to the shortest that programs print)."""


@dataclass(frozen=True, slots=True)
class MeterChange:
    """From `tick` on, bars have `beats` beats of 1/`unit` note. A change in mid-bar starts a new bar there.

    `groups` says how the beats are felt, (3, 2, 2) in a 7/8 that is counted so; empty where the meter says it alone.
    """

    tick: int
    beats: int
    unit: int
    groups: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        assert not self.groups or sum(self.groups) == self.beats, "groups fill the bar"

    @property
    def beat_ticks(self) -> int:
        """Length of one beat."""
        return 4 * PPQ // self.unit

    @property
    def bar_ticks(self) -> int:
        """Length of one whole bar."""
        return self.beats * self.beat_ticks

    @property
    def group_starts(self) -> tuple[int, ...]:
        """The beats, from 0, on which a group begins; those of compound meters (6/8, 9/8, 12/8) are threes."""
        return tuple(accumulate(self.felt_groups[:-1], initial=0))

    @property
    def felt_groups(self) -> tuple[int, ...]:
        """How many beats each pulse of the bar has: the written groups, threes in a compound meter, else ones."""
        is_compound = self.unit >= 8 and self.beats > 3 and self.beats % 3 == 0
        return self.groups or ((3,) * (self.beats // 3) if is_compound else (1,) * self.beats)

    @property
    def pulses(self) -> tuple[tuple[int, int], ...]:
        """Start and end, in ticks of the bar, of what a foot taps: groups of eighths and shorter, else single beats.

        In quarters and longer a group is a phrase of beats: 5/4 as 3+2 is still tapped in five.
        """
        groups = self.felt_groups if self.unit >= 8 else (1,) * self.beats
        ends = [end * self.beat_ticks for end in accumulate(groups)]
        return tuple(zip([0, *ends[:-1]], ends, strict=True))

    @property
    def usual_beat_ticks(self) -> int:
        """The beat that is counted where nobody says: a dotted quarter in 6/8 and its like, else a quarter."""
        is_compound = self.unit == 8 and not self.groups and len(self.felt_groups) < self.beats
        return 3 * self.beat_ticks if is_compound else PPQ

    def __str__(self) -> str:
        beats = "+".join(map(str, self.groups)) or str(self.beats)
        return f"{beats}/{self.unit}"

    def continues(self, before: "MeterChange") -> bool:
        """Whether nothing changes here: the same meter on a bar's start."""
        on_a_bar = (self.tick - before.tick) % before.bar_ticks == 0
        return on_a_bar and (self.beats, self.unit, self.groups) == (before.beats, before.unit, before.groups)


@dataclass(frozen=True, slots=True)
class BarPosition:
    """A place in the music as people count it: `bar` and `beat` from 0, `tick` within the beat."""

    bar: int
    beat: int
    tick: int


@dataclass(frozen=True)
class TempoMap:
    """The tempo and meter of a score from tick 0 to infinity; see the module's head for its exactness.

    `is_played`: the tempi are those of a band that was listened to; nobody wrote them, and nobody reads them.
    """

    tempos: tuple[TempoChange, ...] = (TempoChange(0, DEFAULT_US_PER_QUARTER),)
    meters: tuple[MeterChange, ...] = (MeterChange(0, 4, 4),)
    is_played: bool = False

    @classmethod
    def build(
        cls, tempos: Iterable[TempoChange], meters: Iterable[MeterChange] = (), is_played: bool = False
    ) -> "TempoMap":
        """A map from changes in any order: the last on a tick counts; tick 0 gets 120 bpm and 4/4 if unsaid.

        Changes that change nothing are left out. Raises `BadInput` for what is no tempo or no meter.
        """
        by_tick = {0: TempoChange(0, DEFAULT_US_PER_QUARTER)} | {t.tick: t for t in sorted(tempos, key=_tick)}
        meter_by_tick = {0: MeterChange(0, 4, 4)} | {m.tick: m for m in sorted(meters, key=_tick)}
        for tempo in by_tick.values():
            if tempo.us_per_quarter <= 0 or tempo.tick < 0:
                raise BadInput("tempo map", f"tick {tempo.tick}", f"{tempo.us_per_quarter} µs a quarter is no tempo")
        for meter in meter_by_tick.values():
            if meter.beats <= 0 or meter.unit <= 0 or (4 * PPQ) % meter.unit or meter.tick < 0:
                raise BadInput("tempo map", f"tick {meter.tick}", f"{meter.beats}/{meter.unit} is no meter")
        kept_tempos: list[TempoChange] = []
        for tick in sorted(by_tick):
            if not kept_tempos or by_tick[tick].us_per_quarter != kept_tempos[-1].us_per_quarter:
                kept_tempos.append(by_tick[tick])
        kept_meters: list[MeterChange] = []
        for tick in sorted(meter_by_tick):
            if not kept_meters or not meter_by_tick[tick].continues(kept_meters[-1]):
                kept_meters.append(meter_by_tick[tick])
        return cls(tuple(kept_tempos), tuple(kept_meters), is_played)

    @classmethod
    def constant(cls, tempo_bpm: float, beats: int = 4, unit: int = 4) -> "TempoMap":
        """One tempo (quarter notes a minute) and one meter throughout."""
        return cls.build([TempoChange.from_bpm(0, tempo_bpm)], [MeterChange(0, beats, unit)])

    # --- time ---------------------------------------------------------------------------------------------------------

    @cached_property
    def _segments(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """Start tick, µs a quarter, and the start time as whole µs and remaining 1/PPQ µs, of every tempo segment."""
        ticks = np.array([t.tick for t in self.tempos], np.int64)
        rates = np.array([t.us_per_quarter for t in self.tempos], np.int64)
        starts, total = [0], 0
        for i in range(1, len(ticks)):
            total += int(ticks[i] - ticks[i - 1]) * int(rates[i - 1])
            starts.append(total)
        whole = np.array([s // PPQ for s in starts], np.int64)
        rest = np.array([s % PPQ for s in starts], np.int64)
        return ticks, rates, whole, rest

    def ns_at(self, ticks: ArrayLike) -> NDArray[np.int64]:
        """Time of each tick in ns from tick 0, to the nearest ns; any shape in, the same shape out."""
        starts, rates, whole_us, rest = self._segments
        t = np.asarray(ticks, np.int64)
        i = np.maximum(np.searchsorted(starts, t, side="right") - 1, 0)
        quarters, left = np.divmod(t - starts[i], PPQ)
        parts = left * rates[i] + rest[i]  # of 1/PPQ µs; < 2^63 for every 24-bit MIDI tempo
        us, part = np.divmod(parts, PPQ)
        ns: NDArray[np.int64] = (whole_us[i] + quarters * rates[i] + us) * NS_PER_US + (2 * part * NS_PER_US + PPQ) // (
            2 * PPQ
        )
        return ns

    def seconds_at(self, ticks: ArrayLike) -> NDArray[np.float64]:
        """Time of each tick in seconds from tick 0."""
        return self.ns_at(ticks) / NS_PER_S

    @cached_property
    def _segment_starts_ns(self) -> NDArray[np.int64]:
        return self.ns_at(self._segments[0])

    def ticks_at_ns(self, ns: ArrayLike) -> NDArray[np.int64]:
        """Nearest tick to each time; the inverse of `ns_at`."""
        starts, rates, _, _ = self._segments
        t = np.asarray(ns, np.int64)
        i = np.maximum(np.searchsorted(self._segment_starts_ns, t, side="right") - 1, 0)
        quarter_ns = rates[i] * NS_PER_US
        quarters, left = np.divmod(t - self._segment_starts_ns[i], quarter_ns)
        nearest: NDArray[np.int64] = starts[i] + quarters * PPQ + np.rint(left * (PPQ / quarter_ns)).astype(np.int64)
        return nearest

    def ticks_at(self, seconds: ArrayLike) -> NDArray[np.int64]:
        """Nearest tick to each time in seconds."""
        return self.ticks_at_ns(np.rint(np.asarray(seconds, np.float64) * NS_PER_S).astype(np.int64))

    def bpm_at(self, tick: int) -> float:
        """Quarter notes a minute at `tick`."""
        starts, rates, _, _ = self._segments
        i = max(int(np.searchsorted(starts, tick, side="right")) - 1, 0)
        return _US_PER_MINUTE / int(rates[i])

    def us_per_quarter_at(self, tick: int) -> int:
        """Microseconds a quarter note at `tick`."""
        starts, rates, _, _ = self._segments
        return int(rates[max(int(np.searchsorted(starts, tick, side="right")) - 1, 0)])

    def scaled(self, factor: float) -> "TempoMap":
        """The same music played `factor` times as fast."""
        return TempoMap(
            tuple(TempoChange(t.tick, max(1, round(t.us_per_quarter / factor))) for t in self.tempos),
            self.meters,
            self.is_played,
        )

    def sped(self, speeds: Sequence[tuple[int, float]]) -> "TempoMap":
        """The same music, from each tick of `speeds`, which rise from 0, so many times as fast as here."""
        starts = [tick for tick, _ in speeds]
        assert starts[:1] == [0], "the speed is known from the first tick on"
        ticks = sorted({*starts, *(tempo.tick for tempo in self.tempos)})
        factors = [speeds[bisect_right(starts, tick) - 1][1] for tick in ticks]
        changes = [
            TempoChange(tick, max(1, round(self.us_per_quarter_at(tick) / factor)))
            for tick, factor in zip(ticks, factors, strict=True)
        ]
        return TempoMap.build(changes, self.meters, self.is_played)

    # --- bars ---------------------------------------------------------------------------------------------------------

    @cached_property
    def _meter_bars(self) -> tuple[int, ...]:
        """Index of the first bar of every meter; a bar that a change cuts short counts as one."""
        bars = [0]
        for before, after in zip(self.meters, self.meters[1:], strict=False):
            bars.append(bars[-1] + -(-(after.tick - before.tick) // before.bar_ticks))
        return tuple(bars)

    @cached_property
    def _meter_columns(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """Start tick, length of a bar, and first bar of every meter."""
        starts = np.array([m.tick for m in self.meters], np.int64)
        lengths = np.array([m.bar_ticks for m in self.meters], np.int64)
        return starts, lengths, np.array(self._meter_bars, np.int64)

    def meter_at(self, tick: int) -> MeterChange:
        """The meter in force at `tick`."""
        return self.meters[max(bisect_right(self.meters, tick, key=_tick) - 1, 0)]

    def pickup_ticks(self, end_tick: int) -> int:
        """How long the pick-up is with which music up to `end_tick` begins; 0 where it begins with a whole bar.

        A pick-up is a first bar of at most `MOST_PICKUP` of the second that no bar after it is as short as, but the
        last, which may make up for it.
        """
        first, second = self.bar_start(1), self.bar_start(2) - self.bar_start(1)
        is_first_of_many = first < end_tick and first <= MOST_PICKUP * second
        again = (m for m in self.meters if m.tick > 0 and m.bar_ticks == first and m.tick + first < end_tick)
        return first if is_first_of_many and not self.meters[0].groups and not any(again) else 0

    def bar_start(self, bar: int) -> int:
        """First tick of bar `bar` (from 0)."""
        i = max(bisect_right(self._meter_bars, bar) - 1, 0)
        return self.meters[i].tick + (bar - self._meter_bars[i]) * self.meters[i].bar_ticks

    def bars_at(self, ticks: ArrayLike) -> NDArray[np.int64]:
        """Index of the bar that holds each tick."""
        t = np.asarray(ticks, np.int64)
        starts, lengths, first_bars = self._meter_columns
        i = np.maximum(np.searchsorted(starts, t, side="right") - 1, 0)
        bars: NDArray[np.int64] = first_bars[i] + (t - starts[i]) // lengths[i]
        return bars

    def position_at(self, tick: int) -> BarPosition:
        """Bar, beat and tick within the beat at `tick`."""
        bar = int(self.bars_at(tick))
        within = tick - self.bar_start(bar)
        beat, rest = divmod(within, self.meter_at(tick).beat_ticks)
        return BarPosition(bar, beat, rest)

    def beats_between(self, start: int, end: int) -> list[tuple[int, int]]:
        """Every beat in [start, end) as (tick, index of the beat in its bar)."""
        beats: list[tuple[int, int]] = []
        bar = int(self.bars_at(start))
        while (first := self.bar_start(bar)) < end:
            step, stop = self.meter_at(first).beat_ticks, min(self.bar_start(bar + 1), end)
            beats += [(t, i) for i, t in enumerate(range(first, stop, step)) if t >= start]
            bar += 1
        return beats

    def section(self, start: int, end: int) -> "TempoMap":
        """The map of [start, end) moved to tick 0."""
        tempos = [TempoChange(0, self.us_per_quarter_at(start))] + [
            TempoChange(t.tick - start, t.us_per_quarter) for t in self.tempos if start < t.tick < end
        ]
        at_start = self.meter_at(start)
        meters = [replace(at_start, tick=0)] + [
            replace(m, tick=m.tick - start) for m in self.meters if start < m.tick < end
        ]
        return TempoMap.build(tempos, meters, self.is_played)


def _tick(change: TempoChange | MeterChange) -> int:
    return change.tick
