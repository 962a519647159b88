"""A player who leans from the click more and more, or less: how far beside it they are, and whether elsewhere.

Nobody keeps to a click as a clock does: who rushes is a little farther ahead with every beat, and one who notices comes
back. So a state is an offset of `beat_offsets`, and a lean besides it that moves by a part of a beat at a time and
costs `LEAN_MOVES` then. A tempo that is a percent or two off is thus cheaper than a jump that explains the strokes no
better, and a jump is one whatever the lean was. The way is the best of all (Viterbi 1967).
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.beat_offsets import Offsets, Pause, priced
from station.scoring.following.prices import LEAN_MOVES
from station.scoring.following.written import PARTS, Written

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

NEAR_BEATS = 1 / 4
"""So far a first stroke may be from where it is known to lean: farther on, half a beat away is nearer."""

_NEAR = round(NEAR_BEATS * PARTS)

LOOK_BEATS = 48.0
_FAR = 3 * _NEAR
"""So many beats are looked at together, in which a lean goes no farther: a tempo that is 1.5 % off all the time (our
choice); what goes on after that is followed from there."""


@dataclass(frozen=True, eq=False)
class SwayWay:
    """The best way over beats (b,): indices of `Sway.states` and of the offsets, and leans in parts of a beat."""

    states: Indices
    offsets: Indices
    leans: Indices


@dataclass(frozen=True, eq=False)
class Sway:
    """Every offset of `offsets` (s,) with every lean of `leans` (k,), in parts of a beat, rising, 0 in the middle."""

    offsets: Offsets
    leans: Indices

    @classmethod
    def of(cls, offsets: Offsets, known: Collection[int]) -> "Sway":
        """The leans beside `offsets` of a player who leans at first by about one of `known`, in parts of a beat."""
        far = max(map(abs, known)) + _FAR
        return cls(offsets, np.arange(-far, far + 1))

    @property
    def states(self) -> Offsets:
        """Offset and lean as one offset, (s · k,), for what hits and notes say there."""
        parts = (self.offsets.parts[:, None] + self.leans).ravel()
        return Offsets(parts, self.offsets.step, self.offsets.slips, np.repeat(self.offsets.price, len(self.leans)))

    def begin(self, first: Floats, known: Collection[int], is_sure: bool) -> Floats:
        """Totals (s, k) before the first hit, of those of the offsets (s,), for a player who leans by one of `known`.

        Or by about so much, unless it `is_sure`.
        """
        away = np.abs(self.leans[:, None] - np.array(list(known))).min(axis=1)
        cost = np.where(away > (0 if is_sure else _NEAR), np.inf, LEAN_MOVES * away)
        return np.asarray(first[:, None] - cost)

    def best_way(
        self, gains: Floats, first: Floats, written: Written, last: Floats | None, pauses: Mapping[int, Pause]
    ) -> SwayWay:
        """The best way over beats that gain `gains` (b, s · k), from totals `first` (s, k).

        `last` (s · k,) is added at the end; `pauses` are the silences before beats. A jump keeps the lean, and leaves
        from the likeliest state alone.
        """
        shape = first.shape
        total = first
        moved, jumped = np.zeros((len(gains), *shape), np.int8), np.zeros((len(gains), shape[0]), np.bool_)
        came_from: list[tuple[int, int]] = []
        for b in range(len(gains)):
            total, moved[b] = _leant(total)
            state, lean = divmod(int(total.argmax()), shape[1])
            total, price = priced(total, state, self.offsets, written, pauses.get(b))
            there = total[state, lean] - price
            jumped[b] = there > total[:, lean]
            came_from.append((state, lean))
            total[:, lean] = np.where(jumped[b], there, total[:, lean])
            total = total + gains[b].reshape(shape)
        if last is not None:
            total = total + last.reshape(shape)
        state, lean = divmod(int(total.argmax()), shape[1])
        own, leant = np.empty(len(gains), np.int64), np.empty(len(gains), np.int64)
        for b in range(len(gains) - 1, -1, -1):
            own[b], leant[b] = state, lean
            if lean == came_from[b][1] and jumped[b, state]:
                state = came_from[b][0]
            lean -= int(moved[b, state, lean])
        return SwayWay(own * shape[1] + leant, own, self.leans[leant])


def _leant(total: Floats) -> tuple[Floats, NDArray[np.int8]]:
    """The totals (s, k) after a lean may have moved by one, and by how much each did, −1, 0 or 1."""
    moved = np.zeros(total.shape, np.int8)
    result = total.copy()
    up = total[:, :-1] - LEAN_MOVES
    better = up > result[:, 1:]
    result[:, 1:][better], moved[:, 1:][better] = up[better], 1
    down = total[:, 1:] - LEAN_MOVES
    better = down > result[:, :-1]
    result[:, :-1][better], moved[:, :-1][better] = down[better], -1
    return result, moved


def first_far(leans: Indices) -> int:
    """The beat with which the clock must run anew, for a lean (b,) is far from where it began; `len(leans)` without."""
    far = np.flatnonzero(np.abs(leans - leans[0]) >= _NEAR)
    return int(far[0]) if len(far) else len(leans)
