"""Alignment without a click: the player's own clock is found, and what was due is told by it or by the file.

A passage that was played more than once is paired with one attempt (`attempts`); the hits of the others do not count.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.following.warp import Warp, find_warp, written_of
from station.scoring.matching.alignment import Alignment, Reference, Timed, labelled
from station.scoring.matching.assignment import HitAssignment
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.pairing import Indices, Times
from station.scoring.matching.slow_drift import local_trend, robust_sd
from station.scoring.matching.take_matching import Way, match_take

Floats = NDArray[np.float64]

NO_CLASS = -1
"""Of hits that no note has the class of: they lie between their neighbours."""

SAME_BASE_MS, SAME_BASE_WANDER_MS = 100.0, 60.0
"""A performance that starts within the first and wanders less than the second about it was recorded on the score's own
time base (our choice: a lean and a latency; three times a bar's slow sway)."""

_MOST_PACE = 5.0
"""So many times the written tempo, or slower by as much, nobody plays; a flurry about one note might seem to."""

_CURVE_HALF_WIDTH = 16
"""Hits to both sides in the player's tempo curve: two bars in all, so that a fill's rush stays visible."""


def align_unclocked(
    score: Score, performance: Performance, note_class: Indices, hit_class: Indices, may_share_base: bool
) -> Alignment:
    """The alignment of hits of unknown tempo and offset; some hit has a class that some note has.

    Unless the hits `may_share_base` with the score, a likeness of their times is chance: the player's tempo tells.
    """
    at_ns: Times = np.asarray(performance.hits["at_ns"])
    written = written_of(score, note_class)
    bounces = Unwritten(score).surely_bounces(performance)
    led_class = np.where(bounces, NO_CLASS, hit_class)
    warp = find_warp(written, at_ns / NS_PER_S, led_class)
    hit_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64)
    matching = match_take(score, performance, note_class, hit_class, Way(hit_ns, warp.stretch))
    return labelled(matching, _timed(score, at_ns, warp, matching.assignment, may_share_base))


def _timed(score: Score, at_ns: Times, warp: Warp, assignment: HitAssignment, may_share_base: bool) -> Timed:
    """When each paired note was due, by the file's time if that is the score's, else by the player's tempo curve."""
    hit_of_note = np.where(assignment.partner >= 0, assignment.partner, assignment.wrong)
    score_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64)
    told = np.flatnonzero((assignment.partner >= 0) & ~score.is_grace)
    told = told[np.argsort(at_ns[hit_of_note[told]], kind="stable")]
    played, written = at_ns[hit_of_note[told]], score.onset_ns[told]
    if may_share_base and _is_same_base(played, written):
        return Timed(at_ns, score.onset_ns, score_ns, warp.stretch, Reference.FILE)
    off_ns = score_ns[np.maximum(hit_of_note, 0)] - score.onset_ns - assignment.trend_ns
    pace = _paces(at_ns, warp)[np.maximum(hit_of_note, 0)]
    due = at_ns[np.maximum(hit_of_note, 0)] - np.rint(off_ns / pace).astype(np.int64)
    return Timed(at_ns, due, score_ns, warp.stretch, Reference.PLAYER)


def _is_same_base(played_ns: Times, written_ns: Times) -> bool:
    """Whether hits and their notes share one time base, but for a lean."""
    off_ms = (played_ns - written_ns) / NS_PER_MS
    scale = robust_sd(off_ms)
    if scale is None or abs(float(np.median(off_ms))) > SAME_BASE_MS:
        return False
    trend = local_trend(played_ns / NS_PER_S, off_ms, _CURVE_HALF_WIDTH, max(scale, 1.0))
    return float(np.abs(trend - np.median(off_ms)).max()) <= SAME_BASE_WANDER_MS


def _paces(at_ns: Times, warp: Warp) -> Floats:
    """Score seconds a played second around each hit (m,): 1 is the written tempo."""
    count = len(at_ns)
    pace = np.ones(count)
    edges = np.flatnonzero(np.diff(warp.stretch, prepend=-1, append=-1))
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        k = np.arange(start, end)
        low, high = np.maximum(k - _CURVE_HALF_WIDTH, start), np.minimum(k + _CURVE_HALF_WIDTH, end - 1)
        took = (at_ns[high] - at_ns[low]) / NS_PER_S
        passed = warp.score_s[high] - warp.score_s[low]
        known = (took > 0.0) & (passed * _MOST_PACE > took) & (passed < _MOST_PACE * took)
        pace[k[known]] = passed[known] / took[known]
    return pace
