"""Tempo as a teacher writes it: one for as long as it only wanders, a new one where it really changes."""

from collections.abc import Sequence
from itertools import pairwise

from station.music.tempo import TempoChange, TempoMap

WANDERS = 1.06
"""A band that keeps its tempo stays within 6 % from its slowest to its fastest bar: ± 3 % (our choice)."""
_RUN = 3
"""So many changes in one direction are meant (our choice)."""


def steady(tempo_map: TempoMap, bar_count: int) -> TempoMap:
    """The map, its changes at bars, with one tempo for each run of bars over which it only wanders."""
    rates = [_said(tempo_map.us_per_quarter_at(tempo_map.bar_start(bar))) for bar in range(bar_count)]
    found: list[TempoChange] = []
    start = 0
    while start < bar_count:
        end = _wandering_until(rates, start)
        if len(set(rates[start:end])) == 1 or _is_meant(rates, start, end):
            found += [TempoChange(tempo_map.bar_start(bar), rates[bar]) for bar in range(start, end)]
        else:
            found.append(_mean(tempo_map, rates[start:end], start))
        start = end
    return TempoMap.build(found, tempo_map.meters)


def _said(us_per_quarter: int) -> int:
    """The tempo in tenths of a beat a minute where a file means one: programs cut off what is below a microsecond."""
    tenths = TempoChange.from_bpm(0, round(60e6 / us_per_quarter, 1)).us_per_quarter
    return tenths if abs(tenths - us_per_quarter) <= 1 else us_per_quarter


def _wandering_until(rates: Sequence[int], start: int) -> int:
    end = start + 1
    while end < len(rates) and max(rates[start : end + 1]) <= WANDERS * min(rates[start : end + 1]):
        end += 1
    return end


def _is_meant(rates: Sequence[int], start: int, end: int) -> bool:
    """Whether these bars are part of one way from a tempo to another, which goes on after them."""
    steps = [b - a for a, b in pairwise(rates[start : end + 1]) if b != a]
    return len(steps) >= _RUN and end < len(rates) and (all(s > 0 for s in steps) or all(s < 0 for s in steps))


def _mean(tempo_map: TempoMap, rates: Sequence[int], first_bar: int) -> TempoChange:
    """The mean tempo of bars, in tenths of a beat a minute."""
    lengths = [tempo_map.bar_start(bar + 1) - tempo_map.bar_start(bar) for bar in _bars(first_bar, len(rates))]
    mean = sum(rate * ticks for rate, ticks in zip(rates, lengths, strict=True)) / sum(lengths)
    return TempoChange.from_bpm(tempo_map.bar_start(first_bar), round(60e6 / mean, 1))


def _bars(first: int, count: int) -> range:
    return range(first, first + count)
