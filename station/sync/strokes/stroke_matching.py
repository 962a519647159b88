"""How likely each stick struck each hit: exact probabilities over all one-to-one matchings of hits and strokes.

Times are ms, strokes' moved by their stick's offset. Hits and strokes that are near each other in time form small
groups; within a group every matching that keeps the order of each stick's strokes is weighed.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

GATE_MS = 25.0
"""A hit and a stroke farther apart do not belong together: half of two sticks' fastest stroke (20/s, HUMANS.md)."""
LOST_HIT, LOST_STROKE = 0.03, 0.05 / 200.0
"""How often a hit has no stroke (crosstalk, a stroke too soft to feel), and, each ms, a stroke has no hit (sticks
clicked, a missed pad: one in 20, at five strokes a second); our choice."""
TAIL, TAIL_TIMES = 0.05, 4.0
"""So many matches are this much farther off than the rest: onsets out of lost samples; our choice."""
MOST_HITS = 6
"""Longer groups are cut: 6 hits without a pause of `GATE_MS` are no two hands' playing."""

Weigh = Callable[[int, int], float]
"""How much better (> 1) or worse a hit (index) fits a stroke (index) than any, by all but time."""


class Stroke(NamedTuple):
    """A stroke's time with its offset, its place among all, and its stick (0, 1, …)."""

    at_ms: float
    order: int
    stick: int


@dataclass(slots=True)
class Matching:
    """`by_stick[hit][stick]` the probability that the stick struck it; `stroke[hit]` the likeliest stroke's index."""

    by_stick: dict[int, dict[int, float]] = field(default_factory=dict)
    stroke: dict[int, int] = field(default_factory=dict)
    log_likelihood: float = 0.0


def match(hits_ms: Sequence[float], strokes: Sequence[Stroke], jitter_ms: float, weigh: Weigh) -> Matching:
    """The matching of hits at `hits_ms` (sorted) with `strokes` (sorted by time); residuals are `jitter_ms` wide."""
    found = Matching()
    for hits, near in _groups(hits_ms, strokes):
        _match_group(found, hits_ms, hits, near, jitter_ms, weigh)
    return found


def density(residual_ms: float, jitter_ms: float) -> float:
    """The density, per ms, of a residual between a hit and its stroke."""
    x = residual_ms / jitter_ms
    narrow = math.exp(-0.5 * x * x)
    wide = math.exp(-0.5 * (x / TAIL_TIMES) ** 2) / TAIL_TIMES
    return ((1 - TAIL) * narrow + TAIL * wide) / (jitter_ms * math.sqrt(2 * math.pi))


def _groups(hits_ms: Sequence[float], strokes: Sequence[Stroke]) -> list[tuple[list[int], list[Stroke]]]:
    events: list[tuple[float, int, Stroke | None]] = [(at, k, None) for k, at in enumerate(hits_ms)]
    events += [(stroke.at_ms, -1, stroke) for stroke in strokes]
    events.sort(key=lambda event: (event[0], event[1]))
    groups: list[tuple[list[int], list[Stroke]]] = []
    before_ms = -math.inf
    for at_ms, hit, stroke in events:
        if at_ms - before_ms > GATE_MS or (stroke is None and len(groups[-1][0]) >= MOST_HITS):
            groups.append(([], []))
        before_ms = at_ms
        if stroke is None:
            groups[-1][0].append(hit)
        else:
            groups[-1][1].append(stroke)
    return groups


def _match_group(
    found: Matching, hits_ms: Sequence[float], hits: list[int], strokes: list[Stroke], jitter_ms: float, weigh: Weigh
) -> None:
    """Add a group's probabilities: the weights of all its matchings, summed."""
    options = [
        [
            (k, density(hits_ms[hit] - stroke.at_ms, jitter_ms) * weigh(hit, stroke.order))
            for k, stroke in enumerate(strokes)
            if abs(hits_ms[hit] - stroke.at_ms) <= GATE_MS
        ]
        for hit in hits
    ]
    sums: list[dict[int, float]] = [{} for _ in hits]
    chosen: list[int] = []
    last: dict[int, int] = {}

    def walk(weight: float, matched: int) -> float:
        place = len(chosen)
        if place == len(hits):
            weight *= LOST_STROKE ** (len(strokes) - matched)
            for k, stroke in enumerate(chosen):
                sums[k][stroke] = sums[k].get(stroke, 0.0) + weight
            return weight
        chosen.append(-1)
        total = walk(weight * LOST_HIT, matched)
        for k, share in options[place]:
            stick = strokes[k].stick
            before = last.get(stick, -1)
            if k > before:
                chosen[place], last[stick] = k, k
                total += walk(weight * share, matched + 1)
                last[stick] = before
        chosen.pop()
        return total

    total = walk(1.0, 0)
    found.log_likelihood += math.log(max(total, 1e-300))
    for hit, of_hit in zip(hits, sums, strict=True):
        by_stick: dict[int, float] = {}
        for k, weight in of_hit.items():
            if k >= 0:
                by_stick[strokes[k].stick] = by_stick.get(strokes[k].stick, 0.0) + weight / total
        best = max(of_hit, key=lambda k: of_hit[k])
        found.by_stick[hit] = by_stick
        if best >= 0:
            found.stroke[hit] = strokes[best].order
