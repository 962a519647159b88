"""A score as the staff shows it: with the strokes that are beyond the player, small among the others."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.music.score import Score


def whole_score(
    score: Score, limbs: NDArray[np.int8] | None = None
) -> tuple[Score, NDArray[np.int8], NDArray[np.bool_]]:
    """All strokes of the music, the limb of each, and which are beyond the player and written small, shape (n,) each.

    `limbs` are those of the player's own strokes, in their order; None: those of `score`. The others have none.
    """
    whole, is_small = score.whole
    found = np.full(len(whole), Limb.UNKNOWN, np.int8)
    found[~is_small] = score.notes["limb"] if limbs is None else limbs
    return whole, found, is_small
