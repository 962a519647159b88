"""Where in the score some hits were played, and how fast, when nothing is known: by voting.

For each tempo tried, every pair of a hit and a note of its class votes for one place; the votes of pairs that belong
together fall on one spot, the rest spread thin. A vote weighs what its class tells (`evidence`). The best spots are
then played through by the tempo follower and judged by what hits *and* notes say: notes in the stretch that nobody hit
speak against a tempo that is too fast.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import best_evidence, evidence
from station.scoring.following.tempo_tracker import GATE_S, Place, Tracker

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

WINDOW_HITS, WINDOW_S = 48, 6.0
"""So much music is known again: a bar or two of a groove (our choice)."""

COST_PER_S, MOST_COST = 1.0, 6.0
"""Nats against a place for each second that it lies off the expected one, up to so many (our choice)."""

_NEXT_NOTE_S = 0.05
"""Notes so soon after a place are still those of the place (our choice: 1.7 SD of `evidence`)."""

_BIN_S = 0.02
_SPOTS = 12
"""Spots that are played through; repeated bars give many alike (our choice)."""

_APART_S = 0.06
MISS_COST = 2.0
"""Nats against a note that nobody hit, about log(0.97/0.1): a seventh of the notes may be missing (our choice)."""

_FIT_GATES_S = (0.08, GATE_S)
"""Hits farther off are left out of the first and the second fit of a spot."""

_VOTES_AT_ONCE = 4_000_000
"""Bounds the memory of a vote to about 64 MB."""


@dataclass(frozen=True, eq=False)
class Notes:
    """What can be found: times in s, sorted (n,), classes (n,), `rates` of every class number, and their follower."""

    at_s: Floats
    classes: Indices
    rates: Floats
    tracker: Tracker

    def next_of(self, match_class: int, place_s: float) -> float | None:
        """The time of the first note of a class behind `place_s` and what sounds there; None where none is left."""
        first = int(np.searchsorted(self.at_s, place_s + _NEXT_NOTE_S))
        after = self.classes[first:] == match_class
        return float(self.at_s[first + int(after.argmax())]) if after.any() else None


@dataclass(frozen=True, eq=False)
class Hits:
    """Hits at `at_s`, sorted (m,), of `classes` (m,) that all occur among the notes."""

    at_s: Floats
    classes: Indices

    def part(self, start: int, end: int) -> "Hits":
        """Hits `start` … `end` − 1."""
        return Hits(self.at_s[start:end], self.classes[start:end])

    def lists(self) -> tuple[list[float], list[int]]:
        """Times and classes, for loops."""
        return self.at_s.tolist(), self.classes.tolist()

    def window(self, start: int) -> "Hits":
        """The `WINDOW_HITS` or `WINDOW_S` from hit `start` on, whatever ends first, a third of the hits at least."""
        late = int(np.searchsorted(self.at_s, self.at_s[start] + WINDOW_S))
        end = min(max(late, start + WINDOW_HITS // 3), start + WINDOW_HITS)
        return self.part(start, end)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A place of the window's first hit, and what speaks for it in nats."""

    place: Place
    nats: float


@dataclass(frozen=True, slots=True)
class Search:
    """Where and how is looked: among these notes, at `rates`, and nearest to `expected_s` where all else is alike."""

    among: slice
    rates: Floats
    expected_s: float

    def cost(self, score_s: Floats) -> Floats:
        """Nats against a first hit at these places (any shape): where bars are alike, the nearest is believed."""
        return np.minimum(COST_PER_S * np.abs(score_s - self.expected_s), MOST_COST)


def candidates(notes: Notes, search: Search, hits: Hits) -> list[Candidate]:
    """The likeliest places of the window `hits`."""
    spots = [_fitted(notes, hits, place) for place in _best_spots(notes, search, hits)]
    return [Candidate(place, nats_for(notes, hits, place)) for place in spots]


_MOST_REFIT = 1.25
"""A fit moves the tempo by no more: tried tempi lie a few percent apart (our choice)."""


def _fitted(notes: Notes, hits: Hits, place: Place) -> Place:
    """The place and rate that the window's hits near their notes support, by least squares from `place` on."""
    since, classes = hits.at_s - hits.at_s[0], hits.classes.tolist()
    score_s, rate = place.score_s, place.rate
    for gate_s in _FIT_GATES_S:
        off = np.array(notes.tracker.distances((score_s + rate * since).tolist(), classes))
        near = np.abs(off) < gate_s
        t, d = since[near], off[near]
        spread = float(np.sum((t - t.mean()) ** 2)) if len(t) else 0.0
        if spread > 0.0:
            slope = float(np.sum((t - t.mean()) * d)) / spread
            if not 1 / _MOST_REFIT < (rate + slope) / place.rate < _MOST_REFIT:
                break  # a flurry of hits around one note fits any tempo
            score_s, rate = score_s + float(d.mean()) - slope * float(t.mean()), rate + slope
    return Place(place.at_s, score_s, rate)


def nats_for(notes: Notes, hits: Hits, place: Place) -> float:
    """What hits and notes of a window say for its beginning at `place`.

    Before and after the score a hit costs what a note costs that it leaves out elsewhere: to run beyond the end must
    not be cheaper than to stumble in mid-score.
    """
    reached, distances, _ = notes.tracker.follow(*hits.lists(), place)
    places, off = np.array(reached), np.array(distances)
    near = np.abs(off) < GATE_S
    first, last = np.searchsorted(notes.at_s, (places.min() - GATE_S, places.max() + GATE_S))
    unheard = max(int(last - first) - int(near.sum()), 0)
    beyond = (places < notes.at_s[0] - GATE_S) | (places > notes.at_s[-1] + GATE_S)
    return float(evidence(off, notes.rates[hits.classes]).sum()) - MISS_COST * (unheard + int(beyond.sum()))


def _best_spots(notes: Notes, search: Search, hits: Hits) -> list[Place]:
    """Places with most votes, at least `_APART_S` from each other."""
    found: list[tuple[float, float, float]] = []  # votes, score_s, rate
    pairs = sum(
        int((hits.classes == c).sum()) * int((notes.classes[search.among] == c).sum()) for c in np.unique(hits.classes)
    )
    step = max(1, _VOTES_AT_ONCE // max(pairs, 1))
    for start in range(0, len(search.rates), step):
        found += _vote(notes, replace(search, rates=search.rates[start : start + step]), hits)
    found.sort(reverse=True)
    spots: list[Place] = []
    for _, score_s, rate in found:
        if all(abs(score_s - spot.score_s) > _APART_S or abs(rate / spot.rate - 1) > 0.1 for spot in spots):
            spots.append(Place(float(hits.at_s[0]), score_s, rate))
        if len(spots) == _SPOTS:
            break
    return spots


def _vote(notes: Notes, search: Search, hits: Hits) -> list[tuple[float, float, float]]:
    """The spots with most votes as (votes, score time of the first hit, rate)."""
    note_s, note_class, rates_tried = notes.at_s[search.among], notes.classes[search.among], search.rates
    if not len(note_s):
        return []
    since = hits.at_s - hits.at_s[0]
    # what comes later than the notes last cannot speak for the first hit's place, and would cost memory by the hour
    near = since <= (float(note_s[-1]) - float(note_s[0])) / float(rates_tried.min()) + _BIN_S
    since, classes = since[near], hits.classes[near]
    first_s = float(note_s[0]) - float(since[-1]) * float(rates_tried.max()) - 2 * _BIN_S
    bins = int((float(note_s[-1]) - first_s) / _BIN_S) + 3
    votes = np.zeros(len(rates_tried) * bins)
    rows = (np.arange(len(rates_tried)) * bins)[:, None, None]
    for c in np.unique(classes):
        spots = note_s[note_class == c][None, None, :] - rates_tried[:, None, None] * since[classes == c][None, :, None]
        cells = (rows + np.rint((spots - first_s) / _BIN_S).astype(np.int64)).ravel()
        weight = float(best_evidence(notes.rates[c : c + 1])[0])
        votes += weight * np.bincount(cells, minlength=len(votes))
    votes[1:-1] += 0.5 * (votes[:-2] + votes[2:])
    votes -= np.tile(search.cost(first_s + np.arange(bins, dtype=np.float64) * _BIN_S), len(rates_tried))
    most = min(8 * _SPOTS, len(votes))
    best = np.argpartition(-votes, most - 1)[:most]
    return [(float(votes[k]), first_s + int(k % bins) * _BIN_S, float(rates_tried[k // bins])) for k in best]
