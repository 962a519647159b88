"""Stick spins and tosses in rests, by chance but alike in every run of one seed (users of SMED asked for them).

In a rest that is long enough a hand may go up, clear of the kit, and spin its stick in the fingers, or in a longer one
toss it and catch it. `raised` is how far the hand is on its way to where it shows this (`HandPart.show`), 0 … 1; only
there does the stick turn, by `turn_rad`, in whole turns by the end: about the fulcrum in the fingers, about its middle
while it flies `toss_m` over the hand. The turns are the stick's own: no joint turns with them.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.maths import Maths, Number

Array = NDArray[np.float64]

AWAY_S = 0.40
"""Both begin so long after the last stroke and end so long before the next (our choice)."""
RAISE_S = 0.35
"""So long a hand takes to be up, and down again: for 35 cm a minimum-jerk movement's peak is 1.9 m/s."""
SPIN_TURN_S = 0.30
"""A turn of a spun stick: skilled fingers make three a second."""
GRAVITY_M_S2 = 9.81
TOSS_S, TOSS_TURNS = 0.70, 2
"""A toss flies so long, hence 60 cm high (½ g (t/2)²), and turns twice."""
SPIN_REST_S = 2 * (AWAY_S + RAISE_S) + SPIN_TURN_S
TOSS_REST_S = 2 * (AWAY_S + RAISE_S) + TOSS_S
"""The shortest rests for a spin and a toss."""
MOST_TURNS = 4


class Now(NamedTuple):
    """What a flourish adds at an instant."""

    raised: Number
    turn_rad: Number
    toss_m: Number


NOTHING = Now(0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Flourishes:
    """The flourishes of one hand: start, end and turns of each, and whether it is tossed; in order."""

    start_s: list[float]
    end_s: list[float]
    turns: list[int]
    tossed: list[bool]

    @classmethod
    def of(cls, event_s: Array, likely: Array, seed: int) -> "Flourishes":
        """Flourishes in the rests between events (n,) in order; `likely` (n,) or (1,), 0 … 1, is each rest's chance."""
        random = np.random.default_rng([seed, 2])
        chances, kinds = random.random(len(event_s)), random.random(len(event_s))
        chance = np.broadcast_to(likely, event_s.shape)
        found: list[tuple[float, float, int, bool]] = []
        for k in np.flatnonzero(np.diff(event_s) >= SPIN_REST_S).tolist():
            if chances[k] >= chance[k]:
                continue
            start, rest = float(event_s[k]) + AWAY_S, float(event_s[k + 1] - event_s[k])
            toss = rest >= TOSS_REST_S and kinds[k] > 0.5
            whole = 1 + int((rest - SPIN_REST_S) / SPIN_TURN_S + 1e-9)
            turns = TOSS_TURNS if toss else min(MOST_TURNS, whole)
            turning = TOSS_S if toss else turns * SPIN_TURN_S
            found.append((start, start + 2 * RAISE_S + turning, turns, toss))
        return cls([f[0] for f in found], [f[1] for f in found], [f[2] for f in found], [f[3] for f in found])

    def at(self, time_s: float) -> Now:
        """What is added at one instant."""
        k = bisect_right(self.start_s, time_s) - 1
        if k < 0 or time_s >= self.end_s[k]:
            return NOTHING
        since, left = time_s - self.start_s[k], self.end_s[k] - time_s
        raised = _smooth(min(since, left) / RAISE_S)
        turning, angle = self.end_s[k] - self.start_s[k] - 2 * RAISE_S, 2 * math.pi * self.turns[k]
        u = min(max((since - RAISE_S) / turning, 0.0), 1.0)
        if not self.tossed[k]:
            return Now(raised, angle * _smooth(u), 0.0)
        flown = u * TOSS_S
        return Now(raised, angle * u, 0.5 * GRAVITY_M_S2 * flown * (TOSS_S - flown))

    def many(self, time_s: Array) -> Now:
        """What is added at each time."""
        return Now(*np.array([self.at(t) for t in time_s.tolist()], np.float64).reshape(-1, 3).T)


def _smooth(u: float) -> float:
    """Minimum jerk from 0 at 0 to 1 at 1 and beyond."""
    u = min(u, 1.0)
    return u * u * u * (10 + u * (6 * u - 15))


_HANDS = (3 * Joint.RIGHT_HAND, 3 * Joint.LEFT_HAND)


def flourished(m: Maths, row: list[Number], *flourish: Now | None) -> list[Number]:
    """`row` of `frame` with the right and the left stick turned and tossed; None where nothing is."""
    for side, now in enumerate(flourish):
        if now is None or now is NOTHING:
            continue
        butt, tip = frame.BUTT.start + 3 * side, frame.TIP.start + 3 * side
        ends = [row[butt + k] for k in range(3)], [row[tip + k] for k in range(3)]
        flies = m.least(1e6 * now.toss_m, 1.0)  # 0 in the hand, 1 in the air
        hand = [row[_HANDS[side] + k] for k in range(3)]
        pivot = [h + flies * (0.5 * (a + b) - h) for h, a, b in zip(hand, *ends, strict=True)]
        ax, ay = (ends[1][k] - ends[0][k] for k in (0, 1))
        flat = m.sqrt(ax * ax + ay * ay)
        ux, uy = ax / flat, ay / flat
        c, s = m.cos(now.turn_rad), m.sin(now.turn_rad)
        for at, end in ((butt, ends[0]), (tip, ends[1])):
            dx, dy, dz = (e - p for e, p in zip(end, pivot, strict=True))
            along = dx * ux + dy * uy
            turned = c * along - s * dz
            row[at] = pivot[0] + dx + (turned - along) * ux
            row[at + 1] = pivot[1] + dy + (turned - along) * uy
            row[at + 2] = pivot[2] + s * along + c * dz + now.toss_m
    return row
