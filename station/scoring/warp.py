"""From performance time to score time when tempo and place are unknown: the whole way of a performance through a score.

The beginning is found by voting (`locate`), the tempo followed from there (`tracker`). Where the hits stop fitting, the
player has skipped, repeated or begun again, or paused: the place is found anew, and the hit from which it holds is the
one that leaves most evidence on both sides. What is followed without a break is a *stretch*; within it the way is
smoothed (`drift`). Times are seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.drift import local_trend, robust_sd
from station.scoring.evidence import best_evidence, class_rates, evidence
from station.scoring.locate import Candidate, Hits, Notes, candidates, nats_for
from station.scoring.tracker import GATE_S, Place, Tracker

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

RATES = np.exp(np.arange(-35, 36) * 0.02)
"""Tempi that are tried at the beginning, a half to twice as fast, in steps of 2 %."""

_TEMPO_PRIOR = 0.3
"""SD of log tempo: a student practises at 70 % more readily than at half the tempo (TEACHING)."""

_BEGINNING_S = 15.0
"""Most performances begin within so much of the score's beginning: there is looked first."""

_START_COST_PER_S = 2.0
"""Nats a second against a first hit that is not the first note: up to a jump's cost, for it is one."""

_ENOUGH = 0.5
"""Share of all possible evidence with which a beginning is believed without looking elsewhere."""

_LOOKED_AT, _LONG_LOOK = 5, 256
"""The likeliest beginnings are followed over so many hits: bars that are alike part ways sooner or later."""

_BLOCK = 512
_SUSPECT_HITS = 16
"""So many hits that together speak against the place raise suspicion (our choice: a bar of 16ths)."""

_HORIZON = 64
"""Hits over which a change of place must pay."""

_JUMP_COST = 15.0
"""Nats against a jump (our choice: chance differences over `_HORIZON` hits are about 6 nats, 2.5 SD)."""

_JUMP_COST_PER_S = 0.02
"""Near jumps are likelier than far ones."""

_NEAR_RATES = np.exp(np.arange(-6, 7) * 0.02)
_NEAR_S = 60.0
_SAME_STRETCH_S = 0.25
"""A smaller jump is a stumble and no change of place."""

_TREND_HALF_WIDTH = 16


@dataclass(frozen=True, eq=False)
class Warp:
    """Score time in s of each hit (m,), and the stretch (m,), from 0, that it belongs to."""

    score_s: Floats
    stretch: Indices


def find_warp(note_s: Floats, note_classes: Indices, hit_s: Floats, hit_classes: Indices) -> Warp:
    """The way of the hits (m,), sorted, through the notes (n,); at least one hit has the class of a note."""
    known = np.flatnonzero(np.isin(hit_classes, note_classes))
    order = np.argsort(note_s, kind="stable")
    hits = Hits(hit_s[known], hit_classes[known])
    beginning = _find_beginning(_prepared(note_s[order], note_classes[order]), hits)
    tempo = beginning.rate
    notes = _prepared(note_s[order] / tempo, note_classes[order])
    pursuit = _Pursuit(notes, hits)
    pursuit.run(Place(beginning.at_s, beginning.score_s / tempo, 1.0))
    way = _smoothed(pursuit, hits) * tempo
    return _filled(way, pursuit.stretch, hit_s, known)


def _prepared(note_s: Floats, classes: Indices) -> Notes:
    return Notes(note_s, classes, class_rates(note_s, classes), Tracker(note_s, classes))


def _find_beginning(notes: Notes, hits: Hits) -> Place:
    """Where and how fast the performance begins."""
    window = hits.window(0)
    early = slice(0, int(np.searchsorted(notes.at_s, notes.at_s[0] + _BEGINNING_S)))
    same = Place(float(window.at_s[0]), float(window.at_s[0]), 1.0)  # recorded on the score's own time base
    tried = [Candidate(same, nats_for(notes, window, same)), *candidates(notes, early, window, RATES)]
    possible = float(best_evidence(notes.rates[window.classes]).sum())
    if max(candidate.nats for candidate in tried) < _ENOUGH * possible:
        tried += candidates(notes, slice(None), window, RATES)
    tried.sort(key=lambda candidate: -candidate.nats - _prior(candidate.place, notes))
    longer = hits.part(0, _LONG_LOOK)
    return max((c.place for c in tried[:_LOOKED_AT]), key=lambda p: nats_for(notes, longer, p) + _prior(p, notes))


def _prior(place: Place, notes: Notes) -> float:
    from_start_s = abs(place.score_s - float(notes.at_s[0]))
    elsewhere = min(_START_COST_PER_S * from_start_s, _JUMP_COST) + _JUMP_COST_PER_S * from_start_s
    return -0.5 * float(np.log(place.rate) / _TEMPO_PRIOR) ** 2 - elsewhere


class _Pursuit:
    """Follows all hits and fills `places`, `distances` and `stretch` (m,)."""

    def __init__(self, notes: Notes, hits: Hits) -> None:
        self._notes, self._hits = notes, hits
        self._times, self._classes = hits.at_s.tolist(), hits.classes.tolist()
        self._rates = notes.rates[hits.classes]
        self.places, self.distances = np.zeros(len(hits.at_s)), np.zeros(len(hits.at_s))
        self.stretch = np.zeros(len(hits.at_s), np.int64)
        self._nats = np.zeros(len(hits.at_s))
        self._marks: list[tuple[int, Place]] = []  # where the loop stood before some hits
        self._trusted = 0  # up to here no suspicion is raised any more

    def run(self, start: Place) -> None:
        """Follow from `start` to the end."""
        here, i, total = start, 0, len(self._times)
        while i < total:
            end = min(i + _BLOCK, total)
            self._marks.append((i, here))
            after = self._follow(i, end, here)
            suspect = self._first_suspect(i, end)
            here, i = (after, end) if suspect is None else self._settle_doubt(suspect)

    def _follow(self, start: int, end: int, place: Place) -> Place:
        times, classes = self._times[start:end], self._classes[start:end]
        places, distances, after = self._notes.tracker.follow(times, classes, place)
        self.places[start:end], self.distances[start:end] = places, distances
        self._nats[start:end] = evidence(self.distances[start:end], self._rates[start:end])
        return after

    def _first_suspect(self, start: int, end: int) -> int | None:
        """The first hit in [start, end) before which the last hits together speak against the place."""
        low = max(start - _SUSPECT_HITS, self._trusted)
        totals = np.concatenate(([0.0], np.cumsum(self._nats[low:end])))
        bad = np.flatnonzero(totals[_SUSPECT_HITS:] - totals[:-_SUSPECT_HITS] < 0)
        return None if not len(bad) else low + _SUSPECT_HITS - 1 + int(bad[0])

    def _settle_doubt(self, suspect: int) -> tuple[Place, int]:
        """Decide at hit `suspect` whether the player is elsewhere; returns the place and the hit to go on from."""
        back = max(self._trusted, suspect - 2 * _SUSPECT_HITS)
        end = min(suspect + _HORIZON, len(self._times))
        base = self._place_before(back)
        after = self._follow(back, end, base)
        moves = [self._move(place, back, suspect, end) for place in self._elsewhere(suspect, base)]
        best = max(moves, key=lambda move: move.gain, default=None)
        self._trusted = end
        if best is None or best.gain <= 0:
            return after, end
        return self._take(best, back, suspect)

    def _place_before(self, hit: int) -> Place:
        """Where the loop stood before `hit`."""
        while self._marks[-1][0] > hit:
            self._marks.pop()
        mark, place = self._marks[-1]
        return self._notes.tracker.follow(self._times[mark:hit], self._classes[mark:hit], place)[2]

    def _elsewhere(self, hit: int, base: Place) -> list[Place]:
        """Places where hit `hit` may have been played instead."""
        window = self._hits.window(hit)
        expected_s = base.score_s + base.rate * (self._times[hit] - base.at_s)
        near = slice(*np.searchsorted(self._notes.at_s, (expected_s - _NEAR_S, expected_s + _NEAR_S)).tolist())
        tried = candidates(self._notes, near, window, _NEAR_RATES * base.rate)
        possible = float(best_evidence(self._rates[hit : hit + len(window.at_s)]).sum())
        if not tried or max(candidate.nats for candidate in tried) < _ENOUGH * possible:
            tried += candidates(self._notes, slice(None), window, _NEAR_RATES * base.rate)
        return [candidate.place for candidate in tried]

    def _move(self, place: Place, back: int, suspect: int, end: int) -> "_Move":
        """What it is worth to be at `place` from the best hit of [back, suspect] on."""
        before = place.score_s - place.rate * (self._times[suspect] - self._hits.at_s[back:suspect])
        early = np.array(self._notes.tracker.distances(before.tolist(), self._classes[back:suspect]))
        late = self._notes.tracker.follow(self._times[suspect:end], self._classes[suspect:end], place)[1]
        moved = evidence(np.concatenate((early, late)), self._rates[back:end])
        surplus = np.concatenate((np.cumsum((moved - self._nats[back:end])[::-1])[::-1], [0.0]))
        split = back + int(np.argmax(surplus[: suspect - back + 1]))
        jump_s = abs(self._jump_s(split, suspect, place))
        cost = _JUMP_COST + _JUMP_COST_PER_S * jump_s
        return _Move(place, split, float(surplus[split - back]) - cost, before, early, jump_s)

    def _jump_s(self, split: int, suspect: int, place: Place) -> float:
        then_s = place.score_s - place.rate * (self._times[suspect] - self._times[split])
        return float(then_s - self.places[split])

    def _take(self, move: "_Move", back: int, suspect: int) -> tuple[Place, int]:
        """Be at the move's place from its split on."""
        moved = slice(move.split, suspect)
        self.places[moved], self.distances[moved] = move.before[move.split - back :], move.early[move.split - back :]
        if move.jump_s > _SAME_STRETCH_S:
            self.stretch[move.split :] += 1
        return move.place, suspect


@dataclass(frozen=True, eq=False)
class _Move:
    """A change of place: `place` of the suspect hit, `split` the hit from which it holds, `gain` in nats.

    `before` and `early` are place and distance of the hits from the beginning of the doubt to the suspect one.
    """

    place: Place
    split: int
    gain: float
    before: Floats
    early: Floats
    jump_s: float


def _smoothed(pursuit: _Pursuit, hits: Hits) -> Floats:
    """The way of the hits, freed of the loop's lag and of single strokes' scatter."""
    way = pursuit.places.copy()
    for stretch in range(int(pursuit.stretch[-1]) + 1):
        own = np.flatnonzero(pursuit.stretch == stretch)
        off = pursuit.distances[own]
        near = np.abs(off) < GATE_S
        scale = robust_sd(off[near])
        if scale:
            way[own] += local_trend(hits.at_s[own], off, _TREND_HALF_WIDTH, scale, near.astype(np.float64))
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
