"""Leaning to what is out of the arm's reach: how much more the trunk must lean at each of the body's keys."""

import numpy as np
from numpy.typing import NDArray

from station.motion.body import body_keys as body
from station.motion.body.body_keys import Ground
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, Point
from station.motion.kinematics.splines import SplineChannels
from station.motion.kinematics.trunk import TrunkAngles, trunk
from station.motion.strokes.hand import HandPart
from station.motion.style.style import Style

Array = NDArray[np.float64]

EASY_SHARE = 0.95
"""The trunk helps from this share of the arm's length on (our choice)."""
MOST_RAD = np.radians(30.0)
_ARM_OF_LEAN = 0.85
"""Of the trunk's length times the lean, this much brings the shoulder nearer to the target (our choice)."""


def reaching(
    ground: Ground, style: Style, hands: tuple[HandPart, HandPart], figure: Figure, pelvis: Point
) -> SplineChannels:
    """The body's curves under `style`, leaning to what is out of the arms' reach."""
    values = body.keys(ground, style)
    needed = leans(body.curves(ground, style, values[: body.CHANNELS.index("wing")]), hands, figure, pelvis)
    values[1] += needed
    return body.curves(ground, style, values)


def leans(curves: SplineChannels, hands: tuple[HandPart, HandPart], figure: Figure, pelvis: Point) -> Array:
    """The lean to add at each key of the body's `curves`, (m,) radians."""
    needed = np.zeros(len(curves.knots_s))
    length = EASY_SHARE * (figure.upper_arm_m + figure.forearm_m)
    for side, hand in enumerate(hands):
        if not len(hand.events.row):
            continue
        times = hand.strokes.strike_s
        twist, lean, tilt, shrug, hunch, *_ = curves.many(times)
        body = trunk(MANY, figure, pelvis, TrunkAngles(twist, lean, tilt, 0.0, 0.0, 0.0, shrug, hunch))
        shoulder = body.left_shoulder if side else body.right_shoulder
        far = np.sqrt(sum((s - w) ** 2 for s, w in zip(shoulder, hand.wrist_m.T, strict=True)))
        lack = np.clip((far - length) / (_ARM_OF_LEAN * figure.trunk_m), 0.0, MOST_RAD)
        key = np.clip(np.searchsorted(curves.knots_s, times), 1, len(needed) - 1)
        np.maximum.at(needed, key, lack)
        np.maximum.at(needed, key - 1, lack)
    return needed
