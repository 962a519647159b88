"""The whole way of a performance through a score, when all of it is known.

A clock keeps the player's beat: the click, or a loop that follows their tempo hit by hit (`tempo_tracker`). Against it
the beats are found by which they are elsewhere (`beat_offsets`), with all that comes later in view; from a jump on the
clock runs anew at the new place. Without a click the clock must be set at the beginning and after every silence, and
where no beat fits any more: there the place and tempo are found from nothing (`anchors`). Times are seconds.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits, fitted, found, worth
from station.scoring.following.beat_offsets import (
    EDGE,
    BeatWay,
    Offsets,
    Pause,
    best_way,
    block_gains,
    end_cost,
    offsets_of,
    pauses_of,
)
from station.scoring.following.prices import NEW_TEMPO_SD, POSSIBLE, TEMPO_SD
from station.scoring.following.tempo_tracker import Place, Tracker
from station.scoring.following.written import PARTS, Nats, Written

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

SILENCE_S = 1.0
"""Longer is no wait that a groove has (our choice)."""

_AHEAD = 1536
"""Hits that are looked at together, and of them so many are settled at once: bounds memory, and the cost of a jump."""
_SETTLED = 1152

_LONG_LOOK = 256
"""Hits over which rival anchors are compared: bars that are alike part ways sooner or later."""

_RIVALS, _HOPELESS = 4, 30.0
"""So many anchors are followed over the long look; where one fits, those no more nats behind it in the window."""

_ENOUGH = 0.8
"""Share of all possible evidence with which an anchor is believed without a search: a player of SD 20 ms who leaves out
one note in ten brings .82."""

_SURELY = 0.95
"""As `_ENOUGH`, without a look at tempi close to what is written, in a score short enough to be all alike: a long roll
shifted by one of its strokes fits to .9."""

_LOST, _LOST_HITS = 0.4, 24
"""Less than this share of what is possible over so many hits, on the best way: the clock has lost the beat."""

_MOST_JUMPS = 200
"""Nobody jumps so often who plays the score; what comes then is followed without."""

_RATES = np.exp(np.arange(-37, 38) * 0.02)
"""Tempi tried at the beginning, half to twice as fast, in steps of 2 %."""

_CLOSE_RATES = 1.0 + 0.02 * np.array([-5, -4, -3, -2, -1, 1, 2, 3, 4, 5])
"""Tempi close to what is written."""

_NEAR_RATES = np.exp(np.arange(-10, 11) * 0.02)
"""Tempi tried later on, against the last."""

_EARLY_S = 60.0
"""A recording's tempo and beat are first looked for in so much of the score."""


@dataclass(frozen=True, eq=False)
class RawWay:
    """Score time of each hit (m,) by the clock, its distance to the nearest note, and the first hits of the jumps."""

    score_s: Floats
    distance_s: Floats
    jumps: Indices


def clicked_way(written: Written, hits: Hits) -> tuple[Floats, Indices]:
    """Score time of each hit (m,) and the first hits of the jumps, by the click.

    The hits' times are score time, but for whole beats that the player skipped or went back.
    """
    offsets = offsets_of(written, slips=False)
    beats, shift, jumps = written.beats.beat(hits.at_s), np.zeros(len(hits.at_s)), []
    start, now = 0, 0.0
    for _ in range(_MOST_JUMPS):
        at, parts = _next_jump(written, hits, beats + now, start, offsets, -offsets.price)
        if at is None:
            break
        now += parts / PARTS
        shift[at:] = now
        jumps.append(at)
        start = at
    score_s = hits.at_s if not jumps else written.beats.time(beats + shift)
    return score_s, np.array([j for j in jumps if j], np.int64)


def _next_jump(
    written: Written, hits: Hits, beats: Floats, start: int, offsets: Offsets, first: Floats
) -> tuple[int | None, int]:
    """The first hit from `start` on that is elsewhere and by how many parts of a beat; None where there is none."""
    while start < len(beats):
        end = min(start + _AHEAD, len(beats))
        window = _Blocks.of(written, hits, beats, start, end, offsets)
        last = end_cost(written, float(beats[-1]), offsets) if end == len(beats) else None
        way = best_way(window.gains, first, offsets, written, last, window.pauses)
        left = np.flatnonzero(way.states != offsets.here)
        settled = end if end == len(beats) else start + _SETTLED
        if len(left) and window.starts[left[0]] < settled:
            return window.split(int(left[0]), way), int(offsets.parts[way.states[left[0]]])
        start, first = settled, -offsets.price
    return None, 0


@dataclass(frozen=True, eq=False)
class _Blocks:
    """Hits by the beats of the clock: the first hit of each block (b,), what they gain (b, s), hit by hit (m, s).

    `pauses` are the silences before blocks.
    """

    starts: Indices
    gains: Floats
    said: Nats
    first_hit: int
    pauses: Mapping[int, Pause]

    @classmethod
    def of(cls, written: Written, hits: Hits, beats: Floats, start: int, end: int, offsets: Offsets) -> "_Blocks":
        """Hits `start` … `end` − 1 at `beats` (m,) of the clock."""
        own = np.maximum.accumulate(beats[start:end])
        whole = np.floor(own + EDGE)
        starts = np.concatenate(([0], np.flatnonzero(np.diff(whole)) + 1))
        edges = np.concatenate(([own[0]], whole[starts[1:]], [own[-1] + 2 * EDGE])) - EDGE
        gains, said = block_gains(written, beats[start:end], hits.classes[start:end], starts, edges, offsets)
        return cls(starts + start, gains, said, start, pauses_of(own, starts))

    def split(self, block: int, way: BeatWay) -> int:
        """The hit at which the state of `block` begins: near its first beat, where most evidence is left."""
        if block == 0 or block in self.pauses:
            return int(self.starts[block])
        before, after = int(way.states[block - 1]), int(way.states[block])
        low = int(self.starts[max(block - 1, 0)])
        high = int(self.starts[block + 1]) if block + 1 < len(self.starts) else self.first_hit + len(self.said)
        own = self.said[low - self.first_hit : high - self.first_hit]
        gain = np.concatenate(([0.0], np.cumsum(own[:, before] - own[:, after])))
        best = np.flatnonzero(gain >= gain.max() - 1e-6)
        nearest = best[np.argmin(np.abs(best + low - self.starts[block]))]
        return low + int(nearest)


def _tracker(written: Written) -> Tracker:
    return Tracker(*written.lanes)


def free_way(written: Written, hits: Hits, ends: bool = True) -> tuple[RawWay, float]:
    """The way of a player without a click, in score time at the second value, their tempo against what is written.

    `ends`: the score's end is an end, and not where it was laid out to.
    """
    begin, tempo = _Free(written, hits).beginning()
    return _Free(written.at_tempo(tempo), hits, tempo, ends).run(begin), tempo


class _Free:
    """Follows hits without a click through `written`, at about its tempo."""

    def __init__(self, written: Written, hits: Hits, tempo: float = 1.0, ends: bool = True) -> None:
        self._written, self._hits, self._tempo, self._ends = written, hits, tempo, ends
        self._tracker = _tracker(written)
        self._offsets = offsets_of(written, slips=True)
        self._times, self._classes = hits.at_s.tolist(), hits.classes.tolist()
        self._score_s, self._distance_s = np.zeros(len(hits.at_s)), np.zeros(len(hits.at_s))
        self._silences = silences(hits.at_s)
        self._jumps: list[int] = []
        self._trusted, self._wait = 0, _LOST_HITS
        """No beat counts as lost before the first; so many hits later at the earliest it is lost again."""
        self._settled = np.where(self._offsets.parts == 0, 0.0, -np.inf)
        self._stay = np.where(self._offsets.parts == 0, 0.0, -self._offsets.price)

    # --- the beginning ----------------------------------------------------------------------------------------------

    def beginning(self) -> tuple[Place, float]:
        """Where the performance begins, in score time at the tempo that is the second value."""
        written, hits = self._written, self._hits
        at_s, first_s = float(hits.at_s[0]), float(written.at_s[0])
        gaps = silences(hits.at_s)
        end = int(gaps[gaps >= _LOST_HITS][0]) if (gaps >= _LOST_HITS).any() else len(hits.at_s)
        window = hits.window(0, end)
        usual = [Place(at_s, score_s, 1.0) for score_s in (at_s, first_s)]
        rivals = [self._at_best(window, place) for place in usual + [self._on_beat(window, p) for p in usual]]
        if written.is_short and max(value for value, _ in rivals) < _SURELY * _possible(window):
            close = [self._on_beat(window, Place(at_s, first_s, rate)) for rate in _CLOSE_RATES]
            rivals += [self._at_best(window, place) for place in close]
        for among_s in ((first_s - 1.0, first_s + _EARLY_S), (-np.inf, np.inf)):
            if max(value for value, _ in rivals) < _ENOUGH * _possible(window):
                places = found(written, self._tracker, window, _RATES, among_s)
                rivals += [self._at_best(window, place) for place in places]
        rivals.sort(key=lambda rival: -rival[0])
        hopeless = -np.inf if rivals[0][0] < _ENOUGH * _possible(window) else rivals[0][0] - _HOPELESS
        likely = _unlike(written, [rival for rival in rivals if rival[0] > hopeless])[:_RIVALS]
        best = likely[0] if len(likely) == 1 else max(likely, key=lambda place: self._long_look(place, end))
        tempo = 1.0 if abs(best.rate - 1.0) < _SAME_TEMPO else best.rate
        return Place(at_s, best.score_s / tempo, best.rate / tempo), tempo

    def _at_best(self, window: Hits, place: Place) -> tuple[float, Place]:
        """What speaks for the tempo and beat of a beginning at its likeliest place in the score, and that place."""
        nats = worth(self._written, window, place, self._offsets) + self._first(place)
        best = int(nats.argmax())
        return float(nats[best]), self._moved(place, best)

    def _on_beat(self, window: Hits, place: Place) -> Place:
        """`place` moved by the parts of a beat that fit best, and fitted there."""
        best = int(worth(self._written, window, place, self._offsets).argmax())
        return fitted(self._tracker, window, self._moved(place, best))

    def _moved(self, place: Place, offset: int) -> Place:
        """`place` moved by one of the offsets."""
        if offset == self._offsets.here:
            return place
        beat = self._written.beats.beat(np.array([place.score_s])) + self._offsets.beats[offset]
        return place._replace(score_s=float(self._written.beats.time(beat)[0]))

    def _first(self, place: Place) -> Floats:
        """Nats (s,) for beginning at `place` moved by each offset."""
        beat = self._written.beats.beat(np.array([place.score_s, place.at_s]))
        tempo = place.rate * self._tempo
        prior = -0.5 * float(np.log(tempo) / TEMPO_SD) ** 2
        is_shared = abs(tempo - 1.0) < _SAME_TEMPO
        cost = self._written.prices.begin(beat[0] + self._offsets.beats, float(beat[1]) if is_shared else np.inf)
        return prior - cost + self._offsets.only_whole

    def _long_look(self, place: Place, end: int) -> float:
        """What the first hits say for a beginning, followed for a while at its tempo, wherever they turn out to be."""
        end = min(end, _LONG_LOOK)
        tempo = 1.0 if abs(place.rate - 1.0) < _SAME_TEMPO else place.rate
        free = self if tempo == 1.0 else _Free(self._written.at_tempo(tempo), self._hits, tempo)
        start = Place(place.at_s, place.score_s / tempo, place.rate / tempo)
        free._follow(0, end, start)
        return free._way(0, end, free._first(start)).worth

    # --- the way ----------------------------------------------------------------------------------------------------

    def run(self, begin: Place) -> RawWay:
        """Follow from `begin` to the end."""
        here, first, start = begin, self._first(begin), 0
        while start < len(self._times):
            here, end = self._follow_on(start, here, first)
            start = end
            if end < len(self._times):
                here, first = self._after_pause(end, here)
        return RawWay(self._score_s, self._distance_s, np.array(self._jumps, np.int64))

    def _follow_on(self, start: int, here: Place, first: Floats) -> tuple[Place, int]:
        """Follow from hit `start` through all jumps to the next pause; returns the place after it and its first hit."""
        at = start
        self._trusted, self._wait = start, _LOST_HITS
        while True:
            end = self._next_pause(at, here)
            here, jump = self._follow_to_jump(at, end, here, first)
            if jump is None:
                return here, end
            if jump > start:
                self._jumps.append(jump)
            is_stuck = jump == at or len(self._jumps) >= _MOST_JUMPS
            at, first = jump, self._settled if is_stuck else self._stay

    def _next_pause(self, start: int, here: Place) -> int:
        """The first hit after the next silence that is not written, for a clock at `here` before hit `start`."""
        for gap in self._silences[np.searchsorted(self._silences, start, side="right") :].tolist():
            places, _, here = self._tracker.follow(self._times[start:gap], self._classes[start:gap], here)
            on_time_s = here.score_s + here.rate * (self._times[gap] - here.at_s)
            low, high = np.searchsorted(self._written.at_s, (places[-1] + _SILENT_S, on_time_s - _SILENT_S))
            if np.count_nonzero(np.diff(self._written.at_s[low:high]) > _SILENT_S) + (low < high) >= _STOP_SLOTS:
                return int(gap)
            start = gap
        return len(self._times)

    def _follow(self, start: int, end: int, place: Place) -> Place:
        score_s, distance_s, after = self._tracker.follow(self._times[start:end], self._classes[start:end], place)
        self._score_s[start:end], self._distance_s[start:end] = score_s, distance_s
        return after

    def _blocks(self, start: int, end: int) -> _Blocks:
        beats = self._written.beats.beat(self._score_s[start:end])
        return _Blocks.of(self._written, self._hits.part(start, end), beats, 0, end - start, self._offsets)

    def _way(self, start: int, end: int, first: Floats) -> BeatWay:
        return best_way(self._blocks(start, end).gains, first, self._offsets, self._written)

    def _follow_to_jump(self, start: int, end: int, here: Place, first: Floats) -> tuple[Place, int | None]:
        """Follow from `start`; returns the place at the end and None, or that of the first jump and its hit."""
        while start < end:
            until = min(start + _AHEAD, end)
            after = self._follow(start, until, here)
            blocks = self._blocks(start, until)
            way = best_way(blocks.gains, first, self._offsets, self._written, self._end_cost(until))
            left = np.flatnonzero(way.states != self._offsets.here)
            jump = start + blocks.split(int(left[0]), way) if len(left) else until
            settled = until if until == end else start + _SETTLED
            lost = self._first_lost(blocks, way, start, until)
            if lost is not None and lost < min(jump, settled):
                found_at = self._found_again(lost, end, self._place_before(start, lost, here))
                if found_at is not None:
                    return found_at, lost
            if len(left) and jump < settled:
                back = self._place_before(start, jump, here)
                now = Place(self._times[jump], float(self._score_s[jump]), back.rate)
                place = self._moved(now, int(way.states[left[0]]))
                if not np.isfinite(self._offsets.only_whole[way.states[left[0]]]):
                    place = self._on_another_beat(jump, end, place)
                return place, jump
            here = after if settled == until else self._place_before(start, settled, here)
            start, first = settled, self._stay
        return here, None

    def _end_cost(self, until: int) -> Floats | None:
        """What it costs to end with hit `until` − 1, None where others follow."""
        if until < len(self._times) or not self._ends:
            return None
        return end_cost(self._written, float(self._written.beats.beat(self._score_s[-1:])[0]), self._offsets)

    def _place_before(self, start: int, hit: int, here: Place) -> Place:
        """Where the loop, set to `here` before hit `start`, stands before `hit`."""
        return self._tracker.follow(self._times[start:hit], self._classes[start:hit], here)[2]

    # --- set anew ---------------------------------------------------------------------------------------------------

    def _first_lost(self, blocks: _Blocks, way: BeatWay, start: int, end: int) -> int | None:
        """The first hit from which on even the best way does not fit, None where it always does."""
        hits = np.append(blocks.starts, end - start)[1:]  # hits up to the end of each block
        before = np.concatenate(([0.0], np.cumsum(blocks.gains[np.arange(len(hits)), way.states])))
        first = np.searchsorted(np.append(0, hits), hits - _LOST_HITS, side="right") - 1  # the window's first block
        full = np.flatnonzero((hits >= _LOST_HITS) & (blocks.starts[np.maximum(first, 0)] + start >= self._trusted))
        gained = before[full + 1] - before[first[full]]
        bad = full[gained < _LOST * POSSIBLE * (hits[full] - np.append(0, hits)[first[full]])]
        return None if not len(bad) else start + int(blocks.starts[first[bad[0]]])

    def _found_again(self, lost: int, end: int, back: Place) -> Place | None:
        """The clock set anew at hit `lost`; None where nothing better is found than to go on."""
        on_time_s = back.score_s + back.rate * (self._times[lost] - back.at_s)
        place = Place(self._times[lost], on_time_s, back.rate)
        best = self._set_anew(lost, end, [place])
        self._wait = _LOST_HITS if best is not place else 2 * self._wait
        self._trusted = lost + self._wait
        return None if best is place else best

    def _on_another_beat(self, hit: int, end: int, place: Place) -> Place:
        """The clock set to `place`, parts of a beat away: exactly, or anew where it had lost the tempo before."""
        window = self._hits.window(hit, end)
        place = fitted(self._tracker, window, place)
        fits = float(worth(self._written, window, place, self._offsets)[self._offsets.here])
        return place if fits > _ENOUGH * _possible(window) else self._set_anew(hit, end, [place])

    def _set_anew(self, hit: int, end: int, places: list[Place]) -> Place:
        """The likeliest place of `hit`, of `places` and what is found, for a player who went on without a pause."""
        now = self._written.beats.beat(np.array([places[0].score_s]))[0]
        best, priced = self._best_anchor(hit, end, places, lambda beats: self._written.prices.on(beats - now))
        offset = int((worth(self._written, self._hits.window(hit, end), best, self._offsets) + priced).argmax())
        return self._moved(best, offset)

    def _after_pause(self, start: int, here: Place) -> tuple[Place, Floats]:
        """Where the player goes on with hit `start` after a pause, and the first totals (s,) there."""
        at_s, last_s, end = self._times[start], float(self._score_s[start - 1]), len(self._times)
        on_time_s = here.score_s + here.rate * (at_s - here.at_s)
        next_s = self._written.next_of(self._classes[start], last_s)
        places = [Place(at_s, on_time_s, here.rate)]
        if next_s is not None and abs(next_s - on_time_s) > _SAME_S:
            places.append(self._nearby(self._hits.window(start, end), Place(at_s, next_s, here.rate)))
        last, now = self._written.beats.beat(np.array([last_s, on_time_s])).tolist()
        best, first = self._best_anchor(start, end, places, lambda beats: self._written.prices.pause(beats, last, now))
        self._jumps.append(start)
        return best, first

    def _best_anchor(
        self, start: int, end: int, places: list[Place], price: Callable[[Floats], Floats]
    ) -> tuple[Place, Floats]:
        """The likeliest place of hit `start`, of `places` and those that are found, and what its offsets cost (s,)."""
        written, window, rate = self._written, self._hits.window(start, end), places[0].rate

        def priced(place: Place) -> Floats:
            tempo = -0.5 * float(np.log(max(place.rate, _SLOWEST) / max(rate, _SLOWEST)) / NEW_TEMPO_SD) ** 2
            beats = written.beats.beat(np.array([place.score_s]))[0] + self._offsets.beats
            return tempo - price(beats) + self._offsets.only_whole

        def value(place: Place) -> float:
            return float((worth(written, window, place, self._offsets) + priced(place)).max())

        places = places + [self._on_beat(window, place) for place in places]
        if max(map(value, places)) < _ENOUGH * _possible(window) and len(window.at_s) >= _FEWEST:
            first_s, here_s = float(written.at_s[0]), places[0].score_s
            for among in ((here_s - _EARLY_S, here_s + _EARLY_S), (first_s - 1.0, first_s + _EARLY_S)):
                places = places + found(written, self._tracker, window, _NEAR_RATES * rate, among)
        best = max(places, key=value)
        return best, priced(best)

    def _nearby(self, window: Hits, place: Place) -> Place:
        """`place` moved to what the next hits' notes say, for a first hit may be off."""
        near = window.part(0, _RESUME_HITS)
        score_s = place.score_s + place.rate * (near.at_s - place.at_s)
        off = np.array(self._tracker.distances(score_s.tolist(), near.classes.tolist()))
        off = off[np.abs(off) < _RESUME_S]
        return place._replace(score_s=place.score_s + float(np.median(off))) if len(off) else place


_STOP_SLOTS, _SILENT_S = 3, 0.08
"""A silence is not written where so many moments, so far apart, went by in it (our choice: one or two are left out)."""

_SLOWEST = 0.01
_FEWEST = 6
"""A search with fewer hits finds everything everywhere (our choice)."""

_RESUME_HITS, _RESUME_S = 16, 0.06
"""Hits after a silence that say how exactly the player goes on, if they lie so near to a note."""

_SAME_S, _SAME_BEAT = 0.05, 0.1
_SAME_TEMPO = 0.04
"""A tempo so near to what is written is followed as it: the loop takes it up within a second."""


def _possible(hits: Hits) -> float:
    return POSSIBLE * len(hits.at_s)


def _unlike(written: Written, rivals: list[tuple[float, Place]]) -> list[Place]:
    """The places of the rivals, best first, but for those of the tempo and beat of a better one."""
    kept: list[tuple[float, float]] = []
    places = []
    for _, place in rivals:
        beat = float(written.beats.beat(np.array([place.score_s]))[0])
        if not any(
            abs(place.rate / rate - 1) < _SAME_TEMPO and abs(beat - other - round(beat - other)) < _SAME_BEAT
            for rate, other in kept
        ):
            kept.append((place.rate, beat))
            places.append(place)
    return places


def silences(at_s: Floats) -> Indices:
    """The first hits after silences."""
    return np.flatnonzero(np.diff(at_s) > SILENCE_S) + 1
