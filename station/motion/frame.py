"""The whole drummer at one instant or many, as one flat row of numbers: the layout that poses are cut from.

Everything that moves is evaluated at its time and carried forward from the pelvis to the tips. The same lines run on
floats, for a live pose, and on arrays, for a whole performance (`maths`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.motion.arm import Arm, ArmLengths, Contact, Offsets, solve
from station.motion.figure import Figure
from station.motion.leg import Footing, leg
from station.motion.maths import Maths, Number, Point
from station.motion.pedals import BEATER_SWING_RAD, OPEN_GAP_M
from station.motion.trunk import TrunkAngles, trunk

JOINTS = slice(0, 63)
BUTT, TIP, PALM = slice(63, 69), slice(69, 75), slice(75, 81)
FACING, HEAD_UP = slice(81, 84), slice(84, 87)
ANGLES, BOARDS = slice(87, 115), slice(115, 117)
BEATER, GAP, EYES = 117, 118, 119
PLAYED = 120
"""Where the instruments' four numbers each begin."""

STAND_M = (0.10, 0.30)
"""How far forward and up the pelvis goes to stand (our choice)."""


@dataclass(frozen=True, slots=True)
class HandNow:
    """What one hand's channels say: its contact without the style's wing, and its stroke."""

    contact: Contact
    offsets: Offsets


@dataclass(frozen=True, slots=True)
class BodyNow:
    """What the body's channels say: `body.CHANNELS`, the look's bearing and pitch in space, the bob and the eyes."""

    twist: Number
    lean: Number
    side: Number
    shrug_m: Number
    wing: Number
    stand: Number
    bearing: Number
    pitch: Number
    bob: Number
    eyes: Number


@dataclass(frozen=True, slots=True)
class Rig:
    """The parts that do not move: measures, the rolled hands, the feet's places, how far the head follows the look."""

    figure: Figure
    pelvis: Point
    arms: tuple[ArmLengths, ArmLengths]
    rolls: tuple[float, float]
    footings: tuple[Footing, Footing]
    raised: tuple[float, float]
    heel: float
    kick_side: int
    gaze: float

    def row(self, m: Maths, now: BodyNow, hands: Sequence[HandNow], boards: tuple[Number, Number]) -> list[Number]:
        """All numbers but the instruments'; `boards` of the right and the left foot, 0 down … 1 raised."""
        figure = self.figure
        x, y, z = self.pelvis
        y, z = y + STAND_M[0] * now.stand, z + STAND_M[1] * now.stand
        pelvis = (x, y, z)
        nod, turn, tilt = self._head(m, now)
        body = trunk(m, figure, pelvis, TrunkAngles(now.twist, now.lean, now.side, nod, turn, tilt, now.shrug_m))
        arms = [
            solve(m, self.arms[k], shoulder, _winged(hand.contact, wing), hand.offsets)
            for k, (hand, shoulder, wing) in enumerate(
                zip(hands, (body.right_shoulder, body.left_shoulder), (now.wing, -now.wing), strict=True)
            )
        ]
        half = figure.hip_breadth_m / 2
        hips = ((x + half, y, z), (x - half, y, z))
        angled = boards[0] * self.raised[0], boards[1] * self.raised[1]
        lifted = [self.heel * (0.6 + 0.4 * b) for b in boards]
        legs = [leg(m, f, h, b, e) for f, h, b, e in zip(self.footings, hips, angled, lifted, strict=True)]
        right, left = arms
        row: list[Number] = [*pelvis, *body.spine, *body.neck, *body.head, *body.crown]
        for arm in arms:
            row += [*arm.root, *arm.elbow, *arm.wrist, *arm.hand]
        for hip, one in zip(hips, legs, strict=True):
            row += [*hip, *one.knee, *one.ankle, *one.toe]
        row += [*right.butt, *left.butt, *right.tip, *left.tip]
        for k, arm in enumerate(arms):
            row += _rolled(m, arm, self.arms[k].hand, self.rolls[k], k)
        row += [*body.facing, *body.head_up, now.twist, now.lean, now.side, nod, turn, tilt]
        for k, (arm, hand) in enumerate(zip(arms, hands, strict=True)):
            side = -1.0 if k else 1.0
            wing = side * hand.contact.wing + now.wing
            row += [arm.heading, arm.shoulder, wing, arm.elbow_bend]
            row += [arm.extension, side * arm.deviation, self.rolls[k], arm.palm]
        for one in legs:
            row += one.angles
        kick = boards[self.kick_side]
        row += [*angled, kick * BEATER_SWING_RAD, boards[1 - self.kick_side] * OPEN_GAP_M, now.eyes]
        return row

    def _head(self, m: Maths, now: BodyNow) -> tuple[Number, Number, Number]:
        """Nod, turn and tilt against the trunk: the look is held in space, within what a neck can do."""
        most = self.figure.limits.neck_rotation
        turn = m.most(m.least(self.gaze * now.bearing - now.twist, most), -most)
        return now.bob + self.gaze * LOOK_DOWN * now.pitch, turn, -TILT_OF_TURN * turn


LOOK_DOWN = 0.5
"""How much of the way down to a drum the head nods; the eyes do the rest (our choice)."""
TILT_OF_TURN = 0.12
"""A head that turns tilts a little with it (our choice)."""


def _winged(contact: Contact, wing: Number) -> Contact:
    return contact._replace(wing=contact.wing + wing)


def _rolled(m: Maths, arm: Arm, hand_m: float, roll: float, side: int) -> Point:
    """The normal of the hand's back, rolled about the hand with the thumb upward."""
    nx, ny, nz = arm.back
    px, py, pz = ((h - w) / hand_m for h, w in zip(arm.hand, arm.wrist, strict=True))
    outward = (-1.0 if side else 1.0) * m.sin(roll)
    upward = m.cos(roll)
    return (
        nx * upward + (py * nz - pz * ny) * outward,
        ny * upward + (pz * nx - px * nz) * outward,
        nz * upward + (px * ny - py * nx) * outward,
    )
