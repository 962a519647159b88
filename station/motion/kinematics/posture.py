"""Where the body is when nothing moves it: the pelvis on the throne, the shoulder as it naturally faces a target.

A kit's file says where the throne stands for a median figure; others set it to their knees, and so far from the snare
that their elbows hang beside the ribs.
"""

import math
from dataclasses import replace

from station.core.pieces import Limb
from station.motion.kinematics.figure import Figure, figure_of
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
THIGH_SLOPE_RAD = math.radians(10)
"""Teachers ask for hips a little over the knees: thighs that fall by 5–15° (the middle)."""
ARM_SHARE = 0.7
"""A longer arm moves the throne back by so much of its length more: the elbow stays bent as it was (our choice)."""


def seated(kit: Kit, figure: Figure) -> Kit:
    """The `kit` with its throne as `figure` sets it."""
    median = figure_of()
    x, y, z = kit.seat_m
    y -= ARM_SHARE * (_arm_m(figure) - _arm_m(median))
    return replace(kit, seat_m=(x, y, z + _seat_height_m(figure) - _seat_height_m(median)))


def _arm_m(figure: Figure) -> float:
    return figure.upper_arm_m + figure.forearm_m + figure.hand_m


def _seat_height_m(figure: Figure) -> float:
    """The seat's height from which the thighs fall as they should to soles flat on the floor."""
    knee = figure.ankle_height_m + figure.shank_m
    return knee + figure.thigh_m * math.sin(THIGH_SLOPE_RAD) - HIP_ABOVE_SEAT * figure.stature_m


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
