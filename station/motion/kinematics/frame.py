"""The whole drummer at one instant or many, as one flat row of numbers: the layout that poses are cut from.

Everything that moves is evaluated at its time and carried forward from the pelvis to the tips. The same lines run on
floats, for a live pose, and on arrays, for a whole performance (`maths`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from station.motion.kinematics.arm import ArmLengths, Contact, Offsets
from station.motion.kinematics.arm import chain as arm_chain
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.leg import Footing
from station.motion.kinematics.leg import chain as leg_chain
from station.motion.kinematics.leg import settled as settled_leg
from station.motion.kinematics.maths import ONE, Maths, Number, Point
from station.motion.kinematics.pedal_motion import BEATER_SWING_RAD, OPEN_GAP_M
from station.motion.kinematics.trunk import chain as trunk_chain

JOINTS = slice(0, 63)
BUTT, TIP, PALM = slice(63, 69), slice(69, 75), slice(75, 81)
FACING, HEAD_UP = slice(81, 84), slice(84, 87)
ANGLES, BOARDS = slice(87, 115), slice(115, 117)
BEATER, GAP, EYES = 117, 118, 119
PLAYED = 120
"""Where the instruments' four numbers each begin."""

STAND_M = (0.10, 0.30)
"""How far forward and up the pelvis goes to stand (our choice)."""
HAND_STANDING_RAD = math.radians(30)
"""Who stands plays from above: the wrists are higher over the sticks, and bend back no farther than they can. By half
the way up they are there (our choice)."""


BodyNow = tuple[Number, ...]
"""What the body's channels say: `body.CHANNELS`, the look's bearing and pitch in space, head and eyes."""

HandNow = tuple[Sequence[Number], Sequence[Number]]
"""What one hand's channels say: its contact without the style's wing, and its stroke, in the order of `Contact` and
`Offsets`."""


@dataclass(frozen=True, slots=True)
class Rig:
    """The parts that do not move: measures, the rolled hands, the feet's places."""

    figure: Figure
    pelvis: Point
    arms: tuple[ArmLengths, ArmLengths]
    rolls: tuple[float, float]
    footings: tuple[Footing, Footing]
    raised: tuple[float, float]
    heel: float
    right_kicks: bool
    neck_rad: float
    hip_m: float

    def row(self, m: Maths, now: BodyNow, right: HandNow, left: HandNow, boards: tuple[Number, Number]) -> list[Number]:
        """All numbers but the instruments'; `boards` of the right and the left foot, 0 down … 1 raised."""
        twist, lean, side, shrug, wing, stand, bearing, pitch, bob, tilt, eyes = now
        figure, hip, heel = self.figure, self.hip_m, self.heel
        x, y, z = self.pelvis
        y, z = y + STAND_M[0] * stand, z + STAND_M[1] * stand
        # the look is held in space, within what a neck can do
        most = self.neck_rad
        turn = m.most(m.least(FOLLOWS * bearing - twist, most), -most)
        nod, tilt = bob + LOOK_DOWN * pitch, tilt - TILT_OF_TURN * turn
        hand = HAND_STANDING_RAD * m.least(2 * stand, 1.0)
        spine, right_shoulder, left_shoulder, face = trunk_chain(
            m, figure, (x, y, z), (twist, lean, side, nod, turn, tilt, shrug)
        )
        arm_a, butt_a, tip_a, back_a, angles, _ = arm_chain(m, self.arms[0], right_shoulder, *right, (wing, hand))
        heading_a, shoulder_a, elbow_a, wrist_a, aside_a, palm_a, swing_a = angles
        arm_b, butt_b, tip_b, back_b, angles, _ = arm_chain(m, self.arms[1], left_shoulder, *left, (-wing, hand))
        heading_b, shoulder_b, elbow_b, wrist_b, aside_b, palm_b, swing_b = angles
        foot_a, foot_b = boards
        board_a, board_b = foot_a * self.raised[0], foot_b * self.raised[1]
        stands = settled_leg if m is ONE else leg_chain
        leg_a, bent_a = stands(m, self.footings[0], (x + hip, y, z), board_a, heel * (0.6 + 0.4 * foot_a))
        leg_b, bent_b = stands(m, self.footings[1], (x - hip, y, z), board_b, heel * (0.6 + 0.4 * foot_b))
        kick, hat = boards if self.right_kicks else (foot_b, foot_a)
        rolled_a = self.rolls[0] + (1 - right[0][TURNS]) * right[1][WRIST]
        rolled_b = self.rolls[1] + (1 - left[0][TURNS]) * left[1][WRIST]
        return [
            *(x, y, z, *spine, *arm_a, *arm_b, x + hip, y, z, *leg_a, x - hip, y, z, *leg_b),
            *(*butt_a, *butt_b, *tip_a, *tip_b, *back_a, *back_b, *face),
            *(twist, lean, side, nod, turn, tilt),
            *(heading_a, shoulder_a, swing_a, elbow_a, wrist_a, aside_a, rolled_a, palm_a),
            *(heading_b, shoulder_b, -swing_b, elbow_b, wrist_b, -aside_b, rolled_b, palm_b),
            *(*bent_a, *bent_b, board_a, board_b, kick * BEATER_SWING_RAD, hat * OPEN_GAP_M, eyes),
        ]


TURNS, WRIST = Contact._fields.index("turns"), Offsets._fields.index("wrist")
FOLLOWS = 0.9
"""How far the head turns to what is looked at; the eyes do the rest (our choice)."""
LOOK_DOWN = 0.45
"""How much of the way down to a drum the head nods; the eyes do the rest (our choice)."""
TILT_OF_TURN = 0.12
"""A head that turns tilts a little with it (our choice)."""
