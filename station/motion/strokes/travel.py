"""The way of a hand between contacts: where its stick would touch, were there no stroke.

From one strike to the next the contact stays, travels and stays again. The travel is a minimum-jerk movement (Flash and
Hogan 1985), as hands travel (HUMANS), late in the gap, so that the preparation happens while travelling, and it is
lifted over what stands between. A crash is left at once: its stroke is never parked on the edge. A hand at rest may
give way: it moves off while the other passes, stays off and comes back.
"""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from struct import Struct

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import Contact
from station.motion.kit.kit import Kit

Array = NDArray[np.float64]

_LEAVE_SHARE, _LEAVE_S = 0.15, 0.05
_ARRIVE_SHARE, _ARRIVE_S = 0.28, 0.10
"""A hand stays at least this share of the gap, or these seconds, after a strike and before the next: rebound and whip
are played on the spot (our choice)."""
MINIMUM_JERK_PEAK, HAND_M_S = 1.875, 3.0
"""The peak of a minimum-jerk movement over its mean speed, and the hand's speed that it should not pass (HUMANS)."""
_LEAST_STAY = 0.4
"""Where the way is far for its time, the stays are shortened down to this share (our choice)."""
MOST_TRAVEL = 1.0 - _LEAST_STAY * (_LEAVE_SHARE + _ARRIVE_SHARE)
"""The greatest share of a gap that is travelled."""
_TRAVEL_S, _EASY_TRAVEL_S = 0.45, 0.7
"""Long gaps leave this long for the travel; HUMANS has 0.25 s for 40 cm at full speed. To the thigh and from it nobody
hurries (our choice)."""


FIELDS = len(Contact._fields)
DETOUR = 4
GIVES = 6
"""How a hand gives way: from when, until when, one over the time it takes to move off, right, forward, up."""
_HEAD = 2 + DETOUR + GIVES
_ROW = Struct(f"{_HEAD + 2 * FIELDS}d")


@dataclass(frozen=True, eq=False)
class HandPath:
    """Contacts of one hand: `strike_s` (n,), `rows` (n, 12 + 2 · FIELDS).

    A row: start and 1/duration of the travel, its detour, how the hand gives way, from where, step.
    """

    strike_s: Array
    rows: Array

    @classmethod
    def of(
        cls,
        strike_s: Array,
        contacts: Array,
        bump: Array,
        early: NDArray[np.bool_],
        easy: NDArray[np.bool_],
        gives: Array,
    ) -> "HandPath":
        """The way through `contacts` (n, FIELDS) at `strike_s` (n,).

        Each stretch goes round by `bump` (n − 1, 4) in its middle: right, forward and up in metres, and the hand turned
        to the left in radians. An `early` one (n − 1,) is travelled at once, the others late in their gap, an `easy`
        one slowly. After each
        strike, before the first one too, the hand `gives` (n, 6) way.
        """
        gaps = np.diff(strike_s)
        leave, arrive = np.minimum(_LEAVE_SHARE * gaps, _LEAVE_S), np.minimum(_ARRIVE_SHARE * gaps, _ARRIVE_S)
        way_m = np.linalg.norm(np.diff(contacts[:, :3], axis=0), axis=1)
        lacking = MINIMUM_JERK_PEAK * way_m / HAND_M_S - (gaps - leave - arrive)
        hurry = np.clip(1 - lacking / np.maximum(leave + arrive, 1e-9), _LEAST_STAY, 1.0)
        start, end = strike_s[:-1] + hurry * leave, strike_s[1:] - hurry * arrive
        longest = np.where(easy, _EASY_TRAVEL_S, _TRAVEL_S)
        start, end = (
            np.where(early, start, np.maximum(start, end - longest)),
            np.where(early, np.minimum(end, start + longest), end),
        )
        rows = np.zeros((len(strike_s), _HEAD + 2 * FIELDS))
        rows[:-1, 0], rows[:-1, 1], rows[:-1, 2 : 2 + DETOUR] = start, 1 / np.maximum(end - start, 1e-6), bump
        rows[:, 2 + DETOUR : _HEAD] = gives
        rows[:, _HEAD : _HEAD + FIELDS] = contacts
        rows[:-1, _HEAD + FIELDS :] = np.diff(contacts, axis=0)
        return cls(strike_s, rows)

    @cached_property
    def _fast(self) -> tuple[memoryview, memoryview]:
        """Strikes and rows as buffers: read one by one they beat arrays."""
        return self.strike_s.data, self.rows.data.cast("B")

    def at(self, time_s: float) -> tuple[float, ...]:
        """The contact at one instant, in `Contact`'s order."""
        strikes, rows = self._fast
        i = max(bisect_right(strikes, time_s) - 1, 0)
        row = _ROW.unpack_from(rows, i * _ROW.size)
        (
            t0,
            rate,
            bx,
            by,
            bz,
            turn,
            off,
            back,
            pace,
            gx,
            gy,
            gz,
            x,
            y,
            z,
            sr,
            hr,
            sy,
            hy,
            ahead,
            wing,
            turns,
            roll,
            *steps,
        ) = row
        if off < time_s < back:
            u = min((time_s - off) * pace, (back - time_s) * pace, 1.0)
            s = u * u * u * (10 + u * (6 * u - 15))
            x, y, z = x + s * gx, y + s * gy, z + s * gz
        u = (time_s - t0) * rate
        if u <= 0.0:
            return x, y, z, sr, hr, sy, hy, ahead, wing, turns, roll
        u = min(u, 1.0)
        s = u * u * u * (10 + u * (6 * u - 15))
        dx, dy, dz, dsr, dhr, dsy, dhy, d_ahead, d_wing, d_turns, d_roll = steps
        h = (4 * u * (1 - u)) ** 2
        x, y, z = x + s * dx + h * bx, y + s * dy + h * by, z + s * dz + h * bz
        sr, hr, sy, hy = sr + s * dsr, hr + s * dhr, sy + s * dsy, hy + s * dhy + h * turn
        return x, y, z, sr, hr, sy, hy, ahead + s * d_ahead, wing + s * d_wing, turns + s * d_turns, roll + s * d_roll

    def many(self, time_s: Array) -> Contact:
        """The contact at each time."""
        i = np.maximum(np.searchsorted(self.strike_s, time_s, side="right") - 1, 0)
        t0, rate, bx, by, bz, turn, off, back, pace, gx, gy, gz, *way = self.rows[i].T
        u = np.clip((time_s - t0) * rate, 0.0, 1.0)
        s = u * u * u * (10 + u * (6 * u - 15))
        x, y, z, sr, hr, sy, hy, *rest = (a + s * d for a, d in zip(way[:FIELDS], way[FIELDS:], strict=True))
        h, g = (4 * u * (1 - u)) ** 2, moved_off(time_s, off, back, pace)
        x, y, z = x + h * bx + g * gx, y + h * by + g * gy, z + h * bz + g * gz
        return Contact(x, y, z, sr, hr, sy, hy + h * turn, *rest)

    def nearest(self, time_s: Array) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """The contact that the hand is at, or nearer to on its way, at each time; and whether it stays there."""
        i = np.maximum(np.searchsorted(self.strike_s, time_s, side="right") - 1, 0)
        t0, rate, off, back = (self.rows[i, k] for k in (0, 1, 2 + DETOUR, 3 + DETOUR))
        u, gives = (time_s - t0) * rate, (off < time_s) & (time_s < back)
        return np.where(u > 0.5, np.minimum(i + 1, len(self.strike_s) - 1), i), ((u <= 0.0) | (u >= 1.0)) & ~gives

    def about(self, event: int, time_s: Array) -> tuple[NDArray[np.int64], Array]:
        """Which of the times (n,) the contact at `event` has a part in, and how much of it is made there, 0 … 1."""
        i = np.maximum(np.searchsorted(self.strike_s, time_s, side="right") - 1, 0)
        on = np.flatnonzero((i == event) | (i == event - 1))
        u = np.clip((time_s[on] - self.rows[i[on], 0]) * self.rows[i[on], 1], 0.0, 1.0)
        s = u * u * u * (10 + u * (6 * u - 15))
        share = np.where(i[on] == event, 1.0 - s, s)
        return on[share > 0], share[share > 0]

    def humps(self, time_s: Array) -> tuple[NDArray[np.int64], Array]:
        """The stretch that each time is on, by the strike before it, and how much of its detour is made there, 0 … 1.

        Where the hand comes back to where it was there is no way to go round on.
        """
        i = np.maximum(np.searchsorted(self.strike_s, time_s, side="right") - 1, 0)
        t0, rate = self.rows[i, 0], self.rows[i, 1]
        u = np.clip((time_s - t0) * rate, 0.0, 1.0)
        moves = np.asarray(self.rows[:, _HEAD + FIELDS : _HEAD + FIELDS + 3].any(1))
        return i, np.where(moves[i], (4 * u * (1 - u)) ** 2, 0.0)


def moved_off(time_s: Array, off_s: Array | float, back_s: Array | float, pace: Array | float) -> Array:
    """How far a hand that gives way from `off_s` until `back_s` has moved off at each time, 0 … 1."""
    u = np.clip(np.minimum((time_s - off_s) * pace, (back_s - time_s) * pace), 0.0, 1.0)
    return np.asarray(u * u * u * (10 + u * (6 * u - 15)))


CLEAR_M = 0.10
"""The tip passes at least 10 cm above rims while it travels (what drummers look for)."""
PREPARED_M = 0.05
"""Over the pieces that it leaves and comes to, rebound and preparation give this much of it (our choice)."""


def lifts(kit: Kit, contacts: Array, played: NDArray[np.int64]) -> Array:
    """How far each stretch between `contacts` (n, FIELDS) must be lifted in its middle to clear what stands between.

    `played` (n,) are the pieces there; a stretch on one piece needs no lift. Returns (n − 1,) metres.
    """
    start, end = contacts[:-1, :3], contacts[1:, :3]
    along = np.linspace(0.2, 0.8, 7)[:, None, None]
    share = along**3 * (10 + along * (6 * along - 15))
    way = start + share * (end - start)
    hump = (4 * along[..., 0] * (1 - along[..., 0])) ** 2
    need = np.zeros(len(start))
    for piece in kit.pieces.values():
        if piece.kind == "kick":
            continue
        flat = np.hypot(way[..., 0] - piece.centre[0], way[..., 1] - piece.centre[1])
        nx, ny, nz = piece.normal
        top = piece.centre[2] - (nx * (way[..., 0] - piece.centre[0]) + ny * (way[..., 1] - piece.centre[1])) / nz
        own = (played[:-1] == piece.piece) | (played[1:] == piece.piece)
        clear = np.where(own, CLEAR_M - PREPARED_M, CLEAR_M)
        short = np.where(flat < piece.radius_m + 0.03, (top + clear - way[..., 2]) / hump, 0.0)
        need = np.maximum(need, short.max(axis=0, initial=0.0))
    moved = played[1:] != played[:-1]
    lift: Array = np.where(moved, np.minimum(need, HIGHEST_M), 0.0)
    return lift


HIGHEST_M = 0.25
"""No hand goes higher than this over the straight way (our choice)."""
