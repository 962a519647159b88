"""Strokes that a hand need not strike: a stick that is let go bounces on, each time softer than before.

The second stroke of a double is such a rebound too, but it may be as loud as the first, for fingers help it. What comes
after it on the same piece, soon and softer, is the stick's own. Times in seconds, velocities 1–127.
"""

import numpy as np
from numpy.typing import NDArray

AGAIN_S = 0.09
"""A stick is back on the head within this time (HUMANS: second bounce after 50–90 ms)."""
_MOST = 4
"""So often it bounces on after a double: `events.BOUNCES` has as many of a pressed stick (our choice)."""


def bounces_on(
    time_s: NDArray[np.float64], piece: NDArray[np.integer], velocity: NDArray[np.integer]
) -> NDArray[np.bool_]:
    """Which strokes (n,) of one hand, in order of time, are the third and later ones of a stick that bounces."""
    softer = (np.diff(time_s) < AGAIN_S) & (np.diff(piece) == 0) & (np.diff(velocity.astype(np.int64)) < 0)
    falls = np.concatenate(([False], softer))
    index = np.arange(len(falls))
    since = index - np.maximum.accumulate(np.where(falls, 0, index))  # strokes since the blow
    return np.asarray((since >= 2) & (since <= _MOST + 1))
