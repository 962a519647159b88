"""One instant of the drummer and the kit, ready to be drawn.

Metres, radians, seconds from the score's tick 0; axes as in `station.motion.kit`. A pose is a value: what draws it
needs nothing else of motion but the `Kit` and `Figure` that it was made for. Arrays are read by position, cheaply: the
joints by `Joint`, the sides by `RIGHT` and `LEFT`, the pieces in the order of `Kit.pieces`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion import frame

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


@dataclass(frozen=True, slots=True)
class Pose:
    """Everything that moves at `time_s`.

    `joints_m` (21, 3) by `figure.Joint`; `angles_rad` (28,) by `ANGLE_NAMES`; `butt_m`, `tip_m` (2, 3) the ends of the
    right and the left stick; `palm` (2, 3) the unit normals of the backs of the hands; `facing`, `head_up` (3,) the
    head's directions. `footboard_rad` the kick's and the hi-hat's footboard over flat; `beater_rad` the beater's angle
    back from the head that it touches at 0; `hat_gap_m` between the cymbals.
    `swing_rad` (pieces, 2) how far a piece has tipped about its own right and away axes; `flash` (pieces,) 0 … 1, how
    brightly its last stroke still shows; `ripple_m` (pieces,) how deep its head is pressed at the centre.
    `eyes` 0 closed … 1 open.
    """

    time_s: float
    joints_m: NDArray[np.float64]
    angles_rad: NDArray[np.float64]
    butt_m: NDArray[np.float64]
    tip_m: NDArray[np.float64]
    palm: NDArray[np.float64]
    facing: NDArray[np.float64]
    head_up: NDArray[np.float64]
    footboard_rad: tuple[float, float]
    beater_rad: float
    hat_gap_m: float
    swing_rad: NDArray[np.float64]
    flash: NDArray[np.float64]
    ripple_m: NDArray[np.float64]
    eyes: float

    @classmethod
    def of(cls, time_s: float, row: NDArray[np.float64]) -> "Pose":
        """The pose that `row` holds in the layout of `frame`."""
        played = row[frame.PLAYED :].reshape(-1, 4)
        boards_right, boards_left, beater, gap, eyes = row[frame.BOARDS.start : frame.PLAYED].tolist()
        return cls(
            time_s,
            row[frame.JOINTS].reshape(21, 3),
            row[frame.ANGLES],
            row[frame.BUTT].reshape(2, 3),
            row[frame.TIP].reshape(2, 3),
            row[frame.PALM].reshape(2, 3),
            row[frame.FACING],
            row[frame.HEAD_UP],
            (boards_right, boards_left),
            beater,
            gap,
            played[:, :2],
            played[:, 2],
            played[:, 3],
            eyes,
        )
