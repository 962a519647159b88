"""Pelvis to crown by forward kinematics, and the shoulders that hang on it (DESIGN § 5; thesis figures 4.12, 4.14).

The trunk turns by the twist λ (about z, to the left positive), leans forward by ω (lower and further forward) and to
the right by the side angle; its lower part takes half of each, so that the back bends. The shoulders stand half their
breadth to each side of the neck's base.
"""

from typing import NamedTuple

from station.motion.figure import Figure
from station.motion.maths import Maths, Number, Point

LOWER_SHARE = 0.42
"""The lumbar part of the trunk (our choice)."""


class TrunkAngles(NamedTuple):
    """All angles of trunk and head, radians; `shrug_m` lifts both shoulders; head angles are against the trunk."""

    twist: Number
    lean: Number
    side: Number
    nod: Number
    turn: Number
    tilt: Number
    shrug_m: Number


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
    px, py, pz = pelvis
    sin_t, cos_t = m.sin(angles.twist), m.cos(angles.twist)
    lower, upper = LOWER_SHARE * figure.trunk_m, (1 - LOWER_SHARE) * figure.trunk_m
    spine = _above((px, py, pz), lower, _tip(m, angles.lean / 2, angles.side / 2), (sin_t, cos_t))
    neck = _above(spine, upper, _tip(m, angles.lean, angles.side), (sin_t, cos_t))
    half = figure.shoulder_breadth_m / 2
    cos_r, sin_r = half * m.cos(angles.side), half * m.sin(angles.side)
    nx, ny, nz = neck
    across = (cos_r * cos_t, cos_r * sin_t)
    lift = angles.shrug_m
    # the head keeps level against the lean but for its own nod
    turned = (m.sin(angles.twist + angles.turn), m.cos(angles.twist + angles.turn))
    pitch = LEAN_TO_HEAD * angles.lean + angles.nod
    roll = LEAN_TO_HEAD * angles.side + angles.tilt
    head = _above(neck, figure.neck_m, _tip(m, 0.5 * (angles.lean + pitch), 0.5 * (angles.side + roll)), turned)
    top = _tip(m, pitch, roll)
    crown = _above(head, figure.head_m, top, turned)
    cos_p, sin_p = m.cos(pitch), m.sin(pitch)
    up = (
        (crown[0] - head[0]) / figure.head_m,
        (crown[1] - head[1]) / figure.head_m,
        (crown[2] - head[2]) / figure.head_m,
    )
    return Trunk(
        spine=spine,
        neck=neck,
        head=head,
        crown=crown,
        right_shoulder=(nx + across[0], ny + across[1], nz - sin_r + lift),
        left_shoulder=(nx - across[0], ny - across[1], nz + sin_r + lift),
        facing=(-turned[0] * cos_p, turned[1] * cos_p, -sin_p),
        head_up=up,
    )


LEAN_TO_HEAD = 0.35
"""How much of the trunk's lean the head shares: eyes stay on the drums (our choice)."""


def _tip(m: Maths, forward: Number, right: Number) -> Point:
    """A unit vector tipped from upright, as (forward, right, up)."""
    cos_r = m.cos(right)
    return m.sin(forward) * cos_r, m.sin(right), m.cos(forward) * cos_r


def _above(base: Point, length: float, tip: Point, turned: tuple[Number, Number]) -> Point:
    forward, right, up = tip
    sin_t, cos_t = turned
    return (
        base[0] + length * (right * cos_t - forward * sin_t),
        base[1] + length * (right * sin_t + forward * cos_t),
        base[2] + length * up,
    )
