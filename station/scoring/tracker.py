"""Following an unknown, drifting tempo hit by hit: a phase-locked loop between performance time and score time.

The place in the score is predicted from the last hit by the present tempo; the hit's distance to the nearest note of
its own class corrects the place and the tempo, the less the farther it lies (nothing beyond a gate). This is a loop of
second order with natural frequency ω and damping ζ (Gardner, Phaselock Techniques, 2005, ch. 2): a tempo that changes
by a per second leaves it behind by a/ω², 6 ms at a drift of ±12 % a minute.

Times are seconds. Score time is taken at the player's mean tempo, so that the loop always runs near rate 1. A hit costs
about half a microsecond, so that several loops can be tried where one gets lost.
"""

from bisect import bisect_left
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

GATE_S = 0.06
"""Our choice: nearly half a 16th at 120 bpm; a hit farther from all its notes tells nothing about the tempo."""

OMEGA, ZETA = 1.5, 0.8
"""rad/s and 1, by trial on drifts of 3–12 %: slower loops lag behind, faster ones follow the noise."""

_MIN_STEP_S, _MAX_STEP_S = 0.03, 0.2
"""A hit counts as much as the time since the last one, between these: chords are heard, and no pause shouts."""

_SAME_S = 1e-4
"""Notes of one class nearer than this are one place."""


@dataclass(frozen=True, slots=True)
class Place:
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
        for c in np.unique(classes).tolist():
            own = np.sort(note_s[classes == c])
            own = own[np.concatenate(([True], np.diff(own) > _SAME_S))]
            self._notes[c] = own.tolist()
            self._middles[c] = [*((own[1:] + own[:-1]) / 2).tolist(), inf]

    def follow(
        self, at_s: list[float], classes: list[int], start: Place, omega: float = OMEGA
    ) -> tuple[list[float], list[float], Place]:
        """Score time of each hit as predicted, its distance to the nearest note, and the place after the last.

        `at_s` (m,) rising, `classes` (m,). The prediction is what the loop believed before it heard the hit.
        """
        along, across, tightness = 2 * ZETA * omega, omega * omega, 1 / GATE_S**2
        notes, middles = self._notes, self._middles
        nearest = [bisect_left(own, start.score_s) if own else 0 for own in middles]
        score_s, rate, last_s = start.score_s, start.rate, start.at_s
        places: list[float] = []
        distances: list[float] = []
        for at, c in zip(at_s, classes, strict=True):
            step = at - last_s
            place = score_s + rate * step
            between, i = middles[c], nearest[c]
            if between[i] < place:
                i += 1
                while between[i] < place:
                    i += 1
                nearest[c] = i
            distance = notes[c][i] - place
            places.append(place)
            distances.append(distance)
            if -GATE_S < distance < GATE_S:
                if step < _MIN_STEP_S:
                    step = _MIN_STEP_S
                elif step > _MAX_STEP_S:
                    step = _MAX_STEP_S
                pull = (1 - distance * distance * tightness) * step * distance
                score_s = place + along * pull
                rate += across * pull
                last_s = at
        return places, distances, Place(last_s, score_s, rate)

    def step(self, at: float, match_class: int, here: Place) -> tuple[float, float, Place]:
        """`follow` for one hit: its predicted place, its distance to the nearest note, and the place after it."""
        since = at - here.at_s
        place = here.score_s + here.rate * since
        distance = self._notes[match_class][bisect_left(self._middles[match_class], place)] - place
        if not -GATE_S < distance < GATE_S:
            return place, distance, here
        since = min(max(since, _MIN_STEP_S), _MAX_STEP_S)
        pull = (1 - distance * distance / GATE_S**2) * since * distance
        return place, distance, Place(at, place + 2 * ZETA * OMEGA * pull, here.rate + OMEGA * OMEGA * pull)

    def distances(self, score_s: list[float], classes: list[int]) -> list[float]:
        """Nearest note of each class − place, for places (k,) in any order."""
        notes, middles = self._notes, self._middles
        return [notes[c][bisect_left(middles[c], at)] - at for at, c in zip(score_s, classes, strict=True)]
