"""Where the body is when nothing moves it: the pelvis on the throne, the shoulder as it naturally faces a target."""

import math

from station.core.pieces import Limb
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import ONE, Point
from station.motion.kinematics.trunk import TrunkAngles, trunk
from station.motion.kit.kit import Kit
from station.motion.kit.piece import Vector

HIP_ABOVE_SEAT = 0.05
"""Height of the hip joints over the seat, as a share of the stature (our choice)."""
POSTURE_RAD = math.radians(6.0)
"""How far the trunk leans forward at rest (our choice)."""
TWIST_SHARE = 0.45
"""How much of the way to the struck piece the torso turns; eyes and head do the rest (our choice)."""


def pelvis_of(kit: Kit, figure: Figure) -> Point:
    """The middle between the hip joints of a seated figure."""
    x, y, z = kit.seat_m
    return x, y, z + HIP_ABOVE_SEAT * figure.stature_m


def bearing_of(kit: Kit, point: Vector) -> float:
    """The direction from the seat to a point, to the left positive."""
    x, y, _ = kit.seat_m
    return math.atan2(x - float(point[0]), max(float(point[1]) - y, 0.05))


def natural_shoulder(kit: Kit, figure: Figure, limb: Limb, point: Vector, lean_rad: float = POSTURE_RAD) -> Point:
    """The shoulder of `limb` when the torso faces `point` as it naturally does."""
    twist = TWIST_SHARE * bearing_of(kit, point)
    angles = TrunkAngles(twist, lean_rad, 0.0, 0.0, 0.0, 0.0, 0.0)
    frame = trunk(ONE, figure, pelvis_of(kit, figure), angles)
    return frame.right_shoulder if limb == Limb.RIGHT_HAND else frame.left_shoulder
