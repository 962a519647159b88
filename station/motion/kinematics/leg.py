"""A leg on its footboard: the sole follows the board, the ankle the sole, and the knee closes the chain to the hip.

The foot stands heel down, its sole on the board, or heel up, its ball on the board and the heel in the air (thesis
§ 3.3.2). The knee's plane contains the hip, the ankle and the direction in which the knee points. A foot with two
boards goes from one to the other through the air.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import Maths, Number, Point
from station.motion.kit.kit import Pedal

ANKLE_ALONG = 0.25
"""The ankle's place along the sole, from the heel (our choice)."""
BALL_ALONG = 0.75
"""The ball's (our choice)."""

HEEL_RAD: Mapping[str, float] = MappingProxyType({"down": 0.0, "up": math.radians(18.0)})
"""How far the sole is tipped over the board, heel up: the heel is 6 cm high (our choice; higher knees meet hands)."""
ROCK_RAD = math.radians(7.0)
"""How far a sole that keeps time is tipped between the beats at the natural setting: the heel is 2.5 cm up (our
choice)."""
LIFT_M = 0.04
"""How high the foot is over the boards on its way from one to the other (our choice: it clears both)."""


class Leg(NamedTuple):
    """The solved leg: points, and hip flexion, knee flexion and ankle dorsiflexion in radians."""

    knee: Point
    ankle: Point
    toe: Point
    angles: tuple[Number, Number, Number]


_STRAIGHT = 0.9999
"""A leg is never straighter than this share of its length (our choice)."""


class Place(NamedTuple):
    """Where a foot stands: x, y, z of its board's hinge, the board's heading in plan, and where the knee points."""

    x: Number
    y: Number
    z: Number
    hx: Number
    hy: Number
    out_x: Number
    out_y: Number
    out_z: Number

    @classmethod
    def on(cls, pedal: Pedal, knee_out: Point) -> "Place":
        """The place on `pedal`."""
        along = np.array(pedal.toe_m[:2]) - np.array(pedal.heel_m[:2])
        hx, hy = (along / np.linalg.norm(along)).tolist()
        return cls(*pedal.heel_m, hx, hy, *knee_out)


@dataclass(frozen=True, slots=True, eq=False)
class Footing:
    """One foot: its measures, its place at home, and the other board's if it has one."""

    foot_m: float
    ankle_m: float
    thigh_m: float
    shank_m: float
    home: Place
    away: Place | None = None

    @classmethod
    def of(cls, figure: Figure, home: Place, away: Place | None = None) -> "Footing":
        """The footing of a foot of `figure`."""
        return cls(figure.foot_m, figure.ankle_height_m, figure.thigh_m, figure.shank_m, home, away)

    def between(self, m: Maths, share: Number, lift: Number) -> Place:
        """The place `share` of the way from home to the other board, 0 … 1, lifted by that share of `LIFT_M`."""
        assert self.away is not None
        x, y, z, hx, hy, *out = (a + share * (b - a) for a, b in zip(self.home, self.away, strict=True))
        norm = m.sqrt(hx * hx + hy * hy)
        return Place(x, y, z + LIFT_M * lift, hx / norm, hy / norm, *out)


def leg(m: Maths, footing: Footing, hip: Point, board_rad: Number, heel_rad: Number) -> Leg:
    """The leg at home from `hip`, the board raised by `board_rad` and the sole tipped by `heel_rad` over it."""
    points, angles = chain(m, footing, footing.home, hip, board_rad, heel_rad)
    return Leg(points[:3], points[3:6], points[6:], angles)


LegChain = tuple[tuple[Number, ...], tuple[Number, Number, Number]]
"""`Leg` without names: x, y, z of knee, ankle and toe in one, and the angles."""


def chain(m: Maths, footing: Footing, place: Place, hip: Point, board_rad: Number, heel_rad: Number) -> LegChain:
    """`leg` at any place and in plain tuples, as a row takes it."""
    sin, cos, sqrt, acos, atan2 = m.sin, m.cos, m.sqrt, m.acos, m.atan2
    x0, y0, z0, hx, hy, ox, oy, oz = place
    sole = board_rad - heel_rad
    sin_b, cos_b, sin_s, cos_s = sin(board_rad), cos(board_rad), sin(sole), cos(sole)
    # along the heading and up: the ball on the board, behind it the ankle over the sole, before it the toe
    foot, height = footing.foot_m, footing.ankle_m
    ball, back = BALL_ALONG * foot, (BALL_ALONG - ANKLE_ALONG) * foot
    along, up = ball * cos_b - back * cos_s - height * sin_s, z0 + ball * sin_b - back * sin_s + height * cos_s
    ax, ay = x0 + along * hx, y0 + along * hy
    reach = foot * cos_b
    # the knee by the cosine law, in the plane of hip, ankle and the way that it points
    thigh, shank = footing.thigh_m, footing.shank_m
    whole = thigh + shank
    px, py, pz = hip
    dx, dy, dz = ax - px, ay - py, up - pz
    d = m.least(sqrt(dx * dx + dy * dy + dz * dz), _STRAIGHT * whole)
    dd, tt_ss = d * d, whole * (thigh - shank)
    inside, below = (dd + tt_ss) / (2 * thigh * d), (dd - tt_ss) / (2 * shank * d)
    share = (ox * dx + oy * dy + oz * dz) / dd
    ox, oy, oz = ox - share * dx, oy - share * dy, oz - share * dz
    side = thigh * sqrt((1 - inside * inside) / (ox * ox + oy * oy + oz * oz))
    on = thigh * inside / d
    tx, ty, tz = on * dx + side * ox, on * dy + side * oy, on * dz + side * oz
    kx, ky, kz = px + tx, py + ty, pz + tz
    shin = atan2(kz - up, (kx - ax) * hx + (ky - ay) * hy)
    return (
        (kx, ky, kz, ax, ay, up, x0 + reach * hx, y0 + reach * hy, z0 + foot * sin_b),
        (atan2(sqrt(tx * tx + ty * ty), -tz), acos(inside) + acos(below), 0.5 * math.pi - shin + sole),
    )
