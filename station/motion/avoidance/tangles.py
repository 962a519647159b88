"""What undoes a tangle of a scene: ways round, and steeper sticks.

Every stretch of their ways on which the hands are too near is tried with detours, over, back towards the player, aside
and under, of either hand, if need be with lower strokes; the one that stays farthest clear for the least way is the
best. Where neither hand travels, the upper stick is held steeper. Metres, radians, seconds.
"""

from dataclasses import dataclass
from math import radians

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation
from station.motion.avoidance.both_hands import (
    LOW,
    SLOPES,
    SPARE_M,
    BothHands,
    Moments,
    distances,
    lack,
    limbs,
    too_near,
)
from station.motion.avoidance.clearance import ARM_M, STICKS_M
from station.motion.kinematics.arm import Arm, Contact, Offsets, solve
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.kinematics.maths import MANY
from station.motion.strokes.hand_events import WAIT

Array = NDArray[np.float64]

_LEAST_HUMP = 0.08
"""Moments at which less than this of a detour is left cannot be helped by it (our choice)."""
_RISES, _MOST_RISE = np.radians([4.0, 8.0, 12.0, 16.0, 20.0]), radians(20.5)
"""Where neither hand travels and the sticks cross, the upper one is so much steeper (our choice)."""
_FREE = (Articulation.NORMAL, Articulation.BUZZ, WAIT)
_SHARES, _LOW_COST_M = (1.0, 0.5, 0.2), 0.02
"""Where no way is enough, strokes are lowered to these shares besides, which weighs as so much way (our choice)."""

_WAYS = np.array(
    [
        (aside, -back, up)
        for aside in (0.0, -0.08, 0.08, 0.16)
        for back in (0.0, 0.08, 0.16, 0.24)
        for up in (-0.14, -0.07, 0.0, 0.06, 0.12, 0.18, 0.26)
    ]
)
"""The detours that are tried in the middle of a stretch: aside to the hand's own side, forward, up, (k, 3) metres."""
_MOST_M = 0.45
"""No detour is longer in all (our choice)."""
_WAY_COST = 0.08
"""A metre of detour is taken for this many metres of clearance (our choice)."""
_NEAR_COST = 5.0
"""A metre of what is too near costs so much more than one of what is nearer than drummers like (our choice)."""
_DEPTH_COST = 20.0
_CLEAR_COST, _WELL_OFF, _ELBOW_SPARE_RAD = 2.0, 0.3, radians(10)
_ANGLE_COST_M = 1.0
"""A metre deep in a drum or a radian beyond a joint's limit weighs as this many metres less clear; the elbow's limit is
left to styles by the spare; so does, where so much of a detour is made, what is short of the spare over the kit (our
choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Detour:
    """The hand (0 right, 1 left) that goes round by `way` (3,) more, its strokes about it lowered to a `share`.

    `price` in metres and how much too `near_m` it still is.
    """

    side: int
    way: Array
    share: float
    price: float
    near_m: float


@dataclass(frozen=True, slots=True, eq=False)
class Moves:
    """What one hand may do at the moments `on` (n,): any of `ways` (k, 3), metres, with a `share` of its strokes.

    `made` (n,) is how much of it is made at each moment, from where the hand touches in its way, or in `contact`.
    """

    side: int
    on: Moments
    made: Array
    ways: Array
    share: float = 1.0
    contact: Contact | None = None


def steeper(scene: BothHands, moments: Moments) -> tuple[int, float] | None:
    """The hand whose stick, over the other's, is to be steeper, and by how much; None if it is no use.

    Only a tip's blow leaves its slope free: a stick's shoulder and shaft lie as the piece does.
    """
    side = 1 - scene.lower(moments)
    hand, times = scene.hands[side], scene.stage.grid[moments]
    events = scene.at(side, moments)
    free = np.isin(hand.events.key[events, 2], _FREE) & ~np.isin(hand.which[events], hand.on_the_shoulder)
    lies = np.array([hand.lies[k].contact.stick_rise for k in hand.which[events].tolist()])
    left = _MOST_RISE - float((hand.contacts[events, SLOPES[0]] - lies).max())
    if not free.all():
        return None
    strokes, lengths, (x, y, z) = (
        scene.strokes[side].many(times),
        scene.lengths(side),
        scene.stage.roots[side][:, moments],
    )
    other, contact = limbs(scene.arms(1 - side, moments, (1.0,))[0]), hand.way.many(times)
    for rise in _RISES[left >= _RISES].tolist():
        steep = contact._replace(stick_rise=contact.stick_rise + rise, hand_rise=contact.hand_rise + rise)
        arms = [solve(MANY, lengths, (x, y, z), steep, Offsets(*(low * o for o in strokes))) for low in (1.0, LOW)]
        if all(_is_free(scene, side, arm, other) for arm in arms):
            return side, rise
    return None


def _is_free(scene: BothHands, side: int, arm: Arm, other: list[Array]) -> bool:
    """Whether `arm` of a hand is not too near to the other's limbs and within its joints' limits."""
    near = too_near(distances(limbs(arm), other))
    return float(near.max()) <= 0.0 and float(np.max(_beyond(scene, side, arm))) <= 0.0


def way_round(scene: BothHands, pair: list[int], moments: Moments) -> Detour | None:
    """The cheapest detour of a hand on its stretch of `pair`, with lower strokes where none is enough.

    None where nothing is better than the way as it is.
    """
    best: Detour | None = None
    for share in _SHARES:
        for side in (0, 1):
            if scene.hump[side][moments].max() < _LEAST_HUMP:
                continue
            found = _best(scene, side, pair[side], share)
            if (found.way.any() or share < 1.0) and (best is None or found.price < best.price):
                best = found
        if best is not None and best.near_m <= 0.0:
            break
    return best


def _best(scene: BothHands, side: int, stretch: int, share: float) -> Detour:
    """The cheapest detour of one hand on a stretch with `share` of its strokes."""
    on = np.flatnonzero((scene.stretch[side] == stretch) & (scene.hump[side] > 0.0))
    ways = _WAYS * (1.0 if side == 0 else -1.0, 1.0, 1.0)
    so_far = scene.hands[side].bump[stretch, :3]
    led = so_far - scene.stage.straight[side][stretch, :3]
    if led.any():  # the first detour was not enough: another instead of it may be
        ways = np.concatenate((ways, ways - led))
    ways = ways[(np.linalg.norm(so_far + ways, axis=1) <= _MOST_M) | ~ways.any(1)]
    found, price, near = cheapest(scene, Moves(side, on, scene.hump[side][on], ways, share))
    return Detour(side, ways[found], share, price, near)


def cheapest(scene: BothHands, moves: Moves) -> tuple[int, float, float]:
    """Which of some moves of one hand is the cheapest, its price, and how much too near it is."""
    side, times, ways, made = moves.side, scene.stage.grid[moves.on], moves.ways, moves.made
    contact = moves.contact or scene.hands[side].way.many(times)
    x, y, z = (c + made * w[:, None] for c, w in zip(contact[:3], ways.T, strict=True))
    every = Contact(x, y, z, *(np.broadcast_to(c, x.shape) for c in contact[3:]))
    strokes = moves.share * np.array(scene.strokes[side].many(times))
    lengths, (rx, ry, rz) = scene.lengths(side), scene.stage.roots[side][:, moves.on]
    arms = [solve(MANY, lengths, (rx, ry, rz), every, Offsets(*(low * strokes))) for low in (1.0, LOW)]
    own, flat = ([np.broadcast_to(p, (*x.shape, 3)) for p in limbs(arm)] for arm in arms)
    apart = [
        distances([p.reshape(-1, 3) for p in mine], [np.tile(p, (len(x), 1)) for p in limbs(other)])
        for mine, other in zip((own, flat), scene.arms(1 - side, moves.on), strict=True)
    ]
    short = np.maximum(lack(apart[0], STICKS_M, ARM_M).reshape(x.shape), 0.0)
    near = np.maximum(np.maximum(too_near(apart[0]), too_near(apart[1])).reshape(x.shape), 0.0)
    helped = made > _LEAST_HUMP
    prices = (
        np.where(helped, short, 0.0).max(1)
        + _NEAR_COST * (np.where(helped, near, 0.0).max(1) + np.where(helped, 0.0, near).max(1))
        + _WAY_COST * np.linalg.norm(ways, axis=1)
        + _LOW_COST_M * (1.0 - moves.share)
        + _ANGLE_COST_M * np.broadcast_to(_beyond(scene, side, arms[0]), x.shape).max(1)
        + np.broadcast_to(arms[0].missing_m, x.shape).max(1)
    )
    best, found = np.inf, 0
    for k in np.argsort(prices, kind="stable").tolist():
        if prices[k] >= best:
            break
        price = float(prices[k]) + max(_price_of_depth(scene, stick[0][k], stick[1][k], made) for stick in (own, flat))
        if price < best:
            best, found = price, k
    return found, best, float(near[found].max())


def _price_of_depth(scene: BothHands, butt: Array, tip: Array, made: Array) -> float:
    """What it costs that the stick is in the kit, and off on its way hardly clear, for styles lower it a little."""
    deep = depth_in_kit(scene.stage.kit, butt, tip).max()
    low = np.outer(made > _WELL_OFF, (0.0, 0.0, SPARE_M))
    return float(_DEPTH_COST * deep + _CLEAR_COST * depth_in_kit(scene.stage.kit, butt - low, tip - low).max())


def _beyond(scene: BothHands, side: int, arm: Arm) -> Array:
    """By how much elbow and wrist are beyond their limits, radians."""
    limits = scene.stage.figure.limits
    sideways = arm.deviation if side == 0 else -arm.deviation
    over = [
        arm.elbow_bend - limits.elbow_flexion + _ELBOW_SPARE_RAD,
        arm.extension - limits.wrist_extension,
        -arm.extension - limits.wrist_flexion,
        sideways - limits.wrist_radial,
        -sideways - limits.wrist_ulnar,
    ]
    return np.asarray(sum(np.maximum(o, 0.0) for o in over))
