"""Poses set by hand, for tests of what draws them."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.motion.kinematics import frame
from station.motion.kinematics.figure import Figure, Joint
from station.motion.kinematics.pose import Pose
from station.motion.kit.instruments import NUMBERS
from station.render.figure.skeleton import bind_stance

_PLACES: dict[str, slice | int] = {
    "joints_m": frame.JOINTS,
    "butt_m": frame.BUTT,
    "tip_m": frame.TIP,
    "palm": frame.PALM,
    "facing": frame.FACING,
    "head_up": frame.HEAD_UP,
    "footboard_rad": frame.BOARDS,
    "beater_rad": frame.BEATER,
    "hat_gap_m": frame.GAP,
    "eyes": frame.EYES,
    "face": frame.FACE,
    "gaze": frame.GAZE,
    "slave_rad": slice(frame.SLAVE_BOARD, frame.SLAVE_BEATER + 1),
}


def pose_of(figure: Figure, pieces: int = 0, **values: ArrayLike) -> Pose:
    """The pose in which the skin was made, eyes open and kit at rest, but for `values`, by the names of `Pose`."""
    stance = bind_stance(figure)
    hands = stance.joints_m[[Joint.RIGHT_HAND, Joint.LEFT_HAND]]
    row: NDArray[np.float64] = np.zeros(frame.PLAYED + NUMBERS * pieces)
    plain: dict[str, ArrayLike] = {
        "joints_m": stance.joints_m,
        "butt_m": hands - np.array([0, 0.1, 0]),
        "tip_m": hands + np.array([0, 0.3, 0]),
        "palm": stance.palm,
        "facing": stance.facing,
        "head_up": stance.head_up,
        "eyes": 1.0,
    }
    swing = values.pop("swing_rad", None)
    for name, value in {**plain, **values}.items():
        place = _PLACES[name]
        row[place] = np.ravel(value) if isinstance(place, slice) else float(np.asarray(value))
    if swing is not None:
        row[frame.PLAYED :].reshape(-1, NUMBERS)[:, :2] = swing
    return Pose(0.0, row)
