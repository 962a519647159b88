"""Hits to notes one to one by least cost: the exact solution of the small problem that alignment reduces to.

Both sides are times on one axis. A pair at distance d costs (d/w)² − 1, a note or hit left alone costs nothing, so
that a pair is worth making within the reach and the closer the better (w is the reach and one ns, for the edge itself
is inside); the matching of least total cost is found. Because the cost is convex in d, some best matching never
crosses, and three facts make it fast:

* a note and a hit that are each other's nearest, at distance d, belong to a best matching if their second nearest lie
  at a and b with a² + b² ≥ w² + d² (breaking any other arrangement up to make this pair never costs more);
* with such pairs taken out the same holds for what remains, so the search is repeated;
* what still remains falls into groups that are more than w apart, each solved by dynamic programming.

The first two are whole-array operations; the third runs only in rolls and other tangles. Different pieces are kept
apart by `lanes`: the axis is cut and each piece put on its own stretch. Permuting simultaneous hits changes nothing but
which of the equal ones is named.
"""

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.int64]
Indices = NDArray[np.int64]

_FAR = np.int64(2**62)
"""Farther than any two session times."""


def lanes(times: Times, classes: Indices, span: int) -> Times:
    """Times (n,) moved so that each class lies on its own stretch of `span`; `span` exceeds every difference."""
    return times + classes * np.int64(span)


def pair_nearest(notes: Times, hits: Times, reach: int) -> Indices:
    """The partner of each note: index of its hit or −1, shape (n,), of the one-to-one matching of least cost.

    `notes` (n,) and `hits` (m,) in ns, in any order; pairs farther apart than `reach` are never made.
    """
    note_order, hit_order = np.argsort(notes, kind="stable"), np.argsort(hits, kind="stable")
    partner_sorted = _pair_sorted(notes[note_order], hits[hit_order], reach)
    partner = np.full(len(notes), -1, np.int64)
    found = partner_sorted >= 0
    partner[note_order[found]] = hit_order[partner_sorted[found]]
    return partner


def _pair_sorted(notes: Times, hits: Times, reach: int) -> Indices:
    partner = np.full(len(notes), -1, np.int64)
    free_notes, free_hits = np.arange(len(notes)), np.arange(len(hits))
    while len(free_notes) and len(free_hits):
        i, j = _safe_pairs(notes[free_notes], hits[free_hits], reach)
        if not len(i):
            break
        partner[free_notes[i]] = free_hits[j]
        free_notes, free_hits = np.delete(free_notes, i), np.delete(free_hits, j)
        free_notes, free_hits = _within_reach(notes, hits, free_notes, free_hits, reach)
    for some_notes, some_hits in _groups(notes, hits, free_notes, free_hits, reach):
        for i_note, j_hit in least_cost(notes[some_notes].tolist(), hits[some_hits].tolist(), reach):
            partner[some_notes[i_note]] = some_hits[j_hit]
    return partner


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


def _safe_pairs(notes: Times, hits: Times, reach: int) -> tuple[Indices, Indices]:
    """Mutually nearest notes and hits that surely belong to a best matching, as two index arrays."""
    hit_of, d, second_hit = _two_nearest(notes, hits)
    note_of, _, second_note = _two_nearest(hits, notes)
    i = np.flatnonzero((d <= reach) & (note_of[np.clip(hit_of, 0, len(hits) - 1)] == np.arange(len(notes))))
    j = hit_of[i]
    a, b, near = second_hit[i] / (reach + 1), second_note[j] / (reach + 1), d[i] / (reach + 1)
    safe = a * a + b * b >= 1.0 + near * near
    return i[safe], j[safe]


def _within_reach(
    notes: Times, hits: Times, free_notes: Indices, free_hits: Indices, reach: int
) -> tuple[Indices, Indices]:
    """Those that still have somebody within reach."""
    if not len(free_notes) or not len(free_hits):
        return free_notes[:0], free_hits[:0]
    _, note_d, _ = _two_nearest(notes[free_notes], hits[free_hits])
    _, hit_d, _ = _two_nearest(hits[free_hits], notes[free_notes])
    return free_notes[note_d <= reach], free_hits[hit_d <= reach]


def _groups(
    notes: Times, hits: Times, free_notes: Indices, free_hits: Indices, reach: int
) -> list[tuple[Indices, Indices]]:
    """Free notes and hits in runs that lie more than `reach` from each other."""
    if not len(free_notes) or not len(free_hits):
        return []
    times = np.sort(np.concatenate((notes[free_notes], hits[free_hits])))
    starts = times[1:][np.diff(times) > reach]
    note_parts = np.split(free_notes, np.searchsorted(notes[free_notes], starts))
    hit_parts = np.split(free_hits, np.searchsorted(hits[free_hits], starts))
    return [(n, h) for n, h in zip(note_parts, hit_parts, strict=True) if len(n) and len(h)]


def least_cost(notes: list[int], hits: list[int], reach: int) -> list[tuple[int, int]]:
    """Pairs (note, hit) of the best matching that does not cross, both lists sorted; by dynamic programming.

    `best[j]` is the least cost of the notes so far with hits before j. Only the hits within reach of a note can change
    it; beyond them it is level, so a row is as short as the reach is narrow.
    """
    best = [0.0] * (len(hits) + 1)
    steps: list[tuple[int, bytearray]] = []  # for each note: its first hit in reach, and whether each was taken
    low = high = 0
    narrow = 1 / (reach + 1)
    for note in notes:
        while low < len(hits) and hits[low] < note - reach:
            low += 1
        while high < len(hits) and hits[high] <= note + reach:
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
