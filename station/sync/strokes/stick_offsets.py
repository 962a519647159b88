"""How much later the pads tell of a stroke than a stick's sensor does: candidates, from the data alone.

A sensor's latency and a pad's are unknown, but constant; a stroke's own hit follows it always after the same time, all
other hits at any time. So the true offset is where most differences heap up most narrowly. In an even roll there is a
second heap one stroke away: candidates are only proposed here, and `hand_naming` weighs them.
"""

import numpy as np
from numpy.typing import NDArray

FARTHEST_MS = 70.0
"""Latencies differ by up to 60 ms (Bluetooth's connection interval and a module's scan, the brief of the sensors), and
a stroke's onset and its hit by some more; our choice."""
HEAP_MS = 2.0
"""Width of a heap: what jitter of pads (HUMANS.md: under 1 ms) and of onsets leaves; our choice."""
LEAST_SHARE = 0.4
"""A heap lower than this share of the highest one is none; our choice."""
MOST_CANDIDATES = 5
LONGEST_LOOK = 2000
"""So many strokes tell an offset; our choice: a heap of 2000 is as narrow as one of 20,000."""


def offset_candidates(hits_ms: NDArray[np.float64], strokes_ms: NDArray[np.float64]) -> list[float]:
    """Candidates of hit − stroke in ms, the most likely first; none where no hit is near a stroke.

    `hits_ms` (n,) and `strokes_ms` (m,) sorted.
    """
    strokes_ms = strokes_ms[:LONGEST_LOOK]
    first = np.searchsorted(hits_ms, strokes_ms - FARTHEST_MS)
    last = np.searchsorted(hits_ms, strokes_ms + FARTHEST_MS)
    near = [hits_ms[a:b] - at for a, b, at in zip(first, last, strokes_ms, strict=True)]
    apart = np.concatenate(near) if near else np.empty(0)
    if not len(apart):
        return []
    grid = np.arange(-FARTHEST_MS, FARTHEST_MS + 1.0)
    heap = np.zeros(len(grid))
    for part in np.array_split(apart, len(apart) // 4096 + 1):
        heap += np.exp(-0.5 * ((grid[:, None] - part) / HEAP_MS) ** 2).sum(1)
    padded = np.pad(heap, 1)
    is_peak = (heap >= padded[:-2]) & (heap > padded[2:]) & (heap >= LEAST_SHARE * heap.max())
    peaks = sorted(np.flatnonzero(is_peak), key=lambda k: -heap[k])[:MOST_CANDIDATES]
    return [float(np.median(apart[np.abs(apart - grid[k]) <= 2 * HEAP_MS])) for k in peaks]
