"""Which attempt counts where a passage was played more than once, and which hits belong to one that does not.

A student who stops and begins again means the later attempt, one who by mistake goes back for a few strokes does not.
So the notes that an attempt shares with an earlier one are divided at one place: before it the earlier attempt counts,
after it the later one, and it lies where most notes are answered; of places that are about equal the earliest is taken.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.scoring.matching.note_reach import LEAST_REACH_NS
from station.scoring.matching.pairing import Indices, Times

Flags = NDArray[np.bool_]

_CHANCE_SHARE = 0.05
"""By so much of the shared notes one attempt may have more than the other by chance alone (our choice: two of fifty
left out)."""

_EDGE_NS, _FRINGE_NS = 30 * NS_PER_MS, 150 * NS_PER_MS
"""An attempt covers the notes between its first and last hit and the first around; and, where none does, the second."""


def owners(note_ns: Times, note_class: Indices, hit_ns: Times, hit_class: Indices, attempt: Indices) -> Indices:
    """Which attempt's hits may answer each note, shape (n,); −1 where none passes.

    `hit_ns` (m,) of score time, `attempt` (m,) the number, from 0, of the uninterrupted run that each hit belongs to.
    """
    owner = np.full(len(note_ns), -1, np.int64)
    hits_of = _hits_of(attempt)
    ends = [(hit_ns[mine].min(), hit_ns[mine].max()) for mine in hits_of]
    answered = [_answered(note_ns, note_class, hit_ns[mine], hit_class[mine]) for mine in hits_of]
    for number, (first, last) in enumerate(ends):
        covered = (note_ns >= first - _EDGE_NS) & (note_ns <= last + _EDGE_NS)
        shared = np.flatnonzero(covered & (owner >= 0))
        owner[covered & (owner < 0)] = number
        if len(shared):
            shared = shared[np.argsort(note_ns[shared], kind="stable")]
            old = np.array([answered[k][n] for k, n in zip(owner[shared].tolist(), shared.tolist(), strict=True)])
            owner[shared[_divide(old, answered[number][shared]) :]] = number
    for number, (first, last) in enumerate(ends):
        owner[(owner < 0) & (note_ns >= first - _FRINGE_NS) & (note_ns <= last + _FRINGE_NS)] = number
    return owner


def played_again(note_ns: Times, owner: Indices, hit_ns: Times, attempt: Indices) -> Flags:
    """Which hits (m,) belong to an attempt that does not count where they lie: at the note that is nearest."""
    owned = np.flatnonzero(owner >= 0)
    if not len(owned):
        return np.zeros(len(hit_ns), np.bool_)
    owned = owned[np.argsort(note_ns[owned], kind="stable")]
    at_ns = note_ns[owned]
    after = np.clip(np.searchsorted(at_ns, hit_ns), 1, max(len(owned) - 1, 1))
    before = np.minimum(after, len(owned)) - 1
    after = np.minimum(after, len(owned) - 1)
    nearest = np.where(hit_ns - at_ns[before] <= at_ns[after] - hit_ns, before, after)
    return np.asarray(owner[owned[nearest]] != attempt)


def _hits_of(attempt: Indices) -> list[Indices]:
    """The hits of each attempt."""
    order = np.argsort(attempt, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(attempt[order])) + 1)


def _divide(old: Flags, new: Flags) -> int:
    """Where to go over from the old attempt to the new so that most notes (k,), in order, are answered."""
    before, after = np.concatenate(([0], np.cumsum(old))), np.concatenate((np.cumsum(new[::-1])[::-1], [0]))
    answered = before + after
    return int(np.argmax(answered >= answered.max() - _CHANCE_SHARE * len(old)))


def _answered(note_ns: Times, note_class: Indices, hit_ns: Times, hit_class: Indices) -> Flags:
    """Which notes (n,) have a hit of their class close by."""
    answered = np.zeros(len(note_ns), np.bool_)
    for c in np.unique(hit_class):
        notes, hits = np.flatnonzero(note_class == c), np.sort(hit_ns[hit_class == c])
        low, high = (np.searchsorted(hits, note_ns[notes] + reach) for reach in (-LEAST_REACH_NS, LEAST_REACH_NS))
        answered[notes] = high > low
    return answered
