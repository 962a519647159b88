"""Which attempt counts where a passage was played more than once.

A student who stops and begins again means the later attempt, one who by mistake goes back for a few strokes does not.
So the notes that a stretch shares with an earlier one are divided at one place: before it the earlier attempt counts,
after it the later one, and it lies where most notes are answered; of places that are about equal the earliest is taken.
"""

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.tempo_tracker import GATE_S
from station.scoring.following.warp import Warp

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

_CHANCE_SHARE = 0.05
"""By so much of the shared notes one attempt may have more than the other by chance alone (our choice: two of fifty
left out)."""

_EDGE_S, _FRINGE_S = 0.03, 0.15
"""A stretch covers the notes between its first and last hit and the first around; and, where none does, the second."""


def owners(note_s: Floats, note_class: Indices, warp: Warp, hit_class: Indices) -> Indices:
    """Which stretch's hits may answer each note, shape (n,); −1 where none passes."""
    owner = np.full(len(note_s), -1, np.int64)
    masks = [warp.stretch == k for k in range(int(warp.stretch[-1]) + 1)]
    ends = [(warp.score_s[mine].min(), warp.score_s[mine].max()) for mine in masks]
    answered = [_answered(note_s, note_class, warp.score_s[mine], hit_class[mine]) for mine in masks]
    for stretch, (first, last) in enumerate(ends):
        covered = (note_s >= first - _EDGE_S) & (note_s <= last + _EDGE_S)
        shared = np.flatnonzero(covered & (owner >= 0))
        owner[covered & (owner < 0)] = stretch
        if len(shared):
            shared = shared[np.argsort(note_s[shared], kind="stable")]
            old = np.array([answered[k][n] for k, n in zip(owner[shared].tolist(), shared.tolist(), strict=True)])
            owner[shared[_divide(old, answered[stretch][shared]) :]] = stretch
    for stretch, (first, last) in enumerate(ends):
        owner[(owner < 0) & (note_s >= first - _FRINGE_S) & (note_s <= last + _FRINGE_S)] = stretch
    return owner


def _divide(old: Flags, new: Flags) -> int:
    """Where to go over from the old attempt to the new so that most notes (k,), in order, are answered."""
    before, after = np.concatenate(([0], np.cumsum(old))), np.concatenate((np.cumsum(new[::-1])[::-1], [0]))
    answered = before + after
    return int(np.argmax(answered >= answered.max() - _CHANCE_SHARE * len(old)))


def _answered(note_s: Floats, note_class: Indices, hit_s: Floats, hit_class: Indices) -> Flags:
    """Which notes (n,) have a hit of their class close by."""
    answered = np.zeros(len(note_s), np.bool_)
    for c in np.unique(hit_class):
        notes, hits = np.flatnonzero(note_class == c), np.sort(hit_s[hit_class == c])
        low, high = (np.searchsorted(hits, note_s[notes] + reach) for reach in (-GATE_S, GATE_S))
        answered[notes] = high > low
    return answered
