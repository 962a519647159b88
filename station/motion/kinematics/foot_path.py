"""The way of the foot that has two boards, the hi-hat's and the double pedal's slave, and when it is on which.

The foot is at home on the hi-hat. It goes over to the slave before its first stroke there, stays while such strokes
follow one another, and comes back for a chick or a change of the hi-hat's opening, or when the passage is over. While
it is away the hi-hat's board is up on its spring and its clutch holds the cymbals as they were.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.kinematics.maths import Maths, Number
from station.motion.kinematics.splines import SplineChannels, cubics
from station.music.score import Score

Array = NDArray[np.float64]

MOVE_S = 0.42
"""A foot takes so long, if it has the time, to lift, to go a board's breadth aside and to land (our choice)."""
LEAST_MOVE_S = 0.18
"""Quicker it cannot: up and down once at the 5 Hz at which a foot taps, heel up (HUMANS)."""
READY_S = 0.18
"""It is there so long before its stroke, if it has the time: a kick's own upswing takes 0.16 s."""
STAYS_S = 2.0
"""It stays at the slave over rests of less than this (our choice: a bar at 120 a minute)."""
LINGERS_S = 0.5
"""After the last stroke of a passage it stays so long (our choice)."""
BACK_S = LINGERS_S + MOVE_S + READY_S


class FootNow(NamedTuple):
    """Where the foot is.

    `side` 0 over its home … 1 over the other board, `lift` 0 … 1 of its height in the air, `released` 0 … 1 how far it
    has let go of its home's board.
    """

    side: Number
    lift: Number
    released: Number


@dataclass(frozen=True, eq=False)
class Visits:
    """What the foot has to do: `row` (n,) of the score in order of `time_s`, and whether on the `slave` board."""

    row: NDArray[np.int64]
    time_s: Array
    slave: NDArray[np.bool_]

    @classmethod
    def of(cls, score: Score, limbs: NDArray[np.int8], foot: Limb) -> "Visits":
        """The hi-hat foot's visits: its kicks, its strokes on the hi-hat, and where the hi-hat opens or closes."""
        piece, onset = score.notes["piece"], score.onset_s
        opened = _changes(score)
        slave = (limbs == foot) & (piece == Piece.KICK)
        rows = np.flatnonzero(slave | opened | (piece == Piece.HIHAT_PEDAL))
        rows = rows[np.argsort(onset[rows], kind="stable")]
        return cls(rows, onset[rows], slave[rows])

    @cached_property
    def _journey(self) -> tuple[list[tuple[float, float, float]], list[int]]:
        """When the foot goes over and back, each start, end and side; and the visits that it cannot reach in time."""
        moves: list[tuple[float, float, float]] = []
        missed: list[int] = []
        on_slave, before = False, -np.inf  # where it was of use last, and when

        def go(latest: float) -> None:
            nonlocal on_slave
            end = latest - min(READY_S, 0.35 * (latest - before))
            on_slave = not on_slave
            moves.append((max(end - MOVE_S, before + min(0.05, 0.1 * (end - before))), end, float(on_slave)))

        for k, (at, slave) in enumerate(zip(self.time_s.tolist(), self.slave.tolist(), strict=True)):
            if on_slave and at - before > STAYS_S:
                go(before + BACK_S)
                before = moves[-1][1]
            if slave != on_slave:
                if at - before < LEAST_MOVE_S:
                    missed.append(k)
                    continue
                go(at)
            before = at
        if on_slave:
            go(before + BACK_S)
        return moves, missed

    @property
    def moves(self) -> Array:
        """When the foot goes over and back, (m, 3) of start, end and the side that it comes to."""
        return np.array(self._journey[0]).reshape(-1, 3)

    @property
    def too_soon(self) -> NDArray[np.int64]:
        """The visits to which no foot comes in time from the other board."""
        return np.array(self._journey[1], np.int64)


@dataclass(frozen=True, eq=False)
class FootPath:
    """`moves` (m, 3): when each move begins and ends, and the side on which it ends."""

    phase: SplineChannels
    moves: Array

    @classmethod
    def of(cls, visits: Visits) -> "FootPath | None":
        """The path to all `visits` that can be reached; None for a foot that never leaves its home."""
        moves = visits.moves
        if not len(moves):
            return None
        start, end, to = moves.T
        values = np.stack([1.0 - to, to], 1).reshape(-1)
        level = np.zeros(len(values))
        times = np.stack([start, end], 1).reshape(-1)
        return cls(SplineChannels(times, cubics(times, values, level, level)[:, None, :]), moves)

    @property
    def busy_s(self) -> Array:
        """Instants of the moves, near enough to each other that none lies between two beats unseen."""
        return np.sort(np.linspace(self.moves[:, 0], self.moves[:, 1], 5).reshape(-1))

    def at(self, m: Maths, phase: Number) -> FootNow:
        """The foot at a `phase` of the move, 0 at home … 1 on the other board: it lets go, lifts, goes over, lands."""
        released, up = _ramp(m, phase, 0.0, 0.3), _ramp(m, phase, 0.1, 0.4)
        return FootNow(_ramp(m, phase, 0.25, 0.8), up * (1.0 - _ramp(m, phase, 0.65, 1.0)), released)


def _ramp(m: Maths, x: Number, low: float, high: float) -> Number:
    """0 up to `low`, 1 from `high` on, smooth between."""
    u = m.least(m.most((x - low) / (high - low), 0.0), 1.0)
    return u * u * (3.0 - 2.0 * u)


def _changes(score: Score) -> NDArray[np.bool_]:
    """The strokes of hands on the hi-hat (n,) before which it opens or closes; it is closed at first."""
    notes = score.notes
    rows = np.flatnonzero(np.isin(notes["piece"], (Piece.HIHAT, Piece.HIHAT_PEDAL)))
    rows = rows[np.argsort(score.onset_s[rows], kind="stable")]
    by_hand = notes["piece"][rows] == Piece.HIHAT
    openness = np.where(by_hand, np.nan_to_num(notes["openness"][rows]), 0.0)
    changed = np.zeros(len(notes), np.bool_)
    changed[rows[(np.diff(openness, prepend=0.0) != 0.0) & by_hand]] = True
    return changed
