"""Giving way: a hand that rests in the way of the other's moves off, stays off while that passes, and comes back.

It leaves once its stroke has rebounded and is back before the next is raised. After its last stroke, and before its
first, nothing calls it back. Metres, seconds.
"""

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from station.motion.avoidance.both_hands import BothHands
from station.motion.avoidance.tangles import Moves, cheapest
from station.motion.kinematics.arm import Contact
from station.motion.strokes.travel import HAND_M_S, MINIMUM_JERK_PEAK, moved_off

Array = NDArray[np.float64]

_AFTER_S, _BEFORE_S = 0.05, 0.10
"""The hand stays so long after its strike and is back so long before the next, as on its ways (`travel`)."""
_MOVES_S, _QUICKEST_S, _SPARE_S = 0.25, 0.10, 0.03
"""So long it takes to move off, at least if there is no more time, and so much sooner it is off (our choice)."""
_WAYS = np.array(
    [
        (aside, -back, up)
        for aside in (0.0, 0.1, 0.2, 0.3)
        for back in (0.0, 0.1, 0.2)
        for up in (0.0, 0.08, 0.16, 0.24, 0.32)
    ]
)
"""Where it may move off: aside to its own side, forward, up, (k, 3) metres."""
_MOST_M = 0.40
"""No hand moves off farther (our choice)."""
_LOOKS = 240
"""So many moments of a long rest are looked at beside those in question (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Giving:
    """The hand (0 right, 1 left) that moves off from `off_s` until `back_s`, seconds after its event, by `way` (3,).

    `pace` is one over the time that this takes, and `near_m` how much too near it still is.
    """

    side: int
    off_s: float
    back_s: float
    pace: float
    way: Array
    price: float
    near_m: float

    def row(self, event_s: float) -> Array:
        """The same as a row of `HandPart.gives` after the event at `event_s`."""
        return np.array([event_s + self.off_s, event_s + self.back_s, self.pace, *self.way])


def giving_way(scene: BothHands, pair: list[int], which: NDArray[np.int64], k: int) -> Giving | None:
    """The cheapest way for one of the hands to be elsewhere at tangle `k` of `which`; None where neither has the time.

    `which` (n,) is the tangle of each moment, −1 none: tangles of one rest between which the hand has no time to come
    back are one.
    """
    found = []
    for side, stretch in enumerate(pair):
        all_near = np.flatnonzero((which >= 0) & (scene.stretch[side] == stretch))
        part = np.cumsum(np.diff(scene.stage.grid[all_near], prepend=-inf) > 2 * _MOVES_S)
        here = np.unique(part[which[all_near] == k])
        found.append(_given(scene, side, stretch, all_near[(part >= here[0]) & (part <= here[-1])]))
    return min((g for g in found if g is not None), key=lambda g: g.price, default=None)


def _given(scene: BothHands, side: int, stretch: int, moments: NDArray[np.int64]) -> Giving | None:
    hand, grid = scene.hands[side], scene.stage.grid
    event_s, already = float(hand.events.time_s[stretch]), hand.gives[stretch]
    off, back = float(grid[moments[0]]), float(grid[moments[-1]])
    if already.any():  # once in a rest: what it had moved off for counts too
        off, back = min(off, already[0] + 1 / already[2]), max(back, already[1] - 1 / already[2])
    leaves, returns = _rest(hand.events.time_s, stretch)
    if returns - leaves < 2 * _QUICKEST_S:
        return None
    time_s = max(
        min(_MOVES_S, off - _SPARE_S - max(leaves, off - 1), min(returns, back + 1) - back - _SPARE_S), _QUICKEST_S
    )
    off, back = max(off - _SPARE_S - time_s, leaves), min(back + _SPARE_S + time_s, returns)
    on = np.flatnonzero((grid > off) & (grid < back))
    on = np.union1d(on[:: max(len(on) // _LOOKS, 1)], moments)
    share, contact = moved_off(grid[on], off, back, 1 / time_s), hand.way.many(grid[on])
    was = moved_off(grid[on], already[0], already[1], already[2])
    x, y, z = (c - was * g for c, g in zip(contact[:3], already[3:], strict=True))
    ways = _WAYS * (1.0 if side == 0 else -1.0, 1.0, 1.0)
    length = np.linalg.norm(ways, axis=1)
    ways = ways[(length <= _MOST_M) & (MINIMUM_JERK_PEAK * length <= HAND_M_S * time_s)]
    k, price, near = cheapest(scene, Moves(side, on, share, ways, contact=Contact(x, y, z, *contact[3:])))
    if not ways[k].any():
        return None
    return Giving(side, off - event_s, back - event_s, 1 / time_s, ways[k], price, near)


def _rest(event_s: Array, stretch: int) -> tuple[float, float]:
    """From when until when a hand may be away after the event at `stretch`."""
    if len(event_s) == 1:
        return -inf, inf
    after = float(event_s[stretch + 1]) - _BEFORE_S if stretch + 1 < len(event_s) else inf
    return float(event_s[stretch]) + _AFTER_S, after
