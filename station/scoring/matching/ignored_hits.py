"""Hits that nobody counts, however much they are unwritten: what good drummers' feet and left hands do on their own.

The list is the teacher's: the hi-hat foot keeping time, the chick that closes an open hat, a feathered kick, notes at
ghost level beside a backbeat, the bounces of a buzz roll, which is one note however often the stick bounces, and the
stroke on one that music lands on when it stops: a fill ends there, and behind the last pass nothing is written. Such a
hit still answers a written note of its piece; only if none claims it, it is not an extra. `Unwritten` answers for whole
arrays (the report) and for one hit at a time (live) by the same rules; live, a hit within a buzz is taken for a bounce.
"""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Piece
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.music.score import Score

GHOST_VELOCITY = 45
"""Upper end of ghost strokes (HUMANS, Velocity)."""

FEATHER_VELOCITY = 40
"""A feathered kick is felt, not heard (our choice, below the ghost strokes' upper end)."""

OPEN_FROM = 0.3
"""Openness from which a hi-hat rings on until somebody closes it (our choice)."""

_BEAT_REACH_NS = 60 * NS_PER_MS
"""How far from a beat a feathered kick may lie (our choice: half a 16th at 125 bpm)."""


BUZZ_REACH_NS = 60 * NS_PER_MS
"""How far before and after its written length a buzz roll may bounce (our choice: two bounces, and a late start)."""

BOUNCE_NS = 80 * NS_PER_MS
"""Slower than that a stick is led and does not bounce (our choice: a double's second bounce comes after 50–90 ms)."""

LANDING_EARLY_NS, LANDING_LATE_NS = 50 * NS_PER_MS, 100 * NS_PER_MS
"""How far before and after the one a landing may come (our choice: less than a 16th at 120 bpm; who stops is late)."""

_LANDED_ON = frozenset({Piece.KICK, Piece.CRASH_1, Piece.CRASH_2})
"""What a phrase is ended with, besides what the score itself has on its ones."""

LEAST_COMPANY = 3
"""So many hits are a buzz that bounces, whatever its gaps (our choice: a press and two bounces)."""

PRESS_LOUDER = 1.25
"""A stroke this much louder than the last is a new press (our choice: 4 dB, twice what nobody hears)."""


@dataclass(frozen=True, eq=False)
class Masks:
    """Over the hits (m,): `own_only`, feet and bounces, never answer another piece's note; `quiet` are never extras.

    All that are `own_only` are `quiet` too.
    """

    own_only: NDArray[np.bool_]
    quiet: NDArray[np.bool_]


class Unwritten:
    """The rules over one score; what a rule needs is worked out when a hit first asks for it."""

    def __init__(self, score: Score) -> None:
        self._score = score

    @cached_property
    def _bar_ns(self) -> NDArray[np.int64]:
        return self._score.tempo_map.ns_at(_grid(self._score, whole_bars=True))

    @cached_property
    def _beat_ns(self) -> NDArray[np.int64]:
        return self._score.tempo_map.ns_at(_grid(self._score, whole_bars=False))

    @cached_property
    def _foot_bar(self) -> NDArray[np.bool_]:
        """Which bars hold a written stroke of the hi-hat foot."""
        return self._bars_with(self._score.notes["piece"] == Piece.HIHAT_PEDAL)

    @cached_property
    def _backbeat_bar(self) -> NDArray[np.bool_]:
        """Which bars hold a snare that is no ghost, and other pieces: a snare alone is an exercise and no groove."""
        notes = self._score.notes
        snare = notes["piece"] == Piece.SNARE
        return self._bars_with(snare & (notes["dynamic"] != Dynamic.GHOST)) & self._bars_with(~snare)

    @cached_property
    def _hats(self) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """Times of the hi-hat's strokes, rising, and which of them are open."""
        hats = np.flatnonzero(self._score.notes["piece"] == Piece.HIHAT)
        hats = hats[np.argsort(self._score.onset_ns[hats], kind="stable")]
        opened = self._score.notes["openness"][hats] >= OPEN_FROM  # NaN, not said, is never open
        return self._score.onset_ns[hats], np.asarray(opened)

    @cached_property
    def _buzzes(self) -> dict[int, tuple[NDArray[np.int64], NDArray[np.int64]]]:
        """Of each piece that buzzes: where bounces may begin, rising, and until when the latest of them may go on."""
        score, spans = self._score, {}
        rows = np.flatnonzero((score.notes["articulation"] == Articulation.BUZZ) & ~score.is_grace)
        for piece in np.unique(score.notes["piece"][rows]).tolist():
            own = rows[score.notes["piece"][rows] == piece]
            ends = score.tempo_map.ns_at(score.notes["tick"][own] + score.notes["duration_ticks"][own])
            spans[piece] = (score.onset_ns[own] - BUZZ_REACH_NS, np.maximum.accumulate(ends) + BUZZ_REACH_NS)
        return spans

    @cached_property
    def _buzz_lists(self) -> dict[int, tuple[list[int], list[int]]]:
        return {piece: (starts.tolist(), ends.tolist()) for piece, (starts, ends) in self._buzzes.items()}

    @cached_property
    def _landings(self) -> tuple[list[int], frozenset[int]]:
        """Where music may land, rising: the ones of silent bars after music, and of the bar after the end; on what."""
        full = self._bars_with(np.ones(len(self._score), np.bool_))
        after_music = np.flatnonzero(full[:-1] & ~full[1:]) + 1
        on_one = self._score.on_the_grid.onset_ns == self._bar_ns[self._score.bar]
        pieces = {*np.unique(self._score.notes["piece"][on_one]).tolist(), *_LANDED_ON}
        return self._bar_ns[after_music].tolist(), frozenset(pieces)

    @cached_property
    def _lists(self) -> tuple[list[int], list[bool], list[bool], list[int], list[bool]]:
        """Bars, their flags and hats as lists, which single hits are looked up in faster."""
        hat_ns, opened = self._hats
        bars = (self._bar_ns.tolist(), self._foot_bar.tolist(), self._backbeat_bar.tolist())
        return (*bars, hat_ns.tolist(), opened.tolist())

    @cached_property
    def _beat_list(self) -> list[int]:
        beats: list[int] = self._beat_ns.tolist()
        return beats

    def masks(self, performance: Performance, hit_ns: NDArray[np.int64]) -> Masks:
        """The rules for every hit, `hit_ns` (m,) being its score time."""
        piece, velocity = performance.hits["piece"], performance.hits["velocity"]
        feet = piece == Piece.HIHAT_PEDAL
        ghosts = (piece == Piece.SNARE) & (velocity <= GHOST_VELOCITY)
        feathers = (piece == Piece.KICK) & (velocity <= FEATHER_VELOCITY)
        if feet.any():
            feet[feet] = ~self._foot_bar[self._bars(hit_ns[feet])] | self._after_open_hat(hit_ns[feet])
        if ghosts.any():
            ghosts[ghosts] = self._backbeat_bar[self._bars(hit_ns[ghosts])]
        if feathers.any():
            feathers[feathers] = self._on_beat(hit_ns[feathers])
        own_only = feet | self._bounces(piece, hit_ns)
        return Masks(own_only, own_only | ghosts | feathers | self._land(piece, hit_ns))

    def is_own_only(self, piece: Piece, hit_ns: int) -> bool:
        """One hit of `Masks.own_only`."""
        if piece in self._buzzes:
            starts, ends = self._buzz_lists[piece]
            buzz = bisect_right(starts, hit_ns) - 1
            return buzz >= 0 and hit_ns <= ends[buzz]
        if piece is not Piece.HIHAT_PEDAL:
            return False
        bar_ns, foot_bar, _, hat_ns, hat_open = self._lists
        hat = bisect_right(hat_ns, hit_ns) - 1
        return not foot_bar[max(bisect_right(bar_ns, hit_ns) - 1, 0)] or (hat >= 0 and hat_open[hat])

    def is_quiet(self, piece: Piece, velocity: int, hit_ns: int) -> bool:
        """One hit of `Masks.quiet`."""
        if piece is Piece.SNARE and velocity <= GHOST_VELOCITY:
            bar_ns, _, backbeat_bar, _, _ = self._lists
            if backbeat_bar[max(bisect_right(bar_ns, hit_ns) - 1, 0)]:
                return True
        if piece is Piece.KICK and velocity <= FEATHER_VELOCITY:
            beats = self._beat_list
            i = bisect_right(beats, hit_ns)
            if any(abs(beat - hit_ns) <= _BEAT_REACH_NS for beat in beats[max(i - 1, 0) : i + 1]):
                return True
        at_ns, pieces = self._landings
        i = bisect_left(at_ns, hit_ns - LANDING_LATE_NS)
        if i < len(at_ns) and at_ns[i] <= hit_ns + LANDING_EARLY_NS and piece in pieces:
            return True
        return self.is_own_only(piece, hit_ns)

    def may_bounce(self, performance: Performance) -> NDArray[np.bool_]:
        """Which hits (m,) may be bounces, wherever in the score they belong, or strokes of a fast double.

        On a piece that buzzes somewhere, close after another hit and no new, louder press.
        """
        hits, bounces = performance.hits, np.zeros(len(performance), np.bool_)
        for piece in self._buzzes:
            own = np.flatnonzero(hits["piece"] == piece)
            close = np.diff(hits["at_ns"][own]) < BOUNCE_NS
            louder = hits["velocity"][own][1:] > PRESS_LOUDER * hits["velocity"][own][:-1]
            bounces[own[1:]] = close & ~louder
        return bounces

    def _bounces(self, piece: NDArray[np.uint8], hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which hits fall where their piece buzzes, in company: a lone stroke beside the press is no bounce."""
        bounces = np.zeros(len(hit_ns), np.bool_)
        for own, (starts, ends) in self._buzzes.items():
            here = np.flatnonzero(piece == own)
            buzz = np.searchsorted(starts, hit_ns[here], side="right") - 1
            until_end = ends[np.maximum(buzz, 0)] - hit_ns[here]
            inside = (buzz >= 0) & (until_end >= 0)
            surely = inside & (until_end > 2 * BUZZ_REACH_NS)  # what is later may be the next written stroke
            many = np.bincount(buzz[surely], minlength=len(starts)) >= LEAST_COMPANY
            after_another = np.diff(hit_ns[here], prepend=-(2**62)) < BOUNCE_NS
            bounces[here] = inside & (many[np.maximum(buzz, 0)] | after_another)
        return bounces

    def _land(self, piece: NDArray[np.uint8], hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which hits are a landing on one."""
        landings, pieces = self._landings
        if not landings:
            return np.zeros(len(hit_ns), np.bool_)
        at_ns = np.array(landings)
        i = np.minimum(np.searchsorted(at_ns, hit_ns - LANDING_LATE_NS), len(at_ns) - 1)
        there = (at_ns[i] >= hit_ns - LANDING_LATE_NS) & (at_ns[i] <= hit_ns + LANDING_EARLY_NS)
        return np.asarray(there & np.isin(piece, list(pieces)))

    def _bars(self, hit_ns: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.maximum(np.searchsorted(self._bar_ns, hit_ns, side="right") - 1, 0)

    def _bars_with(self, which: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Which bars hold one of the notes marked in `which` (n,); shape (bars,)."""
        bars = len(self._bar_ns)
        return np.asarray(np.bincount(self._score.bar[which], minlength=bars)[:bars] > 0)

    def _after_open_hat(self, hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which hits come after a written open stroke of the hi-hat and before its next stroke."""
        hat_ns, opened = self._hats
        if not len(hat_ns):
            return np.zeros(len(hit_ns), np.bool_)
        before = np.searchsorted(hat_ns, hit_ns, side="right") - 1
        return np.asarray((before >= 0) & opened[np.maximum(before, 0)])

    def _on_beat(self, hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        right = np.minimum(np.searchsorted(self._beat_ns, hit_ns, side="right"), len(self._beat_ns) - 1)
        left = np.maximum(right - 1, 0)
        distance = np.minimum(np.abs(self._beat_ns[right] - hit_ns), np.abs(hit_ns - self._beat_ns[left]))
        return np.asarray(distance <= _BEAT_REACH_NS)


def _grid(score: Score, whole_bars: bool) -> NDArray[np.int64]:
    """Ticks of the bars' or beats' beginnings up to the score's end, that of the bar after it included."""
    meters = score.tempo_map.meters
    ends = [meter.tick for meter in meters[1:]] + [max(score.end_tick, meters[-1].tick) + 1]
    steps = [meter.bar_ticks if whole_bars else meter.beat_ticks for meter in meters]
    parts = [np.arange(m.tick, end, step) for m, end, step in zip(meters, ends, steps, strict=True)]
    return np.concatenate(parts).astype(np.int64)
