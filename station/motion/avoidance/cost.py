"""What is wrong with both arms at some moments, in one number: metres too near, joints too far, points out of reach.

Both are looked at with their strokes as high as a natural drummer's and as low as a style may make them, at the body's
natural posture. Metres, radians, seconds; a moment is a place in the grid.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import Arm, ArmLengths, Contact, Offsets, solve
from station.motion.kinematics.body_solids import (
    ArmPoints,
    BodyPoints,
    arm_in_kit,
    in_each_other,
    in_the_body,
    points_of,
)
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, blocks
from station.motion.kit.kit import Kit
from station.motion.strokes.hand import HandPart
from station.motion.strokes.stroke import NATURALLY, Strokes

Array = NDArray[np.float64]
Moments = NDArray[np.int64]

SHARES = (1.0, 0.4)
"""A style may make strokes so much lower, and the way must be free then too (our choice)."""
SPARE_M = 0.012
"""Nearer than this to touching are the hands too near: styles move them and the strokes a little (our choice)."""
_RADIAN_M = 0.5
"""A radian beyond a joint's limit weighs as so many metres: 2° as 17 mm (our choice)."""
_KIT, _FLESH = 2.0, 0.4
"""Wood on wood is heard and flesh gives way: a stick in the kit and an arm or hand at the body weigh so much (our
choice)."""
_YIELDS_M = 0.008
"""Flesh and cloth of arm and trunk yield so much together before anything is wrong (our choice)."""
WRONG_M = 0.003
"""What costs more than this is wrong: of the spare between hands a quarter, of a stick in the kit 1.5 mm (our
choice)."""


@dataclass(frozen=True, eq=False)
class Stage:
    """What stays while ways are sought: player, kit, the times of a grid (n,), shoulders (3, n) and body there.

    `straight` are both hands' ways before any move, (stretches, 4) each.
    """

    figure: Figure
    kit: Kit
    grid: Array
    roots: tuple[Array, Array]
    body: BodyPoints
    straight: tuple[Array, Array]

    def body_at(self, moments: Moments) -> BodyPoints:
        """The body at some moments."""
        body, (right, left) = self.body, self.body.shoulders
        pelvis, neck, head, crown = (p[moments] for p in (body.pelvis, body.neck, body.head, body.crown))
        return BodyPoints(pelvis, neck, head, crown, (right[moments], left[moments]), body.thighs)


@dataclass(frozen=True, eq=False)
class Hands:
    """Both hands on their ways and with their strokes."""

    stage: Stage
    parts: tuple[HandPart, HandPart]

    @cached_property
    def strokes(self) -> tuple[Strokes, Strokes]:
        """Natural strokes of both."""
        right, left = self.parts
        return Strokes.of(right.strokes, NATURALLY), Strokes.of(left.strokes, NATURALLY)

    @cached_property
    def lengths(self) -> tuple[ArmLengths, ArmLengths]:
        """Of both arms; their joints do as they are asked to."""
        right, left = self.parts
        figure = self.stage.figure
        return right.hold.lengths(figure).unlimited, left.hold.lengths(figure, right=False).unlimited

    def arms(self, side: int, moments: Moments, contact: Contact | None = None, low: Array | float = 1.0) -> list[Arm]:
        """The arm of one hand (0 right, 1 left) with each of `SHARES` of its strokes, these besides `low`."""
        times, (x, y, z) = self.stage.grid[moments], self.stage.roots[side][:, moments]
        at, raised = contact or self.parts[side].way.many(times), np.array(self.strokes[side].many(times))
        offsets = [Offsets(*(low * share * raised)) for share in SHARES]
        return [solve(MANY, self.lengths[side], (x, y, z), at, o) for o in offsets]

    def cost(self, moments: Moments) -> Array:
        """What is wrong at each moment, (n,)."""
        found = np.zeros(len(moments))
        for block in blocks(len(moments)):
            on = moments[block]
            sides = [self.arms(side, on) for side in (0, 1)]
            whole = np.zeros(len(on))
            for right, left in zip(*sides, strict=True):
                points = points_of(right), points_of(left)
                each = np.maximum(near(self.stage, *points), 0.0)
                for arm, own in zip((right, left), points, strict=True):
                    each = each + self.alone(arm, own, on) + stick_cost(self.stage, own, on)
                whole = np.maximum(whole, each)
            found[block] = whole
        return found

    def alone(self, arm: Arm, own: ArmPoints, moments: Moments) -> Array:
        """What is wrong with one arm but for its stick in the kit, (n,)."""
        stature = self.stage.figure.stature_m
        body = in_the_body(own, self.stage.body_at(moments), stature) | arm_in_kit(self.stage.kit, own, stature)
        deep = np.maximum(np.max(list(body.values()), axis=0) - _YIELDS_M, 0.0)
        return np.asarray(_FLESH * deep + _RADIAN_M * self._beyond(arm) + arm.missing_m)

    def _beyond(self, arm: Arm) -> Array:
        """By how much the elbow is beyond its limit, radians; shoulder and wrist keep to theirs by themselves."""
        return np.asarray(np.maximum(arm.elbow_bend - self.stage.figure.limits.elbow_flexion, 0.0))


def near(stage: Stage, one: ArmPoints, other: ArmPoints) -> Array:
    """By how much the hands are nearer than the spare, (n,)."""
    return np.asarray(np.max(list(in_each_other(one, other, stage.figure.stature_m).values()), axis=0) + SPARE_M)


def stick_cost(stage: Stage, own: ArmPoints, moments: Moments) -> Array:
    """What a stick in the kit costs at each of some moments, (n,)."""
    return _KIT * depth_in_kit(stage.kit, own.butt, own.tip, np.diff(moments, prepend=-1) == 1)
