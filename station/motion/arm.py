"""The arm that really reaches the drum, in closed form (DESIGN § 5; thesis figures 4.15–4.18).

A contact says where the stick touches and how stick and hand lie there. From it and the shoulder follow the wrist, by
the cosine law the elbow and shoulder, and with a stroke's offsets on top of those angles everything up to the tip: at
the strike the offsets are zero and the tip is on the point. Angles of hand and stick in their vertical planes count
from hanging straight down, forward positive; dir(θ) = (sin θ · heading, −cos θ).

DESIGN's b, δ and Σ are the matched grip, in which hand and stick share a vertical plane. Here each has its own heading,
so that a traditional left hand, whose stick crosses the palm, is solved by the same lines.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

from station.motion.maths import Maths, Number, Point

HALF_TURN = math.pi
QUARTER_TURN = math.pi / 2

BACK_SINE, BACK_COSINE = math.sin(math.radians(25)), math.cos(math.radians(25))
"""Elbows hang down and a little back: with the wrist in front the arm's plane is vertical, as DESIGN has it, and with
the wrist under the shoulder the elbow is behind (our choice)."""
SOFT_FROM, SOFT_OVER = 0.93, 0.10
"""From this share of the arm's length on the shoulder comes along, softly over the next tenth: an arm is never quite
straight, for there the elbow's angle has no slope (our choice)."""


class Contact(NamedTuple):
    """Where the stick touches, and how hand and stick lie there.

    Point `x`, `y`, `z`. `stick_rise` and `hand_rise`: the slopes up along the stick from the point to the fulcrum and
    along the hand from there to the wrist. `stick_yaw` and `hand_yaw`: by how much those two are turned in plan, to
    the left positive, from the direction towards the shoulder. `ahead_m` from the fulcrum to the part of the stick
    that touches. `wing`: how far the elbow is swung to the drummer's right about the line from shoulder to wrist.
    """

    x: Number
    y: Number
    z: Number
    stick_rise: Number
    hand_rise: Number
    stick_yaw: Number
    hand_yaw: Number
    ahead_m: Number
    wing: Number


class Offsets(NamedTuple):
    """A stroke's joint angles over those of the contact, radians, all upward; zero at the strike."""

    shoulder: Number
    elbow: Number
    wrist: Number
    stick: Number


class Arm(NamedTuple):
    """The solved arm.

    Points, from the shoulder `root` on; `back`, the normal of the hand's back; the heading κ towards the struck point
    (to the left positive), γ, β; the wrist's extension and its deviation to the left, as of a palm that faces down; μ,
    the stick's angle in the hand; and how far the shoulder had to come forward because the contact was out of reach.
    """

    root: Point
    elbow: Point
    wrist: Point
    hand: Point
    tip: Point
    butt: Point
    back: Point
    heading: Number
    shoulder: Number
    elbow_bend: Number
    extension: Number
    deviation: Number
    palm: Number
    missing_m: Number


@dataclass(frozen=True, slots=True)
class ArmLengths:
    """Upper arm, forearm, hand to the fulcrum, fulcrum to the tip and to the butt, in metres.

    `turns_hand`: 1 where the wrist's part of a stroke bends the hand, 0 where the forearm's roll swings the stick alone
    (a traditional left hand). `roll_sine` and `roll_cosine` of the hand's roll from palm down, to the drummer's right.
    """

    upper: float
    fore: float
    hand: float
    ahead: float
    behind: float
    turns_hand: float = 1.0
    roll_sine: float = 0.0
    roll_cosine: float = 1.0


def solve(  # noqa: PLR0915 - one chain of formulas; cut in two it would cost a tenth of a pose
    m: Maths, lengths: ArmLengths, shoulder: Point, contact: Contact, offsets: Offsets, wing_more: Number = 0.0
) -> Arm:
    """The arm at `shoulder` whose stick would touch `contact`, moved by `offsets`, its elbow out by `wing_more`.

    Where the contact is out of reach, the shoulder itself comes forward by what is missing, as shoulders do a little.
    """
    sin, cos, sqrt, most = m.sin, m.cos, m.sqrt, m.most
    sx, sy, sz = shoulder
    cx, cy, cz, stick_rise, hand_rise, stick_yaw, hand_yaw, touching, wing = contact
    raised_shoulder, raised_elbow, raised_wrist, raised_stick = offsets
    upper, fore, h = lengths.upper, lengths.fore, lengths.hand
    # plan directions towards the player of the stick (ux, uy) and the hand (vx, vy)
    dx, dy = sx - cx, sy - cy
    plan = sqrt(dx * dx + dy * dy)
    c, s = cos(stick_yaw) / plan, sin(stick_yaw) / plan
    ux, uy = dx * c - dy * s, dx * s + dy * c
    c, s = cos(hand_yaw) / plan, sin(hand_yaw) / plan
    vx, vy = dx * c - dy * s, dx * s + dy * c
    # the wrist at the contact: up the stick, up the hand
    a, b = touching * cos(stick_rise), h * cos(hand_rise)
    rx, ry = cx + a * ux + b * vx - sx, cy + a * uy + b * vy - sy
    rz = cz + touching * sin(stick_rise) + h * sin(hand_rise) - sz
    # the cosine law on upper arm, forearm and the distance from shoulder to wrist
    distance = sqrt(rx * rx + ry * ry + rz * rz)
    over = most(distance - SOFT_FROM * (upper + fore), 0.0)
    soft = m.least(over, SOFT_OVER * (upper + fore))
    missing = soft * soft / (2 * SOFT_OVER * (upper + fore)) + over - soft
    given = missing / distance  # the shoulder comes along with what is missing
    sx, sy, sz = sx + given * rx, sy + given * ry, sz + given * rz
    d = most(distance - missing, 1.0001 * abs(upper - fore))
    uu, ff, dd = upper * upper, fore * fore, d * d
    inside = m.acos((uu + dd - ff) / (2 * upper * d))
    bend = HALF_TURN - m.acos((uu + ff - dd) / (2 * upper * fore))
    # the arm's plane: along the line to the wrist, and down and back from it, where elbows hang
    kx, ky, kz = rx / distance, ry / distance, rz / distance
    fx, fy = -dx / plan, -dy / plan
    qx, qy = -BACK_SINE * fx, -BACK_SINE * fy
    along = qx * kx + qy * ky - BACK_COSINE * kz
    ex, ey, ez = qx - along * kx, qy - along * ky, -BACK_COSINE - along * kz
    norm = sqrt(ex * ex + ey * ey + ez * ez)
    ex, ey, ez = ex / norm, ey / norm, ez / norm
    # forward again, with the stroke on top: angles from the line towards the elbow's side
    lifted = raised_shoulder + raised_elbow
    at_shoulder, at_elbow = inside - raised_shoulder, inside - bend - lifted
    cos_u, sin_u = upper * cos(at_shoulder), upper * sin(at_shoulder)
    on, off = cos_u + fore * cos(at_elbow), sin_u + fore * sin(at_elbow)
    wx, wy, wz = sx + on * kx + off * ex, sy + on * ky + off * ey, sz + on * kz + off * ez
    # the elbow, swung about the line to the wrist (Rodrigues)
    wing = wing + wing_more
    reach2 = on * on + off * off
    cos_w, sin_w = cos(wing), sin(wing) / sqrt(reach2)
    stays = (cos_u * on + sin_u * off) * (1 - cos_w) / reach2
    a_k, a_e, a_n = cos_u * cos_w + stays * on, sin_u * cos_w + stays * off, -(on * sin_u - off * cos_u) * sin_w
    jx, jy, jz = sx + a_k * kx + a_e * ex, sy + a_k * ky + a_e * ey, sz + a_k * kz + a_e * ez
    jx, jy, jz = jx + a_n * (ky * ez - kz * ey), jy + a_n * (kz * ex - kx * ez), jz + a_n * (kx * ey - ky * ex)
    # hand and stick
    hand = QUARTER_TURN - hand_rise + lifted + lengths.turns_hand * raised_wrist
    stick = QUARTER_TURN - stick_rise + lifted + raised_wrist + raised_stick
    sin_h, cos_h, sin_s, cos_s = sin(hand), cos(hand), sin(stick), cos(stick)
    px, py, pz = -sin_h * vx, -sin_h * vy, -cos_h
    tx, ty, tz = -sin_s * ux, -sin_s * uy, -cos_s
    hx, hy, hz = wx + h * px, wy + h * py, wz + h * pz
    # the wrist's angles: the forearm seen from the hand's own axes (along, back, left)
    bx, by, bz = (wx - jx) / fore, (wy - jy) / fore, (wz - jz) / fore
    nx, ny, nz = -cos_h * vx, -cos_h * vy, sin_h
    ahead_f, back_f, left_f = bx * px + by * py + bz * pz, bx * nx + by * ny + bz * nz, bx * vy - by * vx
    across, upward = lengths.roll_sine, lengths.roll_cosine
    return Arm(
        (sx, sy, sz),
        (jx, jy, jz),
        (wx, wy, wz),
        (hx, hy, hz),
        (hx + lengths.ahead * tx, hy + lengths.ahead * ty, hz + lengths.ahead * tz),
        (hx - lengths.behind * tx, hy - lengths.behind * ty, hz - lengths.behind * tz),
        (nx * upward - vy * across, ny * upward + vx * across, nz * upward),
        m.atan2(-fx, fy),
        m.atan2((cos_u * kx + sin_u * ex) * fx + (cos_u * ky + sin_u * ey) * fy, -(cos_u * kz + sin_u * ez)),
        bend + raised_elbow,
        -m.atan2(back_f, ahead_f),
        -m.atan2(left_f, sqrt(ahead_f * ahead_f + back_f * back_f)),
        stick - hand,
        missing,
    )
