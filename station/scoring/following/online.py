"""Where a student is in the score, hit by hit as they play.

The same model as at the end (`offline`), filtered instead of smoothed: a clock keeps the beat, the click or a loop that
follows the student's tempo, and with every beat that closes the offsets against it take a step (`beat_offsets`). Where
another offset has become the likeliest, the student is there, from the hit on from which it is.

Without a click the clock itself may be wrong, at the beginning, after a stop or a stumble. Then the hits speak against
the place (a running sum, Page 1954), and place and tempo are looked for anew (`anchors`), soon at first, then ever more
rarely. A student who stops makes the score wait: the next hit is taken for the next note of its class behind the stop
until more hits tell where they really went on.

All that is believed depends on the hits and their times alone. Times are seconds; score time is at the written tempo.
"""

from bisect import bisect_right
from collections.abc import Callable
from math import inf, log

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.scoring.following.anchors import Hits, fitted, found, worth
from station.scoring.following.beat_offsets import EDGE, WAIT_BEATS, Offsets, Pause, block_gains, forward, offsets_of
from station.scoring.following.prices import NEW_TEMPO_SD, POSSIBLE, TEMPO_SD
from station.scoring.following.tempo_tracker import Place, Tracker
from station.scoring.following.written import Written
from station.scoring.matching.live_judge import Moved

Floats = NDArray[np.float64]

STOP_NOTES, STOP_S = 8, 1.0
"""Our choice: so many notes in a row are not missed by a player who plays on."""

_MARGIN = 3.0
"""Nats by which another place must lead before the student is told to be there."""

_DOUBT, _FITTING = 8.0, 0.65
"""Nats that raise a doubt: what the hits lack of this share of what they could say (our choice: two strays do not, and
who leaves out one note in five brings .8)."""

_LOOK_HITS, _LEAST_HITS = 24, 6
"""Hits that a look takes at most, two bars of a sparse groove, and at least: fewer are found everywhere."""

_WAITS = (4, 6, 8, 12, 16, 24, 32, 64, 128)
"""Hits from one look that found nothing to the next: whoever does not play the score costs little (our choice)."""

_CLOSE_S, _NEAR_S, _FAR_S = 4.0, 45.0, 300.0
"""Seconds to both sides: where any tempo is tried, where the last is, and how much a look beyond takes."""

_RATES, _NEAR_RATES = np.exp(np.arange(-18, 19) * 0.02), np.exp(np.arange(-4, 5) * 0.02)
"""Tempi tried against the last: up to 43 % close by, up to 8 % elsewhere."""

_ANY_RATES = np.exp(np.arange(-37, 38) * 0.02)
"""Tempi tried until the student has once been found: half to twice what is written."""

_SAME_BEAT = 0.15
"""So near is the same place, at another tempo."""

_SLOWEST, _FASTEST = 0.4, 2.5
"""Beyond these nobody plays what is written (our choice)."""

_NEXT_S = 0.05
"""A note so soon after the last place is still that place's."""


class Online:
    """Follows hits through what is written, at least one note, from its beginning; `clocked` by the click or not."""

    def __init__(self, written: Written, clocked: bool) -> None:
        self._written = written
        self._clocked = clocked
        self._tracker = Tracker(*written.lanes)
        self._offsets: Offsets = offsets_of(written, slips=not clocked)
        self._known = set((written.answered if clocked else written.lanes[1]).tolist())
        self._note_s: list[float] = written.at_s.tolist()
        self._beat_s: list[float] = written.beat_s.tolist()
        self._shift = 0.0  # beats by which a student with a click is off it
        self._clock = Place(0.0, 0.0, 1.0)
        self._times: list[float] = []
        self._classes: list[int] = []
        self._places: list[float] = []
        self._total = -self._offsets.price
        self._since = np.zeros(len(self._total), np.int64)
        self._block: list[int] = []  # the known hits of the beat that has not closed
        self._edge = -inf  # where it began
        self._last_beat = -inf
        self._pause: Pause | None = None  # the silence before the beat that has not closed
        self._doubt, self._doubt_since = 0.0, 0
        self._looks, self._next_look = 0, _LEAST_HITS - 1
        self._is_settled = False  # whether a look's worth of hits has fitted
        self._stopped_at: int | None = None
        self._stop_s = 0.0
        self.waited: list[tuple[int, int]] = []
        """The first hit after each stop without a click, and for how many ns the score had waited for it."""

    @property
    def totals(self) -> Floats:
        """Nats (s,) of the best way to each offset over the beats that have closed, the best of them 0."""
        return np.asarray(self._total - self._total.max())

    def place_ns(self, at_ns: int) -> int:
        """Where the student is at `at_ns` if they play on; where the score waits once they have stopped."""
        place_s, last_s = self._on_time(at_ns / NS_PER_S), self._places[-1] if self._places else 0.0
        if self._clocked:
            return at_ns if self._shift == 0.0 else round(place_s * NS_PER_S)
        return round((min(place_s, self._waiting_s(last_s)) if place_s > last_s else place_s) * NS_PER_S)

    def is_waiting(self, at_ns: int) -> bool:
        """Whether the score waits at `at_ns` for a student without a click who has stopped."""
        last_s = self._places[-1] if self._places else 0.0
        return not self._clocked and self._on_time(at_ns / NS_PER_S) > max(last_s, self._waiting_s(last_s))

    @property
    def beats_behind(self) -> float:
        """Quarters by which a student is behind the click and plays on, negative ahead of it; 0 without one."""
        return -self._shift

    @property
    def pace(self) -> float:
        """How many times as fast as written the student plays; 1 by the click."""
        return 1.0 if self._clocked else self._clock.rate

    def hit(self, at_ns: int, match_class: int) -> Moved:
        """Take a hit; returns its place, and those of older ones where they turn out to lie elsewhere."""
        index, at_s = len(self._times), at_ns / NS_PER_S
        self._times.append(at_s)
        self._classes.append(match_class)
        if match_class not in self._known:
            self._places.append(self._on_time(at_s))
            return self._found(index, at_ns)
        if not self._clocked and self._has_stopped(index):
            self._resume(index)
        if self._clocked:
            place_s = self._on_time(at_s)
        else:
            place_s, _, self._clock = self._tracker.step(at_s, match_class, self._clock)
            if not _SLOWEST < self._clock.rate < _FASTEST:
                self._clock = self._clock._replace(rate=1.0)
        self._places.append(place_s)
        first = self._beat_closed(index, self._beat_of(place_s))
        self._block.append(index)
        return self._found(min(first, index), at_ns)

    def _found(self, first: int, at_ns: int) -> Moved:
        if self._clocked and self._shift == 0.0 and first == len(self._places) - 1:
            return Moved(first, [at_ns])
        return Moved(first, [round(place * NS_PER_S) for place in self._places[first:]], self._clock.rate)

    # --- the clock --------------------------------------------------------------------------------------------------

    def _on_time(self, at_s: float) -> float:
        """Score time at `at_s` for a student who plays on."""
        if not self._clocked:
            return self._clock.score_s + self._clock.rate * (at_s - self._clock.at_s)
        return at_s if self._shift == 0.0 else self._time_of(self._beat_of(at_s) + self._shift)

    def _beat_of(self, score_s: float) -> float:
        beat_s = self._beat_s
        i = min(max(bisect_right(beat_s, score_s) - 1, 0), len(beat_s) - 2)
        return i + (score_s - beat_s[i]) / (beat_s[i + 1] - beat_s[i])

    def _time_of(self, beat: float) -> float:
        beat_s = self._beat_s
        i = min(max(int(beat // 1), 0), len(beat_s) - 2)
        return beat_s[i] + (beat - i) * (beat_s[i + 1] - beat_s[i])

    # --- beats ------------------------------------------------------------------------------------------------------

    def _beat_closed(self, index: int, beat: float) -> int:
        """Close the beat before hit `index` if that begins another; returns the first hit moved, else `index`."""
        if not self._block:
            self._edge, self._last_beat = beat - EDGE, beat
            return index
        before, self._last_beat = self._last_beat, max(self._last_beat, beat)
        opened = (self._last_beat + EDGE) // 1.0
        if opened <= (before + EDGE) // 1.0:
            return index
        gain = self._gain(opened - EDGE)
        hits, self._block, self._edge = self._block, [], opened - EDGE
        self._total, is_jumped, _ = forward(self._total, gain, self._offsets, self._written, self._pause)
        self._since[is_jumped] = hits[0]
        self._pause = Pause(before, beat) if self._clocked and beat - before > WAIT_BEATS else None
        self._total -= self._total.max()
        best, here = int(self._total.argmax()), self._offsets.here
        if best != here and self._total[here] < -_MARGIN:
            if self._clocked or self._offsets.only_whole[best] == 0.0:
                return self._go(best, index)
            if index >= self._next_look:  # the clock is off the beat
                self._doubt, self._doubt_since = max(self._doubt, _DOUBT), int(self._since[best])
                return self._look(index)
        return index if self._clocked else self._weigh(gain[here], hits, index)

    def _gain(self, end: float) -> Floats:
        """What the beat up to `end` gains at every offset (s,)."""
        beats = np.array([self._beat_of(self._places[k]) for k in self._block])
        classes = np.array([self._classes[k] for k in self._block])
        edges = np.array([self._edge, end])
        gains, _ = block_gains(self._written, beats, classes, _ONE_BLOCK, edges, self._offsets)
        return np.asarray(gains[0])

    def _go(self, state: int, index: int) -> int:
        """The student is at another offset; returns the first hit for which that holds."""
        first, by = int(self._since[state]), float(self._offsets.beats[state])
        for k in range(first, index + 1):
            self._places[k] = self._time_of(self._beat_of(self._places[k]) + by)
        self._shift += by if self._clocked else 0.0
        if not self._clocked:
            moved_s = self._time_of(self._beat_of(self._clock.score_s) + by)
            self._clock = self._clock._replace(score_s=moved_s)
        parts = self._offsets.parts
        at = np.clip(np.searchsorted(parts, parts + parts[state]), 0, len(parts) - 1)
        is_known = parts[at] == parts + parts[state]
        self._total = np.where(is_known, self._total[at], -self._offsets.price)
        self._since = np.where(is_known, self._since[at], index)
        self._edge += by
        if self._pause is not None:
            self._pause = Pause(self._pause.last + by, self._pause.now + by)
        self._last_beat += by
        if self._clocked or self._is_settled:
            self._calm(index)
        return first

    # --- doubts (without a click) -----------------------------------------------------------------------------------

    def _weigh(self, gain: float, hits: list[int], index: int) -> int:
        """Take what a beat says for or against the place; returns the first hit that is moved, else `index`."""
        if self._doubt == 0.0:
            self._doubt_since = hits[0]
        self._doubt = max(self._doubt + _FITTING * POSSIBLE * len(hits) - float(gain), 0.0)
        if self._doubt == 0.0:
            self._is_settled |= index - self._doubt_since >= _LOOK_HITS or index >= 2 * _LOOK_HITS
            if self._looks or self._stopped_at is not None:
                self._calm(index)
        elif self._doubt > _DOUBT and index >= self._next_look:
            return self._look(index)
        return index

    def _calm(self, index: int) -> None:
        """The hits before `index` fit."""
        self._doubt, self._doubt_since, self._stopped_at = 0.0, index, None
        self._looks, self._next_look = 0, index + _LEAST_HITS - 1

    def _look(self, index: int) -> int:
        """Where else the doubtful hits may have been played; returns the first hit that is moved, else `index`."""
        since = max(self._doubt_since if self._is_settled else 0, index - _LOOK_HITS)
        hits = [k for k in range(since, index) if self._classes[k] in self._known]
        self._next_look = index + _WAITS[min(self._looks, len(_WAITS) - 1)]
        self._looks += 1
        if len(hits) < _LEAST_HITS:
            return index
        window = Hits(np.array([self._times[k] for k in hits]), np.array([self._classes[k] for k in hits]))
        at_s, rate = self._times[hits[0]], min(max(self._clock.rate, _SLOWEST), _FASTEST)
        now = Place(at_s, self._places[hits[0]], rate)
        price = self._price(now, hits[0])

        def value(place: Place) -> float:
            return self._fit(window, place) - price(place)

        places = [place for place in self._places_around(window, now) if _SLOWEST < place.rate < _FASTEST]
        best = max(places, key=value, default=now)
        if value(best) <= value(now) + _MARGIN or self._fit(window, best) < _FITTING * POSSIBLE * len(hits):
            return index  # who fits nowhere so far is not told to be elsewhere
        return self._set(best, hits, index)

    def _fit(self, window: Hits, place: Place) -> float:
        """Nats for the first hit of the window being at `place`."""
        return float(worth(self._written, window, place, _NOWHERE)[0])

    def _price(self, now: Place, hit: int) -> Callable[[Place], float]:
        """Nats against having gone on at a place with the doubtful hits, of which `hit` is the first."""
        prices, here = self._written.prices, self._beat_of(now.score_s)
        if not self._is_settled:
            began_s = self._times[0]
            on_time = self._beat_of(began_s)
            together = abs(on_time - prices.start) < self._written.beat

            def late(place: Place) -> float:
                beat = self._beat_of(place.score_s - place.rate * (place.at_s - began_s))
                elsewhere = _COUNTED_IN if together and abs(beat - prices.start) > self._written.beat else 0.0
                nats = float(prices.begin(np.array([beat]), on_time)[0])
                return nats + elsewhere + 0.5 * log(place.rate) ** 2 / TEMPO_SD**2

            return late
        stopped = self._beat_of(self._stop_s)

        def nats(place: Place) -> float:
            beat = self._beat_of(place.score_s)
            if self._stopped_at is not None:
                moved = float(prices.pause(np.array([beat]), stopped, here)[0])
            else:
                moved = 0.0 if abs(beat - here) < _SAME_BEAT else float(prices.on(np.array([beat - here]))[0])
            return moved + min(0.5 * (log(place.rate / now.rate) / NEW_TEMPO_SD) ** 2, _MOST_FOR_TEMPO)

        return nats

    def _places_around(self, window: Hits, now: Place) -> list[Place]:
        """Places of the window's first hit: close by at any tempo, near, at the beginning, and farther look by look."""
        here_s, rate, first_s = now.score_s, now.rate, self._note_s[0]
        if not self._is_settled:
            ends = [(first_s - 1.0, first_s + _NEAR_S)] + ([self._far(first_s)] if self._looks > 1 else [])
            spots = [
                place for among in ends for place in found(self._written, self._tracker, window, _ANY_RATES, among)
            ]
            since_s = now.at_s - self._times[0]
            began = [place._replace(score_s=first_s + place.rate * since_s) for place in spots]
            return spots + [fitted(self._tracker, window, place) for place in began]  # of bars alike the first
        tried = [
            (_RATES, here_s - _CLOSE_S, here_s + _CLOSE_S),
            (_NEAR_RATES, first_s - 1.0, first_s + _CLOSE_S),
            (_NEAR_RATES, here_s - _NEAR_S, here_s + _NEAR_S),
        ]
        if self._looks > 1:
            tried.append((_NEAR_RATES, *self._far(here_s)))
        return [
            place
            for rates, low, high in tried
            for place in found(self._written, self._tracker, window, rates * rate, (low, high))
        ]

    def _far(self, here_s: float) -> tuple[float, float]:
        """The part of the score that this look takes: the next to the left or right of those before."""
        steps = int((self._note_s[-1] - self._note_s[0]) / (2 * _FAR_S)) + 1
        turn = (self._looks - 2) % (2 * steps)
        middle_s = here_s + (turn + 1) // 2 * (1 if turn % 2 else -1) * 2 * _FAR_S
        return middle_s - _FAR_S, middle_s + _FAR_S

    def _set(self, place: Place, hits: list[int], index: int) -> int:
        """The clock stood at `place` with the first of `hits`; returns that hit."""
        here = place
        for k in range(hits[0], index + 1):
            if self._classes[k] in self._known:
                self._places[k], _, here = self._tracker.step(self._times[k], self._classes[k], here)
            else:
                self._places[k] = here.score_s + here.rate * (self._times[k] - here.at_s)
        self._clock = here
        self._total = np.where(self._offsets.parts == 0, 0.0, -self._offsets.price)
        self._since = np.full(len(self._total), index)
        self._last_beat = self._beat_of(self._places[index])
        self._edge = self._last_beat - EDGE
        self._calm(index)
        return hits[0]

    # --- stops (without a click) ------------------------------------------------------------------------------------

    def _waiting_s(self, last_s: float) -> float:
        """Score time at which the score waits for a student whose last hit was at `last_s`."""
        after = bisect_right(self._note_s, last_s) + STOP_NOTES - 1
        return max(self._note_s[after], last_s + STOP_S) if after < len(self._note_s) else inf

    def _has_stopped(self, index: int) -> bool:
        """Whether hit `index` comes after a stop."""
        last_at_s, last_s = (self._times[index - 1], self._places[index - 1]) if index else (0.0, 0.0)
        silence_s = self._times[index] - last_at_s
        return silence_s > STOP_S and last_s + self._clock.rate * silence_s > self._waiting_s(last_s)

    def _resume(self, index: int) -> None:
        """Take hit `index`, the first after a stop, for the next note of its class."""
        last_s = self._places[index - 1] if index else -_NEXT_S
        next_s = self._written.next_of(self._classes[index], last_s)
        place_s = self._note_s[-1] if next_s is None else next_s
        played_on_s = (place_s - last_s) / self._clock.rate
        silence_s = self._times[index] - (self._times[index - 1] if index else 0.0)
        self.waited.append((index, round((silence_s - played_on_s) * NS_PER_S)))
        self._clock = Place(self._times[index], place_s, self._clock.rate)
        self._block = []
        self._total = np.where(self._offsets.parts == 0, 0.0, -self._offsets.price)
        self._since = np.full(len(self._total), index)
        self._calm(index)
        self._stopped_at, self._stop_s = index, last_s
        self._doubt = _DOUBT + _STOP_DOUBT


_STOP_DOUBT = 3.0
"""Nats of doubt more than enough that follow a stop: a few hits must speak for the place (our choice)."""

_COUNTED_IN = 15.0
"""Nats against a student's beginning elsewhere who comes in when they were counted in (our choice: as a jump)."""

_MOST_FOR_TEMPO = 6.0
"""Nats at most against another tempo."""

_ONE_BLOCK = np.zeros(1, np.int64)
"""The first hit of the only block."""

_NOWHERE = Offsets(np.zeros(1, np.int64), 1, False, np.zeros(1))
"""No offset but none."""
