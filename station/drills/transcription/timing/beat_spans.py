"""The beats of a piece as spans of time that are cut into cells, whatever its meters.

A span is what a foot taps (`MeterChange.pulses`): a quarter in 4/4, a dotted quarter in 6/8, a group of eighths in
2+2+3/8. Longer pulses are cut into quarters, so that one table of divisions serves all.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S, PPQ
from station.music.tempo import MeterChange, TempoMap

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class BeatSpans:
    """Spans (shape (s,)) in order without a gap: `starts` and `ends` in ticks and seconds.

    `in_bar` is each one's index in its bar, `bar` the bar from 0; `is_ternary` where it has three cells by nature.
    """

    starts: Ints
    ends: Ints
    starts_s: Floats
    ends_s: Floats
    bar: Ints
    in_bar: Ints
    is_ternary: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.starts)

    @cached_property
    def lengths(self) -> Ints:
        """Length of each in ticks."""
        return self.ends - self.starts

    @cached_property
    def lengths_s(self) -> Floats:
        """Length of each in seconds."""
        return self.ends_s - self.starts_s

    def only(self, chosen: Ints) -> "BeatSpans":
        """Those with the indices `chosen`, in order; what lies between them is a gap."""
        ticks = (self.starts[chosen], self.ends[chosen], self.starts_s[chosen], self.ends_s[chosen])
        return BeatSpans(*ticks, self.bar[chosen], self.in_bar[chosen], self.is_ternary[chosen])

    def places(self, times_s: Floats) -> tuple[Ints, Floats]:
        """Of each time the span that holds it and where in it, 0 to 1; before the first it is below 0."""
        span = np.clip(np.searchsorted(self.starts_s, times_s, side="right") - 1, 0, len(self) - 1)
        return span.astype(np.int64), (times_s - self.starts_s[span]) / self.lengths_s[span]


def spans_of(tempo_map: TempoMap, end_tick: int) -> BeatSpans:
    """The spans of all bars that begin before `end_tick`, and of one bar more, where late takes land."""
    rows: list[tuple[int, int, int, int, bool]] = []
    last_bar = int(tempo_map.bars_at(max(end_tick - 1, 0))) + 1
    for bar in range(last_bar + 1):
        start = tempo_map.bar_start(bar)
        meter = tempo_map.meter_at(start)
        cut = cut_pulses(meter)
        rows += [(start + a, start + b, bar, i, is_ternary(b - a, meter)) for i, (a, b) in enumerate(cut)]
    starts, ends, bars, in_bar, ternary = (np.array(column) for column in zip(*rows, strict=True))
    starts_s, ends_s = tempo_map.ns_at(starts) / NS_PER_S, tempo_map.ns_at(ends) / NS_PER_S
    return BeatSpans(starts, ends, starts_s, ends_s, bars, in_bar, ternary.astype(np.bool_))


def cut_pulses(meter: MeterChange) -> list[tuple[int, int]]:
    """Start and end of each span of a bar of `meter`, in ticks of the bar."""
    found: list[tuple[int, int]] = []
    for start, end in meter.pulses:
        step = _step(end - start, meter)
        found += [(at, at + step) for at in range(start, end, step)]
    return found


def _step(length: int, meter: MeterChange) -> int:
    """How long the spans of one pulse are: all of it, else quarters, else its beats."""
    if length <= PPQ or is_ternary(length, meter):
        return length
    return PPQ if length % PPQ == 0 else meter.beat_ticks


def is_ternary(length: int, meter: MeterChange) -> bool:
    """Whether a span is a group of three of the meter's beats."""
    return meter.unit >= 8 and length == 3 * meter.beat_ticks
