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
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from station.motion.kinematics.maths import ONE, Maths, Number, Point

BACK_SINE, BACK_COSINE = math.sin(math.radians(25)), math.cos(math.radians(25))
"""Elbows hang down and a little back: with the wrist in front the arm's plane is vertical, as DESIGN has it, and with
the wrist under the shoulder the elbow is behind (our choice)."""
FARTHER_BACK, _UNDER2 = 2.0, 0.1**2
"""Where the wrist comes behind the shoulder the elbow is so much farther back, softly from a tenth of the way before
it:
else the plane would have no direction where the wrist is just where elbows hang to (our choice)."""
BEHIND_M = 0.30
"""Yaws count from the direction to a point so far behind the shoulder: stick and hand turn with the shoulder, and what
passes under the shoulder has a direction too (our choice: no tip comes so far behind)."""
_SWING_EASE = 0.02
"""An elbow that would be too far behind the shoulder swings out softly: of the cosine of its swing (our choice)."""
EASE_RAD, _SPARE_RAD = math.radians(1), math.radians(2)
"""So far before and behind its limit a joint gives in, so that its speed has no jump; a hand that turns about the
fulcrum
does so a little sooner, for that takes the tip nowhere (our choice)."""
_GIVES, _MOST_GIVE = 0.85, math.radians(10)
"""A hand turns so much for each degree that its wrist is too far bent, for the forearm turns against it (over the snare
a degree of the hand is 1.2 of the wrist); but no farther than a stick may turn in the palm (our choice)."""
SOFT_FROM, SOFT_OVER = 0.93, 0.10
"""From this share of the arm's length on the shoulder comes along, softly over the next tenth: an arm is never quite
straight, for there the elbow's angle has no slope (our choice)."""


class Contact(NamedTuple):
    """Where the stick touches, and how hand and stick lie there.

    Point `x`, `y`, `z`. `stick_rise` and `hand_rise`: the slopes up along the stick from the point to the fulcrum and
    along the hand from there to the wrist. `stick_yaw` and `hand_yaw`: by how much those two are turned in plan, to
    the left positive, from the direction towards `BEHIND_M` behind the shoulder. `ahead_m` from the fulcrum to the part
    of the stick that touches. `wing`: how far the elbow is swung to the drummer's right about the line from shoulder to
    wrist. `turns`: 1 where the wrist's part of a stroke bends the hand, 0 where the forearm's roll turns hand and stick
    (a traditional left hand), between them where the thumb comes up: the hand bends less and rolls, the stick sinks in
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
    (to the left positive), γ, how far the upper arm points forward from hanging, β; the wrist's extension and its
    deviation to the left, as of a palm that faces down; μ,
    the stick's angle in the hand; how far the elbow is swung to the right; and how far the shoulder had to come
    forward because the contact was out of reach.
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
    swing: Number
    missing_m: Number


@dataclass(frozen=True, slots=True)
class ArmLengths:
    """Upper arm, forearm, hand to the fulcrum, fulcrum to the tip and to the butt, in metres.

    `rolls_hand` is 1 for a right and −1 for a left hand. `roll_sine` and `roll_cosine` of the hand's roll from palm
    down, to the drummer's right. The hand's bones are turned from the line between wrist and fulcrum by `off_thumb`
    and `off_back` radians, to the thumb and to the back: the fulcrum lies beside them, under the palm.
    A stick that lies `across` the hand turns with it.
    `most_bend` is the elbow's limit: a hand that travels close past the shoulder keeps farther off instead.
    `most_back_m` is how far the elbow may be behind the shoulder: one that would be farther swings out. `wrist` are
    the limits of extension and of deviation to the left, least and most each: beyond them the hand is turned about the
    fulcrum, and the stick stays where it is.
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
    most_back_m: float = 1.0
    wrist: tuple[float, float, float, float] = (-math.pi, math.pi, -math.pi, math.pi)

    @property
    def unlimited(self) -> "ArmLengths":
        """The same with joints that bend as far as they are asked to, as whoever looks for a better way needs it."""
        return replace(self, most_bend=math.pi, most_back_m=1.0, wrist=(-math.pi, math.pi, -math.pi, math.pi))


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
"""`Arm` without names: x, y, z of root, elbow, wrist and hand in one, butt, tip, back, the seven angles, the
missing."""


def chain(
    m: Maths,
    lengths: ArmLengths,
    shoulder: Point,
    contact: Sequence[Number],
    offsets: Sequence[Number],
    more: tuple[Number, Number],
) -> ArmChain:
    """`solve` in plain tuples, as a row takes it; `contact` and `offsets` in the order of `Contact` and `Offsets`.

    `more`: by how much the elbow is farther out than the contact's `wing`, the wrist higher than its `hand_rise`.
    The wrist keeps within its limits: the hand turns about the fulcrum, so that the tip stays where it is; only where
    that is not enough the tip goes with the hand.
    """
    arm = _chain(m, lengths, shoulder, contact, offsets, more)
    least_rise, most_rise, least_yaw, most_yaw = lengths.wrist
    flexed, extended = least_rise + _SPARE_RAD, most_rise - _SPARE_RAD
    right, left = least_yaw + _SPARE_RAD, most_yaw - _SPARE_RAD
    rise: Number = 0.0
    yaw: Number = 0.0
    for clamped in (False, True):
        extension, deviation = arm[4][3], arm[4][4]
        if m is ONE:  # on floats in a third of the time
            free = flexed + EASE_RAD <= extension <= extended - EASE_RAD
            free = free and right + EASE_RAD <= deviation <= left - EASE_RAD
        else:
            within = (extension >= flexed + EASE_RAD) & (extension <= extended - EASE_RAD)
            free = bool(np.all(within & (deviation >= right + EASE_RAD) & (deviation <= left - EASE_RAD)))
        if free:
            break
        rise = rise + _GIVES * (extension - _bounded(m, extension, flexed, extended))
        yaw = yaw - _GIVES * (deviation - _bounded(m, deviation, right, left))
        given = _within(m, rise, _MOST_GIVE), _within(m, yaw, _MOST_GIVE)
        arm = _chain(m, lengths, shoulder, contact, offsets, more, given, clamped)
    return arm


def _bounded(m: Maths, angle: Number, least: float, most: float) -> Number:
    """An `angle` that gives in to its limits."""
    return angle - excess(m, angle, most) + excess(m, -angle, -least)


def _within(m: Maths, angle: Number, most: float) -> Number:
    """An angle that nears but never passes `most` to both sides."""
    return angle / m.sqrt(m.sqrt(1.0 + (angle / most) ** 4))


def excess(m: Maths, value: Number, limit: Number, ease: float = EASE_RAD) -> Number:
    """By how much a `value` must give in to stay under its `limit`: nothing until an `ease` before it."""
    if m is ONE and value <= limit - ease:
        return 0.0
    eased = m.least(m.most(value - limit + ease, 0.0), 2 * ease)
    return eased * eased / (4 * ease) + m.most(value - limit - ease, 0.0)


def _chain(  # noqa: PLR0913, PLR0915, PLR0917 - one chain of formulas; cut in two it would cost a tenth of a pose
    m: Maths,
    lengths: ArmLengths,
    shoulder: Point,
    contact: Sequence[Number],
    offsets: Sequence[Number],
    more: tuple[Number, Number],
    gives: tuple[Number, Number] = (0.0, 0.0),
    clamped: bool = False,
) -> ArmChain:
    """`chain` with a hand that `gives`, so much steeper and farther to the left, and a wrist that may be `clamped`."""
    sin, cos, sqrt, atan2, acos, most = m.sin, m.cos, m.sqrt, m.atan2, m.acos, m.most
    sx, sy, sz = shoulder
    cx, cy, cz, stick_rise, hand_rise, stick_yaw, hand_yaw, touching, wing, turns, roll = contact
    raised_shoulder, raised_elbow, raised_wrist, raised_stick = offsets
    hand_rise, hand_yaw = hand_rise + more[1] + gives[0], hand_yaw + gives[1]
    upper, fore, h = lengths.upper, lengths.fore, lengths.hand
    whole = upper + fore
    # in plan: towards behind the shoulder g, and turned from it u of the stick and v of the hand
    dx, dy = sx - cx, sy - cy
    gy = dy - BEHIND_M
    plan = sqrt(dx * dx + gy * gy)
    gx, gy = dx / plan, gy / plan
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
    forearm = acos((dd - uu_ff) / (2 * fore * d))
    forearm = forearm - excess(m, inside + forearm + raised_elbow, lengths.most_bend)
    # the arm's plane: along the line to the wrist, and down and back from it, where elbows hang
    behind = gx * kx + gy * ky
    back = BACK_SINE + 0.5 * FARTHER_BACK * (behind + sqrt(behind * behind + _UNDER2))
    along = back * behind - BACK_COSINE * kz
    norm = sqrt(back * back + BACK_COSINE * BACK_COSINE - along * along)
    ex, ey = (back * gx - along * kx) / norm, (back * gy - along * ky) / norm
    ez = (-BACK_COSINE - along * kz) / norm
    # forward again, with the stroke on top: angles from the line towards the elbow's side
    lifted = raised_shoulder + raised_elbow
    at_shoulder, at_elbow = inside - raised_shoulder, forearm + lifted
    cos_u, sin_u = upper * cos(at_shoulder), upper * sin(at_shoulder)
    on, off = cos_u + fore * cos(at_elbow), sin_u - fore * sin(at_elbow)
    wx, wy, wz = sx + on * kx + off * ex, sy + on * ky + off * ey, sz + on * kz + off * ez
    # the elbow: its foot on the line to the wrist, and from there out, swung about the line; out where it would be too
    # far behind the shoulder
    wing = wing + more[0]
    reach2 = on * on + off * off
    foot, out = (cos_u * on + sin_u * off) / reach2, (sin_u * on - cos_u * off) / reach2
    aback, across = ex * gx + ey * gy, (kz * ey - ky * ez) * gx + (kx * ez - kz * ex) * gy
    hanging, swung = on * aback - off * behind, sqrt(reach2) * across
    hangs = cos(wing - atan2(swung, hanging))
    room = most(lengths.most_back_m - foot * (on * behind + off * aback), 0.0)
    less = excess(m, hangs, room / (abs(out) * sqrt(hanging * hanging + swung * swung) + 1e-6), _SWING_EASE)
    if m is not ONE or less:
        wing = wing + lengths.rolls_hand * (acos(hangs - less) - acos(hangs))
    down = out * cos(wing)
    a_k, a_e, a_n = foot * on - down * off, foot * off + down * on, -out * sqrt(reach2) * sin(wing)
    jx = sx + a_k * kx + a_e * ex + a_n * (ky * ez - kz * ey)
    jy = sy + a_k * ky + a_e * ey + a_n * (kz * ex - kx * ez)
    jz = sz + a_k * kz + a_e * ez + a_n * (kx * ey - ky * ex)
    rx, ry, rz = sx - jx, sy - jy, sz - jz
    # hand and stick, by their slopes up towards the player
    hand = hand_rise - lifted - turns * raised_wrist
    stick = stick_rise - raised_stick - (0.0 if lengths.across else lifted + raised_wrist)
    across, upward, rolled = lengths.roll_sine, lengths.roll_cosine, (1 - turns) * raised_wrist
    side, to_thumb, to_back = lengths.rolls_hand, lengths.off_thumb, lengths.off_back
    c, s = cos(rolled + roll), side * sin(rolled + roll)
    across, upward = across * c + upward * s, upward * c - across * s
    # the wrist's angles: the forearm seen from the hand's own axes, and the hand's bones beside its line
    extended_by, deviated_by = to_thumb * side * across + to_back * upward, to_thumb * side * upward - to_back * across
    bx, by, bz = wx - jx, wy - jy, wz - jz
    b, aside = bx * vx + by * vy, by * vx - bx * vy
    deviation = atan2(aside, sqrt(b * b + bz * bz)) + deviated_by
    if clamped:
        flexed, extended, right, left = lengths.wrist
        deviation = _bounded(m, deviation, right, left)
        flat2 = bx * bx + by * by
        aside_now = fore * sin(deviation - deviated_by)
        turn = atan2(aside_now, sqrt(most(flat2 - aside_now * aside_now, 1e-12))) - atan2(aside, -b)
        c, s = cos(turn), sin(turn)
        ux, uy, vx, vy = ux * c - uy * s, ux * s + uy * c, vx * c - vy * s, vx * s + vy * c
        b = bx * vx + by * vy
    cos_h, sin_h = cos(hand), sin(hand)
    extension = atan2(sin_h * b - cos_h * bz, -(cos_h * b + sin_h * bz)) + extended_by
    if clamped:
        less = extension - _bounded(m, extension, flexed, extended)
        hand, stick, extension = hand + less, stick + less, extension - less
        cos_h, sin_h = cos(hand), sin(hand)
    cos_s, sin_s = cos(stick), sin(stick)
    a = h * cos_h
    hx, hy, hz = wx - a * vx, wy - a * vy, wz - h * sin_h
    tx, ty, tz = cos_s * ux, cos_s * uy, sin_s
    ahead, behind = lengths.ahead, lengths.behind
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
    tilted = sin_h * upward
    return (
        (sx, sy, sz, jx, jy, jz, wx, wy, wz, hx, hy, hz),
        (hx + behind * tx, hy + behind * ty, hz + behind * tz),
        (hx - ahead * tx, hy - ahead * ty, hz - ahead * tz),
        (-tilted * vx - across * vy, across * vx - tilted * vy, cos_h * upward),
        (
            atan2(gx, -gy),
            atan2(rx * gx + ry * gy, sqrt(most((rx * gy - ry * gx) ** 2 + rz * rz, 1e-12))),
            inside + forearm + raised_elbow,
            extension,
            deviation,
            hand - stick + (lifted if lengths.across else 0.0),
            wing,
        ),
        missing,
    )
