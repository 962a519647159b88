"""Keeping hands out of each other's way: how high a stroke may go under the other arm, how high a hand travels over it.

With the leading hand on the hi-hat over the other on the snare, drummers keep the backbeat's stick under the leading
forearm and stick. For every two kinds of contact the highest stroke is found whose stick, at its top, stays clear of
the other arm at rest on its own contact; each stroke is then held to the least over what the other hand does around it.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.arm import Arm, Contact, Offsets, solve
from station.motion.collisions import segments_apart
from station.motion.contacts import Lie
from station.motion.figure import Figure
from station.motion.hand import HandPart, parts
from station.motion.maths import MANY, ONE
from station.motion.stroke import amplitudes, top

Array = NDArray[np.float64]

STICKS_M, ARM_M = 0.045, 0.080
"""How far the stick's line stays from the other stick's and from the other forearm's: drummers' 8 cm (HUMANS says no
number; what a drummer's eye looks for)."""
_HEIGHTS_M = np.array([0.03, 0.05, 0.075, 0.10, 0.125, 0.15, 0.175, 0.20, 0.25, 0.30, 0.35, 0.40, 0.50, 0.60])
_WITHIN_S = 0.9
"""What the other hand does later than this does not matter yet (our choice)."""


def cleared(hands: tuple[HandPart, HandPart], figure: Figure) -> tuple[HandPart, HandPart]:
    """Both parts, each capped by the other."""
    right, left = hands
    return (
        right.cleared(_caps(right, left, figure), _lifts(right, left, figure)),
        left.cleared(_caps(left, right, figure), _lifts(left, right, figure)),
    )


OVER_M, UNDER_M, BESIDE_M = 0.05, 0.05, 0.07
"""A travelling stick that comes nearer to the other arm in plan goes so far over it, or so far under (our choice)."""
_MOMENTS = np.linspace(0.2, 0.8, 7)
_ALONG = np.linspace(0.0, 1.0, 9)


def _lifts(own: HandPart, other: HandPart, figure: Figure) -> Array:
    """How far each stretch of `own` must be lifted to travel over what the other arm does meanwhile, (n − 1,)."""
    n = len(own.which)
    if n < 2 or not len(other.events.row):
        return np.zeros(max(n - 1, 0))
    times, others = own.events.time_s, other.events.time_s
    during = np.clip(np.searchsorted(others, 0.5 * (times[1:] + times[:-1])) - 1, 0, len(others) - 1)
    stretches = np.stack([own.which[:-1], own.which[1:], other.which[during]], 1)
    kinds, which = np.unique(stretches, axis=0, return_inverse=True)
    table = np.array([_lift(own, a, b, other, c, figure) if a != b else 0.0 for a, b, c in kinds.tolist()])
    return np.asarray(table[which.reshape(-1)])


def _lift(own: HandPart, start: int, end: int, other: HandPart, others: int, figure: Figure) -> float:
    """The lift of one stretch: the stick's points over the sampled other arm, by the hump of the way there."""
    ends = [_stick(own, own.lies[k], figure) for k in (start, end)]
    s = _MOMENTS**3 * (10 + _MOMENTS * (6 * _MOMENTS - 15))
    way = ends[0] + s[:, None, None] * (ends[1] - ends[0])  # (moments, places, 3)
    still = _still(other, other.lies[others], figure)
    limbs = [(still.elbow, still.wrist), (still.wrist, still.hand), (still.butt, still.tip)]
    arm = np.concatenate([_line(np.array(a), np.array(b)) for a, b in limbs])
    apart = np.linalg.norm(way[:, :, None, :2] - arm[None, None, :, :2], axis=-1)
    over = way[:, :, None, 2] - arm[:, 2]
    lack = np.where((apart < BESIDE_M) & (over > -UNDER_M), OVER_M - over, 0.0).max(axis=(1, 2))
    hump = (4 * _MOMENTS * (1 - _MOMENTS)) ** 2
    return float(np.maximum(lack / hump, 0.0).max())


def _line(a: Array, b: Array) -> Array:
    return np.asarray(a + _ALONG[:, None] * (b - a))


def _stick(part: HandPart, lie: Lie, figure: Figure) -> Array:
    arm = _still(part, lie, figure)
    return _line(np.array(arm.hand), np.array(arm.tip))


def _still(part: HandPart, lie: Lie, figure: Figure) -> Arm:
    lengths = part.hold.lengths(figure, part.limb == Limb.RIGHT_HAND)
    return solve(ONE, lengths, lie.root, lie.contact, Offsets(0.0, 0.0, 0.0, 0.0))


def _caps(own: HandPart, other: HandPart, figure: Figure) -> Array:
    """The highest that each stroke of `own` may go, (n,)."""
    if not len(own.events.row) or not len(other.events.row):
        return np.full(len(own.which), np.inf)
    table = np.array([[_highest(own, a, other, b, figure) for b in other.lies] for a in own.lies])
    times, others = own.events.time_s, other.events.time_s
    after = np.searchsorted(others, times, side="right")
    before = np.maximum(after - 1, 0)
    after = np.minimum(after, len(others) - 1)
    caps = table[own.which, other.which[before]]
    soon = others[after] - times < _WITHIN_S
    return np.where(soon, np.minimum(caps, table[own.which, other.which[after]]), caps)


def _highest(own: HandPart, lie: Lie, other: HandPart, others: Lie, figure: Figure) -> float:
    """The highest stroke of `own` at `lie` that clears `other` at `others`; infinite where none touches."""
    lengths = own.hold.lengths(figure)
    n = len(_HEIGHTS_M)
    angles = np.repeat(np.array(lie.angles)[:, None], n, 1)
    raised = top(amplitudes(_HEIGHTS_M, angles, lengths, parts(own.hold)))
    arm = solve(MANY, lengths, lie.root, Contact(*(np.full(n, c) for c in lie.contact)), Offsets(*raised))
    clear = _clear(arm, _still(other, others, figure), n)
    return float(_HEIGHTS_M[max(int(np.argmin(clear)) - 1, 0)]) if not clear.all() else np.inf


def _clear(arm: Arm, still: Arm, n: int) -> NDArray[np.bool_]:
    butt, tip = np.stack(np.broadcast_arrays(*arm.butt), 1), np.stack(np.broadcast_arrays(*arm.tip), 1)
    b, t, e, w, h = (
        np.tile(np.array(p), (n, 1)) for p in (still.butt, still.tip, still.elbow, still.wrist, still.hand)
    )
    sticks = segments_apart(butt, tip, b, t) > STICKS_M
    return sticks & (segments_apart(butt, tip, e, w) > ARM_M) & (segments_apart(butt, tip, w, h) > STICKS_M)
