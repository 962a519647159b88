"""What an alignment is: a matching with the asynchronies and what they were measured against.

Asynchrony is played − due, negative is early, in ns of real (performance) time. What is due is said by `Reference`: the
click; the file's own time, where the performance was recorded on the score's time base; or else the player's own tempo
curve, against which a lean of the whole cannot be known.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Judgement, Label, Matching
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.take_matching import TakeMatching


class Reference(Enum):
    """What asynchronies are measured against."""

    CLICK = "click"
    FILE = "file"
    PLAYER = "player"


@dataclass(frozen=True, eq=False)
class Alignment(Matching):
    """A matching and what it was measured by.

    `asynchrony_ns` (n,) played − due of each paired note (0 where `hit_of_note` is −1); `hit_score_ns` (m,) where each
    hit lies in score time; `segment` (m,) which uninterrupted segment of playing each hit belongs to, from 0;
    `sd_ms` the robust spread about the player's lean and drift, None where too little is known.
    """

    asynchrony_ns: NDArray[np.int64]
    hit_score_ns: NDArray[np.int64]
    segment: NDArray[np.int64]
    reference: Reference
    sd_ms: float | None


@dataclass(frozen=True, eq=False)
class Timed:
    """Hits in score time and what is due: `due_ns` (n,) of each paired note on the axis of `at_ns` (m,)."""

    at_ns: NDArray[np.int64]
    due_ns: NDArray[np.int64]
    score_ns: NDArray[np.int64]
    segment: NDArray[np.int64]
    reference: Reference


def labelled(matching: TakeMatching, timed: Timed) -> Alignment:
    """The alignment that a matching stands for."""
    assignment = matching.assignment
    hit_of_note = np.where(assignment.partner >= 0, assignment.partner, assignment.wrong)
    paired = hit_of_note >= 0
    note_label = np.where(assignment.partner >= 0, Label.MATCH, np.where(paired, Label.WRONG_PIECE, Label.MISS))
    hit_label = matching.unpaired_label.copy()
    note_of_hit = np.full(len(timed.at_ns), -1, np.int64)
    note_of_hit[hit_of_note[paired]] = np.flatnonzero(paired)
    hit_label[hit_of_note[paired]] = note_label[paired]
    asynchrony = np.zeros(len(hit_of_note), np.int64)
    asynchrony[paired] = timed.at_ns[hit_of_note[paired]] - timed.due_ns[paired]
    return Alignment(
        hit_of_note=hit_of_note,
        note_of_hit=note_of_hit,
        note_label=note_label.astype(np.uint8),
        hit_label=hit_label,
        asynchrony_ns=asynchrony,
        hit_score_ns=timed.score_ns,
        segment=timed.segment,
        reference=timed.reference,
        sd_ms=assignment.sd_ms,
    )


def judgements(score: Score, performance: Performance, alignment: Alignment) -> list[Judgement]:
    """The alignment as single judgements: a note each with its hit, then the hits without a note, both in order."""
    played, written = performance.fine_velocity.tolist(), score.notes["velocity"].tolist()
    said = []
    for note, hit in enumerate(alignment.hit_of_note.tolist()):
        label = Label(alignment.note_label[note])
        if hit < 0:
            said.append(Judgement(label, note, None))
        else:
            said.append(Judgement(label, note, hit, int(alignment.asynchrony_ns[note]), played[hit] - written[note]))
    alone = np.flatnonzero(alignment.note_of_hit < 0).tolist()
    return said + [Judgement(Label(alignment.hit_label[hit]), None, hit) for hit in alone]
