"""The final alignment of a performance with a score: hits to notes one to one by least cost.

With a click the hits come in score time already and only the player's lean must be found (`bias`). Without one the
tempo, its drift, the place where the recording begins and the bars that were skipped or played again are unknown;
`warp` finds them and `own_clock` says what was due. Both ways end in `settle`, which pairs.
"""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.alignment import Alignment, Reference, Timed, labelled
from station.scoring.bias import common_bias_ns
from station.scoring.classes import match_classes
from station.scoring.graces import with_far_graces
from station.scoring.ignored import Unwritten
from station.scoring.own_clock import align_unclocked
from station.scoring.pairing import Indices
from station.scoring.presses import with_presses
from station.scoring.settle import MOST_CLASSES, Side, Start, note_kinds, settle, spots


def align(score: Score, performance: Performance, clocked: bool, kit: Collection[Piece] | None = None) -> Alignment:
    """Pair every hit and note that belong together.

    `clocked`: the hits' times are score time (practice with a click), else nothing is known of tempo and offset.
    `kit` names the pieces that the student's kit has; notes of others fold onto what is there. Never raises.
    """
    classes = match_classes(kit)
    note_class, hit_class = classes[score.notes["piece"]], classes[performance.hits["piece"]]
    if clocked or not _share_a_class(note_class, hit_class):
        return align_clocked(score, performance, note_class, hit_class)
    return align_unclocked(score, performance, note_class, hit_class)


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
    unwritten = rules.masks(performance, at_ns - bias_ns)
    one = np.zeros(len(at_ns), np.int64)
    notes = Side(score.onset_ns, note_class, np.zeros(len(score), np.int64), spots(score.notes))
    hits = Side(at_ns, hit_class, one, spots(performance.hits))
    settled = settle(notes, hits, note_kinds(score), unwritten.own_only, Start(bias_ns))
    settled = with_presses(score, with_far_graces(score, settled, hits), hits, bounces)
    return labelled(settled, Timed(at_ns, score.onset_ns, at_ns, one, Reference.CLICK), unwritten.quiet)
