"""How far a whole performance lies beside the click: a forgotten latency, or a player who leans.

Every pair of a hit and a note of its class votes for its difference; the lag that most agree on wins. Evenly spaced
strokes agree on many lags, of which the smaller is believed.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.scoring.matching.pairing import Indices, Times

BIAS_REACH_MS = 200.0
"""How far is looked: a latency of 100 ms (TEACHING, hostile learners) and a lean."""

_BIN_MS = 5.0
_PRIOR_MS = 150.0
"""A lag of this size is believed 0.6 times as readily as none (our choice)."""

_SCATTER_MS = 15.0
_KERNEL = np.exp(-0.5 * (np.arange(-8, 9) * _BIN_MS / _SCATTER_MS) ** 2)


def common_bias_ns(note_ns: Times, note_class: Indices, hit_ns: Times, hit_class: Indices) -> int:
    """The lag of all hits (m,) together after the notes (n,), within ±`BIAS_REACH_MS`; 0 where nothing is known."""
    reach = round(BIAS_REACH_MS * NS_PER_MS)
    differences = [
        _differences(np.sort(note_ns[note_class == c]), np.sort(hit_ns[hit_class == c]), reach)
        for c in np.intersect1d(note_class, hit_class).tolist()
    ]
    d_ms = np.concatenate([np.zeros(0), *differences]) / NS_PER_MS
    if not len(d_ms):
        return 0
    bins = np.rint((d_ms + BIAS_REACH_MS) / _BIN_MS).astype(np.int64)
    votes = np.bincount(bins, minlength=round(2 * BIAS_REACH_MS / _BIN_MS) + 1).astype(np.float64)
    votes = np.convolve(votes, _KERNEL, mode="same")
    lags_ms = np.arange(len(votes)) * _BIN_MS - BIAS_REACH_MS
    best = np.argmax(votes * np.exp(-0.5 * (lags_ms / _PRIOR_MS) ** 2))
    return round(float(lags_ms[best]) * NS_PER_MS)


def _differences(notes: NDArray[np.int64], hits: NDArray[np.int64], reach: int) -> NDArray[np.float64]:
    """Hit − note of every pair within `reach`, both sorted."""
    low, high = np.searchsorted(notes, hits - reach), np.searchsorted(notes, hits + reach, side="right")
    counts = high - low
    firsts = np.repeat(low - np.concatenate(([0], np.cumsum(counts)[:-1])), counts)
    differences: NDArray[np.float64] = (np.repeat(hits, counts) - notes[firsts + np.arange(len(firsts))]).astype(
        np.float64
    )
    return differences
