"""Where a student without a click is in the score, hit by hit as he plays: tempo, phase, skips, restarts and stops.

A phase-locked loop (`tracker`) predicts every hit's place from those before. How well the last hits fit, against half
of what they could say, is summed up as long as it speaks against the place (Page's CUSUM, Biometrika 41, 1954); beyond


A student who stops makes the score wait. After `STOP_NOTES` that nobody hit, and `STOP_S` of silence, the next hit is
taken for the next note of its class behind the stop until more hits tell where he really went on.

All that is believed depends on the hits alone. A hit costs a few microseconds whatever the score's length, a look
around some milliseconds, and looks are rare. Times are seconds; score time is at the written tempo.
"""

from bisect import bisect_left, bisect_right
from dataclasses import replace
from math import inf, log

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.scoring.doubt import DOUBT, SLACK_S, Doubt
from station.scoring.evidence import best_evidence, class_rates, nats
from station.scoring.judge import Moved
from station.scoring.locate import Candidate, Hits, Notes, Search, candidates
from station.scoring.shifts import LEAST_JUMP_S
from station.scoring.tracker import Place, Tracker

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

STOP_NOTES, STOP_S = 8, 1.0
"""Our choice: so many notes in a row are not missed by a player who plays on (2 nats each, a jump's cost)."""

MISS_COST = 2.0
"""Nats against a note that nobody hit (`locate`)."""

MOST_MOVED = 48
"""Hits that a change of place may move, at most (our choice: two bars of a dense groove)."""

_LOOK_HITS = 24
"""Hits that say where the student is: two bars of a sparse groove."""

_LEAST_HITS = 6
"""A look with fewer hits finds everything everywhere (our choice)."""

_WAITS = (4, 6, 8, 12, 16, 24, 32, 64, 128)
"""Hits from one look that found nothing to the next: whoever does not play the score costs little (our choice)."""

_NEAR_S, _FAR_S, _CLOSE_S = 45.0, 300.0, 4.0
"""Seconds to both sides: where a skip is looked for first, how much a look beyond takes, where the tempo may jump."""

_NEAR_RATES = np.exp(np.arange(-4, 5) * 0.02)
_RATES = np.exp(np.arange(-18, 19) * 0.02)
"""Tempi tried: up to 8 % from the last after a skip, up to 43 % in place or at the beginning."""

_ENOUGH = 0.5
"""Share of all possible evidence with which a place is believed without looking farther."""

_SLOWEST, _FASTEST = 0.4, 2.5
"""Beyond these nobody plays what is written (our choice)."""

_START_S = 2.0
"""A jump to the beginning counts as one of so many seconds, however far it is: who gives up begins again."""

_CONTEST_HITS = 4
"""Hits between two contests of the lead with its rivals (our choice: a beat of 16ths)."""

_NEW_TEMPO, _SAME_TEMPO = 0.2, 0.06
"""SD of log tempo at the beginning and after a stop, and against the tempo so far (our choice)."""

_SLACK_RATE = 0.05
_MARGIN, _HOPELESS = 3.0, 12.0
"""Nats by which a rival must lead, and by which it is given up."""

_JUMP_COST = 18.0
"""Nats against a change of place (`pursuit` asks 15 of whoever knows what comes after)."""

_PER_S = 2.0
"""Nats more for each second of a jump (our choice: so early, where bars are alike, little but nearness decides)."""

_MOST_FOR_TIME, _MOST_FOR_TEMPO = 10.0, 6.0
"""Nats at most against a far jump, and against another tempo (our choice)."""

_RESUMED_COST = 5.0
"""Nats against a place after a stop, besides its distance: nothing is sure, so little is asked (our choice)."""


class Chase:
    """Follows hits through notes at `note_s` (n,) of `classes` (n,), at least one; counted in to begin at time 0."""

    def __init__(self, note_s: Floats, classes: Indices) -> None:
        order = np.argsort(note_s, kind="stable")
        note_s, classes = note_s[order], classes[order]
        self._notes = Notes(note_s, classes, class_rates(note_s, classes), Tracker(note_s, classes))
        self._note_s: list[float] = note_s.tolist()
        self._by_class: dict[int, list[float]] = {c: note_s[classes == c].tolist() for c in np.unique(classes).tolist()}
        self._rate_of: list[float] = self._notes.rates.tolist()
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
        self._rivals: list[_Line] = []
        self._lead_total = 0.0
        self._contested = 0  # hits before this one have been held against the rivals
        self._looked = -1
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
        if not _SLOWEST < self._place.rate < _FASTEST:
            self._place = replace(self._place, rate=1.0)
        said = nats(distance, self._rate_of[match_class])
        self._places.append(place)
        self._nats.append(said)
        self._doubt.take(index, match_class, place, said)
        if self._doubt.nats == 0.0:
            if self._looks or self._stopped_at is not None:
                self._calm(index + 1)
        elif self._doubt.nats > DOUBT and index >= self._look_at:
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
        self._looks, self._look_at = 0, index + _LEAST_HITS - 1

    def _look(self, index: int) -> None:
        """Find where else the doubtful hits up to `index` may have been played; these places become rivals."""
        self._look_at = index + _WAITS[min(self._looks, len(_WAITS) - 1)]
        self._looks += 1
        known = [k for k in range(max(self._doubt.since, index - _LOOK_HITS + 1), index + 1) if self._is_known(k)]
        if len(known) < _LEAST_HITS:
            return
        if self._rivals:
            self._keep_up(index)
        for rival in self._rivals:
            rival.total -= self._lead_total
        rivals = [self._rival(place, known[0], index) for place in self._elsewhere(known)]
        self._rivals = [rival for rival in self._rivals + rivals if rival.total > -_HOPELESS]
        self._lead_total, self._contested, self._looked = 0.0, index + 1, index

    def _is_known(self, hit: int) -> bool:
        return self._classes[hit] in self._by_class

    def _elsewhere(self, known: list[int]) -> list[Place]:
        """Where the hits `known` fit: close by at any tempo, at the beginning, near, else farther and farther away."""
        window = Hits(np.array([self._times[k] for k in known]), np.array([self._classes[k] for k in known]))
        possible = float(best_evidence(self._notes.rates[window.classes]).sum())
        rate = min(max(self._place.rate, _SLOWEST), _FASTEST)
        here_s = self._places[known[0]] if self._stopped_at is None else self._stop_s
        first_s = self._note_s[0]
        tried = self._candidates(window, (here_s - LEAST_JUMP_S, here_s + LEAST_JUMP_S), _RATES * rate, here_s)
        tried += self._candidates(window, (here_s - _CLOSE_S, here_s + _CLOSE_S), _RATES * rate, here_s)
        if here_s > first_s + _CLOSE_S:
            tried += self._candidates(window, (first_s, first_s + _CLOSE_S), _NEAR_RATES * rate, first_s)
        tried += self._candidates(window, (here_s - _NEAR_S, here_s + _NEAR_S), _NEAR_RATES * rate, here_s)
        if self._looks > 1 and max((candidate.nats for candidate in tried), default=0.0) < _ENOUGH * possible:
            tried += self._candidates(window, self._far(here_s), _NEAR_RATES * rate, here_s)
        slow, fast = rate * float(_RATES[0]) - _SLACK_RATE, rate * float(_RATES[-1]) + _SLACK_RATE
        return [candidate.place for candidate in tried if slow < candidate.place.rate < fast]

    def _candidates(
        self, window: Hits, among_s: tuple[float, float], rates: Floats, expected_s: float
    ) -> list[Candidate]:
        end_s = among_s[1] + float((window.at_s[-1] - window.at_s[0]) * rates[-1])
        among = slice(bisect_left(self._note_s, among_s[0]), bisect_right(self._note_s, end_s))
        return candidates(self._notes, _Anywhere(among, rates, expected_s), window)

    def _far(self, here_s: float) -> tuple[float, float]:
        """The part of the score that this look takes: first around `here_s`, then the next to the left and right."""
        steps = int((self._note_s[-1] - self._note_s[0]) / (2 * _FAR_S)) + 1
        turn = (self._looks - 1) % (2 * steps)
        middle = here_s + (turn + 1) // 2 * (1 if turn % 2 else -1) * 2 * _FAR_S
        return middle - _FAR_S, middle + _FAR_S

    def _rival(self, place: Place, first: int, index: int) -> "_Line":
        """The line of a student who is at `place` with hit `first`, from the hit on from which that is best."""
        back = max(self._doubt.since - _LEAST_HITS, index - MOST_MOVED + 1, self._stopped_at or 0, 0)
        known = [k for k in range(back, index + 1) if self._is_known(k)]
        since = known.index(first)
        early = [place.score_s + place.rate * (self._times[k] - place.at_s) for k in known[:since]]
        distances = self._notes.tracker.distances(early, [self._classes[k] for k in known[:since]])
        late, more, after = self._follow(known[since:], place)
        line = _Line(known, early + late, self._said(known, distances + more), after)
        own, lead = self._worth(line.places_s, line.nats), self._worth(*self._lead(known))
        gains = [
            line.nats[i]
            + MISS_COST * (line.nats[i] > 0.0)
            + sum(own[i + 1 :])
            - sum(lead[i:])
            - self._cost(known[i], line.places_s[i], place.rate)
            for i in range(len(known) - _LEAST_HITS + 1)
        ]
        split = max(range(len(gains)), key=gains.__getitem__)
        line = _Line(known[split:], line.places_s[split:], line.nats[split:], after)
        line.total = gains[split]
        return line

    def _lead(self, hits: list[int]) -> tuple[list[float], list[float]]:
        """Places and evidence of `hits` as believed so far."""
        return [self._places[k] for k in hits], [self._nats[k] for k in hits]

    def _follow(self, hits: list[int], place: Place) -> tuple[list[float], list[float], Place]:
        return self._notes.tracker.follow([self._times[k] for k in hits], [self._classes[k] for k in hits], place)

    def _said(self, hits: list[int], distances: list[float]) -> list[float]:
        return [nats(d, self._rate_of[self._classes[k]]) for k, d in zip(hits, distances, strict=True)]

    def _worth(self, places_s: list[float], said: list[float], before: int | None = None) -> list[float]:
        """What each hit says, less what the notes say that were passed since the hit before."""
        worth = []
        for place, nat in zip(places_s, said, strict=True):
            passed = bisect_left(self._note_s, place + SLACK_S)
            unheard = 0 if before is None else passed - before
            worth.append(nat + MISS_COST * ((nat > 0.0) - unheard))
            before = passed
        return worth

    def _cost(self, split: int, place_s: float, rate: float) -> float:
        """Nats against being at `place_s` with hit `split`, and playing on at `rate`."""
        since_stop = split in (0, self._stopped_at)
        jump_s = min(abs(place_s - self._places[split]), _START_S + abs(place_s - self._note_s[0]))
        if since_stop:
            jump_s = min(jump_s, abs(place_s - (self._stop_s if split else self._note_s[0])))
        new_tempo = log(rate / self._place.rate) / (_NEW_TEMPO if since_stop else _SAME_TEMPO)
        base = _RESUMED_COST if since_stop or jump_s < LEAST_JUMP_S else _JUMP_COST
        return base + min(_PER_S * jump_s, _MOST_FOR_TIME) + min(0.5 * new_tempo * new_tempo, _MOST_FOR_TEMPO)

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
            self._lead_total += sum(
                self._worth(
                    *self._lead(known), bisect_left(self._note_s, self._places[max(self._contested - 1, 0)] + SLACK_S)
                )
            )
            for rival in self._rivals:
                places, distances, rival.place = self._follow(known, rival.place)
                said = self._said(known, distances)
                before = bisect_left(self._note_s, rival.places_s[-1] + SLACK_S)
                rival.total += sum(self._worth(places, said, before))
                rival.hits += known
                rival.places_s += places
                rival.nats += said
        self._contested = index + 1

    def _take(self, line: "_Line") -> None:
        """Follow `line` from now on; the line followed so far becomes its rival."""
        first = line.hits[0]
        hits = [k for k in range(first, len(self._times)) if self._is_known(k)]
        old = _Line(hits, *self._lead(hits), self._place)
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


class _Anywhere(Search):
    """A search in which no place is likelier than another: what a jump costs is told later, line by line."""

    def cost(self, score_s: Floats) -> Floats:
        """Nothing."""
        return np.zeros(np.shape(score_s))


class _Line:
    """Another way on: `hits` from the first for which it holds, their places and evidence, its `place` now.

    `total` is what speaks for it in nats, on the lead's scale.
    """

    __slots__ = ("hits", "nats", "place", "places_s", "total")

    def __init__(self, hits: list[int], places_s: list[float], said: list[float], place: Place) -> None:
        self.hits, self.places_s, self.nats, self.place = hits, places_s, said, place
        self.total = 0.0
