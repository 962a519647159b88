"""How often a lesson was played: a recording of a loop does not say where it ends.

The lesson is laid out as often as anybody could have played it in the time, and the player followed through it: where
they got to says how many passes that were. Who stops and begins again is back at the beginning of a pass, and who
leaves strokes out or doubles them is no farther on.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.following.anchors import Hits
from station.scoring.following.offline import free_way
from station.scoring.following.written import may_bounce, written_of
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.match_classes import match_classes

_FASTEST = 2.2
"""Nobody plays faster than so many times the written tempo (our choice)."""

_MOST_PASSES = 2000
"""Bounds the time for a recording of hours against a lesson of one short bar."""

_LEAST_SHARE = 0.1
"""A pass of which no more than this share was played is the landing of the one before."""


def times_played(score: Score, performance: Performance) -> int:
    """How many passes of `score` the performance is, at least one."""
    if not len(score) or not len(performance):
        return 1
    classes = match_classes()
    bounces = Unwritten(score).may_bounce(performance)
    hit_class = may_bounce(classes[performance.hits["piece"]], bounces)
    known = np.isin(hit_class, written_of(score, classes[score.notes["piece"]]).lanes[1])
    if not known.any():
        return max(1, round(int((~bounces).sum()) / len(score)))
    at_s = np.asarray(performance.hits["at_ns"][known] / NS_PER_S)
    pass_s = score.length_ns / NS_PER_S
    most = min(int(_FASTEST * float(np.ptp(at_s)) / pass_s) + 2, _MOST_PASSES)
    looped = score.repeated(most)
    hits = Hits(at_s, hit_class[known])
    written = written_of(looped, classes[looped.notes["piece"]]).of_classes(hits.classes)
    way, tempo = free_way(written, hits, ends=False)
    return _passes(way.score_s * tempo / pass_s, len(score))


def _passes(place: NDArray[np.float64], notes: int) -> int:
    """Passes of hits at `place` (m,), in passes: from the first to the last that was more than landed on."""
    count = np.bincount(np.maximum(np.floor(place + _EARLY), 0).astype(np.int64))
    begun = np.flatnonzero(count > _LEAST_SHARE * notes)
    return int(begun[-1] - begun[0]) + 1 if len(begun) else 1


_EARLY = 0.01
"""Share of a pass by which its first stroke may come early."""
