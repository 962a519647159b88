"""Bringing times onto the grid: whole bars, tempo changes at their starts, strokes on the cells of their beat."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import groupby, pairwise
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

_EXACT_CELLS = (1, 2, 3, 4, 6, 8, 5, 7, 12, 16, 10)
_COST = MappingProxyType({1: 0.0, 2: 0.005, 4: 0.01, 3: 0.03, 6: 0.05, 8: 0.05})
"""Cells a beat for played music, and what each costs, in beats of mean error: our choice. Human spread is 0.03–0.05
beats (26–28 ms, HUMANS, Timing), so finer cells must earn their place by more than noise."""
_EXACT_BEATS = 1e-4


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
    for change in old.tempos:
        bar = int(whole.bars_at(change.tick))
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


def on_cells(notes: Sequence[Note], tempo_map: TempoMap, end_tick: int) -> list[Note]:
    """The notes with their ticks on cells, beat by beat of the meter."""
    moved: list[Note] = []
    for (bar_start, beat), group in groupby(notes, key=lambda n: _beat_of(n.tick, tempo_map)):
        meter = tempo_map.meter_at(bar_start)
        start = bar_start + beat * meter.beat_ticks
        together = list(group)
        length = meter.beat_ticks // _cells([(n.tick - start) / meter.beat_ticks for n in together])
        moved += [_moved(n, start + round((n.tick - start) / length) * length, meter, end_tick) for n in together]
    return moved


def _beat_of(tick: int, tempo_map: TempoMap) -> tuple[int, int]:
    place = tempo_map.position_at(tick)
    return tempo_map.bar_start(place.bar), place.beat


def _cells(places: Sequence[float]) -> int:
    """Cells that a beat is cut into for strokes at `places` (in beats from its start)."""
    for cells in _EXACT_CELLS:
        if all(_error(p, cells) < _EXACT_BEATS for p in places):
            return cells
    return min(_COST, key=lambda n: sum(_error(p, n) for p in places) / len(places) + _COST[n])


def _error(place: float, cells: int) -> float:
    return abs(place - round(place * cells) / cells)


def _moved(note: Note, tick: int, meter: MeterChange, end_tick: int) -> Note:
    """The note at `tick` (the music's first beat again if that is its end), its length in whole quarters of a beat."""
    quarter = meter.beat_ticks // 4

    def whole(ticks: int) -> int:
        return max(quarter, round(ticks / quarter) * quarter) if ticks else 0

    return replace(
        note,
        tick=tick if tick < end_tick else 0,
        duration_ticks=whole(note.duration_ticks),
        choke_ticks=whole(note.choke_ticks),
    )
