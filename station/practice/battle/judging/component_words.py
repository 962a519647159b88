"""The words of a component: the figures of its formula that cost points, each beside what would have been best.

A figure that earned all it can is not named, so that two turns read alike only where they earned alike, to the printed
precision.
"""

from collections.abc import Sequence
from dataclasses import dataclass

TOLD_FROM = 0.5
"""Points: what costs less is not seen in points that are printed without decimals."""


@dataclass(frozen=True, slots=True)
class Cost:
    """One figure of a formula: the points of 100 that it costs by itself, and what it was, in words."""

    points: float
    words: str


def words_of(costs: Sequence[Cost], at_best: str) -> str:
    """What cost points, the dearest first; `at_best` where nothing did."""
    told = sorted((cost for cost in costs if cost.points >= TOLD_FROM), key=lambda cost: -cost.points)
    return "; ".join(cost.words for cost in told) or at_best


def own_cost(own: float) -> Cost:
    """What was said before, which counts less; `own` 0–1 is the share that counts."""
    return Cost(100.0 * (1.0 - own), f"{100 * own:.0f} % counts, the rest was said before")
