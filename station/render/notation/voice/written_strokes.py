"""The strokes of a score as notation has them: where each is written, how long it is held, and diddles as one."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score
from station.render.notation.spelling.written_rhythm import written_ticks
from station.render.notation.staff import FOOT_PIECES
from station.render.notation.voice.held_rolls import held_until
from station.render.notation.voice.tremolo import measured_cells


@dataclass(frozen=True, slots=True)
class WrittenStrokes:
    """A score's strokes as notation has them, shape (n,) each: the tick where each is written, up to where it is held.

    `until` is its own tick for a stroke that is not held. `is_measured`: the first stroke of a diddle or of an open
    roll's cell, which writes both; `is_hidden`: the second. `held` (k,) are the rows of those that are held.
    """

    score: Score
    tick: NDArray[np.int64]
    until: NDArray[np.int64]
    is_foot: NDArray[np.bool_]
    is_measured: NDArray[np.bool_]
    is_hidden: NDArray[np.bool_]
    held: NDArray[np.intp]

    def held_into(self, tick: int, is_foot: bool) -> tuple[int, ...]:
        """The rolls of one voice that were struck before `tick` and are still held there."""
        rows = self.held
        held = (self.tick[rows] < tick) & (self.until[rows] > tick) & (self.is_foot[rows] == is_foot)
        return tuple(rows[held].tolist())


def feet_of(score: Score) -> NDArray[np.bool_]:
    """Which strokes are of the feet's voice, shape (n,)."""
    return np.isin(score.notes["piece"], [int(piece) for piece in FOOT_PIECES])


def written_strokes(score: Score, is_foot: NDArray[np.bool_], ticks: NDArray[np.int64] | None = None) -> WrittenStrokes:
    """All strokes of `score`; `is_foot`, shape (n,), tells the two voices, `ticks` (n,) where each stands if known."""
    ticks = written_ticks(score, is_foot) if ticks is None else ticks
    until = held_until(score, is_foot, ticks)
    is_measured, is_hidden = np.zeros(len(score), np.bool_), np.zeros(len(score), np.bool_)
    for first, second, end in measured_cells(score, is_foot, ticks):
        is_measured[first], is_hidden[second], until[first] = True, True, end
    return WrittenStrokes(score, ticks, until, is_foot, is_measured, is_hidden, np.flatnonzero(until > ticks))
