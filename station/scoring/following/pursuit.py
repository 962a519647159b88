"""Following a performance from its beginning to its end, through skips, repeats, restarts and pauses.

The tempo is followed block by block (`tracker`). Where the last hits together speak against the place, the player may
be elsewhere: the place is found anew by voting (`locate`), and if that is worth a jump, the hit from which it holds is
the one that leaves most evidence on both sides. Times are seconds.
"""

from bisect import bisect_right
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import best_evidence, evidence
from station.scoring.following.locate import COST_PER_S, MOST_COST, Hits, Notes, Search, candidates
from station.scoring.following.tempo_tracker import Place

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

JUMP_COST = 15.0
"""Nats against a jump (our choice: chance differences over `_HORIZON` hits are about 6 nats, 2.5 SD)."""

SURE_JUMP_COST = 30.0
"""As `JUMP_COST`, where nothing corrects a wrong jump any more: a drummer's own variation of a groove, repeated, speaks
for a wrong bar by 15 to 30 nats (the drummers of GMD's `eval_session` against each other)."""

JUMP_COST_PER_S, MOST_JUMP_COST_MORE = COST_PER_S, MOST_COST
"""Nats more for each second of a jump, up to so many: where bars are alike, the nearest place is believed."""

_BLOCK = 512
_SUSPECT_HITS = 16
"""So many hits that together speak against the place raise suspicion (our choice: a bar of 16ths)."""

_HORIZON = 64
"""Hits over which a change of place must pay."""

_ENOUGH = 0.5
"""Share of all possible evidence with which a place near by is believed without looking everywhere."""

_NEAR_RATES = np.exp(np.arange(-6, 7) * 0.02)
_NEAR_S = 60.0


class Pursuit:
    """Follows all hits and fills their `places` in the score and `distances` to the nearest note, both (m,).

    `resumes`: after a silence that is not written the player is where he stopped, not where he would be by now.
    """

    def __init__(self, notes: Notes, hits: Hits, resumes: bool = False) -> None:
        self._notes, self._hits = notes, hits
        self._resumed: list[int] = silences(hits.at_s).tolist() if resumes else []
        self._times, self._classes = hits.at_s.tolist(), hits.classes.tolist()
        self._rates = notes.rates[hits.classes]
        self.places, self.distances = np.zeros(len(hits.at_s)), np.zeros(len(hits.at_s))
        self._nats = np.zeros(len(hits.at_s))
        self._marks: list[tuple[int, Place]] = []  # where the loop stood before some hits
        self._trusted = 0  # up to here no suspicion is raised any more

    def run(self, start: Place) -> None:
        """Follow from `start` to the end."""
        here, i, total = start, 0, len(self._times)
        while i < total:
            end = self._until(i, i + _BLOCK)
            if i in self._resumed:
                here = self._after_silence(i, here)
                self._trusted = i
            self._marks.append((i, here))
            after = self._follow(i, end, here)
            suspect = self._first_suspect(i, end)
            here, i = (after, end) if suspect is None else self._settle_doubt(suspect)

    def _until(self, hit: int, end: int) -> int:
        """How far the loop may follow from `hit`: to `end`, but not over a silence after which it is set anew."""
        silence = bisect_right(self._resumed, hit)
        return min(end, len(self._times), *self._resumed[silence : silence + 1])

    def _after_silence(self, hit: int, here: Place) -> Place:
        """The first note of the class of `hit` behind the last place, or `here` where that is no farther."""
        after_s = self._notes.next_of(self._classes[hit], float(self.places[hit - 1]))
        now_s = here.score_s + here.rate * (self._times[hit] - here.at_s)
        return here if after_s is None or now_s - after_s < SILENCE_S else Place(self._times[hit], after_s, here.rate)

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
        end = self._until(suspect, suspect + _HORIZON)
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
        search = Search(near, _NEAR_RATES * base.rate, expected_s)
        tried = candidates(self._notes, search, window)
        possible = float(best_evidence(self._rates[hit : hit + len(window.at_s)]).sum())
        if not tried or max(candidate.nats for candidate in tried) < _ENOUGH * possible:
            tried += candidates(self._notes, replace(search, among=slice(None)), window)
        return [candidate.place for candidate in tried]

    def _move(self, place: Place, back: int, suspect: int, end: int) -> "_Move":
        """What it is worth to be at `place` from the best hit of [back, suspect] on."""
        before = place.score_s - place.rate * (self._times[suspect] - self._hits.at_s[back:suspect])
        early = np.array(self._notes.tracker.distances(before.tolist(), self._classes[back:suspect]))
        late = self._notes.tracker.follow(self._times[suspect:end], self._classes[suspect:end], place)[1]
        moved = evidence(np.concatenate((early, late)), self._rates[back:end])
        surplus = np.concatenate((np.cumsum((moved - self._nats[back:end])[::-1])[::-1], [0.0]))
        split = back + int(np.argmax(surplus[: suspect - back + 1]))
        cost = SURE_JUMP_COST + min(JUMP_COST_PER_S * self._jump_s(split, suspect, place), MOST_JUMP_COST_MORE)
        return _Move(place, split, float(surplus[split - back]) - cost, before, early)

    def _jump_s(self, split: int, suspect: int, place: Place) -> float:
        """How far the jump goes, from where the player would be now or, after a pause, from where he stopped."""
        then_s = place.score_s - place.rate * (self._times[suspect] - self._times[split])
        stopped_s = self.places[max(split - 1, 0)]
        return float(min(abs(then_s - self.places[split]), abs(then_s - stopped_s)))

    def _take(self, move: "_Move", back: int, suspect: int) -> tuple[Place, int]:
        """Be at the move's place from its split on."""
        moved = slice(move.split, suspect)
        self.places[moved], self.distances[moved] = move.before[move.split - back :], move.early[move.split - back :]
        return move.place, suspect


SILENCE_S = 1.0
"""Longer is no wait that a groove has (our choice)."""


def silences(at_s: Floats) -> Indices:
    """The first hits after silences."""
    return np.flatnonzero(np.diff(at_s) > SILENCE_S) + 1


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
