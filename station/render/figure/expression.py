"""How a face moves: the matrices of its bones against the head, from a few numbers that say its mood.

Metres in the head's own axes (`head_shape`): x to the right, y where the face looks, z up, designed for `HEAD_M`.
"""

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.pose import Pose
from station.render.figure.bones import FACE_BONES
from station.render.geometry.transforms import Matrix

Array = NDArray[np.float64]

EYE_M = np.array([0.0335, 0.0720, 0.098])
"""The middle of the right eyeball."""
MOUTH_M = np.array([0.0235, 0.0880, 0.0330])
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
    """What a face shows.

    `brow` −1 frowns … 1 raised, `mouth` 0 shut … 1 open, `smile` −1 … 1, `effort` 0 … 1, `gaze` left and down in
    radians, `eyes` 0 closed … 1 open.
    """

    brow: float = 0.0
    mouth: float = 0.0
    smile: float = 0.0
    effort: float = 0.0
    gaze: tuple[float, float] = (0.0, 0.0)
    eyes: float = 1.0

    @classmethod
    def of(cls, pose: Pose) -> "Expression":
        """That of a pose."""
        brow, mouth, smile, effort = pose.face.tolist()
        left, down = pose.gaze.tolist()
        return cls(brow, mouth, smile, effort, (left, down), pose.eyes)


_Turn = tuple[float, float, float, float, float, float, float, float, float]
"""A rotation, row by row."""
_Point = tuple[float, float, float]
_NO_TURN: _Turn = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def face_matrices(shown: Expression) -> Matrix:
    """What each bone of `FACE_BONES` does to the face as it was made, (11, 4, 4) in the head's axes."""
    smile, effort, opened = shown.smile, shown.effort, shown.mouth
    glad, sad = max(smile, 0.0), max(-smile, 0.0)
    raised, lowered = max(shown.brow, 0.0), max(-shown.brow, 0.0)
    frown = lowered + 0.45 * effort
    left, down = (min(max(turn, -_MOST_GAZE_RAD), _MOST_GAZE_RAD) for turn in shown.gaze)
    eye = _look(left, down)
    upper, lower = _lids(shown, 0.34 * effort + 0.16 * glad, down, 0.14 * raised - 0.12 * lowered)
    tip = 0.34 * frown - 0.12 * raised - 0.10 * sad
    brow = 0.001 * frown, 0.0085 * raised - 0.0050 * frown
    out = 0.0065 * glad - 0.0035 * opened + 0.0035 * effort - 0.001 * sad
    corner = -0.0035 * glad, 0.0080 * glad - 0.0075 * sad - 0.0045 * opened
    rows = [
        _moved(eye, _RIGHT_EYE),
        _moved(eye, _mirrored(_RIGHT_EYE)),
        _moved(_about_x(upper - LID_OPEN_RAD), _RIGHT_EYE),
        _moved(_about_x(lower - LOWER_LID_RAD), _RIGHT_EYE),
        _moved(_about_y(-tip), _RIGHT_BROW, (-0.0035 * frown, *brow)),
        _moved(_about_y(tip), _mirrored(_RIGHT_BROW), (0.0035 * frown, *brow)),
        _moved(_about_x(-0.17 * opened), _HINGE, (0.0, 0.0015 * effort, 0.0)),
        _moved(_NO_TURN, _HINGE, (0.0, -0.001 * glad, 0.0025 * opened + 0.0012 * glad - 0.0008 * effort)),
        _moved(_NO_TURN, _HINGE, (0.0, -0.003 * opened, -0.0155 * opened + 0.0006 * glad + 0.0010 * effort)),
        _moved(_NO_TURN, _HINGE, (out, *corner)),
        _moved(_NO_TURN, _HINGE, (-out, *corner)),
    ]
    m = np.zeros((len(FACE_BONES), 4, 4))
    m[:, :3] = np.array(rows).reshape(-1, 3, 4)
    m[:, 3, 3] = 1.0
    return m


def _lids(shown: Expression, narrow: float, down: float, wide: float) -> tuple[float, float]:
    """How high the edges of the upper and the lower lids stand; both come together as the eyes close."""
    upper = LID_OPEN_RAD - 0.7 * narrow - 0.55 * down + wide
    lower = LOWER_LID_RAD + 0.9 * narrow - 0.3 * min(down, 0.0)
    upper = max(upper, lower + 0.05)
    meet, open_ = _LIDS_MEET_RAD, shown.eyes
    return meet + (upper - meet) * open_, meet + (lower - meet) * open_


_RIGHT_EYE, _RIGHT_BROW, _HINGE = ((float(p[0]), float(p[1]), float(p[2])) for p in (EYE_M, BROW_M, HINGE_M))


def _mirrored(point: _Point) -> _Point:
    return -point[0], point[1], point[2]


def _moved(turn: _Turn, about: _Point, shift: _Point = (0.0, 0.0, 0.0)) -> tuple[float, ...]:
    """The upper three rows of the matrix that turns about a point and then shifts."""
    a, b, c, d, e, f, g, h, i = turn
    x, y, z = about
    return (
        *(a, b, c, x - a * x - b * y - c * z + shift[0]),
        *(d, e, f, y - d * x - e * y - f * z + shift[1]),
        *(g, h, i, z - g * x - h * y - i * z + shift[2]),
    )


def _about_x(angle: float) -> _Turn:
    c, s = cos(angle), sin(angle)
    return 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c


def _about_y(angle: float) -> _Turn:
    c, s = cos(angle), sin(angle)
    return c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c


def _look(left: float, down: float) -> _Turn:
    """A turn to the left about z, then down about x."""
    c, s, far, deep = cos(left), sin(left), cos(down), sin(down)
    return c, -s, 0.0, far * s, far * c, deep, -deep * s, -deep * c, far
