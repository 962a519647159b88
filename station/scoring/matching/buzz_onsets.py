"""The press of a buzz roll answers its note, and not a bounce that happens to lie nearer to the written time.

Whoever presses 17 ms early has the first bounce 13 ms late; by time alone the bounce would be the note's stroke. So a
note of a buzz that was given a bounce takes the press that this bounce goes back to, if nobody else has it.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation
from station.music.score import Score
from station.scoring.matching.assignment import AssignmentSide, HitAssignment
from station.scoring.matching.ignored_hits import BOUNCE_NS


def with_buzz_onsets(
    score: Score, assignment: HitAssignment, hits: AssignmentSide, bounces: NDArray[np.bool_]
) -> HitAssignment:
    """`assignment` with presses in place of `bounces` (m,); `hits` (m,) in order of playing."""
    partner = assignment.partner
    buzzes = (score.notes["articulation"] == Articulation.BUZZ) & (partner >= 0)
    swapped = np.flatnonzero(buzzes & bounces[partner]) if len(bounces) else np.empty(0, np.int64)
    if not len(swapped):
        return assignment
    taken, partner = {*partner.tolist(), *assignment.wrong.tolist()}, partner.copy()
    for note in swapped.tolist():
        press = _press_of(hits, bounces, int(partner[note]))
        if press is not None and press not in taken:
            partner[note] = press
    return replace(assignment, partner=partner)


def _press_of(hits: AssignmentSide, bounces: NDArray[np.bool_], bounce: int) -> int | None:
    """The last hit of the same lane before `bounce` that is none; None where it is too long ago."""
    earliest_ns = int(hits.at_ns[bounce]) - BOUNCE_NS
    for hit in range(bounce - 1, -1, -1):
        if hits.strand[hit] != hits.strand[bounce] or hits.at_ns[hit] < earliest_ns:
            return None
        if hits.classes[hit] == hits.classes[bounce] and not bounces[hit]:
            return hit
    return None
