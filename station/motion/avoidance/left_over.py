"""What no way round was found for: the bars in which hands still meet each other or a stick the kit.

In: both hands' parts as the optimiser left them. Out: an `InfeasibleDemand` for each bar and kind.
Prices, spare room and flesh that yields at the body are no faults: only what is deeper than `FAULT_M` in something, or
an elbow beyond its limit.
"""

import math

import numpy as np

from station.core.pieces import Limb
from station.motion.avoidance.cost import WRONG_M, Array, Hands, Moments, Stage
from station.motion.feasibility.on_a_kit import InfeasibleDemand
from station.motion.kinematics.body_solids import in_each_other, points_of
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.strokes.hand import HandPart
from station.music.score import Score

FAULT_M = 0.001
"""What is less deep touches (the tip's own exactness)."""
_LIMIT_RAD = math.radians(1.0)
"""So much farther no eye sees a joint bend (our choice)."""
_SIDES = ("right", "left")


def left_over(score: Score, parts: tuple[HandPart, HandPart], stage: Stage) -> tuple[InfeasibleDemand, ...]:
    """Every bar in which both hands of `parts` still are in something, in order; strokes as natural ones are."""
    hands = Hands(stage, parts)
    wrong = np.flatnonzero(hands.cost(np.arange(len(stage.grid))) > WRONG_M)
    if not len(wrong):
        return ()
    bars = score.tempo_map.bars_at(score.tempo_map.ticks_at(np.maximum(stage.grid[wrong], 0.0)))
    found = []
    for (limb, text), deep in _depths(hands, wrong).items():
        for bar in np.unique(bars[deep > FAULT_M]).tolist():
            times = stage.grid[wrong[(bars == bar) & (deep > FAULT_M)]]
            said = f"bar {bar + 1}: {text}"
            found.append(InfeasibleDemand(bar, limb, float(times[0]), float(times[-1]), said))
    return tuple(sorted(found, key=lambda demand: (demand.bar, demand.limb, demand.start_s)))


def _depths(hands: Hands, on: Moments) -> dict[tuple[Limb, str], Array]:
    """How deep what is in what at some moments, (n,) each, by whose it is and how it is said."""
    stage = hands.stage
    stature = stage.figure.stature_m
    right, left = (hands.arms(side, on)[0] for side in (0, 1))
    points = points_of(right), points_of(left)
    found = {(Limb.RIGHT_HAND, "the hands meet"): np.max(list(in_each_other(*points, stature).values()), axis=0)}
    for limb, side, own, arm in zip((Limb.RIGHT_HAND, Limb.LEFT_HAND), _SIDES, points, (right, left), strict=True):
        stick = depth_in_kit(stage.kit, own.butt, own.tip, np.diff(on, prepend=-1) == 1)
        found[limb, f"the {side} stick meets the kit"] = stick
        found[limb, f"the {side} elbow bends too far"] = (
            np.asarray(arm.elbow_bend) - stage.figure.limits.elbow_flexion - _LIMIT_RAD
        )
    return found
