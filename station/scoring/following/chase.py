"""Where a student without a click is in the score, hit by hit as he plays: tempo, phase, skips, restarts and stops.

A phase-locked loop (`tracker`) predicts every hit's place from those before. Two running sums (`doubt`) tell how much
the last hits speak against the place; beyond a limit other places are looked for (`elsewhere`). Those become rivals,
lines that are followed beside the lead (`line`), and the one that proves better by a margin takes over; the hits that
it places elsewhere are then judged anew.

A student who stops makes the score wait. After `STOP_NOTES` that nobody hit, and `STOP_S` of silence, the next hit is
taken for the next note of its class behind the stop until more hits tell where he really went on.

All that is believed depends on the hits alone. A hit costs a few microseconds whatever the score's length, a look
around some milliseconds, and looks are rare. Times are seconds; score time is at the written tempo.
"""

from bisect import bisect_right
from math import inf, log

import numpy as np

from station.core.units import NS_PER_S
from station.scoring.following.doubt import DOUBT, LEAST_HITS, MOST_MOVED, SLACK_S, Doubt, Looks
from station.scoring.following.elsewhere import FASTEST, SLOWEST, Elsewhere
from station.scoring.following.evidence import class_rates
from station.scoring.following.line import Line, Scales, jump_cost
from station.scoring.following.locate import MISS_COST, Hits, Notes
from station.scoring.following.shifts import START_S
from station.scoring.following.tempo_tracker import Place, Tracker
from station.scoring.following.warp import Written
from station.scoring.matching.live_judge import Moved

STOP_NOTES, STOP_S = 8, 1.0
"""Our choice: so many notes in a row are not missed by a player who plays on (2 nats each, a jump's cost)."""

_LOOK_HITS = 24
"""Hits that say where the student is: two bars of a sparse groove."""

_CONTEST_HITS = 4
"""Hits between two contests of the lead with its rivals (our choice: a beat of 16ths)."""

_MARGIN, _HOPELESS = 3.0, 12.0
"""Nats by which a rival must lead, and by which it is given up."""


class Chase:
    """Follows hits through what is written, at least one note; counted in to begin at time 0."""

    def __init__(self, written: Written) -> None:
        order = np.argsort(written.at_s, kind="stable")
        note_s, classes = written.at_s[order], written.classes[order]
        self._notes = Notes(note_s, classes, class_rates(note_s, classes), Tracker(note_s, classes))
        self._note_s: list[float] = note_s.tolist()
        self._by_class: dict[int, list[float]] = {c: note_s[classes == c].tolist() for c in np.unique(classes).tolist()}
        self._scales, self._elsewhere = Scales(self._notes), Elsewhere(self._notes)
        self._doubt = Doubt(note_s, classes)
        self._place = Place(0.0, 0.0, 1.0)
        self._times: list[float] = []
        self._classes: list[int] = []
        self._places: list[float] = []
        self._nats: list[float] = []
        self._stopped_at: int | None = None  # the first hit after the last stop, while that is in doubt
        self._stop_s = 0.0
        self.waited: list[tuple[int, int]] = []
        """The first hit after each stop, and for how many ns the score had waited for it."""
        self._rivals: list[Line] = []
        self._lead_total = 0.0
        self._contested = 0  # hits before this one have been held against the rivals
        self._looked = -1
        self._looks = Looks()
        self._calm(0)

    def place_ns(self, at_ns: int) -> int:
        """Where the student is at `at_ns` if he plays on; where the score waits once he has stopped."""
        here, last_s = self._place, self._places[-1] if self._places else 0.0
        place_s = here.score_s + here.rate * (at_ns / NS_PER_S - here.at_s)
        return round((min(place_s, self._waiting_s(last_s)) if place_s > last_s else place_s) * NS_PER_S)

    def hit(self, at_ns: int, match_class: int) -> Moved:
        """Take a hit; returns its place, and those of older ones where they turn out to lie elsewhere."""
        index, at_s = len(self._times), at_ns / NS_PER_S
        self._times.append(at_s)
        self._classes.append(match_class)
        if match_class not in self._by_class:
            here = self._place
            self._places.append(here.score_s + here.rate * (at_s - here.at_s))
            self._nats.append(0.0)
            return self._found(index)
        if self._has_stopped(index):
            self._resume(index)
        place, distance, self._place = self._notes.tracker.step(at_s, match_class, self._place)
        if not SLOWEST < self._place.rate < FASTEST:
            self._place = self._place._replace(rate=1.0)
        said = self._scales.said(distance, match_class)
        self._places.append(place)
        self._nats.append(said)
        self._doubt.take(index, match_class, place, said)
        if self._doubt.nats == 0.0:
            if self._looks.count or self._stopped_at is not None:
                self._calm(index + 1)
        elif self._doubt.nats > DOUBT and self._looks.is_due(index):
            self._look(index)
        if self._rivals and (index == self._looked or index >= self._contested + _CONTEST_HITS - 1):
            return self._found(self._contest(index))
        return self._found(index)

    def _found(self, first: int) -> Moved:
        return Moved(first, [round(place * NS_PER_S) for place in self._places[first:]], self._place.rate)

    # --- stops ------------------------------------------------------------------------------------------------------

    def _waiting_s(self, last_s: float) -> float:
        """Score time at which the score waits for a student whose last hit was at `last_s`."""
        after = bisect_right(self._note_s, last_s) + STOP_NOTES - 1
        return max(self._note_s[after], last_s + STOP_S) if after < len(self._note_s) else inf

    def _has_stopped(self, index: int) -> bool:
        """Whether hit `index` comes after a stop."""
        last_at_s, last_s = (self._times[index - 1], self._places[index - 1]) if index else (0.0, 0.0)
        silence_s = self._times[index] - last_at_s
        return silence_s > STOP_S and last_s + self._place.rate * silence_s > self._waiting_s(last_s)

    def _resume(self, index: int) -> None:
        """Take hit `index`, the first after a stop, for the next note of its class."""
        own, last_s = self._by_class[self._classes[index]], self._places[index - 1] if index else -SLACK_S
        place = own[min(bisect_right(own, last_s + SLACK_S), len(own) - 1)]
        played_on_s = (place - last_s) / self._place.rate
        silence_s = self._times[index] - (self._times[index - 1] if index else 0.0)
        self.waited.append((index, round((silence_s - played_on_s) * NS_PER_S)))
        self._place = Place(self._times[index], place, self._place.rate)
        self._calm(index)
        self._stopped_at, self._stop_s = index, last_s
        self._doubt.raised(index)

    # --- doubts -----------------------------------------------------------------------------------------------------

    def _calm(self, index: int) -> None:
        """The hits before `index` fit."""
        self._stopped_at = None
        self._looks.calm(index)

    def _look(self, index: int) -> None:
        """Find where else the doubtful hits up to `index` may have been played; these places become rivals."""
        self._looks.look(index)
        known = [k for k in range(max(self._doubt.since, index - _LOOK_HITS + 1), index + 1) if self._is_known(k)]
        if len(known) < LEAST_HITS:
            return
        if self._rivals:
            self._keep_up(index)
        for rival in self._rivals:
            rival.total -= self._lead_total
        rivals = [self._rival(place, known[0], index) for place in self._places_elsewhere(known)]
        self._rivals = _unlike([rival for rival in self._rivals + rivals if rival.total > -_HOPELESS])
        self._lead_total, self._contested, self._looked = 0.0, index + 1, index

    def _is_known(self, hit: int) -> bool:
        return self._classes[hit] in self._by_class

    def _places_elsewhere(self, known: list[int]) -> list[Place]:
        """Where the hits `known` fit."""
        window = Hits(np.array([self._times[k] for k in known]), np.array([self._classes[k] for k in known]))
        here_s = self._places[known[0]] if self._stopped_at is None else self._stop_s
        return self._elsewhere.places(window, Place(self._times[known[0]], here_s, self._place.rate), self._looks.count)

    def _rival(self, place: Place, first: int, index: int) -> Line:
        """The line of a student who is at `place` with hit `first`, from the hit on from which that is best."""
        back = max(self._doubt.since - LEAST_HITS, index - MOST_MOVED + 1, self._stopped_at or 0, 0)
        known = [k for k in range(back, index + 1) if self._is_known(k)]
        since = known.index(first)
        early = [place.score_s + place.rate * (self._times[k] - place.at_s) for k in known[:since]]
        distances = self._notes.tracker.distances(early, [self._classes[k] for k in known[:since]])
        late, more, after = self._follow(known[since:], place)
        line = Line(known, early + late, self._said(known, distances + more), after)
        own, lead = self._scales.worth(line.places_s, line.nats), self._scales.worth(*self._lead(known))
        gains = [
            line.nats[i]
            + MISS_COST * (line.nats[i] > 0.0)
            + sum(own[i + 1 :])
            - sum(lead[i:])
            - self._cost(known[i], line.places_s[i], place.rate)
            for i in range(len(known) - LEAST_HITS + 1)
        ]
        split = max(range(len(gains)), key=gains.__getitem__)
        line = Line(known[split:], line.places_s[split:], line.nats[split:], after)
        line.total = gains[split]
        return line

    def _lead(self, hits: list[int]) -> tuple[list[float], list[float]]:
        """Places and evidence of `hits` as believed so far."""
        return [self._places[k] for k in hits], [self._nats[k] for k in hits]

    def _follow(self, hits: list[int], place: Place) -> tuple[list[float], list[float], Place]:
        return self._notes.tracker.follow([self._times[k] for k in hits], [self._classes[k] for k in hits], place)

    def _said(self, hits: list[int], distances: list[float]) -> list[float]:
        return [self._scales.said(d, self._classes[k]) for k, d in zip(hits, distances, strict=True)]

    def _cost(self, split: int, place_s: float, rate: float) -> float:
        """Nats against being at `place_s` with hit `split`, and playing on at `rate`."""
        since_stop = split in (0, self._stopped_at)
        jump_s = min(abs(place_s - self._places[split]), START_S + abs(place_s - self._note_s[0]))
        if since_stop:
            jump_s = min(jump_s, abs(place_s - (self._stop_s if split else self._note_s[0])))
        return jump_cost(jump_s, log(rate / self._place.rate), since_stop)

    # --- rivals -----------------------------------------------------------------------------------------------------

    def _contest(self, index: int) -> int:
        """Let the rivals follow the hits since the last contest; returns the first hit that is moved to another place.

        That is where a rival begins that has become better, else `index`.
        """
        self._keep_up(index)
        best, first = max(self._rivals, key=lambda rival: rival.total), index
        if best.total > self._lead_total + _MARGIN:
            self._take(best)
            first = best.hits[0]
        limit = max(self._lead_total, best.total) - _HOPELESS
        oldest = index - MOST_MOVED
        self._rivals = [rival for rival in self._rivals if rival.total > limit and rival.hits[0] > oldest]
        if self._contested - self._looked > MOST_MOVED:
            self._rivals = []
        return first

    def _keep_up(self, index: int) -> None:
        """Let the lead's and the rivals' totals take in the hits up to `index`."""
        known = [k for k in range(self._contested, index + 1) if self._is_known(k)]
        if known:
            before = self._scales.passed(self._places[max(self._contested - 1, 0)])
            self._lead_total += sum(self._scales.worth(*self._lead(known), before))
            for rival in self._rivals:
                places, distances, rival.place = self._follow(known, rival.place)
                said = self._said(known, distances)
                before = self._scales.passed(rival.places_s[-1])
                rival.total += sum(self._scales.worth(places, said, before))
                rival.hits += known
                rival.places_s += places
                rival.nats += said
        self._contested = index + 1

    def _take(self, line: Line) -> None:
        """Follow `line` from now on; the line followed so far becomes its rival."""
        first = line.hits[0]
        hits = [k for k in range(first, len(self._times)) if self._is_known(k)]
        old = Line(hits, *self._lead(hits), self._place)
        old.total, self._lead_total = self._lead_total, line.total
        self._rivals = [old, *(rival for rival in self._rivals if rival is not line)]
        for k, place, said in zip(line.hits, line.places_s, line.nats, strict=True):
            self._places[k], self._nats[k] = place, said
        before = first
        for k in range(first, len(self._times)):
            if self._is_known(k):
                before = k
            else:
                self._places[k] = self._places[before] + line.place.rate * (self._times[k] - self._times[before])
        self._place = line.place
        self._calm(len(self._times))
        self._doubt.calm(len(self._times))


def _unlike(lines: list[Line]) -> list[Line]:
    """The best of all lines that have come to one place: several looks find the same."""
    found: list[Line] = []
    for line in sorted(lines, key=lambda line: -line.total):
        if not any(abs(line.places_s[-1] - other.places_s[-1]) < _SAME_S for other in found):
            found.append(line)
    return found


_SAME_S = 0.01
"""Our choice: less than a player's spread, so that two such lines hear the same notes."""
