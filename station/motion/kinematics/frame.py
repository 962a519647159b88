"""The whole drummer at one instant or many, as one flat row of numbers: the layout that poses are cut from.

Everything that moves is evaluated at its time and carried forward from the pelvis to the tips. The same lines run on
floats, for a live pose, and on arrays, for a whole performance (`maths`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from station.motion.kinematics.arm import ArmLengths, Contact, Offsets
from station.motion.kinematics.arm import chain as arm_chain
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.foot_path import FootPath
from station.motion.kinematics.leg import Footing, Place
from station.motion.kinematics.leg import chain as leg_chain
from station.motion.kinematics.maths import ONE, Maths, Number, Point
from station.motion.kinematics.pedal_motion import BEATER_SWING_RAD, OPEN_GAP_M
from station.motion.kinematics.trunk import LEAN_TO_HEAD
from station.motion.kinematics.trunk import chain as trunk_chain

JOINTS = slice(0, 63)
BUTT, TIP, PALM = slice(63, 69), slice(69, 75), slice(75, 81)
FACING, HEAD_UP = slice(81, 84), slice(84, 87)
ANGLES, BOARDS = slice(87, 115), slice(115, 117)
BEATER, GAP, EYES = 117, 118, 119
SLAVE_BOARD, SLAVE_BEATER = 120, 121
FACE, GAZE = slice(122, 126), slice(126, 128)
PLAYED = 128
"""Where the instruments' numbers begin, `instruments.NUMBERS` each."""

STAND_M = (0.10, 0.30)
"""How far forward and up the pelvis goes to stand (our choice)."""
HAND_STANDING_RAD = math.radians(30)
"""Who stands plays from above: the wrists are higher over the sticks, and bend back no farther than they can; from half
the way up on, for who is half up for a crash plays upward (our choice)."""


BodyNow = tuple[Number, ...]
"""What the body's channels say: the first seven of `body.CHANNELS`, the look's bearing and pitch in space, the head's
nod, tilt and chin, how far the eyes are open, and the face."""

HandNow = tuple[Sequence[Number], Sequence[Number]]
"""What one hand's channels say: its contact without the style's wing, and its stroke, in the order of `Contact` and
`Offsets`."""


class FeetNow(NamedTuple):
    """What the feet's channels say.

    The boards of `kick` and `slave`, 0 down … 1 raised, and how far the `hat` is open; how far the heels rock, radians;
    the `phase` of the hi-hat foot's way to the slave, 0 at home … 1 there.
    """

    kick: Number
    hat: Number
    slave: Number
    kick_heel: Number
    hat_heel: Number
    phase: Number


@dataclass(frozen=True, slots=True)
class Rig:
    """The parts that do not move: measures, the rolled hands, the feet's places.

    `footings` of the kick's and the hi-hat's foot, `raised` the angles to which the boards of kick, hi-hat and slave
    are raised, `path` the way of a foot that has two boards.
    """

    figure: Figure
    pelvis: Point
    arms: tuple[ArmLengths, ArmLengths]
    rolls: tuple[float, float]
    footings: tuple[Footing, Footing]
    raised: tuple[float, float, float]
    path: FootPath | None
    heel: float
    right_kicks: bool
    neck_rad: float
    hip_m: float

    def row(self, m: Maths, now: BodyNow, right: HandNow, left: HandNow, feet: FeetNow) -> list[Number]:
        """All numbers but the instruments'."""
        twist, lean, side, shrug, hunch, wing, stand, bearing, pitch, bob, tilt, chin, eyes, *face_now = now
        figure, hip, heel = self.figure, self.hip_m, self.heel
        x, y, z = self.pelvis
        y, z = y + STAND_M[0] * stand, z + STAND_M[1] * stand
        # the look is held in space, within what a neck can do
        most = self.neck_rad
        turn = m.most(m.least(FOLLOWS * bearing - twist, most), -most)
        nod, tilt = bob + LOOK_DOWN * pitch, tilt - TILT_OF_TURN * turn
        hand = HAND_STANDING_RAD * m.most(2 * stand - 1, 0.0)
        spine, right_shoulder, left_shoulder, face = trunk_chain(
            m, figure, (x, y, z), (twist, lean, side, nod, turn, tilt, shrug, hunch, chin)
        )
        # the eyes do what the head leaves of the look
        aside = m.most(m.least(bearing - twist - turn, EYES_RAD), -EYES_RAD)
        down = m.most(m.least(pitch - LEAN_TO_HEAD * lean - nod, EYES_RAD), -EYES_RAD)
        arm_a, butt_a, tip_a, back_a, angles, _ = arm_chain(m, self.arms[0], right_shoulder, *right, (wing, hand))
        heading_a, shoulder_a, elbow_a, wrist_a, aside_a, palm_a, swing_a = angles
        arm_b, butt_b, tip_b, back_b, angles, _ = arm_chain(m, self.arms[1], left_shoulder, *left, (-wing, hand))
        heading_b, shoulder_b, elbow_b, wrist_b, aside_b, palm_b, swing_b = angles
        kick = feet.kick * self.raised[0]
        kick_side = hip if self.right_kicks else -hip
        kicking, hatting = self.footings
        kick_leg, kick_bent = leg_chain(
            m, kicking, kicking.home, (x + kick_side, y, z), kick, heel * (0.6 + 0.4 * feet.kick) + feet.kick_heel
        )
        hat, place, under, tip = self._hat_foot(m, feet)
        hat_leg, hat_bent = leg_chain(m, hatting, place, (x - kick_side, y, z), under, tip)
        if self.right_kicks:
            legs, bent, boards = (*kick_leg, x - hip, y, z, *hat_leg), (*kick_bent, *hat_bent), (kick, hat)
        else:
            legs, bent, boards = (*hat_leg, x - hip, y, z, *kick_leg), (*hat_bent, *kick_bent), (hat, kick)
        rolled_a = self.rolls[0] + right[0][ROLL] + (1 - right[0][TURNS]) * right[1][WRIST]
        rolled_b = self.rolls[1] + left[0][ROLL] + (1 - left[0][TURNS]) * left[1][WRIST]
        # a row a line, as the layout has them
        # fmt: off
        return [
            x, y, z, *spine, *arm_a, *arm_b, x + hip, y, z, *legs,
            *butt_a, *butt_b, *tip_a, *tip_b, *back_a, *back_b, *face,
            twist, lean, side, nod, turn, tilt,
            heading_a, shoulder_a, swing_a, elbow_a, wrist_a, aside_a, rolled_a, palm_a,
            heading_b, shoulder_b, -swing_b, elbow_b, wrist_b, -aside_b, rolled_b, palm_b,
            *bent, *boards, feet.kick * BEATER_SWING_RAD, feet.hat * OPEN_GAP_M, eyes,
            feet.slave * self.raised[2], feet.slave * BEATER_SWING_RAD,
            *face_now,
            aside, down,
        ]
        # fmt: on

    def _hat_foot(self, m: Maths, feet: FeetNow) -> tuple[Number, Place, Number, Number]:
        """The hi-hat's board, where its foot is, how far the board under the foot is raised, and the sole's tip."""
        raised, heel, footing = self.raised, self.heel, self.footings[1]
        if self.path is None or (m is ONE and feet.phase == 0.0):
            board = feet.hat * raised[1]
            return board, footing.home, board, heel * (0.6 + 0.4 * feet.hat) + feet.hat_heel
        side, lift, released = self.path.at(m, feet.phase)
        hat = feet.hat + (1.0 - feet.hat) * released
        share = hat + side * (feet.slave - hat)
        board, slave = hat * raised[1], feet.slave * raised[2]
        tip = (heel * (0.6 + 0.4 * share) + feet.hat_heel) * (1.0 - lift)  # in the air the heel hangs: low knees
        return board, footing.between(m, side, lift), board + side * (slave - board), tip


TURNS, ROLL = (Contact._fields.index(name) for name in ("turns", "roll"))
WRIST = Offsets._fields.index("wrist")
FOLLOWS = 0.9
"""How far the head turns to what is looked at; the eyes do the rest (our choice)."""
LOOK_DOWN = 0.45
"""How much of the way down to a drum the head nods; the eyes do the rest (our choice)."""
EYES_RAD = math.radians(35)
"""Eyes turn so far in the head before the neck does the rest (general knowledge: comfortable to 30–35°)."""
TILT_OF_TURN = 0.12
"""A head that turns tilts a little with it (our choice)."""
