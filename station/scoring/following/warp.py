"""From performance time to score time when tempo and place are unknown: the whole way of a performance through a score.

`offline` finds the way. What is played without a jump is a *segment*; within it the way is smoothed (`slow_drift`).
Times are seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits
from station.scoring.following.free_run import RawWay
from station.scoring.following.offline import clicked_way, free_way
from station.scoring.following.tempo_tracker import GATE_S
from station.scoring.following.written import Written, written_of
from station.scoring.matching.slow_drift import half_width, local_trend, robust_sd

__all__ = ["Warp", "Written", "click_warp", "find_warp", "written_of"]

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Warp:
    """Score time in s of each hit (m,), and the segment (m,), from 0, that it belongs to.

    `lean_s` (m,) is how far each leans from the click, late is positive; 0 where the way is the player's own.
    """

    score_s: Floats
    segment: Indices
    lean_s: Floats


def find_warp(written: Written, hit_s: Floats, hit_classes: Indices) -> Warp:
    """The way of the hits (m,), sorted, through the score; at least one hit has the class of a note."""
    known = np.flatnonzero(np.isin(hit_classes, written.lanes[1]))
    hits = Hits(hit_s[known], hit_classes[known])
    way, tempo = free_way(written.of_classes(hits.classes), hits)
    segment = _segments(way.jumps, len(known))
    score_s = _smoothed(hits.at_s, way, segment) * tempo
    return _filled(score_s, np.zeros(len(known)), segment, hit_s, known)


def click_warp(written: Written, hit_s: Floats, hit_classes: Indices, common_s: float) -> Warp | None:
    """The way of hits (m,), sorted, whose times are score time but for bars that were left out or played again.

    None where there are none, and the player leans no more here than there. `common_s` is the lean that was taken off.
    """
    known = np.flatnonzero(np.isin(hit_classes, written.answered))
    if not len(known):
        return None
    hits = Hits(hit_s[known], hit_classes[known])
    way = clicked_way(written, hits, common_s)
    if way.score_s is hits.at_s and not way.lean_s.any():
        return None
    return _filled(way.score_s, way.lean_s, _segments(way.jumps, len(known)), hit_s, known)


def _segments(jumps: Indices, count: int) -> Indices:
    """Number of the segment of each hit (m,): a new one begins where the place jumps; behind the last there is none."""
    begins = np.zeros(count + 1, np.int64)
    begins[jumps] = 1
    return np.cumsum(begins[:count])


def _smoothed(at_s: Floats, raw: RawWay, segment: Indices) -> Floats:
    """The way of the hits (m,), freed of the loop's jitter: lines through the notes that were met, fitted twice.

    The second fit, to what the first left over, takes back the bend that straight lines cut off ("twicing", Tukey
    1977).
    """
    places, distances, way = raw.score_s, raw.distance_s, raw.score_s.copy()
    for k in range(int(segment[-1]) + 1):
        own = np.flatnonzero(segment == k)
        off = distances[own]
        near = np.abs(off) < GATE_S
        scale = robust_sd(off[near])
        if scale:
            met, weights = places[own] + off - at_s[own], near.astype(np.float64)
            width = half_width(at_s[own])
            first = local_trend(at_s[own], met, width, scale, weights)
            second = local_trend(at_s[own], met - first, width, scale, weights)
            way[own] = at_s[own] + first + second
    return way


def _filled(way: Floats, lean_s: Floats, segment: Indices, hit_s: Floats, known: Indices) -> Warp:
    """The warp of all hits: those of classes that the score lacks lie between their neighbours'."""
    after = np.searchsorted(known, np.arange(len(hit_s)))
    home = np.minimum(after, len(known) - 1)
    beside = hit_s[known]
    score_s = np.empty(len(hit_s))
    for k in range(int(segment[-1]) + 1):
        own, here = np.flatnonzero(segment[home] == k), np.flatnonzero(segment == k)
        score_s[own] = np.interp(hit_s[own], beside[here], way[here])
    score_s[known] = way
    return Warp(score_s, segment[home], lean_s[home])
