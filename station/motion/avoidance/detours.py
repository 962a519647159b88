"""Ways round: where a hand on its way would bring its stick into the other's stick or arm, it is led around them.

Both hands are looked at `RATE_HZ` times a second. Every tangle (`tangles`) is undone by the detour that helps most;
where neither hand travels, the upper one's stick is held steeper; where one rests, it gives way (`giving_way`); else
the lower one's stroke is lower. What is found once for a figure of the score is kept for its repetitions.
"""

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from station.motion.avoidance.both_hands import SLOPES, BothHands, HandsGrid
from station.motion.avoidance.giving_way import Giving, giving_way
from station.motion.avoidance.tangles import Detour, steeper, way_round
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.motion.strokes.hand import HandPart
from station.motion.strokes.hand_events import LONG_AGO_S

Array = NDArray[np.float64]

RATE_HZ = 120.0
ROUNDS = 8
"""A detour may need another: so often the whole is looked at (our choice)."""
_LOWER = 0.6
_LEAST_HEIGHT_M = 0.04
"""Where nothing else is of use, a stroke in the way is lowered by this factor a round, not under this (our choice)."""


def looks(*event_s: Array) -> Array:
    """The times at which hands with events at `event_s` are looked at; an event long ago is no event."""
    times = np.concatenate(event_s)
    times = times[times > LONG_AGO_S]
    return np.union1d(np.arange(times.min() - 1.0, times.max() + 1.0, 1 / RATE_HZ), times)


def detoured(
    hands: tuple[HandPart, HandPart], figure: Figure, kit: Kit, grid: Array, shoulders: tuple[Array, Array]
) -> tuple[HandPart, HandPart]:
    """Both parts with ways around each other, looked at `grid` (n,) with the shoulders at `shoulders`, (3, n) each."""
    known: dict[tuple[object, ...], Remedy] = {}
    tries: Counter[tuple[int, ...]] = Counter()
    stage = HandsGrid(figure, kit, grid, shoulders, (hands[0].bump, hands[1].bump))
    scene: BothHands | None = None
    for _ in range(ROUNDS):
        scene = BothHands.of(hands, stage, scene)
        pairs, which = scene.tangled()
        if not len(pairs):
            break
        bumps = [hand.bump.copy() for hand in hands]
        most = [hand.strokes.most.copy() for hand in hands]
        contacts = [hand.contacts.copy() for hand in hands]
        gives = [hand.gives.copy() for hand in hands]
        changed: set[tuple[int, int]] = set()
        for pair, k in sorted(((p, k) for k, p in enumerate(pairs.tolist())), key=lambda p: tries[tuple(p[0])]):
            if changed & set(enumerate(pair)):
                continue  # what helped its neighbour may have helped it too; if not, its turn is next
            changed |= set(enumerate(pair))
            tries[tuple(pair)] += 1
            moments = np.flatnonzero(which == k)
            key = scene.figure_of(pair)
            if key not in known:
                known[key] = _remedy(scene, pair, which, k)
            remedy = known[key]
            if isinstance(remedy, Detour):
                bumps[remedy.side][pair[remedy.side], :3] += remedy.way
                if remedy.share < 1.0:
                    _lower(hands[remedy.side], most[remedy.side], pair[remedy.side], remedy.share)
            elif isinstance(remedy, Giving):
                event = pair[remedy.side]
                gives[remedy.side][event] = remedy.row(float(hands[remedy.side].events.time_s[event]))
            elif remedy is not None:
                side, rise = remedy
                contacts[side][np.ix_(scene.at(side, moments), SLOPES)] += rise
            else:
                side = scene.lower(moments)
                _lower(hands[side], most[side], pair[side], _LOWER)
        right, left = (hand.led(*new) for hand, *new in zip(hands, bumps, most, contacts, gives, strict=True))
        hands = (right, left)
    return hands


Remedy = Detour | Giving | tuple[int, float] | None
"""What undoes a tangle: a way round, giving way, a hand whose stick is so much steeper, or nothing."""


def _remedy(scene: BothHands, pair: list[int], which: NDArray[np.int64], k: int) -> Remedy:
    """What undoes tangle `k` of `which`: the first that is enough, in this order; else what comes nearest to it."""
    moments = np.flatnonzero(which == k)
    detour = way_round(scene, pair, moments)
    if detour is not None and detour.near_m <= 0.0:
        return detour
    slope = steeper(scene, moments)
    if slope is not None:
        return slope
    giving = giving_way(scene, pair, which, k)
    if giving is not None and (detour is None or giving.price < detour.price):
        return giving
    return detour


def _lower(hand: HandPart, most: Array, stretch: int, share: float) -> None:
    """Lower both strokes about a stretch of `hand` to this share of what they may be at `most` (n,)."""
    about = slice(stretch, stretch + 2)
    least = np.minimum(_LEAST_HEIGHT_M / np.maximum(hand.strokes.height_m[about], 1e-6), 1.0)
    most[about] = np.minimum(most[about], np.maximum(share * np.minimum(most[about], 1.0), least))
