"""What of each stroke the staff shows, in plain numbers: they are read ten times as fast as numpy's rows one by one."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb
from station.music.score import Score
from station.render.notation.staff import PLACES

_STEPS = {int(piece): place.step for piece, place in PLACES.items()}
_GHOST = int(Dynamic.GHOST)
_FIELDS = ("tick", "piece", "zone", "articulation", "dynamic", "lead_ms", "choke_ticks", "openness")


class StaffStroke(NamedTuple):
    """A stroke's row (`NOTE_DTYPE`), the `limb` that is written, and what it is beside others.

    `is_small`: it is beyond the player; `is_closing`: it is the first closed one after an open hi-hat.
    """

    tick: int
    piece: int
    zone: int
    articulation: int
    dynamic: int
    lead_ms: float
    choke_ticks: int
    openness: float
    limb: int
    is_small: bool
    is_closing: bool

    @property
    def step(self) -> int:
        """Where on the staff it stands."""
        return _STEPS[self.piece]

    @property
    def is_main(self) -> bool:
        """Whether it is no grace stroke."""
        return self.lead_ms <= 0

    @property
    def is_ghost(self) -> bool:
        """Whether brackets say that it is soft; grace strokes are so by themselves."""
        return self.dynamic == _GHOST and self.lead_ms == 0


def staff_strokes(
    score: Score,
    limbs: NDArray[np.int8] | None = None,
    is_small: NDArray[np.bool_] | None = None,
    closing: NDArray[np.bool_] | None = None,
) -> list[StaffStroke]:
    """The strokes of `score` in order; the others, shape (n,) each, are unknown and false where they are left out."""
    count = len(score)
    columns = [score.notes[name].tolist() for name in _FIELDS]
    columns.append([int(Limb.UNKNOWN)] * count if limbs is None else limbs.tolist())
    columns += [[False] * count if flags is None else flags.tolist() for flags in (is_small, closing)]
    return list(map(StaffStroke._make, zip(*columns, strict=True)))
