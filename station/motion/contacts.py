"""How a hand lies when its stick touches: from the kit's targets to the numbers that the arm is solved from.

The kit's wrist radius and height give the slope of the line from the struck point up to the wrist. What they leave
open, the elbow's wing and the way the hand points, is chosen once for each target so that the wrist is bent least, at
the natural posture of the body for that target: drummers lift the elbow for a high hi-hat and keep the wrist straight.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.motion.arm import ArmLengths, Contact, Offsets, solve
from station.motion.figure import Figure
from station.motion.grip import Hold
from station.motion.kit import Kit
from station.motion.maths import MANY, Point
from station.motion.piece import RIM_ABOVE_HEAD_M, Target
from station.motion.posture import natural_shoulder

Array = NDArray[np.float64]

_WINGS = np.radians(np.arange(0.0, 81.0, 8.0))
_HAND_YAWS = np.radians(np.arange(-60.0, 61.0, 6.0))
_EXTENSION_EASE, _DEVIATION_EASE = np.radians(25.0), np.radians(12.0)
_NATURAL_WING, _WING_EASE = np.radians(12.0), np.radians(40.0)
_CROSSING_EASE = np.radians(35.0)
"""What is called comfortable: how far the wrist bends, the elbow leaves its place and the stick crosses the palm
before each costs as much as the others (our choice, within the limits of HUMANS)."""

SHOULDER_OF_STICK = 0.25
"""From the tip back to the part that meets a cymbal's edge or a rim, as a share of the stick (our choice)."""
_LAID_RISE = math.radians(-4.0)
_LAID_AZIMUTH = {Limb.LEFT_HAND: math.radians(-62.0), Limb.RIGHT_HAND: math.radians(62.0)}
"""A cross-stick lies across the head under the hand, its far end over the opposite rim (our choice)."""


@dataclass(frozen=True, slots=True)
class Strike:
    """One way of striking: what, where, how and with which hand."""

    piece: Piece
    zone: Zone
    articulation: Articulation
    limb: Limb


LEANS_RAD = np.radians([6.0, 12.0, 18.0, 24.0, 30.0])
"""How far the trunk may lean for a distant target, the least that serves (our choice)."""
PROTRACTION_M = 0.08
"""A shoulder comes forward by so much for what is still out of reach; the rest is missing (our choice)."""


def contact(kit: Kit, figure: Figure, strike: Strike, hold: Hold) -> tuple[Contact, float, Point]:
    """The most comfortable contact for `strike` with `hold`, how many metres are missing to reach it, and from where.

    The shoulder is where it is with the torso facing the target and leaning to it as little as is needed.
    """
    target = kit.target(strike.piece, strike.zone, strike.limb)
    lengths = hold.lengths(figure)
    side = 1.0 if strike.limb == Limb.RIGHT_HAND else -1.0
    lie = _lie(lengths, target, hold, strike, hold.length_m(figure))
    for lean in LEANS_RAD.tolist():
        shoulder = natural_shoulder(kit, figure, strike.limb, target.point_m, lean)
        found, missing = _easiest(lengths, shoulder, target, lie, hold, side)
        if missing <= 0:
            break
    return found, missing, shoulder


def _easiest(
    lengths: ArmLengths, shoulder: Point, target: Target, lie: "_Lie", hold: Hold, side: float
) -> tuple[Contact, float]:
    """Among all wings and ways to point the hand the easiest one."""
    wing, yaw = (g.ravel() for g in np.meshgrid(side * _WINGS, _HAND_YAWS, indexing="ij"))
    x, y, z = target.point_m.tolist()
    stick_yaw = side * hold.grip.yaw if lie.azimuth is None else _turn(shoulder, target, lie.azimuth)
    trial = Contact(x, y, z, lie.stick_rise, lie.hand_rise, stick_yaw, stick_yaw + yaw, lie.ahead_m, wing)
    arm = solve(MANY, lengths, shoulder, trial, Offsets(0.0, 0.0, 0.0, 0.0))
    price = (
        (arm.extension / _EXTENSION_EASE) ** 2
        + (arm.deviation / _DEVIATION_EASE) ** 2
        + ((side * wing - _NATURAL_WING) / _WING_EASE) ** 2
        + ((yaw + side * hold.grip.crossing) / _CROSSING_EASE) ** 2
        + 100.0 * arm.missing_m
    )
    best = int(np.argmin(price))
    missing = np.broadcast_to(arm.missing_m, price.shape)
    return trial._replace(hand_yaw=stick_yaw + float(yaw[best]), wing=float(wing[best])), float(missing[best])


@dataclass(frozen=True, slots=True)
class _Lie:
    """How the stick lies: what touches, the slopes of stick and hand, and the stick's way in plan where it is fixed."""

    ahead_m: float
    stick_rise: float
    hand_rise: float
    azimuth: float | None = None


def _lie(lengths: ArmLengths, target: Target, hold: Hold, strike: Strike, length_m: float) -> _Lie:
    h, palm = lengths.hand, hold.grip.palm
    ahead = lengths.ahead
    if target.shoulder:
        ahead -= SHOULDER_OF_STICK * length_m
    if strike.articulation == Articulation.CROSS_STICK:
        return _Lie(0.55 * length_m, _LAID_RISE, _LAID_RISE, _LAID_AZIMUTH[strike.limb])
    lean = float(np.arctan2(h * np.sin(palm), ahead + h * np.cos(palm)))  # between the stick and the line to the wrist
    rise = target.rise_rad - lean
    if strike.articulation == Articulation.RIM_SHOT:
        rise = float(np.arctan2(RIM_ABOVE_HEAD_M, 0.9 * target.radius_m))
    return _Lie(ahead, rise, rise + palm)


def _turn(shoulder: Point, target: Target, azimuth: float) -> float:
    """The yaw that makes the stick point to `azimuth` (from straight ahead, to the left positive)."""
    towards = math.atan2(float(target.point_m[0]) - shoulder[0], shoulder[1] - float(target.point_m[1]))
    return math.remainder(azimuth - (towards + math.pi), 2 * math.pi)
