"""The feet's places on a kit's pedals, and knees that point so far out that the legs clear the drums between them."""

import math

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.figure import MEDIAN_STATURE_M, Figure
from station.motion.kinematics.leg import HEEL_RAD, LIFT_M, ROCK_RAD, Footing, Place, leg
from station.motion.kinematics.maths import ONE, Point
from station.motion.kinematics.posture import pelvis_of
from station.motion.kit.kit import Kit, Pedal
from station.motion.kit.piece import KitPiece

Array = NDArray[np.float64]

THIGH_M, KNEE_M, SHIN_M = 0.091, 0.069, 0.054
"""Radii of a median leg in its trousers at the hip, the knee and the ankle (as it is drawn)."""
_SWIVELS_DEG = np.arange(0.0, 76.0, 1.0)
"""How far outward the knee may point, from straight ahead and up; HUMANS has knees outside ±.33 and .20 m."""
_USUAL_DEG = 20.0
"""Where nothing is in the way (our choice: the knee a little outside the foot)."""
_CLEAR_M = 0.004
"""A leg keeps so far from the drums (our choice)."""


def footings(kit: Kit, figure: Figure) -> tuple[Footing, Footing]:
    """Of the kick's foot and of the hi-hat's, which also has the slave board."""
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    kicks_right = not kit.left_handed
    first = Footing.of(figure, _place(kit, figure, kick, kicks_right))
    slave = None if kit.slave is None else _place(kit, figure, kit.slave, not kicks_right)
    return first, Footing.of(figure, _place(kit, figure, hat, not kicks_right), slave)


def _place(kit: Kit, figure: Figure, pedal: Pedal, right: bool) -> Place:
    """The place on `pedal` with the knee so near to its usual swivel as the drums allow, else clearest of them."""
    by_nearness = sorted(_SWIVELS_DEG.tolist(), key=lambda deg: abs(deg - _USUAL_DEG))
    depths = []
    for deg in by_nearness:
        place = Place.on(pedal, _knee_out(deg, right))
        depths.append(max(leg_depth(kit, figure, place, stance, right) for stance in _stances(pedal)))
        if depths[-1] <= -_CLEAR_M:
            return place
    return Place.on(pedal, _knee_out(by_nearness[int(np.argmin(depths))], right))


def _stances(pedal: Pedal) -> list[tuple[float, float, float]]:
    """How a foot may stand: the board raised, the sole tipped, and the foot lifted over the board."""
    high = HEEL_RAD["up"] + ROCK_RAD
    return [(0.0, 0.0, 0.0), (pedal.raised_rad, high, 0.0), (pedal.raised_rad, 0.0, LIFT_M)]


def _knee_out(swivel_deg: float, right: bool) -> Point:
    """Where a knee points that is turned so far outward."""
    out, ahead = math.sin(math.radians(swivel_deg)), math.cos(math.radians(swivel_deg))
    return (out if right else -out), 0.64 * ahead, 0.77 * ahead


def leg_depth(kit: Kit, figure: Figure, place: Place, stance: tuple[float, float, float], right: bool) -> float:
    """How deep the leg of a foot that stands on `place` so is in the deepest drum, negative where it is clear of all.

    `stance`: how far the board is raised and the sole tipped over it, radians, and the foot lifted off it, metres.
    """
    board_rad, heel_rad, lifted_m = stance
    place = place._replace(z=place.z + lifted_m)
    x, y, z = pelvis_of(kit, figure)
    hip = (x + (0.5 if right else -0.5) * figure.hip_breadth_m, y, z)
    found = leg(ONE, Footing.of(figure, place), hip, board_rad, heel_rad)
    points, radii = capsules(figure, np.array([hip]), np.array([found.knee]), np.array([found.ankle]))
    return float(depth_in_drums(kit, points, radii).max())


def capsules(figure: Figure, hip: Array, knee: Array, ankle: Array) -> tuple[Array, Array]:
    """Points along legs, (n, k, 3) from hips, knees and ankles (n, 3), and the leg's radius at each, (k,)."""
    share = np.linspace(0.0, 1.0, 25)[:, None]
    thigh = hip[:, None] + share * (knee - hip)[:, None]
    shank = knee[:, None] + share[1:] * (ankle - knee)[:, None]
    scale = figure.stature_m / MEDIAN_STATURE_M
    radii = np.concatenate((THIGH_M + share * (KNEE_M - THIGH_M), KNEE_M + share[1:] * (SHIN_M - KNEE_M)))
    return np.concatenate((thigh, shank), axis=1), scale * radii[:, 0]


def depth_in_drums(kit: Kit, points: Array, radii: Array) -> Array:
    """How deep balls of `radii` (k,) about `points` (n, k, 3) are in the deepest drum, (n,); negative outside."""
    drums = [piece for piece in kit.pieces.values() if piece.kind in ("drum", "kick")]
    return np.asarray(np.max([_depth(drum, points, radii) for drum in drums], axis=0))


def _depth(drum: KitPiece, points: Array, radii: Array) -> Array:
    """How deep they are in a cylinder: minus the distance from it, or how far from its nearest wall inside."""
    away = points - drum.centre
    height = away @ drum.normal
    radial = np.sqrt(np.maximum((away**2).sum(-1) - height**2, 0.0))
    side, end = radial - drum.radius_m, np.maximum(height, -height - drum.depth_m)
    outside = np.hypot(np.maximum(side, 0.0), np.maximum(end, 0.0))
    distance = np.where((side < 0) & (end < 0), np.maximum(side, end), outside)
    return np.asarray((radii - distance).max(-1))
