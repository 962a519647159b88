"""Ways round: where a hand on its way would bring its stick into the other's stick or arm, it is led around them.

Both hands play the whole score at the body's natural posture, looked at `RATE_HZ` times a second. Every stretch on
which the sticks come too near to each other or to the other forearm is tried with detours, over, back towards the
player, aside and under, of either hand; the one that stays farthest clear for the least way is taken. Where neither
hand travels, the upper one's stick is held steeper, or the lower one's stroke lower. What is found once for a figure of
the score is kept for its repetitions.
"""

from dataclasses import dataclass, replace
from math import pi, radians

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb
from station.motion.arm import Arm, Contact, Offsets, solve
from station.motion.clearance import ARM_M, STICKS_M
from station.motion.collisions import ALONG, ARM_RADIUS_M, STICK_RADIUS_M, depth, segments_apart
from station.motion.events import LONG_AGO_S, WAIT
from station.motion.figure import Figure
from station.motion.hand import HandPart
from station.motion.kit import Kit
from station.motion.maths import MANY, Point
from station.motion.stroke import NATURALLY, Strokes

Array = NDArray[np.float64]

RATE_HZ = 120.0
ROUNDS = 8
"""A detour may need another: so often the whole is looked at (our choice)."""
_SPARE_M = 0.012
"""Nearer than this to touching is too near: styles move the body and the strokes a little (our choice)."""
_TOO_NEAR_M = (2 * STICK_RADIUS_M + _SPARE_M, ARM_RADIUS_M + _SPARE_M)
"""Between sticks, and from a stick to the other forearm."""
_LOW = 0.4
"""A style may make strokes this much lower, and the way must be free then too (our choice)."""
_LEAST_HUMP = 0.08
"""Moments at which less than this of a detour is left cannot be helped by it (our choice)."""
_SLOPES = np.array([Contact._fields.index("stick_rise"), Contact._fields.index("hand_rise")])
_RISES, _MOST_RISE = np.radians([4.0, 8.0, 12.0, 16.0, 20.0]), radians(20.5)
"""Where neither hand travels and the sticks cross, the upper one is so much steeper (our choice)."""
_FREE = (Articulation.NORMAL, Articulation.BUZZ, WAIT)
_LOWER = 0.6
_LEAST_HEIGHT_M = 0.04
"""Where that is no use either, a stroke in the way is lowered by this factor a round, not under this (our choice)."""

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
_NEAR_COST = 0.7
"""A metre of what is too near costs so much more than one of what is nearer than drummers like (our choice)."""
_DEPTH_COST = 10.0
_ELBOW_SPARE_RAD = radians(10)
_ANGLE_COST_M = 1.0
"""A metre deep in a drum or a radian beyond a joint's limit weighs as this many metres less clear; the elbow's limit is
left to styles by the spare (our choice)."""


def looks(*event_s: Array) -> Array:
    """The times at which hands with events at `event_s` are looked at; an event long ago is no event."""
    times = np.concatenate(event_s)
    times = times[times > LONG_AGO_S]
    return np.union1d(np.arange(times.min() - 1.0, times.max() + 1.0, 1 / RATE_HZ), times)


def detoured(
    hands: tuple[HandPart, HandPart], figure: Figure, kit: Kit, grid: Array, shoulders: tuple[Point, Point]
) -> tuple[HandPart, HandPart]:
    """Both parts with ways around each other, looked at `grid` (n,), when the shoulders are at `shoulders`."""
    known: dict[tuple[object, ...], tuple[int, Array] | None] = {}
    for _ in range(ROUNDS):
        scene = _Scene.of(hands, figure, kit, grid, shoulders)
        pairs, which = scene.tangled()
        if not len(pairs):
            break
        bumps = [hand.bump.copy() for hand in hands]
        most = [hand.strokes.most.copy() for hand in hands]
        contacts = [hand.contacts.copy() for hand in hands]
        changed: set[tuple[int, int]] = set()
        rises: dict[tuple[object, ...], tuple[int, float] | None] = {}
        for k, pair in enumerate(pairs.tolist()):
            if changed & set(enumerate(pair)):
                continue  # what helped its neighbour may have helped it too
            changed |= set(enumerate(pair))
            moments = np.flatnonzero(which == k)
            key = scene.figure_of(pair)
            if key not in known:
                known[key] = scene.way_round(pair, moments)
            found = known[key]
            if found is None and key not in rises:
                rises[key] = scene.steeper(moments)
            steeper = rises.get(key)
            if found is not None:
                bumps[found[0]][pair[found[0]], :3] += found[1]
            elif steeper is not None:
                side, rise = steeper
                contacts[side][np.ix_(scene.at(side, moments), _SLOPES)] += rise
            else:
                side = scene.lower(moments)
                near = slice(pair[side], pair[side] + 2)
                least = np.minimum(_LEAST_HEIGHT_M / np.maximum(hands[side].strokes.height_m[near], 1e-6), 1.0)
                most[side][near] = np.minimum(
                    most[side][near], np.maximum(_LOWER * np.minimum(most[side][near], 1.0), least)
                )
        hands = (hands[0].led(bumps[0], most[0], contacts[0]), hands[1].led(bumps[1], most[1], contacts[1]))
    return hands


@dataclass(frozen=True, eq=False)
class _Scene:
    """Both hands at the times of a grid (n,): their strokes (4, n), their arms, and the stretch that each is on."""

    hands: tuple[HandPart, HandPart]
    figure: Figure
    kit: Kit
    grid: Array
    roots: tuple[Point, Point]
    strokes: tuple[Array, Array]
    arms: tuple[Arm, Arm]
    stretch: tuple[NDArray[np.int64], NDArray[np.int64]]
    hump: tuple[Array, Array]

    @classmethod
    def of(
        cls, hands: tuple[HandPart, HandPart], figure: Figure, kit: Kit, grid: Array, roots: tuple[Point, Point]
    ) -> "_Scene":
        raised, other_raised = (Strokes.of(hand.strokes, NATURALLY).many(grid) for hand in hands)
        right, left = (
            solve(MANY, hand.hold.lengths(figure, hand.limb == Limb.RIGHT_HAND), root, hand.way.many(grid), strokes)
            for hand, root, strokes in zip(hands, roots, (raised, other_raised), strict=True)
        )
        (k, hump), (other_k, other_hump) = (hand.way.humps(grid) for hand in hands)
        strokes = np.array(raised), np.array(other_raised)
        return cls(hands, figure, kit, grid, roots, strokes, (right, left), (k, other_k), (hump, other_hump))

    def tangled(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The pairs (p, 2) of stretches on which the hands come too near, and of each moment which, −1 none."""
        a, b = (_limbs(arm) for arm in self.arms)
        near = _lack(a, b, *_TOO_NEAR_M) > 0
        which = np.full(len(self.grid), -1)
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
        return tuple(words)

    def lower(self, moments: NDArray[np.int64]) -> int:
        """Whose stick's middle is lower."""
        heights = [0.5 * (arm.butt[2] + arm.tip[2])[moments].mean() for arm in self.arms]
        return int(heights[1] < heights[0])

    def at(self, side: int, moments: NDArray[np.int64]) -> NDArray[np.int64]:
        """The events of one hand that it is at, or nearer to, at `moments`."""
        return np.unique(self.hands[side].way.nearest(self.grid[moments])[0])

    def steeper(self, moments: NDArray[np.int64]) -> tuple[int, float] | None:
        """The hand whose stick, over the other's, is to be steeper, and by how much; None if it is no use.

        Only a tip's blow leaves its slope free: a stick's shoulder and shaft lie as the piece does.
        """
        side = 1 - self.lower(moments)
        hand, times = self.hands[side], self.grid[moments]
        events = self.at(side, moments)
        free = np.isin(hand.events.key[events, 2], _FREE) & ~np.isin(hand.which[events], hand.on_the_shoulder)
        lies = np.array([hand.lies[k].contact.stick_rise for k in hand.which[events].tolist()])
        left = _MOST_RISE - float((hand.contacts[events, _SLOPES[0]] - lies).max())
        if not free.all():
            return None
        strokes = self.strokes[side][:, moments]
        lengths = hand.hold.lengths(self.figure, hand.limb == Limb.RIGHT_HAND)
        x, y, z = (np.broadcast_to(r, self.grid.shape)[moments] for r in self.roots[side])
        other = [np.broadcast_to(p, (len(self.grid), 3))[moments] for p in _limbs(self.arms[1 - side])]
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

    def way_round(self, pair: list[int], moments: NDArray[np.int64]) -> tuple[int, Array] | None:
        """The hand (0 right, 1 left) and its detour (3,) on its stretch of `pair`; None where nothing is better."""
        best: tuple[float, int, Array] | None = None
        for side in (0, 1):
            if self.hump[side][moments].max() < _LEAST_HUMP:
                continue
            on = np.flatnonzero((self.stretch[side] == pair[side]) & (self.hump[side] > 0.0))
            ways = _WAYS * (1.0 if side == 0 else -1.0, 1.0, 1.0)
            so_far = self.hands[side].bump[pair[side], :3]
            ways = ways[(np.linalg.norm(so_far + ways, axis=1) <= _MOST_M) | ~ways.any(1)]
            price, way = self._best(side, on, ways)
            if way.any() and (best is None or price < best[0]):
                best = price, side, way
        return None if best is None else (best[1], best[2])

    def _best(self, side: int, on: NDArray[np.int64], ways: Array) -> tuple[float, Array]:
        """The cheapest of `ways` (k, 3) of one hand over the moments `on`, and its price in metres."""
        hand = self.hands[side]
        times, hump = self.grid[on], self.hump[side][on]
        contact = hand.way.many(times)
        x, y, z = (c + hump * w[:, None] for c, w in zip(contact[:3], ways.T, strict=True))
        every = Contact(x, y, z, *(np.broadcast_to(c, x.shape) for c in contact[3:]))
        strokes = Offsets(*self.strokes[side][:, on])
        lengths = replace(hand.hold.lengths(self.figure, hand.limb == Limb.RIGHT_HAND), most_bend=pi)
        rx, ry, rz = (np.broadcast_to(r, self.grid.shape)[on] for r in self.roots[side])
        arm = solve(MANY, lengths, (rx, ry, rz), every, strokes)
        own = [np.broadcast_to(p, (*x.shape, 3)) for p in _limbs(arm)]
        other = [np.broadcast_to(p[on], (*x.shape, 3)).reshape(-1, 3) for p in _limbs(self.arms[1 - side])]
        own_flat = [p.reshape(-1, 3) for p in own]
        lack = _lack(own_flat, other, STICKS_M, ARM_M).reshape(x.shape)
        near = _lack(own_flat, other, *_TOO_NEAR_M).reshape(x.shape)
        helped = hump > _LEAST_HUMP
        prices = (
            np.where(helped, np.maximum(lack, 0.0), 0.0).max(1)
            + _NEAR_COST * np.where(helped, np.maximum(near, 0.0), 0.0).max(1)
            + _WAY_COST * np.linalg.norm(ways, axis=1)
            + _ANGLE_COST_M * np.broadcast_to(self._beyond(side, arm), x.shape).max(1)
            + np.broadcast_to(arm.missing_m, x.shape).max(1)
        )
        lower = Offsets(*(_LOW * o for o in strokes))
        flat = [np.broadcast_to(p, (*x.shape, 3)) for p in _limbs(solve(MANY, lengths, (rx, ry, rz), every, lower))]
        best, found = np.inf, 0
        for k in np.argsort(prices, kind="stable").tolist():
            if prices[k] >= best:
                break
            deep = max(self._deepest(own[0][k], own[1][k]), self._deepest(flat[0][k], flat[1][k]))
            price = float(prices[k]) + _DEPTH_COST * deep
            if price < best:
                best, found = price, k
        return best, ways[found]

    def _deepest(self, butt: Array, tip: Array) -> float:
        """How deep the stick is in the kit at its worst, m; `butt` and `tip` (n, 3)."""
        stick = butt[:, None] + ALONG[:, None] * (tip - butt)[:, None]
        return max(float(depth(p, stick).max()) for p in self.kit.pieces.values() if p.kind != "kick")

    def _beyond(self, side: int, arm: Arm) -> Array:
        """By how much elbow and wrist are beyond their limits, radians."""
        limits = self.figure.limits
        sideways = arm.deviation if side == 0 else -arm.deviation
        over = [
            arm.elbow_bend - limits.elbow_flexion + _ELBOW_SPARE_RAD,
            arm.extension - limits.wrist_extension,
            -arm.extension - limits.wrist_flexion,
            sideways - limits.wrist_radial,
            -sideways - limits.wrist_ulnar,
        ]
        return np.asarray(sum(np.maximum(o, 0.0) for o in over))


def _limbs(arm: Arm) -> list[Array]:
    """Butt, tip, elbow and wrist, each (…, 3)."""
    return [np.stack(np.broadcast_arrays(*p), -1) for p in (arm.butt, arm.tip, arm.elbow, arm.wrist)]


def _lack(a: list[Array], b: list[Array], sticks_m: float, arm_m: float) -> Array:
    """How much nearer the hands are than they should be at each moment, (n,): over 0 is too near."""
    sticks = sticks_m - segments_apart(a[0], a[1], b[0], b[1])
    first = arm_m - segments_apart(a[0], a[1], b[2], b[3])
    second = arm_m - segments_apart(b[0], b[1], a[2], a[3])
    return np.maximum(sticks, np.maximum(first, second))
