"""Bringing times onto the grid: strokes on the cells of their beat."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from types import MappingProxyType

from station.music.score import Note
from station.music.tempo import MeterChange, TempoMap

_EXACT_CELLS = (1, 2, 3, 4, 6, 8, 5, 7, 12, 16, 10)
_COST = MappingProxyType({1: 0.0, 2: 0.005, 4: 0.01, 3: 0.03, 6: 0.05, 8: 0.05})
"""Cells a beat for played music, and what each costs, in beats of mean error: our choice. Human spread is 0.03–0.05
beats (26–28 ms, HUMANS, Timing), so finer cells must earn their place by more than noise."""
_EXACT_BEATS = 1e-4


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
