"""Where a hand lies that has long to wait: on its own thigh, the stick along it.

The thigh is as it lies with the foot at rest on its board, which is as high as it comes: a foot that plays takes the
knee down. Metres; azimuths in radians from straight ahead, to the left positive.
"""

import math

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.leg import HEEL_RAD, Footing, leg
from station.motion.kinematics.maths import ONE
from station.motion.kinematics.posture import pelvis_of
from station.motion.kit.kit import Kit
from station.motion.kit.piece import Target

Array = NDArray[np.float64]

THIGH_SHARE = 0.043
"""A thigh's radius where a hand lies, as a share of the stature: 7.6 cm in a man of 1.759 m, whose mid-thigh is 55 cm
round standing (ANSUR II, Gordon and others 2014: 1st to 99th percentile 47–74 cm at its thickest) and thinner to the
knee."""
_ALONG, _LIES_M = 0.80, 0.034
"""The fulcrum lies so far along the thigh, where an arm that hangs and bends comes to, a hand and a little over it (our
choice)."""


Thigh = tuple[Array, Array]
"""Hip and knee, (3,) each."""


def thighs(kit: Kit, figure: Figure, feet: tuple[Footing, Footing], heel: str) -> tuple[Thigh, Thigh]:
    """The right and the left thigh of a seated figure whose `feet`, the kick's and the hi-hat's, rest on their boards.

    `heel` is "down" or "up".
    """
    x, y, z = pelvis_of(kit, figure)
    found = []
    for right in (True, False):
        kicks = right != kit.left_handed
        footing, pedal = feet[not kicks], kit.pedals[Piece.KICK if kicks else Piece.HIHAT_PEDAL]
        hip = (x + (0.5 if right else -0.5) * figure.hip_breadth_m, y, z)
        knee = leg(ONE, footing, hip, pedal.raised_rad, HEEL_RAD[heel]).knee
        found.append((np.array(hip), np.array(knee)))
    return found[0], found[1]


def lap(figure: Figure, thigh: Thigh) -> tuple[Target, float]:
    """Where the fulcrum of a waiting hand lies on a thigh, and where its stick points."""
    hip, knee = thigh
    x, y, z = ((knee - hip) / np.linalg.norm(knee - hip)).tolist()
    up = np.array([0.0, 0.0, 1.0]) - z * np.array([x, y, z])
    up /= np.linalg.norm(up)
    point = hip + _ALONG * (knee - hip) + (THIGH_SHARE * figure.stature_m + _LIES_M) * up
    return Target(point, up, point, THIGH_SHARE * figure.stature_m, -math.asin(z), False, 0.0), math.atan2(-x, y)
