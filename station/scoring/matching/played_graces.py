"""Grace strokes and their main strokes: which leads to which, and those that stand farther off than usual.

A flam that is played far too wide is a wide flam, and not a stroke left out beside one that nobody wrote. So a grace
stroke without a hit, whose main stroke has one, takes the nearest free hit of its piece before that, within what the
ornament spans and a little more.
"""

from dataclasses import replace

import numpy as np

from station.core.units import NS_PER_MS
from station.music.score import Score
from station.scoring.matching.assignment import MOST_CLASSES, AssignmentSide, HitAssignment
from station.scoring.matching.pairing import Indices

FARTHEST_MORE_NS = 80 * NS_PER_MS
"""How much wider than written a grace stroke is still one (our choice: a flam of 30 ms becomes one of 110, slower than
which both strokes are heard as notes of their own)."""


def main_of_grace(score: Score) -> Indices:
    """Index of the main stroke that each grace stroke (n,) leads to; −1 for main strokes and graces without one.

    It stands on the same tick, on the grace's own piece where there is one.
    """
    main = np.full(len(score), -1, np.int64)
    tick, piece = score.notes["tick"].astype(np.int64), score.notes["piece"].astype(np.int64)
    mains, graces = np.flatnonzero(~score.is_grace), np.flatnonzero(score.is_grace)
    if not len(mains) or not len(graces):
        return main
    there = _first_equal(tick[mains], tick[graces])
    own = _first_equal(tick[mains] * MOST_CLASSES + piece[mains], tick[graces] * MOST_CLASSES + piece[graces])
    found = np.where(own >= 0, own, there)
    main[graces] = np.where(found >= 0, mains[found], -1)
    return main


def _first_equal(keys: Indices, wanted: Indices) -> Indices:
    """Index of the first of `keys` (k,) that equals each of `wanted` (w,), or −1."""
    order = np.argsort(keys, kind="stable")
    at = np.minimum(np.searchsorted(keys, wanted, sorter=order), len(keys) - 1)
    return np.where(keys[order[at]] == wanted, order[at], -1)


def with_far_graces(score: Score, assignment: HitAssignment, hits: AssignmentSide) -> HitAssignment:
    """`assignment` with a hit for the grace strokes that were played too wide; `hits` (m,) in order of playing."""
    lonely = np.flatnonzero(score.is_grace & (assignment.partner < 0) & (assignment.wrong < 0))
    if not len(lonely):
        return assignment
    main, partner = main_of_grace(score), assignment.partner.copy()
    free = _Free(hits, partner, assignment.wrong)
    graces_of = _by_main(main)
    for grace in lonely[main[lonely] >= 0].tolist():
        leader = int(main[grace])
        graces, main_hit = graces_of[leader], int(partner[leader])
        lead_ns = int(score.onset_ns[leader] - score.onset_ns[graces[0]])
        found = free.take_last(main_hit, lead_ns + FARTHEST_MORE_NS) if main_hit >= 0 else None
        if found is not None:
            partner[grace] = found
            heard = graces[partner[graces] >= 0]
            partner[heard] = np.sort(partner[heard])  # the strokes of a drag come in their order
    return replace(assignment, partner=partner)


def _by_main(main: Indices) -> dict[int, Indices]:
    """The grace strokes of each main stroke that has some, in order."""
    graces = np.flatnonzero(main >= 0)
    graces = graces[np.argsort(main[graces], kind="stable")]
    parts = np.split(graces, np.flatnonzero(np.diff(main[graces])) + 1) if len(graces) else []
    return {int(main[part[0]]): part for part in parts}


class _Free:
    """The hits that answer nothing yet."""

    def __init__(self, hits: AssignmentSide, partner: Indices, wrong: Indices) -> None:
        taken = np.zeros(len(hits.at_ns), np.bool_)
        taken[partner[partner >= 0]] = True
        taken[wrong[wrong >= 0]] = True
        self._at_ns: list[int] = hits.at_ns.tolist()
        self._lane: list[int] = hits.lane.tolist()
        self._strand: list[int] = hits.strand.tolist()
        self._taken: list[bool] = taken.tolist()

    def take_last(self, before: int, within_ns: int) -> int | None:
        """Take the last free hit of the same lane, at most so long before hit `before`; None if there is none."""
        earliest_ns, strand = self._at_ns[before] - within_ns, self._strand[before]
        for hit in range(before - 1, -1, -1):
            if self._strand[hit] != strand or self._at_ns[hit] < earliest_ns:
                return None
            if self._lane[hit] == self._lane[before] and not self._taken[hit]:
                self._taken[hit] = True
                return hit
        return None
