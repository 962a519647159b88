"""Beats by which a player is before or behind a clock that keeps their beat: skips, repeats, restarts, a late start.

Whoever leaves a bar out plays on in time, so that a clock, the click or one that follows the player's tempo, still
tells the beat, in the wrong bar. The states are offsets in beats against that clock; beat by beat each gains what hits
and notes say there, and the best way through them is found (Viterbi 1967) at the prices of `prices`. `forward` takes
one beat, so that live and final following take the same steps.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import gcd
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.prices import PRICES, UNHEARD_END, When, Where
from station.scoring.following.written import PARTS, Nats, Written, gained

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

_FINE = ((2, 8), (3, 2), (8, 2))
"""Halves, thirds and eighths of a beat are tried as far as so many beats, whole ones as far as `Written.far_beats`."""


@dataclass(frozen=True, eq=False)
class Offsets:
    """The offsets of one score: `parts` (s,) in parts of a beat, rising, 0 among them; whole beats are every `step`.

    `price` (s,) is that of a jump without a pause. A clock `slips` or not: who stays with the click may be off the
    beat, but not so that they would be elsewhere.
    """

    parts: Indices
    step: int
    slips: bool
    price: Floats

    @cached_property
    def here(self) -> int:
        """Index of 0."""
        return int(np.searchsorted(self.parts, 0))

    @cached_property
    def beats(self) -> Floats:
        """The offsets in beats (s,)."""
        return self.parts / PARTS

    @cached_property
    def only_whole(self) -> Floats:
        """0 for whole beats, −∞ for parts: for a clock whose beat was just found (s,)."""
        return np.where(self.parts % self.step == 0, 0.0, -np.inf)

    def prices_from(self, state: int, written: Written) -> Floats:
        """Nats against a jump from one offset to each (s,)."""
        if self.parts[state] == 0:
            return self.price
        return _prices(written, self.parts - self.parts[state], self.step, self.slips)


def _prices(written: Written, parts: Indices, step: int, slips: bool) -> Floats:
    price = written.prices.on(parts / PARTS)
    if slips:
        return price
    is_half = (2 * np.abs(parts) == step) & (step >= PARTS)
    beside = np.where(is_half, PRICES[When.ON, Where.BESIDE_CLICK], np.inf)
    return np.where(parts % step == 0, price, beside)


def offsets_of(written: Written, slips: bool) -> Offsets:
    """The offsets that are tried in `written`, for a clock that `slips` or for the click."""
    step = gcd(round(written.beat * PARTS), round(written.bar * PARTS))
    steps = written.far_beats * PARTS // step
    whole = np.arange(-steps, steps + 1) * step
    fine = [np.arange(-far * n, far * n + 1) * (PARTS // n) for n, far in _FINE]
    parts = np.unique(np.concatenate([whole, *fine]))
    return Offsets(parts, step, slips, _prices(written, parts, step, slips))


def block_gains(
    written: Written, beats: Floats, classes: Indices, starts: Indices, edges: Floats, offsets: Offsets
) -> tuple[Floats, Nats]:
    """What blocks of hits gain at each offset (b, s), and what each hit says there (m, s).

    Hits (m,) at `beats` of `classes`; each block begins with the hit `starts` (b,) and passes the notes between its
    two of `edges` (b + 1,), in beats; what was written in a longer silence says nothing of the place.
    """
    said = written.fits.said(beats, classes, offsets.parts)
    last = np.maximum.reduceat(beats, starts)
    ends = np.minimum(edges[1:], last + WAIT_BEATS)
    before = written.fits.unanswered(np.concatenate((edges[:-1], ends)), offsets.parts)
    passed = before[len(starts) :] - before[: len(starts)]
    count = np.diff(starts, append=len(beats))
    bouncing = written.fits.may_bounce(edges[:-1], edges[1:], count, offsets.parts)
    return gained(np.add.reduceat(said, starts, axis=0), passed, _SLACK, bouncing), said


WAIT_BEATS = 2.0
"""So long after its last hit a block still passes notes (our choice): who stops plays nothing, wherever they are."""

_SLACK = 1
"""Hits more than notes that a block may have: one that came early for the next."""

EDGE = 0.145
"""Beats by which a stroke may come before its beat: graces and early strokes belong to the block that they begin, the
last of six in a beat (0.167) does not."""


class Pause(NamedTuple):
    """A silence on the clock, in beats: the last hit before it and the first after."""

    last: float
    now: float

    def prices_from(self, state: int, offsets: Offsets, written: Written) -> Floats | None:
        """Nats (s,) against going on at each offset after it, from one; None where it is written so."""
        by = float(offsets.beats[state])
        notes = written.note_beats.searchsorted((self.last + by + _BESIDE, self.now + by - _BESIDE))
        if notes[1] - notes[0] < _STOP_NOTES:
            return None
        return written.prices.pause(self.now + offsets.beats, self.last + by, self.now + by)


_STOP_NOTES, _BESIDE = 3, 0.3
"""So many notes in a silence that are not left out by chance, and how far from its hits they count (our choice)."""


_NONE: Mapping[int, Pause] = MappingProxyType({})


def pauses_of(beats: Floats, starts: Indices) -> dict[int, Pause]:
    """The blocks that follow a silence; hits (m,) at `beats`, blocks from the hits `starts` (b,)."""
    last, now = np.maximum.accumulate(beats)[starts[1:] - 1], beats[starts[1:]]
    after = np.flatnonzero(now - last > WAIT_BEATS)
    return {int(b) + 1: Pause(float(last[b]), float(now[b])) for b in after}


def forward(
    total: Floats, gain: Floats, offsets: Offsets, written: Written, pause: Pause | None = None
) -> tuple[Floats, NDArray[np.bool_], int]:
    """One beat, after a `pause` or none: the totals (s,) after it, which were jumped into before it, and from where."""
    best = int(total.argmax())
    total, price = priced(total, best, offsets, written, pause)
    jumped = total[best] - price
    is_better = jumped > total
    return np.where(is_better, jumped, total) + gain, is_better, best


def priced(total: Floats, state: int, offsets: Offsets, written: Written, pause: Pause | None) -> tuple[Floats, Floats]:
    """The totals, any shape, of who goes on after a `pause` or none, and nats (s,) against a jump from `state`."""
    price = None if pause is None else pause.prices_from(state, offsets, written)
    if price is None:
        return total, offsets.prices_from(state, written)
    on_time = PRICES[When.PAUSE, Where.ON_TIME]
    return total - on_time, price - on_time


@dataclass(frozen=True, eq=False)
class BeatWay:
    """The best way over some beats: the state (b,) of each, and its worth in nats."""

    states: Indices
    worth: float


def best_way(
    gains: Floats,
    first: Floats,
    offsets: Offsets,
    written: Written,
    last: Floats | None = None,
    pauses: Mapping[int, Pause] = _NONE,
) -> BeatWay:
    """The best states over beats that gain `gains` (b, s), from totals `first` (s,); `last` (s,) is added at the end.

    `pauses` are the silences before beats.
    """
    end = np.zeros(len(first)) if last is None else last
    state = None if pauses else _never_left(gains, first, end, offsets)
    if state is not None:
        return BeatWay(np.full(len(gains), state), float(first[state] + gains[:, state].sum() + end[state]))
    total = first
    jumped = np.empty(gains.shape, np.bool_)
    came_from = np.empty(len(gains), np.int64)
    for b in range(len(gains)):
        total, jumped[b], came_from[b] = forward(total, gains[b], offsets, written, pauses.get(b))
    total = total + end
    state = int(total.argmax())
    worth, states = float(total[state]), np.empty(len(gains), np.int64)
    for b in range(len(gains) - 1, -1, -1):
        states[b] = state
        if jumped[b, state]:
            state = int(came_from[b])
    return BeatWay(states, worth)


def _never_left(gains: Floats, first: Floats, end: Floats, offsets: Offsets) -> int | None:
    """The state that the best way never leaves, if that is the likeliest at first; None where it may be left.

    An excursion to another offset that gains less than its jump costs is never worth it, nor is one that ends there.
    """
    here = int(first.argmax())
    lead = np.cumsum(gains - gains[:, here : here + 1], axis=0)
    lowest = np.minimum.accumulate(np.minimum(lead, 0.0), axis=0)
    away = (lead - lowest).max(axis=0, initial=0.0)
    ended = end - end[here]
    to_end = ended if not len(lead) else ended + lead[-1] - lowest[-1]
    begun = first - first[here] + lead.max(axis=0, initial=0.0) + np.maximum(ended, 0.0)
    begun[here] = -1.0
    return here if max(away.max(), to_end.max()) < _LEAST_PRICE and (begun < 0.0).all() else None


_LEAST_PRICE = PRICES[When.ON, Where.SLIPPED]


def end_cost(written: Written, last_beat: float, offsets: Offsets) -> Floats:
    """Nats for ending at `last_beat` moved by each offset (s,), never positive: most play to the end of the score."""
    fits = written.fits
    left = fits.unanswered(written.note_beats[-1:] + 1.0, np.zeros(1, np.int64))
    unheard = left - fits.unanswered(np.array([last_beat + _END_SLACK]), offsets.parts)
    return np.asarray(-np.minimum(unheard[0], UNHEARD_END), np.float64)


_END_SLACK = 0.25
"""Beats after the last hit whose notes may still have been its moment's."""
