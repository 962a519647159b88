"""When each stroke of a take is meant: meter, beat, swing, and the cells that its beats are cut into.

`quantised_times` is the only door. Times and ticks are those of `Score`; leans are positive where strokes come late.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.drills.quantise_time import at_bar_starts, on_cells
from station.music.score import Score
from station.music.swing import Swing


@dataclass(frozen=True, slots=True)
class BeatCells:
    """The beat from `tick`, `length_ticks` long, is cut into `cells` equal cells."""

    tick: int
    length_ticks: int
    cells: int


@dataclass(frozen=True, slots=True, eq=False)
class GridTimes:
    """A score on the grid, and how it came there.

    `score` has the rows that were given, their ticks on cells, whole bars alone, `swing_ticks` where swing is written
    as a word; row `i` of it was row `origin[i]` (shape (n,)). `swing` is that of the whole piece and `beat_ticks` the
    beat that is counted. `beats` are the beats with strokes in order. `lean_ms` is how late the take is as a whole,
    and `spread_ms` the standard deviation about that; both 0 where the score was on the grid already.
    """

    score: Score
    origin: NDArray[np.int64]
    swing: Swing
    beat_ticks: int
    beats: tuple[BeatCells, ...]
    lean_ms: float = 0.0
    spread_ms: float = 0.0


def quantised_times(score: Score, is_played: bool) -> GridTimes:
    """`score` with every row on a cell of the grid.

    Rows are main strokes at their played ticks, grace rows (`lead_ms` > 0) on the tick of their main stroke, and
    buzzes, one row each with its duration. With `is_played` the times are known to be somebody's playing; without it
    they are taken so only if they lie on no grid. Raises `BadInput` where a change of meter cuts a bar at a place that
    no meter can name.
    """
    tempo_map = at_bar_starts(score)
    moved = on_cells(list(score), tempo_map, score.end_tick)
    found = Score.from_notes(moved, tempo_map, score.end_tick, score.title)
    order = np.lexsort(([n.piece for n in moved], [-n.lead_ms for n in moved], [n.tick for n in moved]))
    return GridTimes(found, order.astype(np.int64), Swing(), PPQ, ())
