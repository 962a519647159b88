"""How the tempo moves without a click: the change that a straight course of the tempo makes in eight bars.

When the strokes of a segment were played over when they are written is a parabola where the tempo rises or falls
evenly: t = a + b·s + c·s². Over a span S the time between strokes changes by the share 2·c·S/b, and the tempo by its
negative. What is left over hangs together where the inner clock wanders, so that the error rests on the number of
strokes that are independent, (1 − ρ)/(1 + ρ) of them: who wanders is not told that they rush.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.sparse_model import Effect
from station.scoring.analysis.timing_spread import timed_notes
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.matching.slow_drift import robust_sd

Floats = NDArray[np.float64]

BARS = 8
_FEWEST_SLOTS = 16
_FEWEST_BARS = 3.0
"""Fewer bars bear no course of the tempo (our choice)."""
_MOST_RHO = 0.98
_HUBER_SDS = 3.5


def tempo_change(score: Score, performance: Performance, alignment: Alignment) -> Effect | None:
    """By how many percent the tempo rose in `BARS` bars, or over the longest segment if that is shorter.

    A straight course through the whole segment: players who wander up and down by 3 % come back to it.

    Positive: it rushed. None with a click or on a shared time base, where being early or late says it, and where too
    little was played in one segment.
    """
    if alignment.reference is not Reference.PLAYER:
        return None
    rows = np.flatnonzero(timed_notes(score, alignment))
    hit = alignment.hit_of_note[rows]
    segment = alignment.segment[hit]
    if not len(rows):
        return None
    mine = segment == np.bincount(segment).argmax()
    rows, hit = rows[mine], hit[mine]
    ticks, first = np.unique(score.notes["tick"][rows], return_inverse=True)
    if len(ticks) < _FEWEST_SLOTS:
        return None
    counts = np.bincount(first)
    written = score.tempo_map.seconds_at(ticks)
    played = np.bincount(first, weights=performance.hits["at_ns"][hit] / NS_PER_S) / counts
    bar_s = float(score.tempo_map.seconds_at(score.tempo_map.meter_at(0).bar_ticks))
    length_s = float(written[-1] - written[0])
    if length_s < _FEWEST_BARS * bar_s:
        return None
    return _change(written, played, min(BARS * bar_s, length_s))


def _change(written: Floats, played: Floats, span_s: float) -> Effect:
    middle = (written - written.mean()) / max(float(np.ptp(written)), 1e-9)
    x = np.column_stack([np.ones(len(middle)), middle, middle**2])
    y = played - played.mean()
    inverse = np.linalg.inv(x.T @ x)
    fitted = x @ (inverse @ (x.T @ y))
    for _ in range(2):  # slips and wrong pairs are drawn in
        sd = max(robust_sd(y - fitted) or 0.0, 1e-6)
        drawn_in = fitted + np.clip(y - fitted, -_HUBER_SDS * sd, _HUBER_SDS * sd)
        beta = inverse @ (x.T @ drawn_in)
        fitted = x @ beta
    rest = drawn_in - fitted
    sides = float(rest[1:] @ rest[:-1]) / max(float(rest @ rest), 1e-18)
    rho = min(max(sides + 4.0 / len(rest), 0.0), _MOST_RHO)  # a fitted course leaves less than hangs together
    variance = float(rest @ rest) / max(len(rest) - 3, 1) * (1 + rho) / (1 - rho)
    percent = -100 * 2 * span_s / float(np.ptp(written)) / max(float(beta[1]), 1e-9)
    return Effect(float(percent * beta[2]), abs(percent) * (variance * float(inverse[2, 2])) ** 0.5, len(rest))
