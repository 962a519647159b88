"""Grace strokes and their main strokes: which leads to which, and those that stand farther off than usual.

A flam that is played far too wide is a wide flam, and not a stroke left out beside one that nobody wrote. So a grace
stroke without a hit, whose main stroke has one, takes the nearest free hit of its piece before that, within what the
ornament spans and a little more.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.score import Score
from station.scoring.matching.assignment import AssignmentSide, HitAssignment
from station.scoring.matching.pairing import Indices

FARTHEST_MORE_NS = 80 * NS_PER_MS
"""How much wider than written a grace stroke is still one (our choice: a flam of 30 ms becomes one of 110, slower than
which both strokes are heard as notes of their own)."""


def main_of_grace(score: Score) -> Indices:
    """Index of the main stroke that each grace stroke (n,) leads to; −1 for main strokes and graces without one.

    It stands on the same tick, on the grace's own piece where there is one.
    """
    main = np.full(len(score), -1, np.int64)
    pieces, mains, graces = score.notes["piece"], np.flatnonzero(~score.is_grace), np.flatnonzero(score.is_grace)
    ticks = score.notes["tick"][mains]
    lows, highs = (np.searchsorted(ticks, score.notes["tick"][graces], side=side) for side in ("left", "right"))
    for grace, low, high in zip(graces.tolist(), lows.tolist(), highs.tolist(), strict=True):
        there = mains[low:high]
        own = there[pieces[there] == pieces[grace]]
        if len(there):
            main[grace] = own[0] if len(own) else there[0]
    return main


def with_far_graces(score: Score, assignment: HitAssignment, hits: AssignmentSide) -> HitAssignment:
    """`assignment` with a hit for the grace strokes that were played too wide; `hits` (m,) in order of playing."""
    lonely = np.flatnonzero(score.is_grace & (assignment.partner < 0) & (assignment.wrong < 0))
    if not len(lonely):
        return assignment
    main, partner = main_of_grace(score), assignment.partner.copy()
    taken = np.zeros(len(hits.at_ns), np.bool_)
    taken[partner[partner >= 0]] = True
    taken[assignment.wrong[assignment.wrong >= 0]] = True
    for grace in lonely.tolist():
        main_hit = int(partner[main[grace]]) if main[grace] >= 0 else -1
        if main_hit >= 0:
            lead_ns = int(score.onset_ns[main[grace]] - score.onset_ns[main == main[grace]].min())
            found = _last_free(hits, main_hit, int(hits.at_ns[main_hit]) - lead_ns - FARTHEST_MORE_NS, taken)
            if found is not None:
                partner[grace], taken[found] = found, True
                heard = np.flatnonzero((main == main[grace]) & (partner >= 0))
                partner[heard] = np.sort(partner[heard])  # the strokes of a drag come in their order
    return replace(assignment, partner=partner)


def _last_free(hits: AssignmentSide, before: int, earliest_ns: int, taken: NDArray[np.bool_]) -> int | None:
    """The last hit of the same lane before hit `before` that nobody has; None if there is none from `earliest_ns`."""
    for hit in range(before - 1, -1, -1):
        if hits.strand[hit] != hits.strand[before] or hits.at_ns[hit] < earliest_ns:
            return None
        if hits.classes[hit] == hits.classes[before] and not taken[hit]:
            return hit
    return None
