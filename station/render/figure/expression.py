"""How a face moves: the matrices of its bones against the head, from a few numbers that say its mood.

Metres in the head's own axes (`head_shape`): x to the right, y where the face looks, z up, designed for `HEAD_M`.
"""

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.pose import Pose
from station.render.figure.bones import FACE_BONES, Bone
from station.render.geometry.transforms import Matrix

Array = NDArray[np.float64]

EYE_M = np.array([0.0335, 0.0720, 0.098])
"""The middle of the right eyeball."""
MOUTH_M = np.array([0.0215, 0.0880, 0.0330])
"""The right corner of the mouth."""
BROW_M = np.array([0.0330, 0.0920, 0.1260])
"""The middle of the right brow."""
HINGE_M = np.array([0.0, 0.010, 0.066])
"""Between the joints of the jaw, before the ears."""

LID_OPEN_RAD, LOWER_LID_RAD = 0.60, -0.62
"""How far above and below straight ahead the lids' edges stand in open eyes (our choice: the iris's top is covered)."""
_LIDS_MEET_RAD = -0.45
"""Where the lids meet: the upper one goes most of the way."""
_MOST_GAZE_RAD = 0.6
"""Eyes turn no farther in the head; a head follows long before (our choice: a third of a turn of the whole white)."""


@dataclass(frozen=True, slots=True)
class Expression:
    """`brow` −1 frowns … 1 raised, `mouth` 0 shut … 1 open, `smile` −1 … 1, `effort` 0 … 1, `gaze` left and down in
    radians, `eyes` 0 closed … 1 open."""

    brow: float = 0.0
    mouth: float = 0.0
    smile: float = 0.25
    effort: float = 0.0
    gaze: tuple[float, float] = (0.0, 0.0)
    eyes: float = 1.0

    @classmethod
    def of(cls, pose: Pose) -> "Expression":
        """That of a pose."""
        face, gaze = getattr(pose, "face", None), getattr(pose, "gaze", (0.0, 0.0))
        if face is None:
            return cls(eyes=pose.eyes)
        brow, mouth, smile, effort = (float(value) for value in face)
        return cls(brow, mouth, smile, effort, (float(gaze[0]), float(gaze[1])), pose.eyes)


_AT = {bone: i for i, bone in enumerate(FACE_BONES)}


def face_matrices(shown: Expression) -> Matrix:
    """What each bone of `FACE_BONES` does to the face as it was made, (11, 4, 4) in the head's axes."""
    m = np.zeros((len(FACE_BONES), 4, 4))
    m[:] = np.eye(4)
    smile, effort = shown.smile, shown.effort
    glad, sad = max(smile, 0.0), max(-smile, 0.0)
    left, down = (min(max(turn, -_MOST_GAZE_RAD), _MOST_GAZE_RAD) for turn in shown.gaze)
    for bone, side in ((Bone.RIGHT_EYE, 1.0), (Bone.LEFT_EYE, -1.0)):
        _turn(m[_AT[bone]], _about_x(-down) @ _about_z(left), EYE_M * (side, 1.0, 1.0))
    narrow = 0.34 * effort + 0.16 * glad
    lower = LOWER_LID_RAD + (0.9 * narrow - 0.3 * min(down, 0.0)) * shown.eyes
    upper = LID_OPEN_RAD - narrow * 0.7 - 0.55 * down + 0.14 * max(shown.brow, 0.0) - 0.12 * max(-shown.brow, 0.0)
    upper = _LIDS_MEET_RAD + (max(upper, _LIDS_MEET_RAD + 0.05) - _LIDS_MEET_RAD) * shown.eyes
    lower = _LIDS_MEET_RAD + (lower - _LIDS_MEET_RAD) * shown.eyes
    _turn(m[_AT[Bone.UPPER_LIDS]], _about_x(upper - LID_OPEN_RAD), EYE_M * (0.0, 1.0, 1.0))
    _turn(m[_AT[Bone.LOWER_LIDS]], _about_x(lower - LOWER_LID_RAD), EYE_M * (0.0, 1.0, 1.0))
    raised, frown = max(shown.brow, 0.0), max(-shown.brow, 0.0) + 0.45 * effort
    for bone, side in ((Bone.RIGHT_BROW, 1.0), (Bone.LEFT_BROW, -1.0)):
        tip = side * (0.34 * frown - 0.12 * raised - 0.10 * sad)
        shift = (-0.0035 * side * frown, 0.001 * frown, 0.0085 * raised - 0.0050 * frown)
        _turn(m[_AT[bone]], _about_y(-tip), BROW_M * (side, 1.0, 1.0), shift)
    opened = shown.mouth
    _turn(m[_AT[Bone.JAW]], _about_x(-0.17 * opened), HINGE_M, (0.0, 0.0015 * effort, 0.0))
    m[_AT[Bone.UPPER_LIP]][:3, 3] = 0.0, -0.001 * glad, 0.0025 * opened + 0.0012 * glad - 0.0008 * effort
    m[_AT[Bone.LOWER_LIP]][:3, 3] = 0.0, -0.003 * opened, -0.0155 * opened + 0.0006 * glad + 0.0010 * effort
    for bone, side in ((Bone.RIGHT_CORNER, 1.0), (Bone.LEFT_CORNER, -1.0)):
        out = 0.0065 * glad - 0.0035 * opened + 0.0035 * effort - 0.001 * sad
        m[_AT[bone]][:3, 3] = side * out, -0.0035 * glad, 0.0080 * glad - 0.0075 * sad - 0.0045 * opened
    return m


def _turn(m: Matrix, turn: Array, about: Array, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
    """Make `m` the rotation `turn` about a point, and a shift after it."""
    m[:3, :3] = turn
    m[:3, 3] = about - turn @ about + shift


def _about_x(angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _about_y(angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def _about_z(angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
