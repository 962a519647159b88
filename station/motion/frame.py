"""The whole drummer at one instant or many, as one flat row of numbers: the layout that poses are cut from.

Everything that moves is evaluated at its time and carried forward from the pelvis to the tips. The same lines run on
floats, for a live pose, and on arrays, for a whole performance (`maths`).
"""

from dataclasses import dataclass
from typing import NamedTuple

from station.motion.arm import ArmLengths, Contact, Offsets, solve
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


class BodyNow(NamedTuple):
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


HandNow = tuple[Contact, Offsets]
"""What one hand's channels say: its contact without the style's wing, and its stroke."""


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
    right_kicks: bool
    gaze: float
    neck_rad: float
    hip_m: float

    def row(self, m: Maths, now: BodyNow, right: HandNow, left: HandNow, boards: tuple[Number, Number]) -> list[Number]:
        """All numbers but the instruments'; `boards` of the right and the left foot, 0 down … 1 raised."""
        twist, lean, side, shrug, wing, stand, bearing, pitch, bob, eyes = now
        figure, gaze = self.figure, self.gaze
        x, y, z = self.pelvis
        y, z = y + STAND_M[0] * stand, z + STAND_M[1] * stand
        # the look is held in space, within what a neck can do
        most = self.neck_rad
        turn = m.most(m.least(gaze * bearing - twist, most), -most)
        nod, tilt = bob + gaze * LOOK_DOWN * pitch, -TILT_OF_TURN * turn
        spine, neck, head, crown, right_shoulder, left_shoulder, facing, up = trunk(
            m, figure, (x, y, z), TrunkAngles(twist, lean, side, nod, turn, tilt, shrug)
        )
        a = solve(m, self.arms[0], right_shoulder, *right, wing)
        b = solve(m, self.arms[1], left_shoulder, *left, -wing)
        hip, board_a, board_b = self.hip_m, boards[0] * self.raised[0], boards[1] * self.raised[1]
        c = leg(m, self.footings[0], (x + hip, y, z), board_a, self.heel * (0.6 + 0.4 * boards[0]))
        d = leg(m, self.footings[1], (x - hip, y, z), board_b, self.heel * (0.6 + 0.4 * boards[1]))
        kick, hat = boards if self.right_kicks else (boards[1], boards[0])
        return [
            *(x, y, z, *spine, *neck, *head, *crown),
            *(*a.root, *a.elbow, *a.wrist, *a.hand, *b.root, *b.elbow, *b.wrist, *b.hand),
            *(x + hip, y, z, *c.knee, *c.ankle, *c.toe, x - hip, y, z, *d.knee, *d.ankle, *d.toe),
            *(*a.butt, *b.butt, *a.tip, *b.tip, *a.back, *b.back, *facing, *up),
            *(twist, lean, side, nod, turn, tilt),
            *(a.heading, a.shoulder, right[0].wing + wing, a.elbow_bend, a.extension, a.deviation),
            *(self.rolls[0], a.palm, b.heading, b.shoulder, wing - left[0].wing, b.elbow_bend, b.extension),
            *(-b.deviation, self.rolls[1], b.palm, *c.angles, *d.angles),
            *(board_a, board_b, kick * BEATER_SWING_RAD, hat * OPEN_GAP_M, eyes),
        ]


LOOK_DOWN = 0.5
"""How much of the way down to a drum the head nods; the eyes do the rest (our choice)."""
TILT_OF_TURN = 0.12
"""A head that turns tilts a little with it (our choice)."""
