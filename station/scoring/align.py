"""The final alignment of a performance with a score: hits to notes one to one by least cost.

With a click the hits come in score time already; the player's lean must be found (`click_offset`), and the bars that
were skipped or played again (`warp`). Without one tempo, drift and the place where the recording begins are unknown as
well, and `free_tempo` says what was due. Both ways end in `assignment`, which pairs.
"""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.following.free_tempo import NO_CLASS, align_unclocked
from station.scoring.following.stretches import owners
from station.scoring.following.warp import click_warp, written_of
from station.scoring.matching.alignment import Alignment, Reference, Timed, labelled
from station.scoring.matching.assignment import MOST_CLASSES, AssignmentSide, Start, assign, note_kinds, spots
from station.scoring.matching.buzz_onsets import with_buzz_onsets
from station.scoring.matching.click_offset import common_bias_ns
from station.scoring.matching.grace_strokes import with_far_graces
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.match_classes import match_classes
from station.scoring.matching.pairing import Indices


def align(
    score: Score,
    performance: Performance,
    clocked: bool,
    kit: Collection[Piece] | None = None,
    may_share_base: bool = True,
) -> Alignment:
    """Pair every hit and note that belong together.

    `clocked`: the hits' times are score time (practice with a click), else nothing is known of tempo and offset, but
    they `may_share_base`: a MIDI file may have been recorded on the score's own time, a capture never is.
    `kit` names the pieces that the student's kit has; notes of others fold onto what is there. Never raises.
    """
    classes = match_classes(kit)
    note_class, hit_class = classes[score.notes["piece"]], classes[performance.hits["piece"]]
    if clocked or not _share_a_class(note_class, hit_class):
        return align_clocked(score, performance, note_class, hit_class)
    return align_unclocked(score, performance, note_class, hit_class, may_share_base)


def _share_a_class(note_class: Indices, hit_class: Indices) -> bool:
    written, played = (np.bincount(side, minlength=MOST_CLASSES) for side in (note_class, hit_class))
    return bool((written * played).any())


def align_clocked(score: Score, performance: Performance, note_class: Indices, hit_class: Indices) -> Alignment:
    """The alignment of hits whose times are score time."""
    at_ns: NDArray[np.int64] = np.asarray(performance.hits["at_ns"])
    rules = Unwritten(score)
    bounces = rules.surely_bounces(performance)
    led = ~bounces  # bounces would say that all presses came early
    bias_ns = common_bias_ns(score.onset_ns, note_class, at_ns[led], hit_class[led])
    warp = click_warp(written_of(score, note_class), (at_ns - bias_ns) / NS_PER_S, np.where(led, hit_class, NO_CLASS))
    strand, attempt = np.zeros(len(score), np.int64), np.zeros(len(at_ns), np.int64)
    if warp is not None:
        at_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64) + bias_ns
        strand, attempt = owners(score.onset_s, note_class, warp, hit_class), warp.stretch
    unwritten = rules.masks(performance, at_ns - bias_ns)
    notes = AssignmentSide(score.onset_ns, note_class, strand, spots(score.notes))
    hits = AssignmentSide(at_ns, hit_class, attempt, spots(performance.hits))
    assignment = assign(notes, hits, note_kinds(score), unwritten.own_only, Start(bias_ns))
    assignment = with_buzz_onsets(score, with_far_graces(score, assignment, hits), hits, bounces)
    return labelled(assignment, Timed(at_ns, score.onset_ns, at_ns, attempt, Reference.CLICK), unwritten.quiet)
