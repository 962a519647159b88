"""Tangles: where the sticks come too near to each other or to the other forearm, and what would undo it.

Both hands play the whole score at the body's natural posture, with strokes as high as a natural drummer's and as low as
a style may make them. Every stretch of their ways on which they are too near is tried with detours, over, back towards
the player, aside and under, of either hand, if need be with lower strokes; the one that stays farthest clear for the
least way is the best. Metres, radians, seconds.
"""

from dataclasses import dataclass, replace
from math import pi, radians

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb
from station.motion.arm import Arm, Contact, Offsets, solve
from station.motion.clearance import ARM_M, STICKS_M
from station.motion.collisions import ARM_RADIUS_M, STICK_RADIUS_M, depth_in_kit, segments_apart
from station.motion.events import WAIT
from station.motion.figure import Figure
from station.motion.hand import HandPart
from station.motion.kit import Kit
from station.motion.maths import MANY, Point
from station.motion.stroke import NATURALLY, Strokes

Array = NDArray[np.float64]

_SPARE_M = 0.012
"""Nearer than this to touching is too near: styles move the body and the strokes a little (our choice)."""
_TOO_NEAR_M = (2 * STICK_RADIUS_M + _SPARE_M, ARM_RADIUS_M + _SPARE_M)
"""Between sticks, and from a stick to the other forearm."""
_LOW = 0.4
"""A style may make strokes this much lower, and the way must be free then too (our choice)."""
_LEAST_HUMP = 0.08
"""Moments at which less than this of a detour is left cannot be helped by it (our choice)."""
SLOPES = np.array([Contact._fields.index("stick_rise"), Contact._fields.index("hand_rise")])
_RISES, _MOST_RISE = np.radians([4.0, 8.0, 12.0, 16.0, 20.0]), radians(20.5)
"""Where neither hand travels and the sticks cross, the upper one is so much steeper (our choice)."""
_FREE = (Articulation.NORMAL, Articulation.BUZZ, WAIT)
_SHARES, _LOW_COST_M = (1.0, 0.5, 0.2), 0.02
"""Where no way is enough, strokes are lowered to these shares besides, which weighs as so much way (our choice)."""

_WAYS = np.array(
    [
        (aside, -back, up)
        for aside in (0.0, -0.08, 0.08, 0.16)
        for back in (0.0, 0.08, 0.16, 0.24)
        for up in (-0.14, -0.07, 0.0, 0.06, 0.12, 0.18, 0.26)
    ]
)
"""The detours that are tried in the middle of a stretch: aside to the hand's own side, forward, up, (k, 3) metres."""
_MOST_M = 0.45
"""No detour is longer in all (our choice)."""
_WAY_COST = 0.08
"""A metre of detour is taken for this many metres of clearance (our choice)."""
_NEAR_COST = 5.0
"""A metre of what is too near costs so much more than one of what is nearer than drummers like (our choice)."""
_DEPTH_COST = 20.0
_CLEAR_COST, _WELL_OFF, _ELBOW_SPARE_RAD = 2.0, 0.3, radians(10)
_ANGLE_COST_M = 1.0
"""A metre deep in a drum or a radian beyond a joint's limit weighs as this many metres less clear; the elbow's limit is
left to styles by the spare; so does, where so much of a detour is made, what is short of the spare over the kit (our
choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Detour:
    """The hand (0 right, 1 left) that goes round by `way` (3,) more, its strokes about it lowered to a `share`.

    `price` in metres and how much too `near_m` it still is.
    """

    side: int
    way: Array
    share: float
    price: float
    near_m: float


@dataclass(frozen=True, eq=False)
class Stage:
    """What stays while ways are sought: the kit, the player, the times of a grid (n,), where both shoulders are then.

    `straight` are both hands' ways before any detour, each (stretches, 4).
    """

    figure: Figure
    kit: Kit
    grid: Array
    roots: tuple[Point, Point]
    straight: tuple[Array, Array]


@dataclass(frozen=True, eq=False)
class Scene:
    """Both hands at the times of a grid (n,): their strokes (4, n), their arms, and the stretch that each is on."""

    hands: tuple[HandPart, HandPart]
    stage: Stage
    strokes: tuple[Array, Array]
    arms: tuple[Arm, Arm]
    low: tuple[Arm, Arm]
    stretch: tuple[NDArray[np.int64], NDArray[np.int64]]
    hump: tuple[Array, Array]

    @classmethod
    def of(cls, hands: tuple[HandPart, HandPart], stage: Stage) -> "Scene":
        """The scene of `hands` on their ways as they are."""
        (right, right_high, right_low), (left, left_high, left_low) = (
            _raised(hand, stage, root) for hand, root in zip(hands, stage.roots, strict=True)
        )
        (k, hump), (other_k, other_hump) = (hand.way.humps(stage.grid) for hand in hands)
        return cls(
            hands=hands,
            stage=stage,
            strokes=(right, left),
            arms=(right_high, left_high),
            low=(right_low, left_low),
            stretch=(k, other_k),
            hump=(hump, other_hump),
        )

    def tangled(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The pairs (p, 2) of stretches on which the hands come too near, and of each moment which, −1 none."""
        near = np.zeros(len(self.stage.grid), bool)
        for right, left in (self.arms, self.low):
            near |= _lack(_limbs(right), _limbs(left), *_TOO_NEAR_M) > 0
        which = np.full(len(self.stage.grid), -1)
        pairs, of = np.unique(np.stack(self.stretch, 1)[near], axis=0, return_inverse=True)
        which[near] = of.reshape(-1)
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

    def lower(self, moments: NDArray[np.int64]) -> int:
        """Whose stick's middle is lower."""
        heights = [0.5 * (arm.butt[2] + arm.tip[2])[moments].mean() for arm in self.arms]
        return int(heights[1] < heights[0])

    def at(self, side: int, moments: NDArray[np.int64]) -> NDArray[np.int64]:
        """The events of one hand that it is at, or nearer to, at `moments`."""
        return np.unique(self.hands[side].way.nearest(self.stage.grid[moments])[0])

    def steeper(self, moments: NDArray[np.int64]) -> tuple[int, float] | None:
        """The hand whose stick, over the other's, is to be steeper, and by how much; None if it is no use.

        Only a tip's blow leaves its slope free: a stick's shoulder and shaft lie as the piece does.
        """
        side = 1 - self.lower(moments)
        hand, times = self.hands[side], self.stage.grid[moments]
        events = self.at(side, moments)
        free = np.isin(hand.events.key[events, 2], _FREE) & ~np.isin(hand.which[events], hand.on_the_shoulder)
        lies = np.array([hand.lies[k].contact.stick_rise for k in hand.which[events].tolist()])
        left = _MOST_RISE - float((hand.contacts[events, SLOPES[0]] - lies).max())
        if not free.all():
            return None
        strokes = self.strokes[side][:, moments]
        lengths = hand.hold.lengths(self.stage.figure, hand.limb == Limb.RIGHT_HAND)
        x, y, z = (np.broadcast_to(r, self.stage.grid.shape)[moments] for r in self.stage.roots[side])
        other = [np.broadcast_to(p, (len(self.stage.grid), 3))[moments] for p in _limbs(self.arms[1 - side])]
        contact = hand.way.many(times)
        for rise in _RISES[left >= _RISES].tolist():
            steep = contact._replace(stick_rise=contact.stick_rise + rise, hand_rise=contact.hand_rise + rise)
            arms = [solve(MANY, lengths, (x, y, z), steep, Offsets(*(low * strokes))) for low in (1.0, _LOW)]
            if all(self._is_free(side, arm, other) for arm in arms):
                return side, rise
        return None

    def _is_free(self, side: int, arm: Arm, other: list[Array]) -> bool:
        """Whether `arm` of a hand is not too near to the other's limbs and within its joints' limits."""
        near = _lack(_limbs(arm), other, *_TOO_NEAR_M)
        return float(near.max()) <= 0.0 and float(np.max(self._beyond(side, arm))) <= 0.0

    def way_round(self, pair: list[int], moments: NDArray[np.int64]) -> Detour | None:
        """The cheapest detour of a hand on its stretch of `pair`, with lower strokes where none is enough.

        None where nothing is better than the way as it is.
        """
        best: Detour | None = None
        for share in _SHARES:
            for side in (0, 1):
                if self.hump[side][moments].max() < _LEAST_HUMP:
                    continue
                found = self._best(side, pair[side], share)
                if (found.way.any() or share < 1.0) and (best is None or found.price < best.price):
                    best = found
            if best is not None and best.near_m <= 0.0:
                break
        return best

    def _best(self, side: int, stretch: int, share: float) -> Detour:
        """The cheapest detour of one hand on a stretch with `share` of its strokes."""
        hand = self.hands[side]
        on = np.flatnonzero((self.stretch[side] == stretch) & (self.hump[side] > 0.0))
        ways = _WAYS * (1.0 if side == 0 else -1.0, 1.0, 1.0)
        so_far = hand.bump[stretch, :3]
        led = so_far - self.stage.straight[side][stretch, :3]
        if led.any():  # the first detour was not enough: another instead of it may be
            ways = np.concatenate((ways, ways - led))
        ways = ways[(np.linalg.norm(so_far + ways, axis=1) <= _MOST_M) | ~ways.any(1)]
        found, price, near = self.cheapest(side, on, (self.hump[side][on], ways), share)
        return Detour(side, ways[found], share, price, near)

    def cheapest(
        self, side: int, on: NDArray[np.int64], moves: tuple[Array, Array], share: float, contact: Contact | None = None
    ) -> tuple[int, float, float]:
        """Which of some moves of one hand is the cheapest at the moments `on` (n,), its price, how much too near it is.

        `moves` are how much of them is made at each moment, (n,), and the moves, (k, 3) metres, from where the hand
        touches in its way or in `contact`.
        """
        hand, (hump, ways) = self.hands[side], moves
        times = self.stage.grid[on]
        contact = contact or hand.way.many(times)
        x, y, z = (c + hump * w[:, None] for c, w in zip(contact[:3], ways.T, strict=True))
        every = Contact(x, y, z, *(np.broadcast_to(c, x.shape) for c in contact[3:]))
        strokes = Offsets(*(share * self.strokes[side][:, on]))
        lengths = replace(hand.hold.lengths(self.stage.figure, hand.limb == Limb.RIGHT_HAND), most_bend=pi)
        rx, ry, rz = (np.broadcast_to(r, self.stage.grid.shape)[on] for r in self.stage.roots[side])
        arm = solve(MANY, lengths, (rx, ry, rz), every, strokes)
        own = [np.broadcast_to(p, (*x.shape, 3)) for p in _limbs(arm)]
        other = [np.broadcast_to(p[on], (*x.shape, 3)).reshape(-1, 3) for p in _limbs(self.arms[1 - side])]
        own_flat = [p.reshape(-1, 3) for p in own]
        lack = np.maximum(_lack(own_flat, other, STICKS_M, ARM_M).reshape(x.shape), 0.0)
        near = np.maximum(_lack(own_flat, other, *_TOO_NEAR_M).reshape(x.shape), 0.0)
        lower = Offsets(*(_LOW * o for o in strokes))
        flat = [np.broadcast_to(p, (*x.shape, 3)) for p in _limbs(solve(MANY, lengths, (rx, ry, rz), every, lower))]
        other_low = [np.broadcast_to(p[on], (*x.shape, 3)).reshape(-1, 3) for p in _limbs(self.low[1 - side])]
        near = np.maximum(near, _lack([p.reshape(-1, 3) for p in flat], other_low, *_TOO_NEAR_M).reshape(x.shape))
        helped = hump > _LEAST_HUMP
        prices = (
            np.where(helped, lack, 0.0).max(1)
            + _NEAR_COST * (np.where(helped, near, 0.0).max(1) + np.where(helped, 0.0, near).max(1))
            + _WAY_COST * np.linalg.norm(ways, axis=1)
            + _LOW_COST_M * (1.0 - share)
            + _ANGLE_COST_M * np.broadcast_to(self._beyond(side, arm), x.shape).max(1)
            + np.broadcast_to(arm.missing_m, x.shape).max(1)
        )
        best, found = np.inf, 0
        for k in np.argsort(prices, kind="stable").tolist():
            if prices[k] >= best:
                break
            price = float(prices[k]) + max(
                self._price_of_depth(stick[0][k], stick[1][k], hump) for stick in (own, flat)
            )
            if price < best:
                best, found = price, k
        return found, best, float(near[found].max())

    def _price_of_depth(self, butt: Array, tip: Array, hump: Array) -> float:
        """What it costs that the stick is in the kit, and off on its way hardly clear, for styles lower it a little."""
        deep = depth_in_kit(self.stage.kit, butt, tip).max()
        low = np.outer(hump > _WELL_OFF, (0.0, 0.0, _SPARE_M))
        return float(_DEPTH_COST * deep + _CLEAR_COST * depth_in_kit(self.stage.kit, butt - low, tip - low).max())

    def _beyond(self, side: int, arm: Arm) -> Array:
        """By how much elbow and wrist are beyond their limits, radians."""
        limits = self.stage.figure.limits
        sideways = arm.deviation if side == 0 else -arm.deviation
        over = [
            arm.elbow_bend - limits.elbow_flexion + _ELBOW_SPARE_RAD,
            arm.extension - limits.wrist_extension,
            -arm.extension - limits.wrist_flexion,
            sideways - limits.wrist_radial,
            -sideways - limits.wrist_ulnar,
        ]
        return np.asarray(sum(np.maximum(o, 0.0) for o in over))


def _raised(hand: HandPart, stage: Stage, root: Point) -> tuple[Array, Arm, Arm]:
    """The strokes of `hand`, (4, n), and its arm with them and with low ones."""
    lengths = hand.hold.lengths(stage.figure, hand.limb == Limb.RIGHT_HAND)
    strokes, way = np.array(Strokes.of(hand.strokes, NATURALLY).many(stage.grid)), hand.way.many(stage.grid)
    high, low = (solve(MANY, lengths, root, way, Offsets(*(share * strokes))) for share in (1.0, _LOW))
    return strokes, high, low


def _limbs(arm: Arm) -> list[Array]:
    """Butt, tip, elbow and wrist, each (…, 3)."""
    return [np.stack(np.broadcast_arrays(*p), -1) for p in (arm.butt, arm.tip, arm.elbow, arm.wrist)]


def _lack(a: list[Array], b: list[Array], sticks_m: float, arm_m: float) -> Array:
    """How much nearer the hands are than they should be at each moment, (n,): over 0 is too near."""
    sticks = sticks_m - segments_apart(a[0], a[1], b[0], b[1])
    first = arm_m - segments_apart(a[0], a[1], b[2], b[3])
    second = arm_m - segments_apart(b[0], b[1], a[2], a[3])
    return np.maximum(sticks, np.maximum(first, second))
