"""The arm that really reaches the drum, in closed form (DESIGN § 5; thesis figures 4.15–4.18).

A contact says where the stick touches and how it lies there. From it and the shoulder follow the wrist, by the cosine
law the elbow and shoulder, and with the stroke's offsets on top of those angles everything up to the tip: at the strike
the offsets are zero and the tip is on the point. Angles in the arm's vertical plane count from hanging straight down,
forward positive; dir(θ) = (sin θ · heading, −cos θ).
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

from station.motion.maths import Maths, Number, Point

HALF_TURN = math.pi
QUARTER_TURN = math.pi / 2

_STRAIGHT = 0.9999
"""An arm is never straighter than this share of its length: at 1 the elbow's angle has no slope (our choice)."""


class Contact(NamedTuple):
    """Where the stick touches, and how it lies there.

    Point `x`, `y`, `z`; the slope `rise_rad` of the line from there up to the wrist; `yaw_rad` by which that line is
    turned from the shoulder's direction in plan (to the left positive); `ahead_m` from the fulcrum to the part of the
    stick that touches; `palm_rad` the stick's angle μ in the hand.
    """

    x: Number
    y: Number
    z: Number
    rise_rad: Number
    yaw_rad: Number
    ahead_m: Number
    palm_rad: Number


class Offsets(NamedTuple):
    """A stroke's joint angles over those of the contact, radians, all upward; zero at the strike."""

    shoulder: Number
    elbow: Number
    wrist: Number
    stick: Number


class Arm(NamedTuple):
    """The solved arm.

    Points; the normal of the `back` of the hand; the `angles` γ, β, α, μ; the arm plane's `heading_rad` κ (to the left
    positive); and the distance from shoulder to wrist that is missing where the contact is out of reach (else 0).
    """

    elbow: Point
    wrist: Point
    hand: Point
    tip: Point
    butt: Point
    back: Point
    angles: tuple[Number, Number, Number, Number]
    heading_rad: Number
    missing_m: Number


@dataclass(frozen=True, slots=True)
class ArmLengths:
    """Upper arm, forearm, hand to the fulcrum, fulcrum to the tip and to the butt, in metres."""

    upper: float
    fore: float
    hand: float
    ahead: float
    behind: float


def solve(m: Maths, lengths: ArmLengths, shoulder: Point, contact: Contact, offsets: Offsets, wing_rad: Number) -> Arm:
    """The arm at `shoulder` whose stick would touch `contact`, moved by `offsets`, its elbow swung out by `wing_rad`.

    `wing_rad` turns the elbow about the line from shoulder to wrist, positive to the drummer's right, and moves nothing
    else. Out of reach, the arm stretches towards the contact and says how much is missing.
    """
    sx, sy, sz = shoulder
    upper, fore = lengths.upper, lengths.fore
    # the wrist at the contact, on its line at the length b of hand and stick: b² = h² + S² + 2hS cos μ
    h, ahead, mu = lengths.hand, contact.ahead_m, contact.palm_rad
    cos_mu, sin_mu = m.cos(mu), m.sin(mu)
    b = m.sqrt(h * h + ahead * ahead + 2 * h * ahead * cos_mu)
    lean = m.atan2(ahead * sin_mu, h + ahead * cos_mu)
    dx, dy = sx - contact.x, sy - contact.y
    plan = m.sqrt(dx * dx + dy * dy)
    cos_yaw, sin_yaw = m.cos(contact.yaw_rad), m.sin(contact.yaw_rad)
    ux, uy = (dx * cos_yaw - dy * sin_yaw) / plan, (dx * sin_yaw + dy * cos_yaw) / plan
    level = b * m.cos(contact.rise_rad)
    wx, wy, wz = contact.x + level * ux, contact.y + level * uy, contact.z + b * m.sin(contact.rise_rad)
    hand_0 = QUARTER_TURN - contact.rise_rad - lean  # Σ = π/2 − rise points from the wrist down to the contact
    # the cosine law on upper arm, forearm and the distance between shoulder and wrist
    rx, ry, rz = wx - sx, wy - sy, wz - sz
    flat2 = rx * rx + ry * ry
    flat = m.sqrt(flat2)
    distance = m.sqrt(flat2 + rz * rz)
    longest = _STRAIGHT * (upper + fore)
    missing = m.most(distance - longest, 0.0)
    d = m.least(distance, longest)
    inside = m.acos((upper * upper + d * d - fore * fore) / (2 * upper * d))
    gamma = m.atan2(flat, -rz) - inside + offsets.shoulder
    bend = m.acos(m.most(m.least((upper * upper + fore * fore - d * d) / (2 * upper * fore), 1.0), -1.0))
    beta = HALF_TURN - bend + offsets.elbow
    # forward again, with the stroke on top
    ax, ay = rx / flat, ry / flat
    sin_u, cos_u = m.sin(gamma), m.cos(gamma)
    sin_f, cos_f = m.sin(gamma + beta), m.cos(gamma + beta)
    reach, drop = upper * sin_u + fore * sin_f, upper * cos_u + fore * cos_f
    wx, wy, wz = sx + reach * ax, sy + reach * ay, sz - drop
    elbow = _swing(
        m, (sx, sy, sz), (upper * sin_u * ax, upper * sin_u * ay, -upper * cos_u), (reach, drop, ax, ay), wing_rad
    )
    hand = hand_0 + offsets.shoulder + offsets.elbow + offsets.wrist
    stick = hand + mu + offsets.stick
    sin_h, cos_h, sin_s, cos_s = m.sin(hand), m.cos(hand), m.sin(stick), m.cos(stick)
    hx, hy, hz = wx - h * sin_h * ux, wy - h * sin_h * uy, wz - h * cos_h
    tx, ty, tz = -sin_s * ux, -sin_s * uy, -cos_s
    return Arm(
        elbow=elbow,
        wrist=(wx, wy, wz),
        hand=(hx, hy, hz),
        tip=(hx + lengths.ahead * tx, hy + lengths.ahead * ty, hz + lengths.ahead * tz),
        butt=(hx - lengths.behind * tx, hy - lengths.behind * ty, hz - lengths.behind * tz),
        back=(-cos_h * ux, -cos_h * uy, sin_h),
        angles=(gamma, beta, hand - gamma - beta, mu + offsets.stick),
        heading_rad=m.atan2(-ax, ay),
        missing_m=missing,
    )


def _swing(m: Maths, shoulder: Point, arm: Point, line: tuple[Number, ...], wing_rad: Number) -> Point:
    """The elbow at `shoulder` + `arm`, turned by `wing_rad` about the line to the wrist (Rodrigues)."""
    sx, sy, sz = shoulder
    ex, ey, ez = arm
    reach, drop, ax, ay = line
    length = m.sqrt(reach * reach + drop * drop)
    kx, ky, kz = reach * ax / length, reach * ay / length, -drop / length
    cos_w, sin_w = m.cos(wing_rad), m.sin(wing_rad)
    along = (kx * ex + ky * ey + kz * ez) * (1 - cos_w)
    return (
        sx + ex * cos_w + (ky * ez - kz * ey) * sin_w + kx * along,
        sy + ey * cos_w + (kz * ex - kx * ez) * sin_w + ky * along,
        sz + ez * cos_w + (kx * ey - ky * ex) * sin_w + kz * along,
    )
