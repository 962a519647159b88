"""A score as a student reads it: which limb plays what, what falls together, which stroke an ornament leads to."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music.passages import slots
from station.music.score import Score
from station.simulation.student_limbs import limbs_of

Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class StudentReading:
    """A score of n rows in k slots, which are the ticks on which something is written.

    `limbs` (n,) who plays, `main` (n,) the row of each stroke's main stroke (see `main_of_rows`), `slot_ticks` (k,)
    the slots in order, `slot` (n,) the slot of each row.
    """

    score: Score
    limbs: NDArray[np.int8]
    main: Indices
    slot_ticks: Indices
    slot: Indices

    @classmethod
    def of(cls, score: Score) -> "StudentReading":
        """`score`, read."""
        ticks, slot = slots(score)
        return cls(score, limbs_of(score), main_of_rows(score), ticks, slot)

    def __len__(self) -> int:
        return len(self.score)

    @property
    def mains(self) -> Indices:
        """Rows that are no grace strokes, in order."""
        return np.flatnonzero(~self.score.is_grace)


def main_of_rows(score: Score) -> Indices:
    """The row of each stroke's main stroke, shape (n,): itself, or for a grace stroke the stroke that it leads to.

    That is a main stroke of its tick, of its own piece if there is one; a grace stroke that leads to none is its own.
    """
    notes, mains = score.notes, np.arange(len(score))
    if not score.is_grace.any():
        return mains
    by_tick: dict[int, list[int]] = {}
    for row in np.flatnonzero(~score.is_grace).tolist():
        by_tick.setdefault(int(notes["tick"][row]), []).append(row)
    for grace in np.flatnonzero(score.is_grace).tolist():
        candidates = by_tick.get(int(notes["tick"][grace]), [])
        rank = [
            (notes["piece"][r] != notes["piece"][grace], notes["ornament"][r] != notes["ornament"][grace])
            for r in candidates
        ]
        if candidates:
            mains[grace] = candidates[rank.index(min(rank))]
    return mains
