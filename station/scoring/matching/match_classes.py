"""Which pieces answer for each other: alternates, and pieces folded onto a smaller kit.

A student who strikes crash 2 for crash 1, or the ride's second number for its first, plays what is written. Zones of
one piece (bow and edge of a hi-hat or ride) are one piece already. What a kit lacks, it folds onto the nearest piece
that it has; that is known only from the kit itself, never guessed from what was struck, for a student who takes tom 2
for the floor tom has made a mistake.
"""

from collections.abc import Collection
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.stand_ins import STAND_INS, stand_in

ALTERNATES = MappingProxyType({Piece.CRASH_2: Piece.CRASH_1, Piece.RIDE_2: Piece.RIDE})
"""Piece -> the piece that it answers for on every kit."""


def match_classes(kit: Collection[Piece] | None = None) -> NDArray[np.int64]:
    """A table from `Piece` number to match class, shape (largest piece + 1,): equal classes answer for each other.

    `kit` names the pieces that the student's kit has; None takes it for complete.
    """
    table = np.arange(max(Piece) + 1, dtype=np.int64)
    for piece, other in ALTERNATES.items():
        table[piece] = other
    if kit is not None:
        for piece in STAND_INS:
            nearest = stand_in(piece, kit)
            table[piece] = table[piece if nearest is None else nearest]
    return table
