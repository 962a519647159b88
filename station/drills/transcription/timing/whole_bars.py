"""Whole bars alone, and tempo changes at their starts: what a lesson can say about time."""

from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo import MeterChange, TempoChange, TempoMap


def at_bar_starts(score: Score) -> TempoMap:
    """The tempo map with whole bars alone, and tempo changes moved to the start of the nearest bar.

    A bar that a change of meter cuts short gets a meter of its own; of tempo changes that meet the last counts.
    """
    old = score.tempo_map
    meters = list(old.meters)
    for before, after in pairwise(old.meters):
        if cut := (after.tick - before.tick) % before.bar_ticks:
            meters.append(_short_bar(after.tick - cut, cut, score))
    whole = TempoMap.build(old.tempos, [m for m in meters if m.tick < score.end_tick])
    tempos: list[TempoChange] = []
    for change, bar in zip(old.tempos, whole.bars_at([t.tick for t in old.tempos]).tolist(), strict=True):
        start, end = whole.bar_start(bar), whole.bar_start(bar + 1)
        tempos.append(replace(change, tick=start if change.tick - start < end - change.tick else end))
    return TempoMap.build(_changing(t for t in tempos if t.tick < score.end_tick), whole.meters)


def _short_bar(tick: int, length_ticks: int, score: Score) -> MeterChange:
    """A meter for one bar of `length_ticks`."""
    for unit in (4, 8, 16, 32):
        if length_ticks * unit % (4 * PPQ) == 0:
            return MeterChange(tick, length_ticks * unit // (4 * PPQ), unit)
    bar = int(score.tempo_map.bars_at(tick)) + 1
    raise BadInput(score.title or "score", f"bar {bar}", "a change of meter cuts it between the notes of the grid")


def _changing(tempos: Iterable[TempoChange]) -> list[TempoChange]:
    last_of = {t.tick: t for t in tempos}
    found: list[TempoChange] = []
    for change in last_of.values():
        if not found or found[-1].us_per_quarter != change.us_per_quarter:
            found.append(change)
    return found
