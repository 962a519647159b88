"""Few keyframes of a motion: those between which straight lines stay near enough to it.

The line through a few instants is bent where it is farthest off, in all stretches at once, until it is near enough
everywhere: Ramer (1972) and Douglas and Peucker (1973).
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FARTHEST = 64
"""Keys are at most so many instants apart: about a second here, from which few rounds are left (our choice)."""


def sparse_keys(time_s: Array, values: Array, must: NDArray[np.int64]) -> NDArray[np.int64]:
    """The instants (k,) that are kept of `time_s` (n,), rising, n ≥ 2: both ends, those that `must` be, and more.

    Between them straight lines through `values` (n, channels) are off by at most 1.
    """
    keys = np.unique([*must, *range(0, len(time_s), FARTHEST), len(time_s) - 1])
    while True:
        off = _off(time_s, values, keys)
        worst = np.maximum.reduceat(off, keys[:-1])
        stretch = np.searchsorted(keys, np.arange(len(time_s)), side="right") - 1
        stretch = np.minimum(stretch, len(keys) - 2)
        at = np.flatnonzero((off > 1) & (off == worst[stretch]))
        if not len(at):
            return keys
        _, first = np.unique(stretch[at], return_index=True)
        keys = np.union1d(keys, at[first])


def _off(time_s: Array, values: Array, keys: NDArray[np.int64]) -> Array:
    """How far the lines are off at each instant (n,), in the channel that is farthest."""
    before = np.clip(np.searchsorted(keys, np.arange(len(time_s)), side="right") - 1, 0, len(keys) - 2)
    low, high = keys[before], keys[before + 1]
    share = ((time_s - time_s[low]) / (time_s[high] - time_s[low]))[:, None]
    lines = values[low] + share * (values[high] - values[low])
    return np.asarray(np.abs(values - lines).max(axis=1))
