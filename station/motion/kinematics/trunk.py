"""Pelvis to crown by forward kinematics, and the shoulders that hang on it (DESIGN § 5; thesis figures 4.12, 4.14).

The trunk turns by the twist λ (about z, to the left positive), leans forward by ω (lower and further forward) and to
the right by the side angle; its lower part takes half of each, so that the back bends. The shoulders stand half their
breadth to each side of the neck's base.
"""

from typing import NamedTuple

from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import Maths, Number, Point

LOWER_SHARE = 0.42
"""The lumbar part of the trunk (our choice)."""

LEAN_TO_HEAD = 0.35
"""How much of the trunk's lean the head shares: eyes stay on the drums (our choice)."""


class TrunkAngles(NamedTuple):
    """All angles of trunk and head, radians; head angles are against the trunk.

    `shrug_m` lifts both shoulders; `hunch` rounds the back, its upper part forward over the lower, under 0 it arches;
    `chin` pushes the neck forward under a level head.
    """

    twist: Number
    lean: Number
    side: Number
    nod: Number
    turn: Number
    tilt: Number
    shrug_m: Number
    hunch: Number = 0.0
    chin: Number = 0.0


class Trunk(NamedTuple):
    """The points of the trunk and head, and the head's directions."""

    spine: Point
    neck: Point
    head: Point
    crown: Point
    right_shoulder: Point
    left_shoulder: Point
    facing: Point
    head_up: Point


def trunk(m: Maths, figure: Figure, pelvis: Point, angles: TrunkAngles) -> Trunk:
    """Every point of trunk and head over `pelvis`."""
    points, right, left, ways = chain(m, figure, pelvis, angles)
    return Trunk(points[:3], points[3:6], points[6:9], points[9:], right, left, ways[:3], ways[3:])


TrunkChain = tuple[tuple[Number, ...], Point, Point, tuple[Number, ...]]
"""`Trunk` without names: x, y, z of spine, neck, head and crown in one, the shoulders, facing and head up in one."""


def chain(m: Maths, figure: Figure, pelvis: Point, angles: tuple[Number, ...]) -> TrunkChain:
    """`trunk` in plain tuples, as a row takes it; `angles` in the order of `TrunkAngles`."""
    sin, cos = m.sin, m.cos
    twist, lean, side, nod, turn, tilt, shrug, hunch, chin = angles
    sin_t, cos_t, sin_s, cos_s = sin(twist), cos(twist), sin(side), cos(side)
    length = figure.trunk_m
    lower, upper = LOWER_SHARE * length, (1 - LOWER_SHARE) * length
    px, py, pz = pelvis
    # the trunk in its own plane, which is turned by the twist: to the right and forward
    bend, round_ = 0.5 * (lean - hunch), lean + 0.5 * hunch
    right, forward = 0.5 * lower * sin_s, lower * sin(bend)
    ax, ay, az = px + right * cos_t - forward * sin_t, py + right * sin_t + forward * cos_t, pz + lower * cos(bend)
    right, forward, up = upper * sin_s, upper * sin(round_) * cos_s, upper * cos(round_) * cos_s
    nx, ny, nz = ax + right * cos_t - forward * sin_t, ay + right * sin_t + forward * cos_t, az + up
    half = 0.5 * figure.shoulder_breadth_m
    across = half * cos_s
    bx, by, bz, lift = across * cos_t, across * sin_t, half * sin_s, nz + shrug
    # the head keeps level against the lean but for its own nod
    heading, pitch, roll = twist + turn, LEAN_TO_HEAD * lean + nod, LEAN_TO_HEAD * side + tilt
    sin_h, cos_h, sin_p, cos_p, sin_r, cos_r = sin(heading), cos(heading), sin(pitch), cos(pitch), sin(roll), cos(roll)
    neck, skull, bend = figure.neck_m, figure.head_m, 0.5 * (round_ + pitch) + chin
    right, forward = neck * sin(0.5 * (side + roll)), neck * sin(bend)
    hx, hy, hz = nx + right * cos_h - forward * sin_h, ny + right * sin_h + forward * cos_h, nz + neck * cos(bend)
    forward = sin_p * cos_r
    ux, uy, uz = sin_r * cos_h - forward * sin_h, sin_r * sin_h + forward * cos_h, cos_p * cos_r
    return (
        (ax, ay, az, nx, ny, nz, hx, hy, hz, hx + skull * ux, hy + skull * uy, hz + skull * uz),
        (nx + bx, ny + by, lift - bz),
        (nx - bx, ny - by, lift + bz),
        (-sin_h * cos_p, cos_h * cos_p, -sin_p, ux, uy, uz),
    )
