"""Following an unknown, drifting tempo hit by hit: a phase-locked loop between performance time and score time.

The place in the score is predicted from the last hit by the present tempo; the hit's distance to the nearest note of
its own class corrects the place and the tempo. This is a fading-memory filter of second order (Morrison, Introduction
to Sequential Smoothing and Prediction, 1969, ch. 13): what was known is kept by θ = 1/(1 + ω·t) over t seconds without
a hit, the place takes (1 − θ²) and the tempo (1 − θ)²/t of the distance. It is stable at any t, so that two strokes in
five seconds lead it as surely as twenty in one. A tempo that changes by a per second leaves it behind by a/ω², 6 ms at
a drift of ±12 % a minute.

A hit far off counts less, and beyond a gate nothing. The gate is wider after a long wait, when less is known, and never
reaches beyond the middle between two notes, where a hit belongs as well to the one as to the other.

Times are seconds. Score time is taken at the player's mean tempo, so that the loop always runs near rate 1. A hit costs
about half a microsecond, so that several loops can be tried where one gets lost.
"""

from bisect import bisect_left
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

GATE_S = 0.06
"""Our choice: nearly half a 16th at 120 bpm; a hit farther from all its notes tells nothing about the tempo."""

_SLACK = 0.08
"""The gate is wider by this share of the time since the last hit: a tempo may be wrong by so much (our choice)."""

_LEAST_ROOM_S = 0.03
"""Half of what stands closer than 60 ms, a flam, is no room at all: it is one place to the clock (our choice)."""

OMEGA = 1.5
"""rad/s, by trial on drifts of 3–12 %: slower loops lag behind, faster ones follow the noise."""

_MIN_STEP_S, _MAX_STEP_S = 0.03, 1.5
"""A hit counts as the time since the last one says, between these: chords are heard, and no pause shouts."""

_SAME_S = 1e-4
"""Notes of one class nearer than this are one place."""


class Place(NamedTuple):
    """At performance time `at_s` the player is at score time `score_s` and plays `rate` s of score in a second."""

    at_s: float
    score_s: float
    rate: float


class Tracker:
    """The loop over notes at `note_s` (n,) of classes (n,); hits of other classes must be left out."""

    def __init__(self, note_s: Floats, classes: Indices) -> None:
        count = int(classes.max(initial=0)) + 1
        self._notes: list[list[float]] = [[] for _ in range(count)]
        self._middles: list[list[float]] = [[] for _ in range(count)]
        self._rooms: list[list[float]] = [[] for _ in range(count)]
        for c in np.unique(classes).tolist():
            own = np.sort(note_s[classes == c])
            own = own[np.concatenate(([True], np.diff(own) > _SAME_S))]
            self._notes[c] = own.tolist()
            self._middles[c] = [*((own[1:] + own[:-1]) / 2).tolist(), inf]
            apart = np.concatenate(([inf], np.diff(own), [inf]))
            self._rooms[c] = np.maximum(np.minimum(apart[1:], apart[:-1]) / 2, _LEAST_ROOM_S).tolist()
        self._lanes = list(zip(self._middles, self._notes, self._rooms, strict=True))

    def follow(self, at_s: list[float], classes: list[int], start: Place) -> tuple[list[float], list[float], Place]:
        """Score time of each hit as predicted, its distance to the nearest note, and the place after the last.

        `at_s` (m,) rising, `classes` (m,). The prediction is what the loop believed before it heard the hit.
        """
        lanes = self._lanes
        nearest = {c: bisect_left(self._middles[c], start.score_s) for c in set(classes)}
        score_s, rate, last_s = start.score_s, start.rate, start.at_s
        places: list[float] = []
        distances: list[float] = []
        for at, c in zip(at_s, classes, strict=True):
            step = at - last_s
            place = score_s + rate * step
            between, own, rooms = lanes[c]
            i = nearest[c]
            if between[i] < place:
                i += 1
                while between[i] < place:
                    i += 1
                nearest[c] = i
            distance = own[i] - place
            places.append(place)
            distances.append(distance)
            if step < _MIN_STEP_S:
                step = _MIN_STEP_S
            elif step > _MAX_STEP_S:
                step = _MAX_STEP_S
            wide, room = GATE_S + _SLACK * step, rooms[i]
            gate = room if room < wide else wide
            if -gate < distance < gate:
                far = distance * distance / (gate * gate)
                kept = 1 / (1 + OMEGA * step)
                pull = (1 - far * far) * kept * distance  # (1 − θ)² / t is ω·θ·(1 − θ)
                score_s = place + (step + step * kept) * OMEGA * pull
                rate += OMEGA * OMEGA * step * kept * pull
                last_s = at
        return places, distances, Place(last_s, score_s, rate)

    def step(self, at: float, match_class: int, here: Place) -> tuple[float, float, Place]:
        """`follow` for one hit: its predicted place, its distance to the nearest note, and the place after it."""
        since = at - here.at_s
        place = here.score_s + here.rate * since
        i = bisect_left(self._middles[match_class], place)
        distance = self._notes[match_class][i] - place
        since = min(max(since, _MIN_STEP_S), _MAX_STEP_S)
        gate = min(self._rooms[match_class][i], GATE_S + _SLACK * since)
        if not -gate < distance < gate:
            return place, distance, here
        far = distance * distance / (gate * gate)
        kept = 1 / (1 + OMEGA * since)
        pull = (1 - far * far) * kept * distance * OMEGA * since
        return place, distance, Place(at, place + (1 + kept) * pull, here.rate + OMEGA * kept * pull)

    def distances(self, score_s: list[float], classes: list[int]) -> list[float]:
        """Nearest note of each class − place, for places (k,) in any order."""
        notes, middles = self._notes, self._middles
        return [notes[c][bisect_left(middles[c], at)] - at for at, c in zip(score_s, classes, strict=True)]
