"""Where a student with a click is in the score: where the click is, or whole beats before or behind it.

The click is the ruler: a stop, a rush or a drag moves nothing. Whoever skips a bar or begins again plays on in time, in
another bar; then the hits speak against the place (`doubt`), and the last ones are held against the score moved by
every number of beats up to `_MOST_BEATS`, and near its beginning, until one fits so much better that it is worth a
jump. Times are seconds unless a name says otherwise.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.scoring.following.doubt import DOUBT, LEAST_HITS, MOST_MOVED, Doubt, Looks
from station.scoring.following.evidence import class_rates, evidence, nats
from station.scoring.following.locate import MISS_COST
from station.scoring.following.pursuit import JUMP_COST, JUMP_COST_PER_S, MOST_JUMP_COST_MORE
from station.scoring.following.shifts import to_nearest
from station.scoring.following.tempo_tracker import Tracker
from station.scoring.following.warp import Written
from station.scoring.matching.live_judge import Moved

Floats = NDArray[np.float64]

_MOST_BEATS = 64
"""As far as the final alignment looks: 16 bars of 4/4 (`shifts`)."""

_START_BEATS = 8
"""However far he has come, who begins again is found within so many beats of the beginning (our choice: two bars)."""


class ClickChase:
    """Follows hits through what is written."""

    def __init__(self, written: Written) -> None:
        note_s, classes = written.at_s, written.classes
        self._beats = written.beats()
        self._tracker, self._doubt = Tracker(note_s, classes), Doubt(note_s, classes)
        self._note_s = np.sort(note_s)
        rates = class_rates(note_s, classes)
        self._rates = rates
        self._rate_of: dict[int, float] = {c: float(rates[c]) for c in np.unique(classes).tolist()}
        self._by_class = {c: np.sort(note_s[classes == c]) for c in self._rate_of}
        self._shift = 0.0
        self._at_ns: list[int] = []
        self._classes: list[int] = []
        self._nats: list[float] = []
        self._looks = Looks()

    def place_ns(self, at_ns: int) -> int:
        """Where the student is when the click is at `at_ns`."""
        if self._shift == 0.0:
            return at_ns
        return round(float(self._beats.moved(np.array([at_ns / NS_PER_S]), np.array([self._shift]))[0]) * NS_PER_S)

    def hit(self, at_ns: int, match_class: int) -> Moved:
        """Take a hit; returns its place, and those of older ones where they turn out to lie elsewhere."""
        index, place_ns = len(self._at_ns), self.place_ns(at_ns)
        self._at_ns.append(at_ns)
        self._classes.append(match_class)
        if match_class not in self._rate_of:
            self._nats.append(0.0)
            return Moved(index, [place_ns])
        place = place_ns / NS_PER_S
        said = nats(self._tracker.distances([place], [match_class])[0], self._rate_of[match_class])
        self._nats.append(said)
        self._doubt.take(index, match_class, place, said)
        if self._doubt.nats == 0.0:
            self._looks.calm(index + 1)
        elif self._doubt.nats > DOUBT and self._looks.is_due(index):
            return self._look(index) or Moved(index, [place_ns])
        return Moved(index, [place_ns])

    def _look(self, index: int) -> Moved | None:
        """Whether the doubtful hits fit some beats away; then the student is there from the first of them on."""
        self._looks.look(index)
        first = max(self._doubt.since, index - MOST_MOVED + 1)
        known = [k for k in range(first, index + 1) if self._classes[k] in self._rate_of]
        if len(known) < LEAST_HITS:
            return None
        shifts = self._shifts(known[0])
        worth = self._worth(known, shifts)
        beat_s = float(np.diff(self._beats.at_s[:2])[0])
        cost = JUMP_COST + np.minimum(JUMP_COST_PER_S * beat_s * np.abs(shifts - self._shift), MOST_JUMP_COST_MORE)
        best = int(np.argmax(worth - cost))
        if worth[best] - cost[best] <= worth[shifts == self._shift].max(initial=-np.inf):
            return None
        self._shift = float(shifts[best])
        self._doubt.calm(index + 1)
        self._looks.calm(index + 1)
        places = self._moved(range(first, index + 1), shifts[best : best + 1])[:, 0]
        return Moved(first, np.rint(places * NS_PER_S).astype(np.int64).tolist())

    def _shifts(self, hit: int) -> Floats:
        """The shifts that are tried, rising: those near the present one, and those with `hit` near the beginning."""
        beat = self._beats.beat(np.array([self._note_s[0], self._at_ns[hit] / NS_PER_S]))
        to_start = np.rint(beat[0] - beat[1]) + np.arange(-_START_BEATS, _START_BEATS + 1.0)
        return np.unique(np.concatenate([self._shift + np.arange(-_MOST_BEATS, _MOST_BEATS + 1.0), to_start]))

    def _moved(self, hits: range | list[int], shifts: Floats) -> Floats:
        """Score times (hits, shifts)."""
        at_s = np.array([self._at_ns[k] for k in hits]) / NS_PER_S
        return self._beats.moved(at_s[:, None], shifts[None, :])

    def _worth(self, hits: list[int], shifts: Floats) -> Floats:
        """What hits and notes say for each of `shifts`, shape (shifts,)."""
        places = self._moved(hits, shifts)
        classes = np.array([self._classes[k] for k in hits])
        said = np.empty_like(places)
        for c in np.unique(classes).tolist():
            here = classes == c
            said[here] = evidence(to_nearest(self._by_class[c], places[here]), self._rates[c : c + 1])
        passed = np.searchsorted(self._note_s, places[-1]) - np.searchsorted(self._note_s, places[0])
        unheard = np.maximum(passed - (said > 0.0).sum(0), 0)
        return np.asarray(said.sum(0) - MISS_COST * unheard)
