"""The final alignment of a performance with a score: hits to notes one to one by least cost.

With a click the hits come in score time already; the player's lean must be found (`click_offset`), and the bars that
were skipped or played again (`warp`). Without one tempo, drift and the place where the recording begins are unknown as
well, and `free_tempo` says what was due. Both ways end in `match_take`, which pairs.
"""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.following.free_tempo import align_unclocked
from station.scoring.following.warp import click_warp, written_of
from station.scoring.following.written import may_bounce
from station.scoring.matching.alignment import Alignment, Reference, Timed, labelled
from station.scoring.matching.assignment import MOST_CLASSES
from station.scoring.matching.click_offset import common_bias_ns
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.match_classes import match_classes
from station.scoring.matching.pairing import Indices
from station.scoring.matching.take_matching import Way, match_take


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
    bounces = Unwritten(score).may_bounce(performance)  # they would say that all presses came early
    bias_ns = common_bias_ns(score.onset_ns, note_class, at_ns[~bounces], hit_class[~bounces])
    heard = may_bounce(hit_class, bounces)
    warp = click_warp(written_of(score, note_class), (at_ns - bias_ns) / NS_PER_S, heard, bias_ns / NS_PER_S)
    attempt, lean_ns = np.zeros(len(at_ns), np.int64), np.full(len(at_ns), bias_ns)
    if warp is not None:
        at_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64) + bias_ns
        attempt, lean_ns = warp.segment, lean_ns + np.rint(warp.lean_s * NS_PER_S).astype(np.int64)
    matching = match_take(score, performance, note_class, hit_class, Way(at_ns, attempt, lean_ns))
    return labelled(matching, Timed(at_ns, score.onset_ns, at_ns, attempt, Reference.CLICK))
