"""Alignment without a click: the player's own clock is found, and what was due is told by it or by the file.

A passage that was played more than once is paired with one attempt (`attempts`); the hits of the others do not count.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.following.warp import Warp, find_warp, written_of
from station.scoring.following.written import may_bounce
from station.scoring.matching.alignment import Alignment, Reference, Timed, labelled
from station.scoring.matching.assignment import HitAssignment
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.pairing import Indices, Times
from station.scoring.matching.slow_drift import local_trend, robust_sd
from station.scoring.matching.take_matching import Way, match_take

Floats = NDArray[np.float64]

SAME_BASE_MS = 100.0
"""A performance that keeps the score's tempo and starts within so much of it was recorded on the score's own time base
(our choice: a lean and a latency)."""

STEADY_WANDER_MS, FREE_WANDER_MS = 30.0, 60.0
"""Who never strays farther than the first from the score's tempo plays to a click; whoever strays beyond the second
keeps a time of their own. Between, what was due lies between the two, so that no single stroke decides. The trend of a
player to a click (SD 20 ms, lag-1 .3) strays up to 20 ms; free tempo wanders by 100 ms in half a minute (HUMANS: an
interval's SD of 2–3 %, added up over 60 beats)."""

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
    led_class = may_bounce(hit_class, Unwritten(score).may_bounce(performance))
    warp = find_warp(written, at_ns / NS_PER_S, led_class)
    hit_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64)
    matching = match_take(
        score, performance, note_class, hit_class, Way(hit_ns, warp.segment, np.zeros(len(hit_ns), np.int64))
    )
    return labelled(matching, _timed(score, at_ns, warp, matching.assignment, may_share_base))


def _timed(score: Score, at_ns: Times, warp: Warp, assignment: HitAssignment, may_share_base: bool) -> Timed:
    """When each paired note was due: at the score's tempo, if the player kept it, else by the player's tempo curve.

    Where the hits begin on their axis has no say but in one thing: with a time base that both share a lean is known.
    """
    hit_of_note = np.where(assignment.partner >= 0, assignment.partner, assignment.wrong)
    score_ns = np.rint(warp.score_s * NS_PER_S).astype(np.int64)
    told = np.flatnonzero((assignment.partner >= 0) & ~score.is_grace)
    told = told[np.argsort(at_ns[hit_of_note[told]], kind="stable")]
    steady = _steady(at_ns[hit_of_note[told]], score.onset_ns[told])
    off_ns = score_ns[np.maximum(hit_of_note, 0)] - score.onset_ns - assignment.trend_ns
    pace = _paces(at_ns, warp)[np.maximum(hit_of_note, 0)]
    own_ns = at_ns[np.maximum(hit_of_note, 0)] - off_ns / pace
    kept_ns = score.onset_ns + steady.offset_ns
    due = kept_ns + np.rint(steady.freedom * (own_ns - kept_ns)).astype(np.int64)
    if may_share_base and steady.freedom < 1.0 and abs(steady.offset_ns) <= SAME_BASE_MS * NS_PER_MS:
        return Timed(at_ns, due - steady.offset_ns, score_ns, warp.segment, Reference.FILE)
    return Timed(at_ns, due, score_ns, warp.segment, Reference.PLAYER)


@dataclass(frozen=True, slots=True)
class _Steadiness:
    """How far hits lie behind the score's own times in the middle, and their `freedom`: 0 its tempo, 1 their own."""

    offset_ns: int
    freedom: float


def _steady(played_ns: Times, written_ns: Times) -> _Steadiness:
    """How hits, which rise, and their notes go together."""
    off_ms = (played_ns - written_ns) / NS_PER_MS
    scale = robust_sd(off_ms)
    if scale is None:
        return _Steadiness(0, 1.0)
    middle = float(np.median(off_ms))
    trend = local_trend(played_ns / NS_PER_S, off_ms, _CURVE_HALF_WIDTH, max(scale, 1.0))
    wander = float(np.abs(trend - middle).max())
    return _Steadiness(round(middle * NS_PER_MS), float(np.interp(wander, (STEADY_WANDER_MS, FREE_WANDER_MS), (0, 1))))


def _paces(at_ns: Times, warp: Warp) -> Floats:
    """Score seconds a played second around each hit (m,): 1 is the written tempo."""
    count = len(at_ns)
    pace = np.ones(count)
    edges = np.flatnonzero(np.diff(warp.segment, prepend=-1, append=-1))
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        k = np.arange(start, end)
        low, high = np.maximum(k - _CURVE_HALF_WIDTH, start), np.minimum(k + _CURVE_HALF_WIDTH, end - 1)
        took = (at_ns[high] - at_ns[low]) / NS_PER_S
        passed = warp.score_s[high] - warp.score_s[low]
        known = (took > 0.0) & (passed * _MOST_PACE > took) & (passed < _MOST_PACE * took)
        pace[k[known]] = passed[known] / took[known]
    return pace
