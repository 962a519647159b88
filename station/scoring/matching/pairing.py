"""Hits to notes one to one by least cost: the exact solution of the small problem that alignment reduces to.

Both sides are times on one axis. A pair at distance d costs (d/w)² − 1, a note or hit left alone costs nothing, so
that a pair is worth making within the reach and the closer the better (w is the reach and one ns, for the edge itself
is inside); the matching of least total cost is found. A note may be given less room than the reach: a first and a last
time of its hit. Because the cost is convex in d, and the rooms of later notes begin and end later, some best matching
never crosses, and three facts make it fast:

* where as many notes as hits are among themselves, one after the other belongs together if Σ(d/w)² ≤ 1: who pairs
  them all pairs them in order, and who leaves one out saves no more than that;
* a note and a hit that are each other's nearest, at distance d, belong to a best matching if one of them has nobody
  else to pair with, or if their second nearest lie at a and b with a² + b² ≥ w² + d² (breaking any other arrangement
  up to make this pair never costs more);
* with such pairs taken out the same holds for what remains, so the search is repeated; what still remains falls into
  islands, each solved by dynamic programming.

The first two are whole-array operations; the third runs only in rolls and other tangles. Different pieces are kept
apart by `lanes`: the axis is cut and each piece put on its own segment. Permuting simultaneous hits changes nothing but
which of the equal ones is named.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.int64]
Indices = NDArray[np.int64]

_FAR = np.int64(2**62)
"""Farther than any two session times."""


def lanes(times: Times, classes: Indices, span: int) -> Times:
    """Times (n,) moved so that each class lies on its own segment of `span`; `span` exceeds every difference."""
    return times + classes * np.int64(span)


@dataclass(frozen=True, eq=False)
class Room:
    """How far before (`early`) and after (`late`) its time each note's hit may lie, (n,), at least 0."""

    early: Times
    late: Times


def pair_nearest(notes: Times, hits: Times, reach: int, room: Room | None = None) -> Indices:
    """The partner of each note: index of its hit or −1, shape (n,), of the one-to-one matching of least cost.

    `notes` (n,) and `hits` (m,) in ns, in any order; pairs farther apart than `reach`, or outside the note's room, are
    never made. Where an earlier note's room ends after a later one's, or a later one's begins before, both are cut.
    """
    note_order, hit_order = np.argsort(notes, kind="stable"), np.argsort(hits, kind="stable")
    notes, hits = notes[note_order], hits[hit_order]
    rooms = _nested(notes, reach, room, note_order)
    partner_sorted = _pair_sorted(notes, hits, rooms, reach)
    partner = np.full(len(notes), -1, np.int64)
    found = partner_sorted >= 0
    partner[note_order[found]] = hit_order[partner_sorted[found]]
    return partner


@dataclass(frozen=True, eq=False)
class _Rooms:
    """The first and last time of the hit of each note, (n,): about the note's own time, neither ever falling."""

    first: Times
    last: Times

    def __getitem__(self, which: Indices) -> "_Rooms":
        return _Rooms(self.first[which], self.last[which])


def _nested(notes: Times, reach: int, room: Room | None, order: Indices) -> _Rooms:
    """The rooms within `reach` of sorted `notes`; `room` has them in another `order`."""
    if room is None:
        return _Rooms(notes - reach, notes + reach)
    first, last = notes - np.minimum(room.early[order], reach), notes + np.minimum(room.late[order], reach)
    return _Rooms(np.maximum.accumulate(first), np.minimum.accumulate(last[::-1])[::-1])


def _pair_sorted(notes: Times, hits: Times, rooms: _Rooms, reach: int) -> Indices:
    partner = np.full(len(notes), -1, np.int64)
    free_notes, free_hits = _with_company(np.arange(len(notes)), np.arange(len(hits)), hits, rooms)
    for surely in _SURELY:
        while len(free_notes):
            i, j = surely(notes[free_notes], hits[free_hits], rooms[free_notes], reach)
            if not len(i):
                break
            partner[free_notes[i]] = free_hits[j]
            free_notes, free_hits = np.delete(free_notes, i), np.delete(free_hits, j)
            free_notes, free_hits = _with_company(free_notes, free_hits, hits, rooms)
    for some_notes, some_hits in _parted(free_notes, free_hits, hits, rooms):
        own = rooms[some_notes]
        spans = list(zip(own.first.tolist(), own.last.tolist(), strict=True))
        for i_note, j_hit in least_cost(notes[some_notes].tolist(), hits[some_hits].tolist(), spans, reach):
            partner[some_notes[i_note]] = some_hits[j_hit]
    return partner


def _islands(hits: Times, rooms: _Rooms) -> tuple[Indices, Indices]:
    """The number of the island that each note (n,) and each hit (m,) is on; no note reaches a hit of another.

    There is a note, and each hit lies in the room of one. A new island begins where no hit is in the rooms of both a
    note and the note before it.
    """
    shared = np.searchsorted(hits, rooms.last[:-1], side="right") > np.searchsorted(hits, rooms.first[1:])
    of_note = np.concatenate(([0], np.cumsum(~shared)))
    return of_note, of_note[np.searchsorted(rooms.last, hits)]


def _even_pairs(notes: Times, hits: Times, rooms: _Rooms, reach: int) -> tuple[Indices, Indices]:
    """Notes and hits of islands with as many of the ones as of the others that are best paired in their order."""
    of_note, of_hit = _islands(hits, rooms)
    count = int(of_note[-1]) + 1
    even = np.bincount(of_note, minlength=count) == np.bincount(of_hit, minlength=count)
    i, j = np.flatnonzero(even[of_note]), np.flatnonzero(even[of_hit])
    near = (hits[j] - notes[i]) / (reach + 1)
    near[(hits[j] < rooms.first[i]) | (hits[j] > rooms.last[i])] = np.inf
    good = (np.bincount(of_note[i], near * near, count) <= 1.0)[of_note[i]]
    return i[good], j[good]


def _two_nearest(of: Times, among: Times) -> tuple[Indices, Times, Times]:
    """For each of `of` (n,): index of the nearest of `among`, its distance, the distance of the second nearest."""
    padded = np.concatenate(([-_FAR, -_FAR], among, [_FAR, _FAR]))
    right = np.searchsorted(among, of) + 2
    left_d, right_d = of - padded[right - 1], padded[right] - of
    takes_left = left_d <= right_d
    nearest = np.where(takes_left, right - 1, right)
    near_d = np.minimum(left_d, right_d)
    beyond = np.where(takes_left, of - padded[right - 2], padded[np.minimum(right + 1, len(padded) - 1)] - of)
    return nearest - 2, near_d, np.minimum(np.maximum(left_d, right_d), beyond)


def _choices(hits: Times, rooms: _Rooms) -> tuple[Indices, Indices]:
    """How many hits lie in the room of each note (n,), and in how many rooms each hit (m,) lies."""
    of_note = np.searchsorted(hits, rooms.last, side="right") - np.searchsorted(hits, rooms.first)
    of_hit = np.searchsorted(rooms.first, hits, side="right") - np.searchsorted(rooms.last, hits)
    return of_note, of_hit


def _safe_pairs(notes: Times, hits: Times, rooms: _Rooms, reach: int) -> tuple[Indices, Indices]:
    """Mutually nearest notes and hits that surely belong to a best matching, as two index arrays."""
    hit_of, d, second_hit = _two_nearest(notes, hits)
    note_of, _, second_note = _two_nearest(hits, notes)
    at = hits[hit_of]
    i = np.flatnonzero((rooms.first <= at) & (at <= rooms.last) & (note_of[hit_of] == np.arange(len(notes))))
    j = hit_of[i]
    of_note, of_hit = _choices(hits, rooms)
    a, b, near = second_hit[i] / (reach + 1), second_note[j] / (reach + 1), d[i] / (reach + 1)
    safe = (of_note[i] == 1) | (of_hit[j] == 1) | (a * a + b * b >= 1.0 + near * near)
    return i[safe], j[safe]


def _with_company(free_notes: Indices, free_hits: Indices, hits: Times, rooms: _Rooms) -> tuple[Indices, Indices]:
    """Those that still have somebody to pair with."""
    of_note, of_hit = _choices(hits[free_hits], rooms[free_notes])
    return free_notes[of_note > 0], free_hits[of_hit > 0]


_SURELY = (_even_pairs, _safe_pairs, _even_pairs)
"""Each is repeated until it finds nothing more."""


def _parted(free_notes: Indices, free_hits: Indices, hits: Times, rooms: _Rooms) -> list[tuple[Indices, Indices]]:
    """Free notes and hits by their islands; each hit lies in the room of a note."""
    if not len(free_notes):
        return []
    of_note, of_hit = _islands(hits[free_hits], rooms[free_notes])
    last = np.arange(of_note[-1])
    note_parts = np.split(free_notes, np.searchsorted(of_note, last, side="right"))
    hit_parts = np.split(free_hits, np.searchsorted(of_hit, last, side="right"))
    return list(zip(note_parts, hit_parts, strict=True))


def least_cost(notes: list[int], hits: list[int], rooms: list[tuple[int, int]], reach: int) -> list[tuple[int, int]]:
    """Pairs (note, hit) of the best matching that does not cross, both lists sorted; by dynamic programming.

    `rooms` say the first and the last time of each note's hit, neither of which ever falls.

    `best[j]` is the least cost of the notes so far with hits before j. Only the hits in a note's room can change
    it; beyond them it is level, so a row is as short as the room is narrow.
    """
    best = [0.0] * (len(hits) + 1)
    steps: list[tuple[int, bytearray]] = []  # for each note: its first hit in reach, and whether each was taken
    low = high = 0
    narrow = 1 / (reach + 1)
    for note, (first, last) in zip(notes, rooms, strict=True):
        while low < len(hits) and hits[low] < first:
            low += 1
        while high < len(hits) and hits[high] <= last:
            best[high + 1] = best[high]
            high += 1
        taken = bytearray(high - low)
        before = best[low]
        for j in range(low, high):
            with_hit = before + ((hits[j] - note) * narrow) ** 2 - 1.0
            before = best[j + 1]
            if with_hit < best[j] and with_hit < before:
                best[j + 1] = with_hit
                taken[j - low] = 1
            elif best[j] < before:
                best[j + 1] = best[j]
                taken[j - low] = 2
        steps.append((low, taken))
    return _walk_back(steps, high)


_TAKEN, _PASSED = 1, 2


def _walk_back(steps: list[tuple[int, bytearray]], j: int) -> list[tuple[int, int]]:
    """Follow the choices from the last note back; `taken` says for hit j: 1 paired here, 2 no better than without j."""
    pairs = []
    for i in range(len(steps) - 1, -1, -1):
        low, taken = steps[i]
        j = min(j, low + len(taken))
        while j > low and taken[j - 1 - low] == _PASSED:
            j -= 1
        if j > low and taken[j - 1 - low] == _TAKEN:
            j -= 1
            pairs.append((i, j))
    return pairs[::-1]
