"""Whole beats that a player skipped or went back: what the tempo follower cannot see where bars are nearly alike.

Whoever leaves a bar out plays on in time, so that the follower stays locked to the beat, in the wrong bar. Here every
hit is held against the score moved by each of a set of shifts, and the row of shifts is found that all hits together
support best, each change of shift costing a jump (Viterbi 1967). Shifts are in beats, so that they hold across changes
of the written tempo.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import evidence
from station.scoring.following.locate import MISS_COST, Hits, Notes
from station.scoring.following.pursuit import JUMP_COST_PER_S, MOST_JUMP_COST_MORE, SILENCE_S, SURE_JUMP_COST, silences
from station.scoring.following.tempo_tracker import GATE_S

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

_FAR_BEATS, _NEAR_BEATS = 64, 2
"""Whole beats are tried as far as the first, 16 bars of 4/4; thirds and quarters of a beat as far as the second."""

SHIFTS_BEATS = np.unique(
    np.concatenate(
        [np.arange(-_FAR_BEATS, _FAR_BEATS + 1.0)]
        + [np.arange(-_NEAR_BEATS * parts, _NEAR_BEATS * parts + 1) / parts for parts in (3, 4)]
    )
)
"""The shifts that are always tried, rising; 0 is among them. Jumps that were found by voting come with their own."""

_MOST_JUMPS = 64
"""Jumps that are reconsidered (our choice: more than anyone makes who is worth an alignment)."""

LEAST_JUMP_S = 0.25
"""A smaller jump is a stumble and no change of place (our choice: an eighth at 120 bpm)."""

JUMP_COST_PER_S_MORE = 0.2
"""Nats for each second of a jump beyond that (our choice: it decides between places that are alike)."""

_RESUME_HITS = 16
"""Hits after a silence that say how exactly the player goes on (our choice: a bar of 16ths)."""

_MOST_UNHEARD_COST = 12.0
"""Nats against a performance that ends before the score, at most (our choice: it buys no jump)."""

START_S = 2.0
"""A jump to the beginning counts as one of so many seconds, however far it is: who gives up begins again."""

START_BEATS = 16
"""Who begins again with the click is looked for so many beats around a place of doubt (our choice: 32 eighths)."""

_SLACK = 0.1
"""Share of a rest by which the place may move without a jump: the tempo may have changed meanwhile."""

_SAME_BEAT = 0.12
"""Jumps as the follower sees them are as exact as its place when it was losing it: its gate, 60 ms at 120 bpm."""

_AT_ONCE = 4096
"""Hits whose evidence is computed in one go: bounds the memory to some 5 MB."""


@dataclass(frozen=True, eq=False)
class Beats:
    """`at_s` (b,) when each quarter of the score begins, rising; before and after go on at the tempo there.

    `a_bar` is how many quarters the first bar has.
    """

    at_s: Floats
    a_bar: float

    def moved(self, score_s: Floats, by_beats: Floats) -> Floats:
        """Score times moved by so many beats; the shapes broadcast."""
        return self._time(self.beat(score_s) + by_beats)

    def beat(self, score_s: Floats) -> Floats:
        """Beats from the score's beginning."""
        i = np.clip(np.searchsorted(self.at_s, score_s, side="right") - 1, 0, len(self.at_s) - 2)
        return np.asarray(i + (score_s - self.at_s[i]) / (self.at_s[i + 1] - self.at_s[i]))

    def _time(self, beat: Floats) -> Floats:
        i = np.clip(beat.astype(np.int64), 0, len(self.at_s) - 2)
        return np.asarray(self.at_s[i] + (beat - i) * (self.at_s[i + 1] - self.at_s[i]))


def best_shifts(notes: Notes, hits: Hits, places: Floats, beats: Beats, only: Floats | None = None) -> Floats:
    """By how many beats each hit (m,) at `places` (m,) must be moved, shape (m,).

    `only` these shifts, rising, 0 among them, are tried of a player who keeps to a click, and comes in again with it.
    Jumps that `places` already make are reconsidered too: there, going on at the old place is free and the jump costs.
    """
    made = _made(hits.at_s, places, beats) if only is None else {}
    resumed = resumes(notes, hits, places, beats) if only is None else {}
    tried = _with(SHIFTS_BEATS, [*made.values(), *resumed.values()]) if only is None else only
    to_start = _index_of(beats.beat(notes.at_s[:1]) - beats.beat(places), tried).tolist()
    beat_s = float(np.median(np.diff(beats.at_s)))
    total = np.where(tried == 0.0, 0.0, -_jump_cost(beat_s * np.abs(tried)))
    came_from = np.empty((len(places), len(tried)), np.int16)
    straight = np.arange(len(tried), dtype=np.int16)
    for i, said in enumerate(chain.from_iterable(_evidence(notes, hits, places, beats, tried))):
        best = int(total.argmax())
        far_s = beat_s * np.abs(tried - tried[best] + made.get(i, 0.0))
        if i in resumed:
            far_s = np.minimum(far_s, beat_s * np.abs(tried - tried[best] - resumed[i]))
        if to_start[i] >= 0:
            far_s[to_start[i]] = min(far_s[to_start[i]], START_S)
        jumped = total[best] - _jump_cost(far_s)
        came_from[i] = straight
        if i in made:
            came_from[i] = _index_of(tried + made[i], tried)
            total = np.where(came_from[i] < 0, -np.inf, total[came_from[i]])
        here = total < jumped
        came_from[i, here] = best
        total = np.where(here, jumped, total) + said
    total -= _unheard_cost(notes, beats.moved(places[-1], tried))
    row: Floats = tried[_walk_back(came_from, int(total.argmax()))]
    return row


def _jump_cost(far_s: Floats) -> Floats:
    """Nats against a jump by so many s of the score, any shape; of places that are alike the nearest is believed."""
    return SURE_JUMP_COST + np.minimum(JUMP_COST_PER_S * far_s, MOST_JUMP_COST_MORE) + JUMP_COST_PER_S_MORE * far_s


def whole_beats(notes: Notes, hits: Hits, beats: Beats, restarts: Indices) -> Floats:
    """Shifts by whole beats, rising: near ones, and those with one of the hits `restarts` (k,) near the beginning."""
    near = np.arange(-_FAR_BEATS, _FAR_BEATS + 1.0)
    to_start = np.rint(beats.beat(notes.at_s[:1]) - beats.beat(hits.at_s[restarts[:_MOST_JUMPS]]))
    around = np.arange(-START_BEATS, START_BEATS + 1.0)
    return np.unique(np.concatenate([near, (to_start[:, None] + around[None, :]).ravel()]))


def _unheard_cost(notes: Notes, last_s: Floats) -> Floats:
    """Nats against a performance that ends at these places, any shape: most end where the score does."""
    unheard = len(notes.at_s) - np.searchsorted(notes.at_s, last_s + GATE_S)
    return np.asarray(np.minimum(MISS_COST * unheard, _MOST_UNHEARD_COST))


def resumes(notes: Notes, hits: Hits, places: Floats, beats: Beats) -> dict[int, float]:
    """The first hits after silences that are not written, and by how many beats to move who then goes on where he was.

    He goes on with the first note of the hit's class behind the last place, as exactly as the next hits show.
    """
    found: dict[int, float] = {}
    for hit in silences(hits.at_s).tolist():
        after_s = notes.next_of(int(hits.classes[hit]), float(places[hit - 1]))
        if after_s is None or places[hit] - after_s < SILENCE_S:
            continue
        next_hits = slice(hit, hit + _RESUME_HITS)
        moved = places[next_hits] - (places[hit] - after_s)
        off = np.array(notes.tracker.distances(moved.tolist(), hits.classes[next_hits].tolist()))
        place = after_s + np.median(off[np.abs(off) < GATE_S])
        found[hit] = float(np.subtract(*beats.beat(np.array([place, places[hit]]))))
        if len(found) == _MOST_JUMPS:
            break
    return found


def fits_elsewhere(notes: Notes, hits: Hits, places: Floats, beats: Beats, tried: Floats = SHIFTS_BEATS) -> bool:
    """Whether `hits` (m,), moved together by one of the shifts, fit better by more than a jump costs."""
    said = sum((part.sum(0) for part in _evidence(notes, hits, places, beats, tried)), np.zeros(len(tried)))
    return bool(said.max() - said[tried == 0.0][0] > SURE_JUMP_COST)


def fits_bars_away(notes: Notes, hits: Hits, places: Floats, beats: Beats) -> bool:
    """Whether some stretch of `hits` (m,) fits better some bars away by more than a jump costs.

    Where bars are nearly alike no few hits tell that one was left out, but all that come after it together do.
    """
    shifts = beats.a_bar * _BARS_AWAY
    said = np.concatenate(list(_evidence(notes, hits, places, beats, shifts)))
    gain = np.cumsum(said - said[:, shifts == 0.0], axis=0)
    return bool((gain - np.minimum.accumulate(gain, axis=0)).max(initial=0.0) > SURE_JUMP_COST)


_BARS_AWAY = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
"""Our choice: a bar, or a phrase of two; each more costs a score of 3000 notes half a millisecond."""


def jumps(at_s: Floats, places: Floats) -> Indices:
    """The first hits after the jumps of `places` (m,)."""
    steps = np.diff(at_s)
    return np.flatnonzero(np.abs(np.diff(places) - steps) > LEAST_JUMP_S + _SLACK * steps) + 1


def _made(at_s: Floats, places: Floats, beats: Beats) -> dict[int, float]:
    """The jumps that `places` makes: their first hits, and by how many beats."""
    jumped = jumps(at_s, places)[:_MOST_JUMPS]
    expected = places[jumped - 1] + (at_s[jumped] - at_s[jumped - 1])
    by_beats = beats.beat(places[jumped]) - beats.beat(expected)
    return dict(zip(jumped.tolist(), by_beats.tolist(), strict=True))


def _with(shifts: Floats, more: list[float]) -> Floats:
    """`shifts` and those of `more` that are none of them, rising."""
    for shift in more:
        if _index_of(np.array([shift]), shifts)[0] < 0:
            shifts = np.sort(np.append(shifts, shift))
    return shifts


def _index_of(beats: Floats, shifts: Floats) -> NDArray[np.int16]:
    """Index in `shifts` of the one that each value (k,) is, −1 for none."""
    right = np.clip(np.searchsorted(shifts, beats), 1, len(shifts) - 1)
    nearest = right - (beats - shifts[right - 1] < shifts[right] - beats)
    return np.where(np.abs(shifts[nearest] - beats) < _SAME_BEAT, nearest, -1).astype(np.int16)


def _walk_back(came_from: NDArray[np.int16], state: int) -> Indices:
    """The states of the best row, shape (m,)."""
    row = np.empty(len(came_from), np.int64)
    for i in range(len(came_from) - 1, -1, -1):
        row[i] = state
        state = int(came_from[i, state])
    return row


def _evidence(notes: Notes, hits: Hits, places: Floats, beats: Beats, shifts: Floats) -> Iterator[Floats]:
    """What each hit says for each shift, in parts of shape (hits, shifts)."""
    by_class = {c: notes.at_s[notes.classes == c] for c in np.unique(hits.classes).tolist()}
    for start in range(0, len(places), _AT_ONCE):
        part = hits.part(start, start + _AT_ONCE)
        moved = beats.moved(places[start : start + _AT_ONCE, None], shifts[None, :])
        distance = np.empty_like(moved)
        for c, own in by_class.items():
            here = part.classes == c
            distance[here] = to_nearest(own, moved[here])
        yield evidence(distance, notes.rates[part.classes][:, None])


def to_nearest(note_s: Floats, at_s: Floats) -> Floats:
    """Distance to the nearest note, any shape."""
    right = np.minimum(np.searchsorted(note_s, at_s), len(note_s) - 1)
    left = np.maximum(right - 1, 0)
    distance: Floats = np.minimum(np.abs(note_s[right] - at_s), np.abs(at_s - note_s[left]))
    return distance
