"""Where in the score some hits were played, and how fast, when nothing is known: by voting.

For each tempo tried, every pair of a hit and a note of its class votes for one place; the votes of pairs that belong
together fall on one spot, the rest spread thin. The best spots are fitted by least squares. What each is worth is then
told by the table of fits at every whole beat around (`worth`), for bars that are alike give votes alike.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.beat_offsets import Offsets
from station.scoring.following.tempo_tracker import GATE_S, Place, Tracker
from station.scoring.following.written import Written, gained

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

WINDOW_HITS, WINDOW_S = 48, 6.0
"""So much music is known again: a bar or two of a groove (our choice)."""

_BIN_S = 0.02
_SPOTS = 12
"""Spots that are fitted; repeated bars give many alike (our choice)."""

_APART_S, _APART_RATE = 0.06, 0.1
"""Two spots nearer in place and tempo are one."""

_FIT_GATES_S = (0.08, GATE_S)
"""Hits farther off are left out of the first and the second fit of a spot."""

_MOST_REFIT = 1.25
"""A fit moves the tempo by no more: tried tempi lie a few percent apart (our choice)."""

_VOTES_AT_ONCE = 4_000_000
"""Bounds the memory of a vote to about 64 MB."""


@dataclass(frozen=True, eq=False)
class Hits:
    """Hits at `at_s`, sorted (m,), of `classes` (m,) that all occur in the score's lanes."""

    at_s: Floats
    classes: Indices

    def part(self, start: int, end: int) -> "Hits":
        """Hits `start` … `end` − 1."""
        return Hits(self.at_s[start:end], self.classes[start:end])

    def window(self, start: int, end: int) -> "Hits":
        """The `WINDOW_HITS` or `WINDOW_S` from hit `start` on, whatever ends first, a third of the hits at least."""
        late = int(np.searchsorted(self.at_s, self.at_s[start] + WINDOW_S))
        return self.part(start, min(max(late, start + WINDOW_HITS // 3), start + WINDOW_HITS, end))


def found(written: Written, tracker: Tracker, hits: Hits, rates: Floats, among_s: tuple[float, float]) -> list[Place]:
    """The likeliest places of the first of `hits`, with score times between `among_s`, at about one of `rates`."""
    spots: list[tuple[float, float, float]] = []  # votes, score_s, rate
    note_s, classes = written.lanes
    low, high = np.searchsorted(note_s, (among_s[0], among_s[1] + float(np.ptp(hits.at_s) * rates[-1])))
    note_s, classes = note_s[low:high], classes[low:high]
    pairs = sum(int((hits.classes == c).sum()) * int((classes == c).sum()) for c in np.unique(hits.classes))
    step = max(1, _VOTES_AT_ONCE // max(pairs, 1))
    for start in range(0, len(rates), step):
        spots += _vote(note_s, classes, hits, rates[start : start + step])
    spots.sort(reverse=True)
    places: list[Place] = []
    for _, score_s, rate in spots:
        if all(abs(score_s - p.score_s) > _APART_S or abs(rate / p.rate - 1) > _APART_RATE for p in places):
            places.append(Place(float(hits.at_s[0]), score_s, rate))
        if len(places) == _SPOTS:
            break
    return [fitted(tracker, hits, place) for place in places]


def _vote(note_s: Floats, note_class: Indices, hits: Hits, rates: Floats) -> list[tuple[float, float, float]]:
    """The spots with most votes as (votes, score time of the first hit, rate)."""
    if not len(note_s):
        return []
    since = hits.at_s - hits.at_s[0]
    # what comes later than the notes last cannot speak for the first hit's place, and would cost memory by the hour
    near = since <= (float(note_s[-1]) - float(note_s[0])) / float(rates.min()) + _BIN_S
    since, classes = since[near], hits.classes[near]
    first_s = float(note_s[0]) - float(since[-1]) * float(rates.max()) - 2 * _BIN_S
    bins = int((float(note_s[-1]) - first_s) / _BIN_S) + 3
    votes = np.zeros(len(rates) * bins)
    rows = (np.arange(len(rates)) * bins)[:, None, None]
    for c in np.unique(classes):
        own = note_s[note_class == c]
        spots = own[None, None, :] - rates[:, None, None] * since[classes == c][None, :, None]
        cells = (rows + np.rint((spots - first_s) / _BIN_S).astype(np.int64)).ravel()
        votes += np.bincount(cells, minlength=len(votes)) * (len(note_s) / max(len(own), 1)) ** 0.5
    votes[1:-1] += 0.5 * (votes[:-2] + votes[2:])
    most = min(8 * _SPOTS, len(votes))
    best = np.argpartition(-votes, most - 1)[:most]
    return [(float(votes[k]), first_s + int(k % bins) * _BIN_S, float(rates[k // bins])) for k in best]


def fitted(tracker: Tracker, hits: Hits, place: Place) -> Place:
    """The place and rate that the hits near their notes support, by least squares from `place` on."""
    since, classes = hits.at_s - hits.at_s[0], hits.classes.tolist()
    score_s, rate = place.score_s, place.rate
    for gate_s in _FIT_GATES_S:
        off = np.array(tracker.distances((score_s + rate * since).tolist(), classes))
        near = np.abs(off) < gate_s
        t, d = since[near], off[near]
        spread = float(np.sum((t - t.mean()) ** 2)) if len(t) else 0.0
        if spread > 0.0:
            slope = float(np.sum((t - t.mean()) * d)) / spread
            if not 1 / _MOST_REFIT < (rate + slope) / place.rate < _MOST_REFIT:
                break  # a flurry of hits around one note fits any tempo
            score_s, rate = score_s + float(d.mean()) - slope * float(t.mean()), rate + slope
    return Place(place.at_s, score_s, rate)


def worth(written: Written, hits: Hits, place: Place, offsets: Offsets) -> Floats:
    """What `hits` and the notes they pass say for the first being at `place`, moved by each of `offsets` (s,)."""
    beats = written.beats.beat(place.score_s + place.rate * (hits.at_s - place.at_s))
    said = written.fits.said(beats, hits.classes, offsets.parts).sum(0)
    edges = np.array([beats[0] - _EDGE, beats[-1] + _EDGE])
    unanswered = written.fits.unanswered(edges, offsets.parts)
    bouncing = written.fits.may_bounce(edges[:1], edges[1:], np.array([len(beats)]), offsets.parts)
    return gained(said, unanswered[1] - unanswered[0], bouncing=None if bouncing is None else bouncing[0])


_EDGE = 0.1
"""Beats around the first and last hit whose notes they may answer."""
