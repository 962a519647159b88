"""How much goes on around each of the body's keys: how loud it is, where the fills are, where the crashes.

The body answers it: it leans into a fill and holds its breath, rises before a crash and falls onto it, strains where
it is loud.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece

Array = NDArray[np.float64]

_METAL = (Piece.HIHAT, Piece.RIDE, Piece.RIDE_2)
_CRASHES = (Piece.CRASH_1, Piece.CRASH_2, Piece.CHINA)
_DRUMS = (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.TOM_3, Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2)
_FILL_STROKES = 2.0
"""So many strokes on drums within a beat, none of them on what keeps the time, are a fill (our choice)."""
_CRASH_VELOCITY = 70
"""Softer crashes are the time kept on a crash (our choice)."""
_SMOOTH = np.array([0.25, 0.5, 0.25])


@dataclass(frozen=True, eq=False)
class Intensity:
    """At each key (k,), 0 … 1: the mean loudness within a beat, how much of a fill it is, how hard a crash."""

    loud: Array
    fill: Array
    crash: Array

    @classmethod
    def of(cls, key_s: Array, onset_s: Array, velocity: Array, piece: NDArray[np.uint8]) -> "Intensity":
        """At the beats and their middles `key_s` (k,), from the onsets (n,) in order of time and velocities 1–127."""
        half = np.gradient(key_s) if len(key_s) > 1 else np.full(1, 0.5)
        if not len(onset_s):
            return cls(*np.zeros((3, len(key_s))))

        def within(reach: Array, weight: Array) -> Array:
            total = np.concatenate(([0.0], np.cumsum(weight)))
            ends = (np.searchsorted(onset_s, key_s + sign * reach) for sign in (-1, 1))
            first, last = ends
            return np.asarray(total[last] - total[first])

        count = within(2 * half, np.ones(len(onset_s)))
        loud = within(2 * half, velocity / 127) / np.maximum(count, 1.0)
        drums = within(half, np.isin(piece, _DRUMS).astype(np.float64))
        metal = within(0.9 * half, np.isin(piece, _METAL).astype(np.float64))
        fill = np.where(metal > 0, 0.0, np.minimum(drums / _FILL_STROKES, 1.0))
        played = (key_s >= onset_s[0]) & (key_s <= onset_s[-1])
        fill *= 1.0 - (fill[played] > 0.5).mean() if played.any() else 0.0  # what goes on all the time is none
        hit = np.isin(piece, _CRASHES) & (velocity >= _CRASH_VELOCITY)
        nearest = np.clip(np.searchsorted(key_s, onset_s[hit] - 0.5 * half[0]), 0, len(key_s) - 1)
        crash = np.zeros(len(key_s))
        np.maximum.at(crash, nearest, velocity[hit] / 127)
        return cls(loud, np.convolve(fill, _SMOOTH, "same"), crash)

    @property
    def fall(self) -> Array:
        """The body's fall onto crashes: 1 on the hardest, under 0 while it rises before."""
        before, after = np.append(self.crash[1:], 0.0), np.append(0.0, self.crash[:-1])
        return np.asarray(self.crash + 0.4 * after - 0.6 * before * (self.crash == 0))

    @property
    def rise(self) -> Array:
        """The way up to crashes and down from them, 0 … 1."""
        before, after = np.append(self.crash[1:], 0.0), np.append(0.0, self.crash[:-1])
        return np.asarray(np.maximum(self.crash, np.maximum(0.45 * before, 0.6 * after)))
