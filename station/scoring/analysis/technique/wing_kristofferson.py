"""The inner clock and the hand told apart: timekeeper and motor variance after Wing & Kristofferson (1973).

A stroke is off by A = B + M: the timekeeper's error B and the hand's own noise M of variance σ_M². The timekeeper adds
noise of variance σ_C² each interval.

*With a click* the player takes the share α of every error back (Vorberg & Wing 1996), else asynchronies would wander:

    Bₙ₊₁ = Bₙ − α·Aₙ + Cₙ,   so that A is stationary with   lag-1 autocovariance = (1 − α)·var A − σ_M²,
    var A = (σ_C² + 2·α·σ_M²)/(1 − (1 − α)²)

Only three autocovariances say all that, hence the exact Gaussian likelihood: given A the next B is normal, so that one
Kalman filter a grid point (α, σ_M²/var A) gives it; var A is profiled out. Intervals are those of the profile
likelihood (drop of ½·χ² at 95 %). Where strokes hardly depend on each other, the likelihood is flat and nothing can be
told.

*Without a click* nothing is corrected: intervals are Iₙ = T + Cₙ + Mₙ₊₁ − Mₙ, and

    lag-1 autocovariance of I = −σ_M²,   var I = σ_C² + 2·σ_M²

over runs of `_RUN` intervals, each freed of its straight line (a tempo drifts). A line takes about 2·σ_C²/n off every
autocovariance, which is put back. The model admits a lag-1 correlation between −½ and 0 and none at lag 2.

One series is looked at: the piece, or limb where limbs are known, with most strokes at its commonest spacing.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.core.student_t import t_quantile_95
from station.core.units import NS_PER_MS, PPQ
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment, Reference

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


class NotSeparable(Enum):
    """Why clock and hand cannot be told apart."""

    FEW = "too few evenly spaced strokes"
    INDEPENDENT = "one stroke hardly depends on the one before, which both would explain"
    NOT_ADMITTED = "how one interval follows the other does not fit a clock and a hand"


@dataclass(frozen=True, slots=True)
class ClockShare:
    """An SD in ms with its 95 % interval."""

    sd_ms: float
    ci: tuple[float, float]


@dataclass(frozen=True, slots=True)
class WingKristofferson:
    """`strokes` of one series `interval_ms` apart and what they tell; None where not known.

    `lag_1` is their autocorrelation, of asynchronies with a click and of intervals without; then the two `ClockShare`s
    and the share that is corrected, or why they cannot be told.
    """

    with_click: bool
    strokes: int
    interval_ms: float | None
    lag_1: float | None
    timekeeper: ClockShare | None = None
    motor: ClockShare | None = None
    correction: float | None = None
    cannot_tell: NotSeparable | None = None


FEWEST = 100
"""Fewer strokes tell nothing within a factor of two (our choice, after simulation)."""
_MOST = 2000
"""More strokes tell little more and take time."""
_WIDEST = 4.0
"""An interval whose ends are more than so many times apart tells nothing (our choice)."""
_DROP = 1.920729
"""Half the 95 % point of χ² with one degree of freedom."""
_MISFIT_SDS = 4.0
"""Autocorrelations that lie farther from the model's are no clock's (their SD is about 1/√n; our choice)."""
_RUN = 32
"""Intervals in a run without a click: the length of Wing and Kristofferson's trials."""
_FEWEST_RUNS = 4
_EVENLY = 0.02
"""Spacings that differ by so much are one spacing: ticks are rounded."""


def wing_kristofferson(score: Score, performance: Performance, alignment: Alignment) -> WingKristofferson:
    """Clock and hand, by the model that the reference asks for."""
    with_click = alignment.reference is not Reference.PLAYER
    runs, interval_ms = _series(score, alignment)
    count = sum(len(run) for run in runs)
    if interval_ms is None or count < FEWEST:
        return WingKristofferson(with_click, count, interval_ms, None, cannot_tell=NotSeparable.FEW)
    if with_click:
        off = _without_places(score, asynchrony_ms(alignment), np.concatenate(runs))
        return _with_click([off[run] for run in runs], interval_ms)
    at_ms = performance.hits["at_ns"][np.maximum(alignment.hit_of_note, 0)] / NS_PER_MS
    return _without_click([np.diff(at_ms[run]) for run in runs], interval_ms, count)


def _without_places(score: Score, off: Floats, rows: Indices) -> Floats:
    """Asynchronies of `rows` less the mean of their place in the beat: a lean of all offbeats is neither."""
    place = np.unique(score.notes["tick"][rows] % PPQ, return_inverse=True)[1]
    rest = off.copy()
    rest[rows] -= (np.bincount(place, weights=off[rows]) / np.bincount(place))[place]
    return rest


# --- the series -------------------------------------------------------------------------------------------------------


def _series(score: Score, alignment: Alignment) -> tuple[list[Indices], float | None]:
    """Runs of rows that one limb or piece plays at its commonest spacing, and the spacing in ms; the longest series."""
    timed, limbs = timed_notes(score, alignment), score.notes["limb"]
    voice = np.where(limbs == Limb.UNKNOWN, score.notes["piece"].astype(np.int64), -1 - limbs.astype(np.int64))
    best: tuple[list[Indices], float | None] = ([], None)
    for own in np.unique(voice[timed]).tolist():
        rows = np.flatnonzero((voice == own) & ~score.is_grace)
        rows = rows[np.unique(score.notes["tick"][rows], return_index=True)[1]]
        found = _runs(score, alignment, rows, timed)
        if sum(map(len, found[0])) > sum(map(len, best[0])):
            best = found
    return best


def _runs(
    score: Score, alignment: Alignment, rows: Indices, timed: NDArray[np.bool_]
) -> tuple[list[Indices], float | None]:
    gaps = np.diff(score.onset_ns[rows]) / NS_PER_MS
    if not len(gaps):
        return [], None
    spacing = float(np.median(gaps[np.abs(gaps - _commonest(gaps)) <= _EVENLY * gaps]))
    segment = alignment.segment[np.maximum(alignment.hit_of_note[rows], 0)] if len(alignment.segment) else 0 * rows
    joined = (np.abs(gaps - spacing) <= _EVENLY * spacing) & timed[rows[:-1]] & timed[rows[1:]]
    joined &= np.diff(segment) == 0
    runs = [run for run in np.split(rows, np.flatnonzero(~joined) + 1) if len(run) > 1]
    return runs, spacing


def _commonest(gaps: Floats) -> float:
    """The gap that most others are like."""
    values, counts = np.unique(np.round(gaps), return_counts=True)
    return float(values[np.argmax(counts)])


# --- with a click -----------------------------------------------------------------------------------------------------

_PHI, _SHARE = (
    grid.ravel() for grid in np.meshgrid(np.linspace(0.02, 0.98, 49), np.linspace(0.0, 0.99, 50), indexing="ij")
)
_GRID = np.stack([_PHI, _SHARE])[:, (1 - _PHI**2) - 2 * (1 - _PHI) * _SHARE >= 0]
"""φ = 1 − α, and σ_M² as a share of var A, where σ_C² is not negative."""


def _with_click(runs: list[Floats], interval_ms: float) -> WingKristofferson:
    """The likeliest clock and hand, and how far off they may be."""
    runs = _first(runs, _MOST)
    lag_1, lag_2 = _lag(runs, 1), _lag(runs, 2)
    if lag_1 is None or lag_2 is None:
        return WingKristofferson(True, sum(map(len, runs)), interval_ms, lag_1, cannot_tell=NotSeparable.FEW)
    phi, share = _GRID
    squares, logs, count = _filtered(runs, phi, share)
    variance = squares / count
    likelihood = -0.5 * (count * np.log(variance) + logs)
    clock = variance * ((1 - phi**2) - 2 * (1 - phi) * share)
    best = int(np.argmax(likelihood))
    inside = likelihood >= likelihood[best] - _DROP
    timekeeper, motor = (
        _part(part[best], (part[inside].min(), part[inside].max())) for part in (clock, variance * share)
    )
    expected = float(phi[best] - share[best])
    off = max(abs(lag_1 - expected), abs(lag_2 - phi[best] * expected))
    if off > _MISFIT_SDS / count**0.5:
        return WingKristofferson(True, count, interval_ms, lag_1, cannot_tell=NotSeparable.NOT_ADMITTED)
    if timekeeper is None or motor is None:
        return WingKristofferson(True, count, interval_ms, lag_1, cannot_tell=NotSeparable.INDEPENDENT)
    return WingKristofferson(True, count, interval_ms, lag_1, timekeeper, motor, correction=1 - float(phi[best]))


def _filtered(runs: list[Floats], phi: Floats, share: Floats) -> tuple[Floats, Floats, int]:
    """Sum of the squared innovations over their variances, and of the variances' logarithms, at each grid point.

    In units of var A. A run starts from the stationary law: B ~ N(0, 1 − share).
    """
    noise = (1 - phi**2) - 2 * (1 - phi) * share
    squares, logs, count = np.zeros(len(phi)), np.zeros(len(phi)), 0
    for run in runs:
        mean, spread = np.zeros(len(phi)), 1 - share
        for value in run.tolist():
            total = spread + share
            off = value - mean
            squares += off * off / total
            logs += np.log(total)
            gain = spread / total
            mean = mean + gain * off - (1 - phi) * value
            spread = spread - gain * spread + noise
        count += len(run)
    return squares, logs, count


def _first(runs: list[Floats], most: int) -> list[Floats]:
    """The first `most` values."""
    ends = np.cumsum([len(run) for run in runs])
    return [run[: max(most - (int(end) - len(run)), 0)] for run, end in zip(runs, ends, strict=True)]


def _lag(runs: list[Floats], lag: int) -> float | None:
    """Autocorrelation over pairs of one run; None where there is nothing to compare."""
    square = sum(float(run @ run) for run in runs) / max(sum(map(len, runs)), 1)
    pairs = sum(max(len(run) - lag, 0) for run in runs)
    if not pairs or not square:
        return None
    return sum(float(run[lag:] @ run[:-lag]) for run in runs if len(run) > lag) / pairs / square


def _part(variance: float, ends: tuple[float, float]) -> ClockShare | None:
    """The SDs of variances; None where the interval tells nothing."""
    low, high = (float(max(end, 0.0)) ** 0.5 for end in ends)
    if variance <= 0 or low <= 0 or high > _WIDEST * low:
        return None
    return ClockShare(float(variance) ** 0.5, (low, high))


# --- without a click --------------------------------------------------------------------------------------------------


def _without_click(intervals: list[Floats], interval_ms: float, strokes: int) -> WingKristofferson:
    """Clock and hand from runs of intervals; their intervals by Student's t over the runs."""
    blocks = [run[k : k + _RUN] for run in intervals for k in range(0, len(run) - _RUN + 1, _RUN)]
    if len(blocks) < _FEWEST_RUNS:
        return WingKristofferson(False, strokes, interval_ms, None, cannot_tell=NotSeparable.FEW)
    lags = np.array([_autocovariances(block) for block in blocks])
    g0, g1, _ = lags.mean(axis=0)
    clocks = (lags[:, 0] + 2 * lags[:, 1]) / (1 - 6 / _RUN)
    hands = -(lags[:, 1] + 2 * clocks / _RUN)
    lag_1 = float(g1 / g0) if g0 > 0 else None
    half = t_quantile_95(len(blocks) - 1.0) / len(blocks) ** 0.5
    beyond = lags[:, 2] + 2 * clocks / _RUN
    timekeeper, motor = (
        _part(part.mean(), (part.mean() - half * part.std(ddof=1), part.mean() + half * part.std(ddof=1)))
        for part in (clocks, hands)
    )
    if timekeeper is None or motor is None or abs(beyond.mean()) > half * beyond.std(ddof=1):
        return WingKristofferson(False, strokes, interval_ms, lag_1, cannot_tell=NotSeparable.NOT_ADMITTED)
    return WingKristofferson(False, strokes, interval_ms, lag_1, timekeeper, motor)


def _autocovariances(block: Floats) -> tuple[float, float, float]:
    """Lags 0, 1 and 2 of a run freed of its straight line."""
    at = np.arange(len(block)) - (len(block) - 1) / 2
    rest = block - block.mean() - at * float(at @ block) / float(at @ at)
    n = len(rest)
    return float(rest @ rest) / n, float(rest[1:] @ rest[:-1]) / (n - 1), float(rest[2:] @ rest[:-2]) / (n - 2)
