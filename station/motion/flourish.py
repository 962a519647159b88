"""Stick spins and tosses in rests, by chance but alike in every run of one seed (users of SMED asked for them).

In a rest that is long enough a hand may lift the stick clear of the kit and spin it in the fingers, or in a longer one
toss it and catch it. `lift_m` raises the whole contact, `turn_rad` is the stick's extra turn (whole turns by the end),
`toss_m` how high the stick is over the hand that threw it.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPIN_REST_S, TOSS_REST_S = 1.8, 2.6
"""The shortest rests for a spin and a toss (our choice)."""
AWAY_S = 0.45
"""Both begin so long after the last stroke and end so long before the next (our choice)."""
SPIN_TURN_S = 0.30
"""A turn of a spun stick: skilled fingers make three a second."""
SPIN_LIFT_M, TOSS_LIFT_M = 0.30, 0.30
"""High enough for the whole stick to turn over the kit (our choice)."""
GRAVITY_M_S2 = 9.81
TOSS_S = 0.70
"""A toss flies so long, hence 60 cm high (½ g (t/2)²), and turns twice."""


class Now(NamedTuple):
    """What a flourish adds at an instant."""

    lift_m: float
    turn_rad: float
    toss_m: float


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
        for k in np.flatnonzero(np.diff(event_s) > SPIN_REST_S).tolist():
            if chances[k] >= chance[k]:
                continue
            start, room = float(event_s[k]) + AWAY_S, float(event_s[k + 1] - event_s[k]) - 2 * AWAY_S
            toss = room > TOSS_REST_S - 2 * AWAY_S and kinds[k] > 0.5
            turns = 2 if toss else max(1, min(4, int(room / SPIN_TURN_S)))
            found.append((start, start + (TOSS_S + AWAY_S if toss else room), turns, toss))
        return cls([f[0] for f in found], [f[1] for f in found], [f[2] for f in found], [f[3] for f in found])

    def at(self, time_s: float) -> Now:
        """What is added at one instant."""
        k = bisect_right(self.start_s, time_s) - 1
        if k < 0 or time_s >= self.end_s[k]:
            return NOTHING
        length = self.end_s[k] - self.start_s[k]
        u = (time_s - self.start_s[k]) / length
        bump = (4 * u * (1 - u)) ** 2
        turn = 2 * math.pi * self.turns[k] * u * u * u * (10 + u * (6 * u - 15))
        if not self.tossed[k]:
            return Now(SPIN_LIFT_M * min(1.0, 1.6 * bump), turn, 0.0)
        flight = 0.5 * TOSS_S - abs(time_s - self.start_s[k] - 0.5 * length)  # s from the nearer of throw and catch
        high = 0.5 * GRAVITY_M_S2 * flight * (TOSS_S - flight) if flight > 0 else 0.0
        return Now(TOSS_LIFT_M * min(1.0, 1.6 * bump), turn, high)

    def many(self, time_s: Array) -> tuple[Array, Array, Array]:
        """What is added at each time."""
        lift, turn, toss = np.array([self.at(t) for t in time_s.tolist()], np.float64).reshape(-1, 3).T
        return lift, turn, toss
