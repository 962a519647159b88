"""A whole take matched: what the assignment says, then what it cannot know of ornaments, bounces and attempts.

In: hits brought to score time, and the uninterrupted run that each belongs to (`following`). Out: pairs, and the labels
of the hits that answer no note.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.assignment import (
    AssignmentSide,
    HitAssignment,
    Leaning,
    assign,
    leaning_places,
    spots,
)
from station.scoring.matching.attempts import owners, played_again
from station.scoring.matching.buzz_onsets import with_buzz_onsets
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.note_reach import reach_of
from station.scoring.matching.pairing import Indices, Times
from station.scoring.matching.played_graces import with_far_graces


@dataclass(frozen=True, eq=False)
class Way:
    """Where the hits (m,) are: `score_ns` of score time, in the run `attempt`, from 0.

    `lean_ns` (m,) is how far the player leans from there, common to all pieces.
    """

    score_ns: Times
    attempt: Indices
    lean_ns: Times

    def lean_at(self, note_ns: Times, owner: Indices) -> Times:
        """The lean at notes (n,) that hits of the attempt `owner` (n,) may answer."""
        lean_ns = np.zeros(len(note_ns), np.int64)
        for attempt in np.unique(self.attempt).tolist():
            mine, notes = self.attempt == attempt, owner == attempt
            on_time_ns, own_ns = (self.score_ns - self.lean_ns)[mine], self.lean_ns[mine]
            order = np.argsort(on_time_ns, kind="stable")
            lean_ns[notes] = np.rint(np.interp(note_ns[notes], on_time_ns[order], own_ns[order])).astype(np.int64)
        return lean_ns


@dataclass(frozen=True, eq=False)
class TakeMatching:
    """The pairs, and the label (m,) of each hit that is in none."""

    assignment: HitAssignment
    unpaired_label: NDArray[np.uint8]


def match_take(
    score: Score, performance: Performance, note_class: Indices, hit_class: Indices, way: Way
) -> TakeMatching:
    """Match the hits of `performance` (m,), which lie on `way`, with the notes of `score` (n,)."""
    rules = Unwritten(score)
    on_time_ns = way.score_ns - way.lean_ns
    unwritten = rules.masks(performance, on_time_ns)
    owner, again = np.zeros(len(score), np.int64), np.zeros(len(way.score_ns), np.bool_)
    if way.attempt.any():
        owner = owners(score.onset_ns, note_class, on_time_ns, hit_class, way.attempt)
        again = played_again(score.onset_ns, owner, on_time_ns, way.attempt)
    notes = AssignmentSide(score.onset_ns, note_class, owner, spots(score.notes))
    hits = AssignmentSide(way.score_ns, hit_class, way.attempt, spots(performance.hits))
    leaning = Leaning(leaning_places(score), reach_of(score, note_class))
    assignment = assign(notes, hits, leaning, unwritten.own_only, way.lean_at(score.onset_ns, owner))
    assignment = with_far_graces(score, assignment, hits)
    assignment = with_buzz_onsets(score, assignment, hits, rules.may_bounce(performance))
    alone = np.select([again, unwritten.quiet], [Label.PLAYED_AGAIN, Label.IGNORED], Label.EXTRA)
    return TakeMatching(assignment, alone.astype(np.uint8))
