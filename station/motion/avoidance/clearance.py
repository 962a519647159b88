"""Keeping hands out of each other's way: how high a stroke may go under the other arm, how high a hand travels over it.

With the leading hand on the hi-hat over the other on the snare, drummers keep the backbeat's stick under the leading
forearm and stick. For every two kinds of contact the highest stroke is found whose stick, at its top, stays clear of
the other arm at rest on its own contact; each stroke is then held to the least over what the other hand does around it.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.kinematics.arm import Arm, Contact, Offsets, solve
from station.motion.kinematics.body_solids import segments_apart
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, ONE
from station.motion.strokes.amplitudes import amplitudes, top
from station.motion.strokes.contact_pose import ContactPose
from station.motion.strokes.hand import HandPart, parts

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
    return right.held_under(_caps(right, left, figure)), left.held_under(_caps(left, right, figure))


def _caps(own: HandPart, other: HandPart, figure: Figure) -> Array:
    """The highest that each stroke of `own` may go, (n,)."""
    if not len(own.events.row) or not len(other.events.row):
        return np.full(len(own.which), np.inf)
    table = _highest(own, other, figure)
    times, others = own.events.time_s, other.events.time_s
    after = np.searchsorted(others, times, side="right")
    before = np.maximum(after - 1, 0)
    after = np.minimum(after, len(others) - 1)
    caps = table[own.which, other.which[before]]
    soon = others[after] - times < _WITHIN_S
    return np.where(soon, np.minimum(caps, table[own.which, other.which[after]]), caps)


def _highest(own: HandPart, other: HandPart, figure: Figure) -> Array:
    """The highest stroke of `own` at each of its lies that clears `other` at each of its; infinite where none touches.

    Each stroke's top and each arm at rest is solved once, whatever it is held against.
    """
    still = [_still(other, lie, figure) for lie in other.lies]
    n = len(_HEIGHTS_M)
    butt, tip, elbow, wrist, hand = (
        np.repeat(np.array([getattr(arm, end) for arm in still])[:, None], n, 1)
        for end in ("butt", "tip", "elbow", "wrist", "hand")
    )
    table = np.full((len(own.lies), len(still)), np.inf)
    for k, lie in enumerate(own.lies):
        near_end, far_end = (np.broadcast_to(end, butt.shape).copy() for end in _raised(own, lie, figure))
        clear = segments_apart(near_end, far_end, butt, tip) > STICKS_M
        clear &= segments_apart(near_end, far_end, elbow, wrist) > ARM_M
        clear &= segments_apart(near_end, far_end, wrist, hand) > STICKS_M
        touched = ~clear.all(1)
        table[k, touched] = _HEIGHTS_M[np.maximum(np.argmin(clear[touched], axis=1) - 1, 0)]
    return table


def _still(part: HandPart, lie: ContactPose, figure: Figure) -> Arm:
    lengths = part.hold.lengths(figure, part.limb == Limb.RIGHT_HAND)
    return solve(ONE, lengths, lie.root, lie.contact, Offsets(0.0, 0.0, 0.0, 0.0))


def _raised(own: HandPart, lie: ContactPose, figure: Figure) -> tuple[Array, Array]:
    """The stick's butt and tip at the tops of strokes of all heights, (heights, 3) each."""
    lengths = own.hold.lengths(figure)
    n = len(_HEIGHTS_M)
    angles = np.repeat(np.array(lie.angles)[:, None], n, 1)
    raised = top(amplitudes(_HEIGHTS_M, angles, lengths, parts(own.hold), np.array([lie.contact.turns])))
    arm = solve(MANY, lengths, lie.root, Contact(*(np.full(n, c) for c in lie.contact)), Offsets(*raised))
    butt, tip = (np.stack(np.broadcast_arrays(*end), 1) for end in (arm.butt, arm.tip))
    return butt, tip
