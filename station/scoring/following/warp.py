"""From performance time to score time when tempo and place are unknown: the whole way of a performance through a score.

The beginning is found (`beginning`) and the tempo followed from there, through pauses, restarts and bars that are left
out or played again (`ways`). What is played without a break is a *stretch*; within it the way is smoothed
(`slow_drift`). Times are seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.scoring.following.beginning import find_beginning
from station.scoring.following.evidence import class_rates
from station.scoring.following.locate import Hits, Notes
from station.scoring.following.shifts import Beats, jumps
from station.scoring.following.tempo_tracker import GATE_S, Place, Tracker
from station.scoring.following.ways import best_way, clicked_way
from station.scoring.matching.slow_drift import half_width, local_trend, robust_sd

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Written:
    """A score as it is looked for.

    `at_s` (n,) and `classes` (n,) of its notes in any order; `beat_s` (b,) of every quarter, rising, at least two;
    `bar_beats` how many quarters the first bar has.
    """

    at_s: Floats
    classes: Indices
    beat_s: Floats
    bar_beats: float

    def beats(self, tempo: float = 1.0) -> Beats:
        """Its quarters, played at `tempo` times the written one."""
        return Beats(self.beat_s / tempo, self.bar_beats)


def written_of(score: Score, note_class: Indices) -> Written:
    """`score`, whose notes are of `note_class` (n,), as it is looked for."""
    beats = np.arange(0, max(score.end_tick, PPQ) + 1, PPQ)
    bar_beats = score.tempo_map.meter_at(0).bar_ticks / PPQ
    return Written(score.onset_s, note_class, score.tempo_map.seconds_at(beats), bar_beats)


@dataclass(frozen=True, eq=False)
class Warp:
    """Score time in s of each hit (m,), and the stretch (m,), from 0, that it belongs to."""

    score_s: Floats
    stretch: Indices


def find_warp(written: Written, hit_s: Floats, hit_classes: Indices) -> Warp:
    """The way of the hits (m,), sorted, through the score; at least one hit has the class of a note."""
    known = np.flatnonzero(np.isin(hit_classes, written.classes))
    order = np.argsort(written.at_s, kind="stable")
    order = order[np.isin(written.classes[order], hit_classes)]  # a part that is never played tells no place
    note_s, classes = written.at_s[order], written.classes[order]
    hits = Hits(hit_s[known], hit_classes[known])
    notes = _prepared(note_s, classes)
    beginning = find_beginning(notes, hits)
    tempo = beginning.rate
    if tempo != 1.0:
        notes = _prepared(note_s / tempo, classes)
    way = best_way(notes, hits, Place(beginning.at_s, beginning.score_s / tempo, 1.0), written.beats(tempo))
    stretch = _stretches(hits.at_s, way.places)
    return _filled(_smoothed(hits.at_s, way.places, way.distances, stretch) * tempo, stretch, hit_s, known)


def click_warp(written: Written, hit_s: Floats, hit_classes: Indices) -> Warp | None:
    """The way of hits (m,), sorted, whose times are score time but for bars that were left out or played again.

    None where there are none.
    """
    known = np.flatnonzero(np.isin(hit_classes, written.classes))
    if not len(known):
        return None
    order = np.argsort(written.at_s, kind="stable")
    notes = _prepared(written.at_s[order], written.classes[order])
    hits = Hits(hit_s[known], hit_classes[known])
    places = clicked_way(notes, hits, written.beats())
    if places is None:
        return None
    stretch = _stretches(hits.at_s, places)
    return _filled(places, stretch, hit_s, known)


def _prepared(note_s: Floats, classes: Indices) -> Notes:
    return Notes(note_s, classes, class_rates(note_s, classes), Tracker(note_s, classes))


def _stretches(at_s: Floats, places: Floats) -> Indices:
    """Number of the stretch of each hit (m,): a new one begins where the place jumps."""
    begins = np.zeros(len(at_s), np.int64)
    begins[jumps(at_s, places)] = 1
    return np.cumsum(begins)


def _smoothed(at_s: Floats, places: Floats, distances: Floats, stretch: Indices) -> Floats:
    """The way of the hits (m,), freed of the loop's jitter: lines through the notes that were met, fitted twice.

    The second fit, to what the first left over, takes back the bend that straight lines cut off ("twicing", Tukey
    1977).
    """
    way = places.copy()
    for k in range(int(stretch[-1]) + 1):
        own = np.flatnonzero(stretch == k)
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


def _filled(way: Floats, stretch: Indices, hit_s: Floats, known: Indices) -> Warp:
    """The warp of all hits: those of classes that the score lacks lie between their neighbours'."""
    after = np.searchsorted(known, np.arange(len(hit_s)))
    home = np.minimum(after, len(known) - 1)
    beside = hit_s[known]
    score_s = np.empty(len(hit_s))
    for k in range(int(stretch[-1]) + 1):
        own, here = np.flatnonzero(stretch[home] == k), np.flatnonzero(stretch == k)
        score_s[own] = np.interp(hit_s[own], beside[here], way[here])
    score_s[known] = way
    return Warp(score_s, stretch[home])
