"""How a hand lies when its stick touches: from the kit's targets to the numbers that the arm is solved from.

The kit's wrist radius and height give the slope of the line from the struck point up to the wrist, the grip how the
stick lies in the hand. What they leave open, the elbow's wing and the way that hand and stick point, is chosen once for
each target so that the wrist is bent least, at the natural posture of the body for that target: drummers lift the elbow
for a high hi-hat and keep the wrist straight.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece
from station.motion.kinematics.arm import BEHIND_M, Arm, ArmLengths, Contact, Offsets, solve
from station.motion.kinematics.body_solids import CHEST, Capsules, in_capsules, points_of, trunk_capsules
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.grip import Grip, Hold
from station.motion.kinematics.joint_limits import Limits
from station.motion.kinematics.maths import MANY, ONE, Point, arcsine
from station.motion.kinematics.posture import natural_shoulder, pelvis_of
from station.motion.kit.kit import Kit
from station.motion.kit.piece import RIM_ABOVE_HEAD_M, Target
from station.motion.strokes.hand_events import GRAB, LAP, SHOW, WAIT
from station.motion.strokes.lap import Thigh, lap
from station.motion.strokes.targets import Strike, laid_azimuth, target_of

Array = NDArray[np.float64]

_WINGS = np.radians(np.arange(0.0, 81.0, 8.0))
_TURNS = np.radians(np.arange(-60.0, 61.0, 6.0))
_EXTENSION_EASE, _DEVIATION_EASE = np.radians(25.0), np.radians(12.0)
_NATURAL_WING, _WING_EASE = np.radians(12.0), np.radians(40.0)
_TURN_EASE = np.radians(18.0)
_SPARE, _BEYOND_EASE = np.radians(8.0), np.radians(1.0)
"""What is called comfortable: how far the wrist bends, the elbow leaves its place and the stick is turned from its
grip's own way before each costs as much as the others; near its limits no wrist is comfortable, for strokes and styles
need room (our choice, within the limits of HUMANS)."""

SHOULDER_OF_STICK = 0.25
"""From the tip back to the part that meets a cymbal's edge or a rim, as a share of the stick (our choice)."""
_LAID_AHEAD = 0.55
_LAID_RISE, _LAID_IN_THE_WEB = math.radians(2.0), math.radians(12.0)
"""A cross-stick strikes the rim so far ahead of the fulcrum as a share of its length; a matched hand lies flat
on it, palm down; the back of a traditional one lies on the head (our choice)."""

_RIDES = (Piece.RIDE, Piece.RIDE_2)
THUMB_UP_TURNS = 0.75
"""On a ride the thumb comes up: a quarter of the wrist's part of a stroke is the forearm's roll (our choice)."""

LEANS_RAD = np.radians([6.0, 12.0, 18.0, 24.0, 30.0])
"""How far the trunk may lean for a distant target, the least that serves (our choice)."""
PROTRACTION_M = 0.10
"""A shoulder comes forward by so much for what is still out of reach; the rest is missing (our choice)."""


@dataclass(frozen=True, slots=True)
class ContactPose:
    """One kind of strike, solved at the natural posture.

    `root` is the shoulder with the torso facing the target and leaning to it as little as is needed, `missing_m` how
    far it is still from reaching; `angles` those of upper arm, forearm, hand and stick from hanging straight down, and
    `ceiling` how far shoulder, elbow, wrist and stick may rise from there within their limits.
    """

    contact: Contact
    root: Point
    wrist: Point
    angles: tuple[float, float, float, float]
    ceiling: tuple[float, float, float, float]
    missing_m: float
    shoulder_of_stick: bool


def lie_of(kit: Kit, figure: Figure, hold: Hold, strike: Strike, thigh: Thigh | None = None) -> ContactPose:
    """The most comfortable way for `strike` with `hold`; `thigh` on which a hand may lie."""
    if strike.articulation in (WAIT, LAP) and not hold.held.rest_m:  # a brush waits on the head
        strike = replace(strike, articulation=Articulation.NORMAL)
    elif strike.articulation == LAP and not hold.grip.turns_hand:  # on the thigh its wrist would be bent to its end
        strike = replace(strike, articulation=WAIT)
    target = target_of(kit, strike)
    if kit.stand_in(strike.piece) in _RIDES and hold.held.name == "stick":
        hold = replace(hold, grip=replace(hold.grip, turns_hand=min(hold.grip.turns_hand, THUMB_UP_TURNS)))
    right = strike.limb == Limb.RIGHT_HAND
    side = 1.0 if right else -1.0
    lengths = hold.lengths(figure, right).unlimited
    slopes = _slopes(lengths, target, hold, strike, hold.length_m(figure))
    if strike.articulation == Articulation.CROSS_STICK:
        azimuth = laid_azimuth(kit, kit.pieces[kit.stand_in(strike.piece)], strike.limb)
        slopes = replace(slopes, azimuth=azimuth, free=0.0)
    elif strike.articulation == LAP:
        assert thigh is not None
        target, azimuth = lap(figure, thigh)
        slopes = _Slopes(0.0, lengths.ahead, target.rise_rad, azimuth=azimuth, free=0.0)
    faced = np.array([0.0, 1.0, 0.0]) if strike.articulation in (WAIT, SHOW, LAP) else target.point_m  # for anything
    for lean in LEANS_RAD.tolist():
        root = natural_shoulder(kit, figure, strike.limb, faced, lean)
        other = natural_shoulder(kit, figure, Limb.LEFT_HAND if right else Limb.RIGHT_HAND, faced, lean)
        body = _Body.of(kit, figure, root, other, side)
        touch, stretched = _easiest(lengths, root, target, slopes, hold.grip, body)
        if not stretched:
            break
    arm = solve(ONE, lengths, root, touch, Offsets(0.0, 0.0, 0.0, 0.0))
    for share in _STRAIGHTER:  # the butt may be in the way of a neighbour: the stick is turned until it is not
        if not _caught(kit, lengths, root, touch):
            break
        grip = replace(hold.grip, yaw=share * hold.grip.yaw)
        touch, _ = _easiest(lengths, root, target, replace(slopes, free=_LED * slopes.free), grip, body)
        arm = solve(ONE, lengths, root, touch, Offsets(0.0, 0.0, 0.0, 0.0))
    limits = figure.limits
    return ContactPose(
        contact=touch,
        root=root,
        wrist=arm.wrist,
        angles=(arm.shoulder, arm.shoulder + arm.elbow_bend, _UPRIGHT - touch.hand_rise, _UPRIGHT - touch.stick_rise),
        ceiling=(
            max(limits.shoulder_flexion - arm.shoulder, 0.0),
            max(limits.elbow_flexion - arm.elbow_bend, 0.0),
            max(limits.wrist_extension - arm.extension, _LEAST_ROOM),
            max(limits.fingers - arm.palm, _LEAST_ROOM),
        ),
        missing_m=arm.missing_m,
        shoulder_of_stick=target.shoulder,
    )


def _caught(kit: Kit, lengths: ArmLengths, root: Point, touch: Contact) -> bool:
    """Whether the stick meets any piece of the kit while it is raised from `touch`: its butt goes down meanwhile."""
    raised = Offsets(*(_RAISING * part for part in _RAISED))
    arm = solve(MANY, lengths, root, Contact(*(np.full(len(_RAISING), c) for c in touch)), raised)
    return float(depth_in_kit(kit, np.stack(arm.butt, 1), np.stack(arm.tip, 1)).max()) > _TOUCHING_M


_STRAIGHTER = (0.7, 0.4, 0.1, -0.2, -0.5)
_LED = 0.15
"""Shares of its own yaw that a stick is turned to, clear of a neighbour, and how free it is then (our choice)."""
_TOUCHING_M = 0.002
_RAISED = Offsets(0.0, 0.05, 0.35, 0.15)
"""A middling stroke at its top."""
_RAISING = np.linspace(0.0, 1.0, 12)
_UPRIGHT = math.pi / 2
_LEAST_ROOM = 0.1
"""Even a bent wrist has this much left (our choice)."""
_EASY = 0.95
"""The trunk leans before an arm is straighter than this share of its length (our choice)."""


def _easiest(
    lengths: ArmLengths, root: Point, target: Target, slopes: "_Slopes", grip: Grip, body: "_Body"
) -> tuple[Contact, bool]:
    """Among all wings and ways to turn hand and stick the easiest one, and whether the arm is stretched for it."""
    side, limits = body.side, body.limits
    wing, turn = (g.ravel() for g in np.meshgrid(side * _WINGS, _TURNS, indexing="ij"))
    turn = slopes.free * turn
    x, y, z = target.point_m.tolist()
    way = side * grip.yaw if slopes.azimuth is None else _turn(root, target, slopes.azimuth)
    turns, which = np.unique(turn, return_inverse=True)
    rises = [_over_the_piece(target, root, way + t, slopes) for t in turns.tolist()]
    lies = [grip.lie(r, slopes.hand_roll) for r in rises]
    rise = np.array(rises)[which]
    palm, crossing, roll = np.array([(lie.palm, lie.crossing, lie.roll) for lie in lies])[which].T
    way += math.atan2(root[1] - y, root[0] - x) - math.atan2(root[1] - BEHIND_M - y, root[0] - x)
    stick_yaw = way + turn
    tries = Contact(
        x,
        y,
        z,
        stick_rise=rise,
        hand_rise=rise + palm,
        stick_yaw=stick_yaw,
        hand_yaw=stick_yaw - side * crossing,
        ahead_m=slopes.ahead_m,
        wing=wing,
        turns=grip.turns_hand,
        roll=roll,
    )
    arm = solve(MANY, lengths, root, tries, Offsets(0.0, 0.0, 0.0, 0.0))
    price = (
        (arm.extension / _EXTENSION_EASE) ** 2
        + (arm.deviation / _DEVIATION_EASE) ** 2
        + ((side * wing - _NATURAL_WING) / _WING_EASE) ** 2
        + (turn / _TURN_EASE) ** 2
        + 100.0 * arm.missing_m
        + (_beyond(arm, side, limits) / _BEYOND_EASE) ** 2
        + (body.deep(arm) / _BODY_EASE_M) ** 2
    )
    best = int(np.argmin(price))
    wx, wy, wz = (float(np.broadcast_to(w, price.shape)[best]) for w in arm.wrist)
    stretched = math.dist((wx, wy, wz), root) > _EASY * (lengths.upper + lengths.fore)
    return Contact(*(float(np.broadcast_to(t, price.shape)[best]) for t in tries)), stretched


@dataclass(frozen=True, slots=True, eq=False)
class _Body:
    """What an arm must heed of its body: its side, 1 right and −1 left, its joints' limits and the trunk."""

    side: float
    limits: Limits
    trunk: Capsules
    stature_m: float

    @classmethod
    def of(cls, kit: Kit, figure: Figure, root: Point, other: Point, side: float) -> "_Body":
        """The body with the arm's own and the other shoulder there."""
        right, left = (np.array(p)[None] for p in ((root, other) if side > 0 else (other, root)))
        pelvis = np.array(pelvis_of(kit, figure))[None]
        capsules = trunk_capsules(pelvis, 0.5 * (right + left), (right, left), figure.stature_m)
        return cls(side, figure.limits, capsules, figure.stature_m)

    def deep(self, arm: Arm) -> Array:
        """How deep the arm and hand are in the trunk, or nearer than they like, (n,)."""
        points = points_of(arm)
        parts = ("hand", "forearm", "upper arm")
        deep = [in_capsules(points, part, self.trunk, CHEST, self.stature_m) for part in parts]
        return np.asarray(np.maximum(np.max(deep, axis=0) + _OFF_M, 0.0))


_BODY_EASE_M, _OFF_M = 0.008, 0.020
"""An arm is this far off the trunk where it can be, for the trunk moves, and so much nearer costs as much as 25° of the
wrist (our choice)."""


def _beyond(arm: Arm, side: float, limits: Limits) -> Array:
    """By how much the wrist is bent beyond what its limits leave to strokes and styles, radians."""
    over = (
        arm.extension - limits.wrist_extension,
        -arm.extension - limits.wrist_flexion,
        side * arm.deviation - limits.wrist_radial,
        -side * arm.deviation - limits.wrist_ulnar,
    )
    return np.asarray(sum(np.maximum(o + _SPARE, 0.0) for o in over))


@dataclass(frozen=True, slots=True)
class _Slopes:
    """How the stick wants to lie.

    What touches and how much stick is beyond it, its slope, the hand's roll where it is not its grip's, its way in plan
    where that is fixed, whether its shaft lies on the rim, and how `free` it is to turn, 0 … 1.
    """

    ahead_m: float
    beyond_m: float
    rise: float
    hand_roll: float | None = None
    azimuth: float | None = None
    on_rim: bool = False
    free: float = 1.0


def _slopes(lengths: ArmLengths, target: Target, hold: Hold, strike: Strike, length_m: float) -> _Slopes:
    h, palm, ahead = lengths.hand, hold.grip.closed_rad, lengths.ahead
    if strike.articulation == GRAB:
        return _Slopes(0.0, lengths.ahead, target.rise_rad)
    if strike.articulation == Articulation.CROSS_STICK:
        laid = _LAID_AHEAD * length_m
        if hold.grip.turns_hand:
            return _Slopes(laid, ahead - laid, _LAID_RISE, hand_roll=0.0)
        return _Slopes(laid, ahead - laid, _LAID_IN_THE_WEB)
    if target.shoulder:
        ahead -= SHOULDER_OF_STICK * length_m
    lean = math.atan2(h * math.sin(palm), ahead + h * math.cos(palm))  # between the stick and the line to the wrist
    rise = target.rise_rad - lean
    on_rim = strike.articulation == Articulation.RIM_SHOT
    return _Slopes(ahead, lengths.ahead - ahead, rise, on_rim=on_rim)


def _over_the_piece(target: Target, root: Point, stick_yaw: float, slopes: _Slopes) -> float:
    """The stick's slope, bent as little as is needed for its shaft and its end to stay over the struck surface.

    With the plan direction u towards the player the shaft leaves the plane by cos e · (u·n) + sin e · n_z, which is
    R sin(e + ψ): for the shaft it must be positive, for the end beyond the touch negative by what the zone is raised.
    """
    nx, ny, nz = target.normal.tolist()
    towards = math.atan2(root[1] - float(target.point_m[1]), root[0] - float(target.point_m[0])) + stick_yaw
    lean = math.cos(towards) * nx + math.sin(towards) * ny
    size, turn = math.hypot(lean, nz), math.atan2(lean, nz)
    if slopes.on_rim:
        to_rim_m = _way_to_the_rim(target, math.cos(towards), math.sin(towards))
        return arcsine(math.sin(math.atan2(RIM_ABOVE_HEAD_M, to_rim_m)) / size) - turn
    if slopes.beyond_m <= 0 or not target.shoulder:
        return max(slopes.rise, arcsine(_SHAFT_CLEAR / size) - turn) if slopes.azimuth is None else slopes.rise
    over = (_END_CLEAR_M - target.raised_m) / slopes.beyond_m
    return min(slopes.rise, arcsine(-over / size) - turn)


def _way_to_the_rim(target: Target, ux: float, uy: float) -> float:
    """How far it is in plan from the struck point to the rim, along the unit direction (`ux`, `uy`)."""
    x, y = (float(d) for d in (target.point_m - target.centre_m)[:2])
    along = x * ux + y * uy
    return math.sqrt(max(along * along - x * x - y * y + target.radius_m**2, 0.0)) - along


_SHAFT_CLEAR = math.sin(math.radians(2.5))
_END_CLEAR_M = 0.006
"""How far shaft and end stay off the surface that is not struck by them (our choice)."""


def _turn(root: Point, target: Target, azimuth: float) -> float:
    """The yaw that makes the stick point to `azimuth` (from straight ahead, to the left positive)."""
    towards = math.atan2(root[1] - float(target.point_m[1]), root[0] - float(target.point_m[0]))
    return math.remainder(azimuth - math.pi / 2 - towards, 2 * math.pi)
