"""One instant of the drummer and the kit, ready to be drawn.

Metres, radians, seconds from the score's tick 0; axes as in `station.motion.kit.kit`. A pose is a value: what draws it
needs nothing else of motion but the `Kit` and `Figure` that it was made for. Arrays are read by position, cheaply: the
joints by `Joint`, the sides by `RIGHT` and `LEFT`, the pieces in the order of `Kit.pieces`.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics import frame
from station.motion.kinematics.grip import Hold
from station.motion.kit.instruments import NUMBERS

RIGHT, LEFT = 0, 1

ANGLE_NAMES: tuple[str, ...] = (
    "torso_twist",  # λ, about z, positive to the left
    "torso_lean",  # ω, forward
    "torso_side",  # to the right
    "head_nod",  # down, against the torso
    "head_turn",  # to the left, against the torso
    "head_tilt",  # to the right, against the torso
    "right_shoulder_twist",  # κ, the arm plane's heading from straight ahead, positive to the left
    "right_shoulder",  # γ, forward from hanging
    "right_shoulder_wing",  # the elbow out of the vertical plane, outward
    "right_elbow",  # β, flexion
    "right_wrist",  # α, extension
    "right_wrist_side",  # deviation towards the thumb
    "right_forearm",  # roll from palm down, thumb upward
    "right_stick",  # μ, the stick in the hand
    "left_shoulder_twist",
    "left_shoulder",
    "left_shoulder_wing",
    "left_elbow",
    "left_wrist",
    "left_wrist_side",
    "left_forearm",
    "left_stick",
    "right_hip",  # flexion
    "right_knee",
    "right_ankle",  # dorsiflexion
    "left_hip",
    "left_knee",
    "left_ankle",
)


_STICKS = [ANGLE_NAMES.index("right_stick"), ANGLE_NAMES.index("left_stick")]
OPEN_FINGERS_RAD = math.radians(40)
"""How far the stick sinks in a hand whose fingers are quite open: with that of the contact, the limit of
`limits.Limits.fingers`."""
_PLAIN = Hold.of("american", "stick")

_FACE_LOW = np.array([-1.0, 0.0, -1.0, 0.0])


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Everything that moves at `time_s`: one `row` of numbers in the layout of `frame`, and views into it.

    `holds` are what the right and the left hand hold, and how.
    """

    time_s: float
    row: NDArray[np.float64]
    holds: tuple[Hold, Hold] = (_PLAIN, _PLAIN)

    @property
    def joints_m(self) -> NDArray[np.float64]:
        """Positions, (21, 3) by `figure.Joint`."""
        return self.row[frame.JOINTS].reshape(21, 3)

    @property
    def angles_rad(self) -> NDArray[np.float64]:
        """Joint angles, (28,) by `ANGLE_NAMES`."""
        return self.row[frame.ANGLES]

    @property
    def butt_m(self) -> NDArray[np.float64]:
        """The butts of the right and the left stick, (2, 3)."""
        return self.row[frame.BUTT].reshape(2, 3)

    @property
    def tip_m(self) -> NDArray[np.float64]:
        """The tips of the right and the left stick, (2, 3)."""
        return self.row[frame.TIP].reshape(2, 3)

    @property
    def palm(self) -> NDArray[np.float64]:
        """The unit normals of the backs of the hands, (2, 3)."""
        return self.row[frame.PALM].reshape(2, 3)

    @property
    def facing(self) -> NDArray[np.float64]:
        """Where the face looks, a unit vector."""
        return self.row[frame.FACING]

    @property
    def head_up(self) -> NDArray[np.float64]:
        """From the neck to the crown, a unit vector."""
        return self.row[frame.HEAD_UP]

    @property
    def fingers(self) -> NDArray[np.float64]:
        """How far the fingers of the right and the left hand are closed about the stick, (2,) 0 open … 1 closed.

        They open as the stick rises in the hand and close at the fulcrum for the stroke.
        """
        closed = [hold.grip.closed_rad for hold in self.holds]
        return np.clip(1.0 - (self.angles_rad[_STICKS] - closed) / OPEN_FINGERS_RAD, 0.0, 1.0)

    @property
    def footboard_rad(self) -> tuple[float, float]:
        """How far the boards at which the right and the left foot are at home are raised over flat."""
        right, left = self.row[frame.BOARDS].tolist()
        return right, left

    @property
    def beater_rad(self) -> float:
        """The kick beater's angle back from the head, which it touches at 0."""
        return self.row.item(frame.BEATER)

    @property
    def slave_rad(self) -> tuple[float, float]:
        """The slave board of a double pedal, raised over flat, and its beater's angle back from the head."""
        return self.row.item(frame.SLAVE_BOARD), self.row.item(frame.SLAVE_BEATER)

    @property
    def hat_gap_m(self) -> float:
        """Between the cymbals of the hi-hat."""
        return self.row.item(frame.GAP)

    @property
    def eyes(self) -> float:
        """0 closed … 1 open."""
        return self.row.item(frame.EYES)

    @property
    def face(self) -> NDArray[np.float64]:
        """Brow (−1 frown … 1 raised), mouth (0 shut … 1 open), smile (−1 … 1), effort (0 … 1 narrowed, tense), (4,)."""
        return np.clip(self.row[frame.FACE], _FACE_LOW, 1.0)

    @property
    def gaze(self) -> NDArray[np.float64]:
        """The eyes' turn in the head, to the left and down, radians, (2,)."""
        return self.row[frame.GAZE]

    @property
    def swing_rad(self) -> NDArray[np.float64]:
        """How far each piece, in `Kit.pieces`' order, has tipped about its own right and away axes, (pieces, 2)."""
        return self._played[:, :2]

    @property
    def flash(self) -> NDArray[np.float64]:
        """How brightly each piece's last stroke still shows, (pieces,) 0 … 1."""
        return self._played[:, 2]

    @property
    def ripple(self) -> NDArray[np.float64]:
        """How each head gives way, (pieces, 4): metres, where it was struck along right and away, seconds since."""
        return self._played[:, 3:]

    @property
    def _played(self) -> NDArray[np.float64]:
        return self.row[frame.PLAYED :].reshape(-1, NUMBERS)
