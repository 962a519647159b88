"""How often a lesson was played: a recording of a loop does not say where it ends.

Each piece that is played says it for itself, by how many strokes it got for each that is written; the piece of the
middle note is believed, so that ghost notes, a foot that keeps time, or one pad that triggers twice do not make five
passes of four. The bounces of a buzz roll are no strokes.
"""

import numpy as np

from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.match_classes import match_classes


def times_played(score: Score, performance: Performance) -> int:
    """How many passes of `score` the performance is, at least one."""
    if not len(score) or not len(performance):
        return 1
    classes, bounces = match_classes(), Unwritten(score).surely_bounces(performance)
    written = np.bincount(classes[score.notes["piece"]], minlength=len(classes))
    played = np.bincount(classes[performance.hits["piece"][~bounces]], minlength=len(classes))
    here = np.flatnonzero((written > 0) & (played > 0))
    passes = np.repeat(played[here] / written[here], written[here])
    return max(1, round(float(np.median(passes)) if len(here) else len(performance) / len(score)))
