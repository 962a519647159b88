"""The arm that really reaches the drum, in closed form (DESIGN § 5; thesis figures 4.15–4.18).

A contact says where the stick touches and how stick and hand lie there. From it and the shoulder follow the wrist, by
the cosine law the elbow and shoulder, and with a stroke's offsets on top of those angles everything up to the tip: at
the strike the offsets are zero and the tip is on the point. Angles of hand and stick in their vertical planes count
from hanging straight down, forward positive; dir(θ) = (sin θ · heading, −cos θ).

DESIGN's b, δ and Σ are the matched grip, in which hand and stick share a vertical plane. Here each has its own heading,
so that a traditional left hand, whose stick crosses the palm, is solved by the same lines.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from station.motion.kinematics.maths import Maths, Number, Point

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
    `turns`: 1 where the wrist's part of a stroke bends the hand, 0 where the forearm's roll turns hand and stick (a
    traditional left hand), between them where the thumb comes up: the hand bends less and rolls, the stick sinks in
    it. `roll` of the hand's back beyond its grip's.
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
    turns: Number = 1.0
    roll: Number = 0.0


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

    `rolls_hand` is 1 for a right and −1 for a left hand. `roll_sine` and `roll_cosine` of the hand's roll from palm
    down, to the drummer's right. The hand's bones are turned from the line between wrist and fulcrum by `off_thumb`
    and `off_back` radians, to the thumb and to the back: the fulcrum lies beside them, under the palm.
    A stick that lies `across` the hand turns with it.
    `most_bend` is the elbow's limit: a hand that travels close past the shoulder keeps farther off instead.
    """

    upper: float
    fore: float
    hand: float
    ahead: float
    behind: float
    roll_sine: float = 0.0
    roll_cosine: float = 1.0
    rolls_hand: float = 1.0
    across: bool = False
    off_thumb: float = 0.0
    off_back: float = 0.0
    most_bend: float = math.pi

    def nearest_m(self, m: Maths, bend: Number) -> Number:
        """How near to the shoulder an elbow bent by `bend` brings the wrist, metres."""
        return m.sqrt(self.upper**2 + self.fore**2 + 2 * self.upper * self.fore * m.cos(bend))


def solve(
    m: Maths, lengths: ArmLengths, shoulder: Point, contact: Contact, offsets: Offsets, wing_more: Number = 0.0
) -> Arm:
    """The arm at `shoulder` whose stick would touch `contact`, moved by `offsets`, its elbow out by `wing_more`.

    Where the contact is out of reach, the shoulder itself comes forward by what is missing, as shoulders do a little.
    """
    joints, butt, tip, back, angles, missing = chain(m, lengths, shoulder, contact, offsets, (wing_more, 0.0))
    named = (joints[:3], joints[3:6], joints[6:9], joints[9:], tip, butt, back, *angles, missing)
    return Arm._make(named)


ArmChain = tuple[tuple[Number, ...], Point, Point, Point, tuple[Number, ...], Number]
"""`Arm` without names: x, y, z of root, elbow, wrist and hand in one, butt, tip, back, the six angles, the missing."""


def chain(  # noqa: PLR0915 - one chain of formulas; cut in two it would cost a tenth of a pose
    m: Maths,
    lengths: ArmLengths,
    shoulder: Point,
    contact: Sequence[Number],
    offsets: Sequence[Number],
    more: tuple[Number, Number],
) -> ArmChain:
    """`solve` in plain tuples, as a row takes it; `contact` and `offsets` in the order of `Contact` and `Offsets`.

    `more`: by how much the elbow is farther out than the contact's `wing`, the wrist higher than its `hand_rise`.
    """
    sin, cos, sqrt, atan2, acos, most = m.sin, m.cos, m.sqrt, m.atan2, m.acos, m.most
    sx, sy, sz = shoulder
    cx, cy, cz, stick_rise, hand_rise, stick_yaw, hand_yaw, touching, wing, turns, roll = contact
    raised_shoulder, raised_elbow, raised_wrist, raised_stick = offsets
    hand_rise = hand_rise + more[1]
    upper, fore, h = lengths.upper, lengths.fore, lengths.hand
    whole = upper + fore
    # plan directions: towards the player (gx, gy), and turned from it those of the stick (ux, uy) and hand (vx, vy)
    dx, dy = sx - cx, sy - cy
    plan = sqrt(dx * dx + dy * dy)
    gx, gy = dx / plan, dy / plan
    c, s = cos(stick_yaw), sin(stick_yaw)
    ux, uy = gx * c - gy * s, gx * s + gy * c
    c, s = cos(hand_yaw), sin(hand_yaw)
    vx, vy = gx * c - gy * s, gx * s + gy * c
    # from the shoulder to the wrist at the contact: up the stick, up the hand
    a, b = touching * cos(stick_rise), h * cos(hand_rise)
    rx, ry = a * ux + b * vx - dx, a * uy + b * vy - dy
    rz = cz + touching * sin(stick_rise) + h * sin(hand_rise) - sz
    # the cosine law on upper arm, forearm and the distance from shoulder to wrist
    distance = sqrt(rx * rx + ry * ry + rz * rz)
    over = most(distance - SOFT_FROM * whole, 0.0)
    soft = m.least(over, SOFT_OVER * whole)
    missing = soft * soft / (2 * SOFT_OVER * whole) + over - soft
    kx, ky, kz = rx / distance, ry / distance, rz / distance
    sx, sy, sz = sx + missing * kx, sy + missing * ky, sz + missing * kz  # the shoulder comes along
    d = most(distance - missing, 1.0001 * abs(upper - fore))
    dd, uu_ff = d * d, whole * (upper - fore)
    inside = acos((dd + uu_ff) / (2 * upper * d))
    forearm = m.least(acos((dd - uu_ff) / (2 * fore * d)), lengths.most_bend - inside - raised_elbow)
    # the arm's plane: along the line to the wrist, and down and back from it, where elbows hang
    along = BACK_SINE * (gx * kx + gy * ky) - BACK_COSINE * kz
    norm = sqrt(1 - along * along)
    ex, ey = (BACK_SINE * gx - along * kx) / norm, (BACK_SINE * gy - along * ky) / norm
    ez = (-BACK_COSINE - along * kz) / norm
    # forward again, with the stroke on top: angles from the line towards the elbow's side
    lifted = raised_shoulder + raised_elbow
    at_shoulder, at_elbow = inside - raised_shoulder, forearm + lifted
    cos_u, sin_u = upper * cos(at_shoulder), upper * sin(at_shoulder)
    on, off = cos_u + fore * cos(at_elbow), sin_u - fore * sin(at_elbow)
    wx, wy, wz = sx + on * kx + off * ex, sy + on * ky + off * ey, sz + on * kz + off * ez
    # the elbow: its foot on the line to the wrist, and from there out, swung about the line
    wing = wing + more[0]
    reach2 = on * on + off * off
    foot, out = (cos_u * on + sin_u * off) / reach2, (sin_u * on - cos_u * off) / reach2
    down = out * cos(wing)
    a_k, a_e, a_n = foot * on - down * off, foot * off + down * on, -out * sqrt(reach2) * sin(wing)
    jx = sx + a_k * kx + a_e * ex + a_n * (ky * ez - kz * ey)
    jy = sy + a_k * ky + a_e * ey + a_n * (kz * ex - kx * ez)
    jz = sz + a_k * kz + a_e * ez + a_n * (kx * ey - ky * ex)
    # hand and stick, by their slopes up towards the player
    hand = hand_rise - lifted - turns * raised_wrist
    stick = stick_rise - raised_stick - (0.0 if lengths.across else lifted + raised_wrist)
    cos_h, sin_h, cos_s, sin_s = cos(hand), sin(hand), cos(stick), sin(stick)
    a = h * cos_h
    hx, hy, hz = wx - a * vx, wy - a * vy, wz - h * sin_h
    tx, ty, tz = cos_s * ux, cos_s * uy, sin_s
    ahead, behind = lengths.ahead, lengths.behind
    # the wrist's angles: the forearm seen from the hand's own axes, and the hand's rolled back
    bx, by, bz = wx - jx, wy - jy, wz - jz
    b = bx * vx + by * vy
    across, upward, rolled = lengths.roll_sine, lengths.roll_cosine, (1 - turns) * raised_wrist
    side, to_thumb, to_back = lengths.rolls_hand, lengths.off_thumb, lengths.off_back
    if lengths.across:  # the stick goes with the hand, pitched by the arm and turned by the forearm
        c, s = cos(lifted), sin(lifted)
        along = vx * tx + vy * ty
        pitched = (c - 1) * along + s * tz
        tx, ty, tz = tx + pitched * vx, ty + pitched * vy, c * tz - s * along
        c, s = cos(rolled), -side * sin(rolled)
        lx, ly = cos_h * vx, cos_h * vy
        dot = (1 - c) * (lx * tx + ly * ty + sin_h * tz)
        tx, ty, tz = (
            c * tx + s * (ly * tz - sin_h * ty) + dot * lx,
            c * ty + s * (sin_h * tx - lx * tz) + dot * ly,
            c * tz + s * (lx * ty - ly * tx) + dot * sin_h,
        )
    c, s = cos(rolled + roll), side * sin(rolled + roll)
    across, upward = across * c + upward * s, upward * c - across * s
    tilted = sin_h * upward
    return (
        (sx, sy, sz, jx, jy, jz, wx, wy, wz, hx, hy, hz),
        (hx + behind * tx, hy + behind * ty, hz + behind * tz),
        (hx - ahead * tx, hy - ahead * ty, hz - ahead * tz),
        (-tilted * vx - across * vy, across * vx - tilted * vy, cos_h * upward),
        (
            atan2(gx, -gy),
            atan2(-(cos_u * kx + sin_u * ex) * gx - (cos_u * ky + sin_u * ey) * gy, -(cos_u * kz + sin_u * ez)),
            inside + forearm + raised_elbow,
            atan2(sin_h * b - cos_h * bz, -(cos_h * b + sin_h * bz)) + to_thumb * side * across + to_back * upward,
            atan2(by * vx - bx * vy, sqrt(b * b + bz * bz)) + to_thumb * side * upward - to_back * across,
            hand - stick + (lifted if lengths.across else 0.0),
        ),
        missing,
    )
