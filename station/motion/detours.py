"""Ways round: where a hand on its way would bring its stick into the other's stick or arm, it is led around them.

Both hands are looked at `RATE_HZ` times a second. Every tangle (`tangles`) is undone by the detour that helps most;
where neither hand travels, the upper one's stick is held steeper, or the lower one's stroke lower. What is found once
for a figure of the score is kept for its repetitions.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.events import LONG_AGO_S
from station.motion.figure import Figure
from station.motion.hand import HandPart
from station.motion.kit import Kit
from station.motion.maths import Point
from station.motion.tangles import SLOPES, Detour, Scene, Stage

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
    hands: tuple[HandPart, HandPart], figure: Figure, kit: Kit, grid: Array, shoulders: tuple[Point, Point]
) -> tuple[HandPart, HandPart]:
    """Both parts with ways around each other, looked at `grid` (n,), when the shoulders are at `shoulders`."""
    known: dict[tuple[object, ...], Detour | None] = {}
    stage = Stage(figure, kit, grid, shoulders, (hands[0].bump, hands[1].bump))
    for _ in range(ROUNDS):
        scene = Scene.of(hands, stage)
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
                bumps[found.side][pair[found.side], :3] += found.way
                if found.share < 1.0:
                    _lower(hands[found.side], most[found.side], pair[found.side], found.share)
            elif steeper is not None:
                side, rise = steeper
                contacts[side][np.ix_(scene.at(side, moments), SLOPES)] += rise
            else:
                side = scene.lower(moments)
                _lower(hands[side], most[side], pair[side], _LOWER)
        hands = (hands[0].led(bumps[0], most[0], contacts[0]), hands[1].led(bumps[1], most[1], contacts[1]))
    return hands


def _lower(hand: HandPart, most: Array, stretch: int, share: float) -> None:
    """Lower both strokes about a stretch of `hand` to this share of what they may be at `most` (n,)."""
    about = slice(stretch, stretch + 2)
    least = np.minimum(_LEAST_HEIGHT_M / np.maximum(hand.strokes.height_m[about], 1e-6), 1.0)
    most[about] = np.minimum(most[about], np.maximum(share * np.minimum(most[about], 1.0), least))
