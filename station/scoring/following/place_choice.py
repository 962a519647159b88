"""Where some hits without a click begin, of places that are likely and places that are found (`anchors`).

A place is a time of the player, the score time that they are at then, and their tempo against what is written.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits, fitted, found, worth
from station.scoring.following.beat_offsets import offsets_of
from station.scoring.following.prices import BOUNCED, NEW_TEMPO_SD, POSSIBLE, TEMPO_SD
from station.scoring.following.tempo_tracker import Place, Tracker
from station.scoring.following.written import MAYBE_BOUNCE, Written

Floats = NDArray[np.float64]

ENOUGH = 0.8
"""Share of all possible evidence with which an anchor is believed without a search: a player of SD 20 ms who leaves out
one note in ten brings .82."""

_NEAR_RATES = np.exp(np.arange(-10, 11) * 0.02)
"""Tempi tried later on, against the last."""

EARLY_S = 60.0
"""A recording's tempo and beat are first looked for in so much of the score."""

_SLOWEST = 0.01
_FEWEST = 6
"""A search with fewer hits finds everything everywhere (our choice)."""

_RESUME_HITS, _RESUME_S = 16, 0.06
"""Hits after a silence that say how exactly the player goes on, if they lie so near to a note."""

SAME_S = 0.05
"""A note so near to where the player is on time is the one that they play (our choice)."""

SAME_TEMPO = 0.04
"""A tempo so near to what is written is followed as it: the loop takes it up within a second."""


class PlaceChoice:
    """Chooses among places in `written`, at about its tempo, which is `tempo` times what stands on paper."""

    def __init__(self, written: Written, hits: Hits, tempo: float) -> None:
        self._written, self._hits, self._tempo = written, hits, tempo
        self.tracker = Tracker(*written.lanes)
        self.offsets = offsets_of(written, slips=True)

    def moved(self, place: Place, offset: int) -> Place:
        """`place` moved by one of the offsets."""
        if offset == self.offsets.here:
            return place
        beat = self._written.beats.beat(np.array([place.score_s])) + self.offsets.beats[offset]
        return place._replace(score_s=float(self._written.beats.time(beat)[0]))

    def at_best(self, window: Hits, place: Place) -> tuple[float, Place]:
        """What speaks for the tempo and beat of a beginning at its likeliest place in the score, and that place."""
        nats = worth(self._written, window, place, self.offsets) + self.first(place)
        best = int(nats.argmax())
        return float(nats[best]), self.moved(place, best)

    def on_beat(self, window: Hits, place: Place) -> Place:
        """`place` moved by the parts of a beat that fit best, and fitted there."""
        best = int(worth(self._written, window, place, self.offsets).argmax())
        return fitted(self.tracker, window, self.moved(place, best))

    def first(self, place: Place) -> Floats:
        """Nats (s,) for beginning at `place` moved by each offset."""
        beat = self._written.beats.beat(np.array([place.score_s, place.at_s]))
        tempo = place.rate * self._tempo
        prior = -0.5 * float(np.log(tempo) / TEMPO_SD) ** 2
        is_shared = abs(tempo - 1.0) < SAME_TEMPO
        cost = self._written.prices.begin(beat[0] + self.offsets.beats, float(beat[1]) if is_shared else np.inf)
        return prior - cost + self.offsets.only_whole

    def on_another_beat(self, hit: int, end: int, place: Place) -> Place:
        """The clock set to `place`, parts of a beat away: exactly, or anew where it had lost the tempo before."""
        window = self._hits.window(hit, end)
        place = fitted(self.tracker, window, place)
        fits = float(worth(self._written, window, place, self.offsets)[self.offsets.here])
        return place if fits > ENOUGH * possible(window) else self.set_anew(hit, end, [place])

    def set_anew(self, hit: int, end: int, places: list[Place]) -> Place:
        """The likeliest place of `hit`, of `places` and what is found, for a player who went on without a pause."""
        now = self._written.beats.beat(np.array([places[0].score_s]))[0]
        best, priced = self.best_anchor(hit, end, places, lambda beats: self._written.prices.on(beats - now))
        offset = int((worth(self._written, self._hits.window(hit, end), best, self.offsets) + priced).argmax())
        return self.moved(best, offset)

    def best_anchor(
        self, start: int, end: int, places: list[Place], price: Callable[[Floats], Floats]
    ) -> tuple[Place, Floats]:
        """The likeliest place of hit `start`, of `places` and those that are found, and what its offsets cost (s,)."""
        written, window, rate = self._written, self._hits.window(start, end), places[0].rate

        def priced(place: Place) -> Floats:
            tempo = -0.5 * float(np.log(max(place.rate, _SLOWEST) / max(rate, _SLOWEST)) / NEW_TEMPO_SD) ** 2
            beats = written.beats.beat(np.array([place.score_s]))[0] + self.offsets.beats
            return tempo - price(beats) + self.offsets.only_whole

        def value(place: Place) -> float:
            return float((worth(written, window, place, self.offsets) + priced(place)).max())

        places = places + [self.on_beat(window, place) for place in places]
        if max(map(value, places)) < ENOUGH * possible(window) and len(window.at_s) >= _FEWEST:
            first_s, here_s = float(written.at_s[0]), places[0].score_s
            for among in ((here_s - EARLY_S, here_s + EARLY_S), (first_s - 1.0, first_s + EARLY_S)):
                places = places + found(written, self.tracker, window, _NEAR_RATES * rate, among)
        best = max(places, key=value)
        return best, priced(best)

    def nearby(self, window: Hits, place: Place) -> Place:
        """`place` moved to what the next hits' notes say, for a first hit may be off."""
        near = window.part(0, _RESUME_HITS)
        score_s = place.score_s + place.rate * (near.at_s - place.at_s)
        off = np.array(self.tracker.distances(score_s.tolist(), near.classes.tolist()))
        off = off[np.abs(off) < _RESUME_S]
        return place._replace(score_s=place.score_s + float(np.median(off))) if len(off) else place


def possible(hits: Hits) -> float:
    """Nats that hits bring where each is exactly what is written, a stroke or a bounce."""
    bounces = int((hits.classes >= MAYBE_BOUNCE).sum())
    return POSSIBLE * (len(hits.at_s) - bounces) + BOUNCED * bounces
