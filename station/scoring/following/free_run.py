"""Follows hits without a click from a place on: jumps, pauses, and where the clock lost the beat.

Times are seconds. The place to begin at is chosen elsewhere (`offline`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits
from station.scoring.following.beat_blocks import AHEAD, MOST_JUMPS, SETTLED, Blocks
from station.scoring.following.beat_offsets import BeatWay, best_way, end_cost
from station.scoring.following.place_choice import SAME_S, PlaceChoice
from station.scoring.following.prices import POSSIBLE
from station.scoring.following.tempo_tracker import Place
from station.scoring.following.written import Written

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

SILENCE_S = 1.0
"""Longer is no wait that a groove has (our choice)."""

_LOST, LOST_HITS = 0.4, 24
"""Less than this share of what is possible over so many hits, on the best way: the clock has lost the beat."""

_STOP_SLOTS, _SILENT_S = 3, 0.08
"""A silence is not written where so many moments, so far apart, went by in it (our choice: one or two are left out)."""


@dataclass(frozen=True, eq=False)
class RawWay:
    """Score time of each hit (m,) by the clock, its distance to the nearest note, and the first hits of the jumps."""

    score_s: Floats
    distance_s: Floats
    jumps: Indices


class FreeRun:
    """Follows hits without a click through `written`, at about its tempo; `ends`: its end is an end to the player."""

    def __init__(self, written: Written, hits: Hits, tempo: float = 1.0, ends: bool = True) -> None:
        self._written, self._hits, self._ends = written, hits, ends
        self.choice = PlaceChoice(written, hits, tempo)
        self._tracker, self._offsets = self.choice.tracker, self.choice.offsets
        self._times, self._classes = hits.at_s.tolist(), hits.classes.tolist()
        self._score_s, self._distance_s = np.zeros(len(hits.at_s)), np.zeros(len(hits.at_s))
        self._silences = silences(hits.at_s)
        self._jumps: list[int] = []
        self._trusted, self._wait = 0, LOST_HITS
        """No beat counts as lost before the first; so many hits later at the earliest it is lost again."""
        self._settled = np.where(self._offsets.parts == 0, 0.0, -np.inf)
        self._stay = np.where(self._offsets.parts == 0, 0.0, -self._offsets.price)

    def worth(self, begin: Place, end: int) -> float:
        """What hits 0 … `end` − 1 say for a beginning at `begin`, wherever they turn out to be, in nats."""
        self._follow(0, end, begin)
        return best_way(self._blocks(0, end).gains, self.choice.first(begin), self._offsets, self._written).worth

    def run(self, begin: Place) -> RawWay:
        """Follow from `begin` to the end."""
        here, first, start = begin, self.choice.first(begin), 0
        while start < len(self._times):
            here, end = self._follow_on(start, here, first)
            start = end
            if end < len(self._times):
                here, first = self._after_pause(end, here)
        return RawWay(self._score_s, self._distance_s, np.array(self._jumps, np.int64))

    def _follow_on(self, start: int, here: Place, first: Floats) -> tuple[Place, int]:
        """Follow from hit `start` through all jumps to the next pause; returns the place after it and its first hit."""
        at, is_stuck = start, False
        self._trusted, self._wait = start, LOST_HITS
        while True:
            end = self._next_pause(at, here)
            if is_stuck and len(self._jumps) >= MOST_JUMPS:
                return self._follow(at, end, here), end
            here, jump = self._follow_to_jump(at, end, here, first, at + is_stuck)
            if jump is None:
                return here, end
            if jump > start:
                self._jumps.append(jump)
            is_stuck = jump == at or len(self._jumps) >= MOST_JUMPS
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

    def _blocks(self, start: int, end: int) -> Blocks:
        beats = self._written.beats.beat(self._score_s[start:end])
        return Blocks.of(self._written, self._hits.part(start, end), beats, 0, end - start, self._offsets)

    def _follow_to_jump(
        self, start: int, end: int, here: Place, first: Floats, earliest: int
    ) -> tuple[Place, int | None]:
        """Follow from `start`; returns the place at the end and None, or that of the first jump and its hit.

        No jump is before the hit `earliest`: where one led to the next at the same hit, it would never end.
        """
        while start < end:
            until = min(start + AHEAD, end)
            after = self._follow(start, until, here)
            blocks = self._blocks(start, until)
            way = best_way(blocks.gains, first, self._offsets, self._written, self._end_cost(until))
            left = np.flatnonzero(way.states != self._offsets.here)
            jump = max(start + blocks.split(int(left[0]), way.states), earliest) if len(left) else until
            settled = until if until == end else start + SETTLED
            lost = self._first_lost(blocks, way, start, until)
            if lost is not None and lost < min(jump, settled):
                found_at = self._found_again(lost, end, self._place_before(start, lost, here))
                if found_at is not None:
                    return found_at, lost
            if len(left) and jump < settled:
                back = self._place_before(start, jump, here)
                now = Place(self._times[jump], float(self._score_s[jump]), back.rate)
                place = self.choice.moved(now, int(way.states[left[0]]))
                if not np.isfinite(self._offsets.only_whole[way.states[left[0]]]):
                    place = self.choice.on_another_beat(jump, end, place)
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

    def _first_lost(self, blocks: Blocks, way: BeatWay, start: int, end: int) -> int | None:
        """The first hit from which on even the best way does not fit, None where it always does."""
        hits = np.append(blocks.starts, end - start)[1:]  # hits up to the end of each block
        before = np.concatenate(([0.0], np.cumsum(blocks.gains[np.arange(len(hits)), way.states])))
        first = np.searchsorted(np.append(0, hits), hits - LOST_HITS, side="right") - 1  # the window's first block
        full = np.flatnonzero((hits >= LOST_HITS) & (blocks.starts[np.maximum(first, 0)] + start >= self._trusted))
        gained = before[full + 1] - before[first[full]]
        bad = full[gained < _LOST * POSSIBLE * (hits[full] - np.append(0, hits)[first[full]])]
        return None if not len(bad) else start + int(blocks.starts[first[bad[0]]])

    def _found_again(self, lost: int, end: int, back: Place) -> Place | None:
        """The clock set anew at hit `lost`; None where nothing better is found than to go on."""
        on_time_s = back.score_s + back.rate * (self._times[lost] - back.at_s)
        place = Place(self._times[lost], on_time_s, back.rate)
        best = self.choice.set_anew(lost, end, [place])
        self._wait = LOST_HITS if best is not place else 2 * self._wait
        self._trusted = lost + self._wait
        return None if best is place else best

    def _after_pause(self, start: int, here: Place) -> tuple[Place, Floats]:
        """Where the player goes on with hit `start` after a pause, and the first totals (s,) there."""
        at_s, last_s, end = self._times[start], float(self._score_s[start - 1]), len(self._times)
        on_time_s = here.score_s + here.rate * (at_s - here.at_s)
        next_s = self._written.next_of(self._classes[start], last_s)
        places = [Place(at_s, on_time_s, here.rate)]
        if next_s is not None and abs(next_s - on_time_s) > SAME_S:
            places.append(self.choice.nearby(self._hits.window(start, end), Place(at_s, next_s, here.rate)))
        last, now = self._written.beats.beat(np.array([last_s, on_time_s])).tolist()
        best, first = self.choice.best_anchor(
            start, end, places, lambda beats: self._written.prices.pause(beats, last, now)
        )
        self._jumps.append(start)
        return best, first


def silences(at_s: Floats) -> Indices:
    """The first hits after silences."""
    return np.flatnonzero(np.diff(at_s) > SILENCE_S) + 1
