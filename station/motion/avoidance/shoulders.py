"""Past the shoulder: ways that would bring a wrist nearer to its shoulder than the elbow bends are led farther off.

The straight way between two pieces on either side of the player passes close by the shoulder, where an arm folds and
its elbow swings fast. Such a stretch goes round by the least detour, forward, aside or down, that keeps the wrist off
and the stick out of the kit.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import radians

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.kinematics.arm import Arm, ArmLengths, Offsets, solve
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, blocks
from station.motion.kit.kit import Kit
from station.motion.strokes.hand import HandPart
from station.motion.strokes.stroke import NATURALLY, Strokes

Array = NDArray[np.float64]

_ROUNDS = 3
SPARE_RAD = radians(15)
"""What ways leave of the elbow's limit to the styles' bodies and strokes (our choice)."""
_LEAST_HUMP = 0.3
"""Moments at which so little of a detour is left are not helped by it (our choice)."""
_MOST_M = 0.35
"""No detour past the shoulder is longer (our choice)."""
_LOW = 0.4
"""A style may make strokes this much lower, and the way must be free then too (our choice)."""
_WAYS = np.array(
    [(0.0, 1.0, 0.0), (0.7, 0.7, 0.0), (-0.7, 0.7, 0.0), (0.0, 0.8, -0.6), (0.5, 0.7, -0.5), (0, 0.8, 0.6)]
)
"""The directions that are tried: to the hand's own side, forward, up (unit vectors, nearly)."""
_WAY_COST, _DEPTH_COST = 0.1, 10.0
"""A metre of detour and a metre deep in the kit weigh as this many metres too near to the shoulder (our choice)."""


def past_the_shoulder(part: HandPart, figure: Figure, kit: Kit, time_s: Array, root: Array) -> HandPart:
    """`part` on ways that keep its elbow within its limit.

    `root` (3, k) is where the shoulder is at `time_s` (k,) as the body naturally is.
    """
    scene = _Scene.of(part, figure, kit, time_s, root)
    for _ in range(_ROUNDS):
        k, hump = part.way.humps(time_s)
        away = scene.away(part)
        lack = np.where(hump > _LEAST_HUMP, scene.near_m - np.linalg.norm(away, axis=1), 0.0)
        stretches = np.unique(k[lack > 0])
        if not len(stretches):
            break
        here = scene.at(np.isin(k, stretches))
        bump, cheapest = part.bump.copy(), here.price(part, 0.0)
        for way in _WAYS * (1.0 if part.limb == Limb.RIGHT_HAND else -1.0, 1.0, 1.0):
            along = away @ way
            far = np.sqrt(np.maximum(along**2 + scene.near_m**2 - (away**2).sum(1), 0.0)) - along
            far = np.where(lack > 0, far / np.maximum(hump, _LEAST_HUMP), 0.0)
            length = np.minimum(_worst(k, far, len(bump)), _MOST_M)
            led = part.bump.copy()
            led[:, :3] += length[:, None] * way
            price = here.price(replace(part, bump=led), length)
            better = price < cheapest
            bump[better], cheapest[better] = led[better], price[better]
        part = replace(part, bump=bump)
    return part


@dataclass(frozen=True, eq=False)
class _Scene:
    """One hand's arm at some moments: how its stroke raises it, its shoulder (3, n), how near the wrist may come."""

    kit: Kit
    lengths: ArmLengths
    time_s: Array
    raised: Array
    root: Array
    near_m: Array

    @classmethod
    def of(cls, part: HandPart, figure: Figure, kit: Kit, time_s: Array, root: Array) -> "_Scene":
        lengths = part.hold.lengths(figure, part.limb == Limb.RIGHT_HAND).unlimited
        raised = np.array(Strokes.of(part.strokes, NATURALLY).many(time_s))
        near = lengths.nearest_m(MANY, figure.limits.elbow_flexion - SPARE_RAD - raised[1])
        return cls(kit, lengths, time_s, raised, root, np.asarray(near))

    def at(self, which: NDArray[np.bool_]) -> "_Scene":
        """The same at some of the moments."""
        return _Scene(
            self.kit,
            self.lengths,
            self.time_s[which],
            self.raised[:, which],
            self.root[:, which],
            self.near_m[which],
        )

    def away(self, part: HandPart) -> Array:
        """From the shoulder to the wrist, without the stroke, (n, 3)."""
        away = np.empty((len(self.time_s), 3))
        for block, arm in self._arms(part, 0.0):
            away[block] = np.stack(arm.wrist, 1) - self.root[:, block].T
        return away

    def price(self, part: HandPart, length: Array | float) -> Array:
        """What each stretch of `part` costs, whose detour is longer by `length`, (n − 1,) metres."""
        k, hump = part.way.humps(self.time_s)
        apart = np.linalg.norm(self.away(part), axis=1)
        lack = np.where(hump > _LEAST_HUMP, self.near_m - apart, 0.0)
        deep = np.maximum(self._depth(part, 1.0), self._depth(part, _LOW))
        return _worst(k, lack, len(part.bump)) + _DEPTH_COST * _worst(k, deep, len(part.bump)) + _WAY_COST * length

    def _arms(self, part: HandPart, share: float) -> Iterator[tuple[slice, Arm]]:
        """The arm with this share of the stroke, block by block of the moments."""
        for block in blocks(len(self.time_s)):
            x, y, z = self.root[:, block]
            contact = part.way.many(self.time_s[block])
            yield block, solve(MANY, self.lengths, (x, y, z), contact, Offsets(*(share * self.raised[:, block])))

    def _depth(self, part: HandPart, share: float) -> Array:
        """How deep the stick is in the kit, (n,)."""
        butt, tip = np.empty((len(self.time_s), 3)), np.empty((len(self.time_s), 3))
        for block, arm in self._arms(part, share):
            butt[block], tip[block] = np.stack(arm.butt, 1), np.stack(arm.tip, 1)
        return depth_in_kit(self.kit, butt, tip)


def _worst(stretch: NDArray[np.int64], value: Array, count: int) -> Array:
    """The greatest `value` of each of `count` stretches, at least 0."""
    worst = np.zeros(count + 1)
    np.maximum.at(worst, stretch, value)
    return worst[:-1]
