"""Both hands on their ways, and where the sticks come too near to each other or to the other forearm.

They play the whole score at the body's natural posture, with strokes as high as a natural drummer's and as low as a
style may make them. What is asked about some moments is computed for these alone, so that a long score takes no more
memory than a short one. Metres, radians, seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import Arm, ArmLengths, Contact, Offsets, solve
from station.motion.kinematics.collisions import ARM_RADIUS_M, STICK_RADIUS_M, segments_apart
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, blocks
from station.motion.kit.kit import Kit
from station.motion.strokes.hand import HandPart
from station.motion.strokes.stroke import NATURALLY, Strokes

Array = NDArray[np.float64]
Moments = NDArray[np.int64]
"""Places in the grid."""

SPARE_M = 0.012
"""Nearer than this to touching is too near: styles move the body and the strokes a little (our choice)."""
_TOO_NEAR_M = (2 * STICK_RADIUS_M + SPARE_M, ARM_RADIUS_M + SPARE_M)
"""Between sticks, and from a stick to the other forearm."""
LOW = 0.4
"""A style may make strokes this much lower, and the way must be free then too (our choice)."""
SLOPES = np.array([Contact._fields.index("stick_rise"), Contact._fields.index("hand_rise")])


@dataclass(frozen=True, eq=False)
class HandsGrid:
    """What stays while ways are sought: the kit, the player, the times of a grid (n,), where both shoulders are then.

    `roots` are (3, n) each; `straight` both hands' ways before any detour, each (stretches, 4).
    """

    figure: Figure
    kit: Kit
    grid: Array
    roots: tuple[Array, Array]
    straight: tuple[Array, Array]


@dataclass(frozen=True, eq=False)
class BothHands:
    """Both hands at the times of a grid (n,): their strokes, and where they are too near each other.

    `stretch` (n,) is what stretch of its way each is on, `hump` (n,) how much of that one's detour is made there.
    """

    hands: tuple[HandPart, HandPart]
    stage: HandsGrid
    strokes: tuple[Strokes, Strokes]
    stretch: tuple[Moments, Moments]
    hump: tuple[Array, Array]
    near: NDArray[np.bool_]

    @classmethod
    def of(cls, hands: tuple[HandPart, HandPart], stage: HandsGrid, before: "BothHands | None" = None) -> "BothHands":
        """The scene of `hands` on their ways as they are; what is as it was `before` is not looked at again."""
        right, left = hands
        (k, hump), (other_k, other_hump) = right.way.humps(stage.grid), left.way.humps(stage.grid)
        scene = cls(
            hands=hands,
            stage=stage,
            strokes=(Strokes.of(right.strokes, NATURALLY), Strokes.of(left.strokes, NATURALLY)),
            stretch=(k, other_k),
            hump=(hump, other_hump),
            near=np.zeros(len(stage.grid), bool) if before is None else before.near.copy(),
        )
        changed = np.arange(len(stage.grid)) if before is None else scene._changed(before)
        for block in blocks(len(changed)):
            on = changed[block]
            apart = zip(scene.arms(0, on), scene.arms(1, on), strict=True)
            scene.near[on] = np.max([too_near(distances(limbs(a), limbs(b))) for a, b in apart], axis=0) > 0
        return scene

    def _changed(self, before: "BothHands") -> Moments:
        """Where a hand is not as it was `before`."""
        changed = np.zeros(len(self.stage.grid), bool)
        for side, (hand, old) in enumerate(zip(self.hands, before.hands, strict=True)):
            way = (hand.way.rows != old.way.rows).any(1)
            changed |= (way | self.strokes[side].differ(before.strokes[side]))[self.stretch[side]]
        return np.flatnonzero(changed)

    def arms(self, side: int, on: Moments, shares: tuple[float, ...] = (1.0, LOW)) -> list[Arm]:
        """The arm of one hand (0 right, 1 left) at some moments, once with each of these shares of its strokes."""
        times, (x, y, z) = self.stage.grid[on], self.stage.roots[side][:, on]
        way, strokes = self.hands[side].way.many(times), np.array(self.strokes[side].many(times))
        return [solve(MANY, self.lengths(side), (x, y, z), way, Offsets(*(share * strokes))) for share in shares]

    def lengths(self, side: int) -> ArmLengths:
        """Of one arm with what it holds."""
        return self.hands[side].hold.lengths(self.stage.figure, right=side == 0).unlimited

    def tangled(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The pairs (p, 2) of stretches on which the hands come too near, and of each moment which, −1 none."""
        which = np.full(len(self.stage.grid), -1)
        pairs, of = np.unique(np.stack([k[self.near] for k in self.stretch], 1), axis=0, return_inverse=True)
        which[self.near] = of.reshape(-1)
        return pairs, which

    def figure_of(self, pair: list[int]) -> tuple[object, ...]:
        """What a tangle is like: the kinds and relative times of both hands' events about it, and the ways there."""
        start = self.hands[0].events.time_s[pair[0]]
        words: list[object] = []
        for hand, k in zip(self.hands, pair, strict=True):
            part = slice(max(k - 1, 0), k + 3)
            words += [tuple(hand.which[part].tolist())]
            words += [tuple(np.round(hand.events.time_s[part] - start, 3).tolist())]
            words += [tuple(np.round(hand.bump[k : k + 1].ravel(), 3).tolist())]
            words += [tuple(np.round(hand.strokes.most[part], 3).tolist())]
            words += [tuple(np.round(hand.contacts[part, SLOPES[0]], 3).tolist())]
            words += [tuple(np.round(hand.gives[k, 3:], 3).tolist())]
        return tuple(words)

    def lower(self, moments: Moments) -> int:
        """Whose stick's middle is lower."""
        sticks = [self.arms(side, moments, (1.0,))[0] for side in (0, 1)]
        heights = [0.5 * (arm.butt[2] + arm.tip[2]).mean() for arm in sticks]
        return int(heights[1] < heights[0])

    def at(self, side: int, moments: Moments) -> NDArray[np.int64]:
        """The events of one hand that it is at, or nearer to, at `moments`."""
        return np.unique(self.hands[side].way.nearest(self.stage.grid[moments])[0])


def limbs(arm: Arm) -> list[Array]:
    """Butt, tip, elbow and wrist, each (…, 3)."""
    return [np.stack(np.broadcast_arrays(*p), -1) for p in (arm.butt, arm.tip, arm.elbow, arm.wrist)]


Distances = tuple[Array, Array]
"""Between the sticks, and the least from a stick to the other forearm, at each moment (n,)."""


def distances(a: list[Array], b: list[Array]) -> Distances:
    """How far apart the `limbs` of two arms are, (n, 3) each."""
    first, second = segments_apart(a[0], a[1], b[2], b[3]), segments_apart(b[0], b[1], a[2], a[3])
    return segments_apart(a[0], a[1], b[0], b[1]), np.minimum(first, second)


def lack(apart: Distances, sticks_m: float, arm_m: float) -> Array:
    """How much nearer the hands are than they should be at each moment, (n,): over 0 is too near."""
    return np.maximum(sticks_m - apart[0], arm_m - apart[1])


def too_near(apart: Distances) -> Array:
    """How much they lack of what keeps them clear of each other in every style, (n,)."""
    return lack(apart, *_TOO_NEAR_M)
