"""Hits by the beats of the clock: what speaks for each offset there, and at which hit one gives way to another."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits
from station.scoring.following.beat_offsets import EDGE, Offsets, Pause, block_gains, pauses_of
from station.scoring.following.written import Nats, Written

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

AHEAD = 1536
"""Hits that are looked at together, and of them so many are settled at once: bounds memory, and the cost of a jump."""
SETTLED = 1152

MOST_JUMPS = 200
"""Nobody jumps so often who plays the score; what comes then is followed without."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """Hits by the beats of the clock: the first hit of each block (b,), what they gain (b, s), hit by hit (m, s).

    `pauses` are the silences before blocks.
    """

    starts: Indices
    gains: Floats
    said: Nats
    first_hit: int
    pauses: Mapping[int, Pause]

    @classmethod
    def of(cls, written: Written, hits: Hits, beats: Floats, start: int, end: int, offsets: Offsets) -> "Blocks":
        """Hits `start` … `end` − 1 at `beats` (m,) of the clock."""
        own = np.maximum.accumulate(beats[start:end])
        whole = np.floor(own + EDGE)
        starts = np.concatenate(([0], np.flatnonzero(np.diff(whole)) + 1))
        edges = np.concatenate(([own[0]], whole[starts[1:]], [own[-1] + 2 * EDGE])) - EDGE
        gains, said = block_gains(written, beats[start:end], hits.classes[start:end], starts, edges, offsets)
        return cls(starts + start, gains, said, start, pauses_of(own, starts))

    def split(self, block: int, states: Indices) -> int:
        """The hit at which the state of `block`, of `states` (b,), begins: near its first beat, where most is left."""
        if block == 0 or block in self.pauses:
            return int(self.starts[block])
        before, after = int(states[block - 1]), int(states[block])
        low = int(self.starts[max(block - 1, 0)])
        high = int(self.starts[block + 1]) if block + 1 < len(self.starts) else self.first_hit + len(self.said)
        own = self.said[low - self.first_hit : high - self.first_hit]
        gain = np.concatenate(([0.0], np.cumsum(own[:, before] - own[:, after])))
        best = np.flatnonzero(gain >= gain.max() - 1e-6)
        nearest = best[np.argmin(np.abs(best + low - self.starts[block]))]
        return low + int(nearest)
