"""Two close strokes of a drum: a flam, or two strokes of a run of which one came late and the next early.

Both are weighed by how well they explain the strokes about them (costs, negative natural logarithms). Those of a
run lie a cell apart, about which each falls with a spread; a flam is one of them, its grace stroke before it, which has
a flam's spacing and is, as a rule, far softer. Where no run is near, close strokes are a flam.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf, log
from statistics import fmean, median

RUN_MS = 120.0
"""So near to other strokes of its drum a pair is part of a run: sixteenths at 125 bpm (our choice)."""
_NEAR = 8
"""So many gaps before and after tell how far apart a run's strokes are (our choice)."""
_REST = 1.6
"""So much longer than the shorter gaps is one with a rest in it (our choice)."""
_BESIDE = 1.75
"""What is farther than so many cells is no neighbour in the run, but a rest lies between."""
_SPREAD_MS = 15.0
"""Between a professional's 10 ms and the 26 ms of the Groove MIDI Dataset (HUMANS, Timing)."""
_FLAM_MS, _FLAM_SPREAD_MS = 27.5, 8.0
"""A flam's spacing, 15–40 ms (HUMANS, Timing)."""
_GRACE_SHARE, _SHARE_SPREAD = 0.4, 0.35
"""A grace stroke has 25–50 % of its note's velocity (HUMANS, Timing); the spread is of the natural logarithm."""
_ALIKE, _ALIKE_COST = 1.0, 2.5
"""Grace strokes as loud as their note are one in ten (our choice)."""
_RUN_SPREAD, _ACCENT_COST = 0.25, 1.5
"""Strokes of a run are alike but for accents, which a fifth of them are (our choice)."""


@dataclass(frozen=True, slots=True)
class Neighbours:
    """The run about a pair: its cell, and the strokes before and after it where they are not farther than its cells."""

    cell_ms: float
    before_ms: float | None
    after_ms: float | None


def neighbours(starts: Sequence[float], ends: Sequence[float], at: int) -> Neighbours | None:
    """The run about chain `at` of those that go from `starts` to `ends` (ms), or None where none is near."""
    gaps = [b - a for a, b in (*pairwise(ends[max(at - _NEAR, 0) : at]), *pairwise(starts[at + 1 : at + 1 + _NEAR]))]
    cell = _cell(gaps)
    if cell > RUN_MS:
        return None
    before = ends[at - 1] if at and starts[at] - ends[at - 1] <= _BESIDE * cell else None
    after = starts[at + 1] if at + 1 < len(starts) and starts[at + 1] - ends[at] <= _BESIDE * cell else None
    return Neighbours(cell, before, after) if before is not None or after is not None else None


def _cell(gaps: Sequence[float]) -> float:
    """The length of most of the short gaps: those that are no rests."""
    if not gaps:
        return inf
    short = sorted(gaps)[len(gaps) // 4]
    return median(gap for gap in gaps if gap <= _REST * short)


def is_two_of_a_run(first_ms: float, second_ms: float, share: float, near: Neighbours, rare: float) -> bool:
    """Whether strokes at those times, the first of `share` of the second's velocity, are two of the run.

    `rare` is what a flam costs before anything is heard, as seldom as the drum has them.
    """
    before = [] if near.before_ms is None else [near.before_ms]
    after = [] if near.after_ms is None else [near.after_ms]
    two = _unevenness([*before, first_ms, second_ms, *after], near.cell_ms) + log(_SPREAD_MS)
    flam = _unevenness([*before, second_ms, *after], near.cell_ms) + log(_FLAM_SPREAD_MS) + rare
    flam += ((second_ms - first_ms - _FLAM_MS) / _FLAM_SPREAD_MS) ** 2 / 2
    two += min((log(share) / _RUN_SPREAD) ** 2 / 2, _ACCENT_COST)
    soft = (log(share / _GRACE_SHARE) / _SHARE_SPREAD) ** 2 / 2
    flam += min(soft, (log(share / _ALIKE) / _RUN_SPREAD) ** 2 / 2 + _ALIKE_COST)
    return two < flam


def _unevenness(times_ms: Sequence[float], cell_ms: float) -> float:
    """What it costs that strokes meant a cell apart fall at those times."""
    errors = [ms - i * cell_ms for i, ms in enumerate(times_ms)]
    middle = fmean(errors)
    return sum((error - middle) ** 2 for error in errors) / (2 * _SPREAD_MS**2)
