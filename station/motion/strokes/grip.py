"""What a hand holds, and how: grips of the stick, and brushes, mallets and bare hands in its place.

Grips after HUMANS: German palms flat, sticks near 90° to each other; American palms at 45°; French palms facing, the
forearm's roll and the fingers do the work; traditional left palm 45–90° up, the stick across it, and the forearm's
roll strikes.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.motion.kinematics.arm import EASE_RAD, ArmLengths
from station.motion.kinematics.figure import Figure


@dataclass(frozen=True, slots=True)
class Grip:
    """How the stick lies in a hand; angles in radians, mirrored for the left hand.

    `yaw` by which the stick is turned in from the line between shoulder and struck point; `palm` the stick's angle μ in
    the hand at the contact; `crossing` by which the hand points outward of the stick; `roll` of the hand's back from
    facing up, thumb upward; `turns_hand` as `turns` in `Contact`; `wrist` and `fingers` their parts of a stroke, 1
    as in the measured stroke.
    """

    name: str
    yaw: float
    palm: float
    crossing: float
    roll: float
    turns_hand: float
    wrist: float
    fingers: float


def _grip(name: str, degrees: tuple[float, float, float, float], turns: float, wrist: float, fingers: float) -> Grip:
    yaw, palm, crossing, roll = np.radians(degrees).tolist()
    return Grip(name, yaw, palm, crossing, roll, turns, wrist, fingers)


GRIPS: Mapping[str, Grip] = MappingProxyType(
    {
        g.name: g
        for g in (
            _grip("german", (28.0, 14.0, 30.0, 0.0), 1.0, 1.0, 0.8),
            _grip("american", (20.0, 14.0, 22.0, 45.0), 1.0, 1.0, 1.0),
            _grip("french", (8.0, 10.0, 8.0, 85.0), 0.4, 1.0, 0.8),
            _grip("traditional", (38.0, 0.0, 70.0, 120.0), 0.0, 1.0, 0.65),
        )
    }
)


@dataclass(frozen=True, slots=True)
class Held:
    """What is held: its length in shares of a stick's, the fulcrum's place on it from the butt, and how it strikes.

    `height` multiplies the stroke's height; `rest_m` is how high the tip rests between strokes. A bare hand has no
    length of its own: the fingers are its stick.
    """

    name: str
    length: float
    pivot: float
    height: float
    rest_m: float


HELD: Mapping[str, Held] = MappingProxyType(
    {
        h.name: h
        for h in (
            Held("stick", 1.0, 1 / 3, 1.0, 0.045),
            Held("brush", 0.84, 0.30, 0.7, 0.0),
            Held("mallet", 0.96, 0.30, 0.9, 0.045),
            Held("hand", 0.0, 0.0, 0.55, 0.045),
        )
    }
)
"""A stick's pivot is a third from the butt (HUMANS) and it rests 3.4–4.5 cm high in the measured stroke; a brush rests
on the head. The rest are our choices."""

_KNUCKLES = 0.055
_FINGERTIPS = 0.108
"""Shares of the stature from the wrist to the knuckles (our choice) and the fingertips (HUMANS)."""


@dataclass(frozen=True, slots=True)
class Hold:
    """A grip on something held."""

    grip: Grip
    held: Held

    def lengths(self, figure: Figure, right: bool = True) -> ArmLengths:
        """The measures of the right or left arm of `figure` that holds this."""
        length, pivot, limits = self.length_m(figure), self.held.pivot, figure.limits
        sideways = (-limits.wrist_ulnar, limits.wrist_radial) if right else (-limits.wrist_radial, limits.wrist_ulnar)
        hand, ahead = figure.hand_m, length * (1 - pivot)
        if not length:
            hand, ahead = _KNUCKLES * figure.stature_m, (_FINGERTIPS - _KNUCKLES) * figure.stature_m
        return ArmLengths(
            upper=figure.upper_arm_m,
            fore=figure.forearm_m,
            hand=hand,
            ahead=ahead,
            behind=length * pivot,
            rolls_hand=1.0 if right else -1.0,
            roll_sine=math.sin(self.grip.roll) * (1 if right else -1),
            roll_cosine=math.cos(self.grip.roll),
            most_bend=limits.elbow_flexion,
            most_back_m=figure.upper_arm_m * math.sin(min(limits.shoulder_extension - EASE_RAD, 0.5 * math.pi)),
            wrist=(-limits.wrist_flexion, limits.wrist_extension, *sideways),
        )

    def length_m(self, figure: Figure) -> float:
        """The length of what is held."""
        return self.held.length * figure.stick_m
