"""A leg on its footboard: the sole follows the board, the ankle the sole, and the knee closes the chain to the hip.

The foot stands heel down, its sole on the board, or heel up, its ball on the board and the heel in the air (thesis
§ 3.3.2). The knee's plane contains the hip, the ankle and the direction in which the knee points.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from station.motion.figure import Figure
from station.motion.kit import Pedal
from station.motion.maths import Maths, Number, Point

ANKLE_ALONG = 0.25
"""The ankle's place along the sole, from the heel (our choice)."""
BALL_ALONG = 0.75
"""The ball's (our choice)."""

HEEL_RAD: Mapping[str, float] = MappingProxyType({"down": 0.0, "up": math.radians(24.0)})
"""How far the sole is tipped over the board, heel up (our choice)."""


class Leg(NamedTuple):
    """The solved leg: points, and hip flexion, knee flexion and ankle dorsiflexion in radians."""

    knee: Point
    ankle: Point
    toe: Point
    angles: tuple[Number, Number, Number]


@dataclass(frozen=True, slots=True)
class Footing:
    """A foot's place: its board's hinge, heading in plan (unit) and the sole's length beyond the ball and ankle."""

    heel: tuple[float, float, float]
    heading: tuple[float, float]
    foot_m: float
    ankle_m: float
    thigh_m: float
    shank_m: float
    knee_out: tuple[float, float, float]

    @classmethod
    def of(cls, pedal: Pedal, figure: Figure, right: bool) -> "Footing":
        """The footing of one foot on `pedal`."""
        along = np.array(pedal.toe_m[:2]) - np.array(pedal.heel_m[:2])
        along = along / np.linalg.norm(along)
        return cls(
            heel=pedal.heel_m,
            heading=(float(along[0]), float(along[1])),
            foot_m=figure.foot_m,
            ankle_m=figure.ankle_height_m,
            thigh_m=figure.thigh_m,
            shank_m=figure.shank_m,
            knee_out=(0.35 if right else -0.35, 0.6, 0.72),
        )


def leg(m: Maths, footing: Footing, hip: Point, board_rad: Number, heel_rad: Number) -> Leg:
    """The leg from `hip` with the board raised by `board_rad` and the sole tipped by `heel_rad` over it, heel up."""
    hx, hy = footing.heading
    x0, y0, z0 = footing.heel
    sin_b, cos_b = m.sin(board_rad), m.cos(board_rad)
    ball = BALL_ALONG * footing.foot_m
    bx, bz = ball * cos_b, z0 + ball * sin_b  # the ball, along the heading and up
    sole = board_rad - heel_rad
    sin_s, cos_s = m.sin(sole), m.cos(sole)
    back = (BALL_ALONG - ANKLE_ALONG) * footing.foot_m
    ahead = (1 - BALL_ALONG) * footing.foot_m
    along, up = bx - back * cos_s - footing.ankle_m * sin_s, bz - back * sin_s + footing.ankle_m * cos_s
    ankle = (x0 + along * hx, y0 + along * hy, up)
    reach = bx + ahead * cos_b
    toe = (x0 + reach * hx, y0 + reach * hy, bz + ahead * sin_b)
    knee, flexion, bend = _knee(m, footing, hip, ankle)
    shank_lean = m.atan2(knee[2] - ankle[2], (knee[0] - ankle[0]) * hx + (knee[1] - ankle[1]) * hy)
    return Leg(knee, ankle, toe, (flexion, bend, np.pi / 2 - shank_lean + sole))


def _knee(m: Maths, footing: Footing, hip: Point, ankle: Point) -> tuple[Point, Number, Number]:
    """The knee by the cosine law, the thigh's flexion from hanging and the knee's."""
    thigh, shank = footing.thigh_m, footing.shank_m
    dx, dy, dz = ankle[0] - hip[0], ankle[1] - hip[1], ankle[2] - hip[2]
    d = m.least(m.sqrt(dx * dx + dy * dy + dz * dz), 0.9999 * (thigh + shank))
    inside = (thigh * thigh + d * d - shank * shank) / (2 * thigh * d)
    bend = m.acos((thigh * thigh + shank * shank - d * d) / (2 * thigh * shank))
    kx, ky, kz = footing.knee_out
    along = (kx * dx + ky * dy + kz * dz) / (d * d)
    kx, ky, kz = kx - along * dx, ky - along * dy, kz - along * dz
    norm = m.sqrt(kx * kx + ky * ky + kz * kz)
    side = thigh * m.sqrt(1 - inside * inside) / norm
    on = thigh * inside / d
    knee = (hip[0] + on * dx + side * kx, hip[1] + on * dy + side * ky, hip[2] + on * dz + side * kz)
    flexion = m.acos(m.most(m.least((hip[2] - knee[2]) / thigh, 1.0), -1.0))
    return knee, flexion, np.pi - bend
