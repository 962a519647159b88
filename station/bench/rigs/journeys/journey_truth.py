"""What of a journey an ear can know, and how near a pairing comes to it.

Notes that nobody could tell apart count as one:
* of bars that are alike, notes of one piece and place, and within a bar that repeats a figure, one place of the figure;
* where a player turns from one place to another and the music goes on alike for a while, it cannot be told whether they
  turned before or after that segment: both readings are right within it;
* a leg whose strokes, as they were played, fit another place of the score as well could have been there; where they
  fit nearly as well to go straight on, or to have begun at the beginning, whoever hears a turn guesses.

A note that was played several times may be paired with any of its plays, and where one of them failed, be missed.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.journeys.journey_takes import Take
from station.core.units import NS_PER_MS, PPQ
from station.music.score import Score

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

_PIECES = 64
"""More than there are pieces, twice over for grace strokes: a stroke's key is its tick times this and its piece."""
_SHIFT = PPQ // 2
"""Other places of a leg are looked for by eighths: players turn on bars and beats."""
_TURN_FAULTS, _START_FAULTS = 2, 1
"""A reading without a turn is as likely with so many more faults as one with it: a fault is one stroke in 30, a turn
one beat in 100 to one of 100, ln(10⁴)/ln 30 = 2.7; and who begins, begins at the beginning or at one of 100 beats."""
_REACH_SDS = 4.5
"""An oracle gives a stroke up that lies further from its time: one in 150,000 does."""


def keys(score: Score) -> Indices:
    """Tick, piece and whether it is a grace stroke of every note as one number (n,), rising."""
    key: Indices = score.notes["tick"] * _PIECES + score.notes["piece"] * 2 + score.is_grace
    return key


def alike(score: Score) -> Indices:
    """A class for each note (n,): equal where bars are alike, and places in a bar's own repeated figure."""
    known: dict[object, int] = {}
    key, classes = keys(score), np.zeros(len(score), np.int64)
    for bar in np.unique(score.bar).tolist():
        rows = np.flatnonzero(score.bar == bar)
        start, end = (score.tempo_map.bar_start(b) * _PIECES for b in (bar, bar + 1))
        within = key[rows] - start
        period = _period(within, end - start)
        content = (end - start, period, *np.unique(within % period).tolist())
        for row, place in zip(rows.tolist(), (within % period).tolist(), strict=True):
            classes[row] = known.setdefault((content, place), len(known))
    return classes


def _period(within: Indices, length: int) -> int:
    """The shortest part of the bar (a whole number of them fill it) after which its strokes repeat."""
    bar_ticks = length // _PIECES
    for parts in range(48, 1, -1):
        if bar_ticks % parts:
            continue
        period = length // parts
        if np.array_equal(np.sort((within + period) % length), np.sort(within)):
            return period
    return length


@dataclass(frozen=True, eq=False)
class Truth:
    """What there is to know of a take."""

    take: Take

    @cached_property
    def classes(self) -> Indices:
        """The class of each note (n,)."""
        return alike(self.take.score)

    @cached_property
    def _keys(self) -> Indices:
        return keys(self.take.score)

    @cached_property
    def readings(self) -> tuple[tuple[tuple[int, int, int], ...], ...]:
        """For each leg what else it could have been: a shift in ticks, and the ticks of the leg from which to which."""
        legs, last = self.take.legs, len(self.take.legs) - 1
        found = []
        for i, leg in enumerate(legs):
            whole = [(shift, leg.first, leg.last) for shift in self._elsewhere(i)]
            if i > 0 and leg.wait_s == 0:
                shift = legs[i - 1].last - leg.first
                whole.append((shift, leg.first, self._alike_until(i, shift)))
            if i < last and legs[i + 1].wait_s == 0:
                shift = legs[i + 1].first - leg.last
                whole.append((shift, self._alike_since(i, shift), leg.last))
            found.append(tuple(whole))
        return tuple(found)

    @cached_property
    def _heard(self) -> tuple[Indices, ...]:
        """The strokes of each leg as they were played, extras left out, as keys of their written ticks."""
        take, key = self.take, self._keys
        played = take.meant >= 0
        piece = take.performance.hits["piece"].astype(np.int64)
        meant = key[take.meant]
        as_played = np.where(take.is_wrong, meant - meant % _PIECES + piece * 2, meant)
        return tuple(np.unique(as_played[played & (take.leg == leg)]) for leg in range(len(take.legs)))

    def _faults(self, leg: int, shift: int) -> Indices:
        """The ticks at which leg `leg`, read `shift` ticks later, differs from what was heard, in order."""
        first, last = self.take.legs[leg].first, self.take.legs[leg].last
        low, high = np.searchsorted(self._keys, [(first + shift) * _PIECES, (last + shift) * _PIECES])
        written = np.unique(self._keys[low:high]) - shift * _PIECES
        return np.asarray(np.setxor1d(self._heard[leg], written, assume_unique=True) // _PIECES)

    def _elsewhere(self, leg: int) -> list[int]:
        """The shifts by which all that was heard of the leg fits the score as well as where it was played."""
        here = self.take.legs[leg]
        lowest = -(here.first // _SHIFT) * _SHIFT
        shifts = range(lowest, self.take.score.end_tick - here.last + 1, _SHIFT)
        grace = {-here.first: _START_FAULTS} if leg == 0 else {}
        return [shift for shift in shifts if shift and self._fits(leg, shift, grace.get(shift, 0))]

    def _fits(self, leg: int, shift: int, grace: int) -> bool:
        """Whether all that was heard of the leg fits `shift` ticks later with at most `grace` faults more."""
        return len(self._faults(leg, shift)) <= len(self._faults(leg, 0)) + grace

    def _alike_until(self, leg: int, shift: int) -> int:
        """The last tick of the leg up to which it fits as well `shift` ticks later, where the leg before went on."""
        if self._fits(leg, shift, _TURN_FAULTS):
            return self.take.legs[leg].last
        return self._last_even(self._faults(leg, shift), self._faults(leg, 0), self.take.legs[leg].last)

    def _alike_since(self, leg: int, shift: int) -> int:
        """The first tick of the leg from which on it fits as well `shift` ticks later, where the next leg begins."""
        if self._fits(leg, shift, _TURN_FAULTS):
            return self.take.legs[leg].first
        other, own = (-self._faults(leg, s)[::-1] for s in (shift, 0))
        return -self._last_even(other, own, -self.take.legs[leg].first) + 1

    @staticmethod
    def _last_even(other: Indices, own: Indices, end: int) -> int:
        """The last place, going on, before which `other` has no more faults than `own`; `end` where it never has."""
        places = np.unique(np.concatenate([other, own, [end]]))
        more = np.searchsorted(other, places, side="right") > np.searchsorted(own, places, side="right")
        if not more.any():
            return end
        even = np.flatnonzero(~more)
        after = int(even[-1]) + 1 if len(even) else 0
        return int(places[after]) if after < len(places) else end

    def right(self, said: Indices) -> Flags:
        """Which hits (m,) `said` (m,) gives to a note that they may have been meant for; −1 is no note."""
        note, classes = self.take.right_note, self.classes
        paired = (said >= 0) & (note >= 0)
        right: Flags = paired & (classes[said] == classes[note])
        key = self._keys
        for leg, others in enumerate(self.readings):
            rows = np.flatnonzero(paired & ~right & (self.take.leg == leg))
            for shift, first, last in others if len(rows) else ():
                tick = key[note[rows]] // _PIECES
                moved = key[note[rows]] + shift * _PIECES
                at = np.minimum(np.searchsorted(key, moved), len(key) - 1)
                fits = (key[at] == moved) & (classes[at] == classes[said[rows]]) & (tick >= first) & (tick < last)
                right[rows] |= fits
        return right

    def f1(self, said: Indices, place_ns: Indices | None = None) -> float:
        """The F1 of hits (m,) matched with notes, each note once at most, −1 where a hit matches none.

        `place_ns` (m,) says where in the score each hit is held to lie: of several readings that is the one by which
        notes are missed. None holds the true one.
        """
        right = self.right(said)
        due = self._due(self.take.true_ns if place_ns is None else place_ns)
        found = np.bincount(self.classes[said[right]], minlength=len(due))
        true, missed = int(right.sum()), int(np.maximum(due - found, 0).sum())
        false = int((said >= 0).sum()) - true
        return 2 * true / max(2 * true + false + missed, 1)

    def _due(self, place_ns: Indices) -> Indices:
        """How many notes of each class must be found: those that every play hit, legs read as `place_ns` has them."""
        take, key = self.take, self._keys
        plays, played = np.zeros(len(key), np.int64), np.zeros(len(key), np.int64)
        tick = take.score.notes["tick"]
        for i, leg in enumerate(take.legs):
            rows = np.flatnonzero((tick >= leg.first) & (tick < leg.last))
            moved = key[rows] + self._shifts(i, tick[rows], place_ns) * _PIECES
            at = np.minimum(np.searchsorted(key, moved), len(key) - 1)
            is_hit, is_there = np.isin(rows, take.right_note[take.leg == i]), key[at] == moved
            np.add.at(plays, at[is_there], 1)
            np.add.at(played, at[is_there & is_hit], 1)
        must = (plays > 0) & (played >= plays)
        return np.bincount(self.classes[must], minlength=int(self.classes.max(initial=0)) + 1)

    def _shifts(self, leg: int, tick: Indices, place_ns: Indices) -> Indices:
        """The reading of the notes at `tick` (k,) that is nearest to where their hits are held to lie, in ticks."""
        hits = np.flatnonzero(self.take.leg == leg)
        if not len(hits):
            return np.zeros(len(tick), np.int64)
        tempo = self.take.score.tempo_map
        true = tempo.ticks_at_ns(self.take.true_ns[hits])
        off = tempo.ticks_at_ns(place_ns[hits]) - true
        order = np.argsort(true, kind="stable")
        near = np.minimum(np.searchsorted(true[order], tick), len(hits) - 1)
        best, held = np.zeros(len(tick), np.int64), off[order][near]
        for shift, first, last in self.readings[leg]:
            nearer = (tick >= first) & (tick < last) & (abs(held - shift) < abs(held - best))
            best[nearer] = shift
        return best

    @cached_property
    def turns(self) -> tuple["Turn", ...]:
        """Where the player set out anew, and whether anyone could hear it."""
        take, at_ns = self.take, self.take.performance.hits["at_ns"]
        tick = np.where(take.meant >= 0, take.score.notes["tick"][take.meant], -1)
        found = []
        for i, (before, after) in enumerate(pairwise(take.legs), start=1):
            since, until, is_heard = before.last, after.first, True
            if after.wait_s == 0:
                since = self._alike_since(i - 1, after.first - before.last)
                until = self._alike_until(i, before.last - after.first)
                is_heard = since > before.first and until < after.last
            earlier = at_ns[(take.leg == i - 1) & (tick >= 0) & (tick < since)]
            later = at_ns[(take.leg == i) & (tick >= until)]
            found.append(Turn(int(earlier.max(initial=at_ns[0])), int(later.min(initial=at_ns[-1])), is_heard))
        return tuple(found)

    def oracle(self) -> Indices:
        """What one who knows the way, the tempo and the spread would pair: the note of each hit (m,), −1 for none.

        Leg by leg and piece by piece, the pairs whose squared distances are least, none further than `_REACH_SDS`. A
        note that was played several times belongs to the longest leg.
        """
        take, score = self.take, self.take.score
        reach_ns = _REACH_SDS * take.player.sd_ms * NS_PER_MS * take.player.speed
        said, owner = np.full(len(take.meant), -1, np.int64), np.full(len(score), -1)
        for i in sorted(range(len(take.legs)), key=lambda i: take.legs[i].last - take.legs[i].first):
            owner[(score.notes["tick"] >= take.legs[i].first) & (score.notes["tick"] < take.legs[i].last)] = i
        for i, leg in enumerate(take.legs):
            inside = (score.notes["tick"] >= leg.first) & (score.notes["tick"] < leg.last)
            for piece in np.unique(score.notes["piece"][inside]):
                rows = np.flatnonzero(inside & (score.notes["piece"] == piece))
                rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
                hits = np.flatnonzero((take.leg == i) & (take.performance.hits["piece"] == piece))
                hits = hits[np.argsort(take.true_ns[hits], kind="stable")]
                for note, hit in nearest_pairs(score.onset_ns[rows], take.true_ns[hits], reach_ns):
                    if owner[rows[note]] == i:
                        said[hits[hit]] = rows[note]
        return said


@dataclass(frozen=True, slots=True)
class Turn:
    """A player sets out anew, somewhere between two instants; `is_heard` unless going straight on sounds the same."""

    since_ns: int
    until_ns: int
    is_heard: bool


def nearest_pairs(notes: Indices, hits: Indices, reach: float) -> list[tuple[int, int]]:
    """Pairs (note, hit) of two rising rows of times, in order, at the least sum of squared distances.

    What stays alone costs as much as half a pair that is `reach` apart.
    """
    pairs: list[tuple[int, int]] = []
    at = np.concatenate([notes, hits])
    order = np.argsort(at, kind="stable")
    ends = np.flatnonzero(np.diff(at[order]) > reach) + 1
    for group in np.split(order, ends):
        own = np.sort(group[group < len(notes)])
        theirs = np.sort(group[group >= len(notes)] - len(notes))
        if len(own) and len(theirs):
            pairs += [(int(own[i]), int(theirs[j])) for i, j in _pair(notes[own], hits[theirs], reach)]
    return pairs


def _pair(notes: Indices, hits: Indices, reach: float) -> list[tuple[int, int]]:
    """The same for a few: by dynamic programming over how many of each are dealt with."""
    n, m = len(notes), len(hits)
    off = (np.subtract.outer(notes, hits) / reach) ** 2
    cost = np.zeros((n + 1, m + 1))
    cost[:, 0], cost[0, :] = np.arange(n + 1) / 2, np.arange(m + 1) / 2
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            cost[i, j] = min(cost[i - 1, j - 1] + off[i - 1, j - 1], cost[i - 1, j] + 0.5, cost[i, j - 1] + 0.5)
    pairs, i, j = [], n, m
    while i and j:
        if cost[i, j] == cost[i - 1, j - 1] + off[i - 1, j - 1]:
            i, j = i - 1, j - 1
            pairs.append((i, j))
        elif cost[i, j] == cost[i - 1, j] + 0.5:
            i -= 1
        else:
            j -= 1
    return pairs[::-1]
