"""What a hand holds, and how: grips of the stick, and brushes, mallets and bare hands in its place.

Where the stick is in the hand is said in the hand's own axes: the wrist at the origin, x to the thumb, y to the back,
z along the middle finger's metacarpal, metres for a hand of `HAND_M`, a right one; a left one is its mirror image.

German palms are flat, American at 45°, French ones face each other (HUMANS); in all three the stick is pinched beside
the index finger's middle joint, 10–11 cm from the wrist, runs under the palm and leaves it 3–5 cm past its heel. In the
traditional left hand, palm 45–90° up, it lies in the web of the thumb, over the ring finger, its butt 5–8 cm beyond.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import EASE_RAD, ArmLengths
from station.motion.kinematics.figure import MEDIAN_STATURE_M, Figure
from station.motion.kinematics.maths import arcsine

HAND_M = 0.108 * MEDIAN_STATURE_M
"""From the wrist to the fingertips of the hand that the places below are said for, the median man's (HUMANS)."""
STICK_RADIUS_M = 0.0072
"""A 5A stick is 14.4 mm thick."""


@dataclass(frozen=True, slots=True)
class Lie:
    """A stick in the hand at the contact.

    μ in vertical planes; in plan, how far the hand points outward of the stick; how far it is rolled from its grip.
    """

    palm: float
    crossing: float
    roll: float


@dataclass(frozen=True)
class Grip:
    """How the stick lies in a hand; angles in radians.

    `yaw` by which the stick is best turned in from the line between shoulder and struck point; `roll` of the hand's
    back from facing up, thumb upward; `turns_hand` as `turns` in `Contact`; `wrist` and `fingers` their parts of a
    stroke, 1 as in the measured stroke. In the hand's axes: `fulcrum`, and `to_butt`, the stick's way from there when
    the fingers are closed, a unit vector. Behind the fulcrum `in_hand_m` of the stick is in the hand, `beyond_m`
    out of it.
    """

    name: str
    yaw: float
    roll: float
    turns_hand: float
    wrist: float
    fingers: float
    fulcrum: tuple[float, float, float]
    to_butt: tuple[float, float, float]
    in_hand_m: float
    beyond_m: float

    def lie(self, stick_rise: float = 0.0, roll: float | None = None) -> Lie:
        """How hand and stick lie to each other where the stick rises from the contact by `stick_rise`.

        A hand that bends for its strokes stays at its `roll` and is pitched until the stick lies in it as it should;
        one that turns for them is as steep as its stick, and is rolled.
        """
        x, y, z = (line_axes(self.fulcrum) @ self.to_butt).tolist()
        roll = self.roll if roll is None else roll
        if self.turns_hand:
            up = x * math.sin(roll) + y * math.cos(roll)
            pitch = arcsine(math.sin(stick_rise) / math.hypot(up, z)) - math.atan2(up, -z)
        else:
            pitch, up = stick_rise, math.tan(stick_rise) * (1 + z)
            roll = math.pi - arcsine(up / math.hypot(x, y)) - math.atan2(y, x)
        inward, ahead = x * math.cos(roll) - y * math.sin(roll), -z * math.cos(pitch) - up * math.sin(pitch)
        return Lie(pitch - stick_rise, -math.atan2(inward, ahead), roll - self.roll)

    @cached_property
    def closed_rad(self) -> float:
        """μ at the contact of a level stick: the fingers are closed."""
        return self.lie().palm


def line_axes(fulcrum: tuple[float, float, float]) -> NDArray[np.float64]:
    """Rows: x, y, z of the axes in which `fulcrum` lies on z and the hand's back is towards y, in the hand's own."""
    z = np.array(fulcrum) / math.hypot(*fulcrum)
    y = np.array([0.0, 1.0, 0.0]) - z[1] * z
    y /= np.linalg.norm(y)
    return np.stack([np.cross(y, z), y, z])


HEEL_M = 0.012
"""From the middle of the wrist to the heel of the hand."""
_BEYOND_M = 0.04
"""What is beyond the heel in the matched grips: with it the pivot of a stick is a third from its butt (HUMANS)."""


def _way(across_deg: float, under_deg: float) -> tuple[float, float, float]:
    """The way to the butt: towards the wrist, by `across_deg` to the little finger, by `under_deg` off the palm."""
    a, u = math.radians(across_deg), math.radians(under_deg)
    return -math.sin(a) * math.cos(u), -math.sin(u), -math.cos(a) * math.cos(u)


_PINCH = (0.034, -0.022, 0.098)


def _matched(
    name: str, degrees: tuple[float, float], turns: float, parts: tuple[float, float], way_deg: tuple[float, float]
) -> Grip:
    """A grip in which the stick is pinched and runs under the palm by `way_deg`."""
    to_butt = _way(*way_deg)
    under_palm = (HEEL_M - _PINCH[2]) / to_butt[2]
    yaw, roll = np.radians(degrees).tolist()
    return Grip(name, yaw, roll, turns, *parts, _PINCH, to_butt, under_palm, _BEYOND_M)


_TRADITIONAL = Grip(
    "traditional",
    yaw=math.radians(38.0),
    roll=math.radians(145.0),
    turns_hand=0.0,
    wrist=1.0,
    fingers=0.65,
    fulcrum=(0.040, -0.012, 0.062),
    to_butt=(0.68, 0.41, -0.605),
    in_hand_m=0.0,
    beyond_m=0.065,
)
BARE = Grip(
    "bare",
    yaw=math.radians(20.0),
    roll=0.0,
    turns_hand=1.0,
    wrist=1.0,
    fingers=0.4,
    fulcrum=(0.004, 0.0, 0.096),
    to_butt=_way(0.0, -8.0),
    in_hand_m=0.0,
    beyond_m=0.0,
)
"""A bare hand: its fingers are the stick, held a little bent, and the knuckles are where it turns."""
GRIPS: Mapping[str, Grip] = MappingProxyType(
    {
        g.name: g
        for g in (
            _matched("german", (28.0, 0.0), 1.0, (1.0, 0.8), (22.0, 6.0)),
            _matched("american", (20.0, 45.0), 1.0, (1.0, 1.0), (24.0, 6.0)),
            _matched("french", (8.0, 80.0), 0.5, (0.75, 1.25), (31.0, 13.0)),
            _TRADITIONAL,
        )
    }
)
"""The numbers but those of HUMANS are our choice within what the text above says."""


@dataclass(frozen=True, slots=True)
class Held:
    """What is held: its length in shares of a stick's, and how it strikes.

    `height` multiplies the stroke's height; `rest_m` is how high the tip rests between strokes. A bare hand has no
    length of its own: the fingers are its stick.
    """

    name: str
    length: float
    height: float
    rest_m: float


HELD: Mapping[str, Held] = MappingProxyType(
    {
        h.name: h
        for h in (
            Held("stick", 1.0, 1.0, 0.045),
            Held("brush", 0.84, 0.7, 0.0),
            Held("mallet", 0.96, 0.9, 0.045),
            Held("hand", 0.0, 0.55, 0.045),
        )
    }
)
"""A stick rests 3.4–4.5 cm high in the measured stroke; a brush rests on the head. The rest are our choices."""


@dataclass(frozen=True, slots=True)
class Hold:
    """A grip on something held."""

    grip: Grip
    held: Held

    @classmethod
    def of(cls, grip: str, held: str) -> "Hold":
        """The hold by the names of both; a bare hand has a grip of its own."""
        return cls(GRIPS[grip] if HELD[held].length else BARE, HELD[held])

    def lengths(self, figure: Figure, right: bool = True) -> ArmLengths:
        """The measures of the right or left arm of `figure` that holds this."""
        length, side = self.length_m(figure), 1.0 if right else -1.0
        size = figure.hand_m / HAND_M
        hand, behind = math.hypot(*self.grip.fulcrum) * size, self.grip.in_hand_m * size + self.grip.beyond_m
        limits = figure.limits
        sideways = (-limits.wrist_ulnar, limits.wrist_radial) if right else (-limits.wrist_radial, limits.wrist_ulnar)
        x, y, z = line_axes(self.grip.fulcrum)[:, 2].tolist()
        tilt = math.acos(z) / math.hypot(x, y)
        return ArmLengths(
            upper=figure.upper_arm_m,
            fore=figure.forearm_m,
            hand=hand,
            ahead=length - behind if length else figure.hand_m - hand,
            behind=behind,
            rolls_hand=side,
            roll_sine=math.sin(self.grip.roll) * side,
            roll_cosine=math.cos(self.grip.roll),
            across=not self.grip.turns_hand,
            off_thumb=tilt * x,
            off_back=tilt * y,
            most_bend=limits.elbow_flexion,
            most_back_m=figure.upper_arm_m * math.sin(min(limits.shoulder_extension - EASE_RAD, 0.5 * math.pi)),
            wrist=(-limits.wrist_flexion, limits.wrist_extension, *sideways),
        )

    def length_m(self, figure: Figure) -> float:
        """The length of what is held."""
        return self.held.length * figure.stick_m
