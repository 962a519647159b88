"""Where the player stands while they play: leans and spread from the matches so far, for the live judge.

It answers live what `assignment` finds for a whole take: the lean that all notes share, that of each piece at each
place in the beat, and the spread about both. Each costs the same however long the take is. Times are ns of score time.
"""

import numpy as np

from station.core.units import NS_PER_MS
from station.scoring.matching.assignment import (
    LEAN_PRIOR,
    UNKNOWN_SD_MS,
    Leaning,
    reach_by_spread,
    wrong_reach_by_spread,
)
from station.scoring.matching.pairing import Indices

_LEAST_OF_ALL, _LEAST_OF_PLACE = 8, 3
"""So many matches show a spread, which is told anew after as many more, and so many of one place its lean; before, the
reach is what the music leaves (our choice: half a bar, and more than one accident)."""

_MEMORY = 64
"""Matches that are remembered: two of the final alignment's trends (our choice)."""

_ALL_ANEW = (8, 16, 32, 64, 128)
"""After so many matches what all share is taken over by the places that were not heard yet."""

_MEAN_TO_SD = 1.2533
"""Mean absolute deviation of a normal distribution times this is its SD: √(π/2)."""

_MOST_SDS, _LEAST_CLIP_NS = 2.5, 30.0 * NS_PER_MS
"""What is farther off moves a lean no more than this (Huber's clipping, wider: nearly all of normal data counts)."""


_MOST_OF_ROOM = 5 / 6
"""A place leans no farther than so much of its room, half the way to the next slot: beyond, another note was meant."""

_MOST_COMMON_NS = 60.0 * NS_PER_MS
"""The same of what all notes share: a swung offbeat that is played straight says little of the beats."""


class RunningLean:
    """Leans of notes, of which `leaning` tells the place and the room, and `classes` (n,) the match class."""

    def __init__(self, leaning: Leaning, classes: Indices) -> None:
        groups, of_note = np.unique(
            classes * (int(leaning.place.max(initial=0)) + 1) + leaning.place, return_inverse=True
        )
        self._group: list[int] = of_note.tolist()
        self._early: list[int] = leaning.room.early.tolist()
        self._late: list[int] = leaning.room.late.tolist()
        self._groups = len(groups)
        self.begin_at(0)

    def begin_at(self, common_ns: int) -> None:
        """Forget all; what all notes share is `common_ns`."""
        self._sum, self._count = [0.0] * self._groups, [0.0] * self._groups
        self._due_ns = [common_ns] * self._groups
        self._common, self._heard, self._off = float(common_ns), 0, 0.0
        self._known = bytearray(len(self._group))
        self.wrong_reach_ns = wrong_reach_by_spread(UNKNOWN_SD_MS)
        """How far from where it is due another piece's note may be."""
        self._reach_ns: int | None = None

    @property
    def common_ns(self) -> float:
        """The lean that all notes share."""
        return self._common

    def due_ns(self, note: int) -> int:
        """How much later than written the note is due."""
        return self._due_ns[self._group[note]]

    def due_at(self, notes: list[int], written_ns: list[int]) -> list[tuple[int, int]]:
        """Each of a few notes and when it is due, of which is told when they are written."""
        due, group = self._due_ns, self._group
        return [(note, at_ns + due[group[note]]) for note, at_ns in zip(notes, written_ns, strict=True)]

    def reach_ns(self, note: int) -> tuple[int, int]:
        """How long before and after it is due its hit may come."""
        if self._reach_ns is None or self._count[self._group[note]] < _LEAST_OF_PLACE:
            return self._early[note], self._late[note]
        return self._reach_ns, self._reach_ns

    def learn(self, note: int, off_ns: int) -> None:
        """Take in that the hit of `note` came `off_ns` after it was written; each note counts once."""
        if self._known[note]:
            return
        self._known[note] = True
        group = self._group[note]
        due_ns = self._due_ns[group]
        most_early, most_late = _MOST_OF_ROOM * self._early[note], _MOST_OF_ROOM * self._late[note]
        own_ns = min(max(off_ns - self._common, -most_early), most_late)
        rest = self._common + own_ns - due_ns
        self._heard += 1
        weight = min(self._heard, _MEMORY)
        self._off += (abs(rest) - self._off) / weight
        if self._reach_ns is not None and self._count[group] >= _LEAST_OF_PLACE:
            most = max(_MOST_SDS * _MEAN_TO_SD * self._off, _LEAST_CLIP_NS)
            rest = min(max(rest, -most), most)
        if self._count[group] >= _MEMORY:
            self._sum[group] *= 0.5
            self._count[group] *= 0.5
        self._sum[group] += due_ns + rest
        self._count[group] += 1.0
        beyond = min(max(off_ns - self._common, -_MOST_COMMON_NS), _MOST_COMMON_NS)
        self._common += beyond / (weight + LEAN_PRIOR)
        self._due_ns[group] = self._due(group)
        if self._heard in _ALL_ANEW:
            self._due_ns = [self._due(group) for group in range(len(self._due_ns))]
        if self._heard % _LEAST_OF_ALL == 0:
            sd_ms = _MEAN_TO_SD * self._off / NS_PER_MS
            self._reach_ns, self.wrong_reach_ns = reach_by_spread(sd_ms), wrong_reach_by_spread(sd_ms)

    def _due(self, group: int) -> int:
        return round((self._sum[group] + LEAN_PRIOR * self._common) / (self._count[group] + LEAN_PRIOR))
