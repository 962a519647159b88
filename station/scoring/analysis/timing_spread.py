"""How a set of asynchronies is summed up: mean and spread apart, with the interval that the data can bear.

Asynchronies are in ms, negative is early. Grace strokes are paired but never counted here: their distance from the main
stroke is the hand's choice, not the clock's. No data is None: a mean needs one value, a spread two, an interval
`MIN_SLOTS` slots.

Strokes of one slot share the player's inner clock, and one slot's error is carried on in part to the next (lag-1 about
.2–.4 in HUMANS), so that n strokes say less than n independent ones. With u_k the sum of slot k's deviations from the
mean, in units of the mean number of strokes a slot, the mean's error is that of the mean of u. Its long-run variance Ω
is read from the slow end of the spectrum, where an error of any shape shows all that it does to a mean:

    e_k = u_k − ρ·u_{k−1},     Ω = mean over j = 1 … q of Λ_j² / (1 − ρ)²,     Λ_j = √(2/n)·Σ e_k·cos(πj(k − ½)/n)

and the interval is mean ± t_q·√(Ω/slots), that of a slope over x ± t_q·√(Ω/Σx²) with cosines made orthogonal to x
(equally weighted cosines, Lazarus, Lewis, Stock & Watson 2018; prewhitened after Andrews & Monahan 1992). ρ is
the larger of the lag-1 correlation and the root of the lag-2 one, which noise of the hand hides less, each with its
bias (1 + 3ρ)/n put back (Marriott & Pope 1954), and a standard error added: to think strokes more independent than they
are is the costlier mistake. `docs/report.md` says how often it holds.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MIN_SLOTS = 8
"""Fewer slots cannot tell how much one depends on the one before: intervals of 4 to 7 held the mean in 70–90 % of rows
with a lag-1 correlation of .6 (simulated)."""

_MOST_PERSISTENCE = 0.97
"""Beyond, the deviations are a drift and no scatter about a mean (our choice)."""

_MOST_HIDDEN = 2.0
"""The hand's noise halves the lag-1 correlation at most (HUMANS: σ_M is half of σ_C and less); what goes on at lag 2
and not at lag 1 is a pattern, such as strokes that alternate."""

_WAVES_PER_SLOT, _FEWEST_WAVES, _MOST_WAVES = 0.3, 2, 8
"""q = 0.3·n^⅔ (Lazarus et al. 2018: small q keeps the promise, large q narrows the interval), at most 8: t₈ is wider
than the normal law by a sixth only, and slow sway under fast noise is still seen (simulated)."""


@dataclass(frozen=True, slots=True)
class Spread:
    """`count` values, their mean, SD (n − 1) and the 95 % interval of the mean, in ms; None where unknown."""

    count: int
    mean_ms: float | None
    sd_ms: float | None
    ci_ms: tuple[float, float] | None


def timed_notes(score: Score, alignment: Alignment) -> Flags:
    """Which notes (n,) have a time that counts: matched, and no grace strokes."""
    return np.asarray((alignment.note_label == Label.MATCH) & ~score.is_grace)


def asynchrony_ms(alignment: Alignment) -> Floats:
    """Played − due of every paired note in ms, NaN elsewhere, shape (n,)."""
    return np.where(alignment.hit_of_note >= 0, alignment.asynchrony_ns / NS_PER_MS, np.nan)


def spread(values_ms: Floats, slots: NDArray[np.int64]) -> Spread:
    """Sum up values (n,) whose `slots` (n,) say which belong to one moment; any order."""
    n = len(values_ms)
    error = standard_error(values_ms, slots)
    mean = float(values_ms.mean()) if n else None
    sd = float(values_ms.std(ddof=1)) if n > 1 else None
    if error is None or mean is None:
        return Spread(n, mean, sd, None)
    half = t_quantile_95(error.freedom) * error.value
    return Spread(n, mean, sd, (mean - half, mean + half))


@dataclass(frozen=True, slots=True)
class StandardError:
    """Standard error of a mean in the unit of its values, with its degrees of freedom."""

    value: float
    freedom: float


def standard_error(values: Floats, slots: NDArray[np.int64]) -> StandardError | None:
    """Standard error of the mean of values (n,) that come in `slots` (n,); None of fewer than `MIN_SLOTS` slots."""
    off = slot_sums(values - values.mean(), slots) if len(values) else values
    if len(off) < MIN_SLOTS:
        return None
    variance, waves = _long_run(off)
    return StandardError(math.sqrt(variance / len(off)), float(waves))


@dataclass(frozen=True, slots=True)
class Slope:
    """How fast y rises with x, and its 95 % interval; None of fewer than `MIN_SLOTS` values."""

    value: float
    ci: tuple[float, float] | None


def slope(x: Floats, y: Floats) -> Slope | None:
    """The slope of `y` (n,), in the order in which it was played, over `x` (n,); None where `x` is constant."""
    off = x - x.mean() if len(x) else x
    square = float(off @ off)
    if not square > 0:
        return None
    rise = float(off @ y) / square
    if len(x) < MIN_SLOTS:
        return Slope(rise, None)
    variance, waves = _long_run(y - y.mean() - rise * off, off)
    half = t_quantile_95(float(waves)) * math.sqrt(variance / square)
    return Slope(rise, (rise - half, rise + half))


def _long_run(off: Floats, along: Floats | None = None) -> tuple[float, int]:
    """Ω of deviations (n,) from their mean, or from a line over `along` (n,), and how many cosines tell it."""
    count = len(off)
    rho = persistence(off, 1 if along is None else 2)
    rest = off[1:] - rho * off[:-1]
    waves = min(max(round(_WAVES_PER_SLOT * count ** (2 / 3)), _FEWEST_WAVES), _MOST_WAVES)
    told = _cosines(count - 1, waves)
    if along is not None:
        line = along[1:] - rho * along[:-1]
        told = np.linalg.qr(np.column_stack([line - line.mean(), told]))[0][:, 1:]
    return float(np.square(rest @ told).mean()) / (1 - rho) ** 2, waves


@lru_cache(maxsize=16)
def _cosines(count: int, waves: int) -> Floats:
    """√(2/n)·cos(πj(k − ½)/n), orthogonal to each other and to a constant, shape (count, waves)."""
    at = (np.arange(count) + 0.5) / count
    return np.asarray(np.sqrt(2 / count) * np.cos(np.pi * at[:, None] * np.arange(1, waves + 1)))


def slot_sums(off: Floats, slots: NDArray[np.int64]) -> Floats:
    """What each slot (k,), in order, adds to the mean of `off` (n,), times the number of slots: their mean is its."""
    _, slot = np.unique(slots, return_inverse=True)
    sums = np.bincount(slot, weights=off)
    return np.asarray(sums * (len(sums) / len(off)))


def persistence(off: Floats, fitted: int = 1) -> float:
    """How much of one deviation lives on in the next, on the safe side.

    `off` (k,) are what is left when so many columns, the mean first, were `fitted`: each takes as much off the lag-1.
    """
    count, square = len(off), float(off @ off)
    if square == 0.0:
        return 0.0
    lag_1, lag_2 = (float(off[lag:] @ off[:-lag]) / square for lag in (1, 2))
    first, second = (
        min(max((count * seen + fitted) / (count - 2 - fitted), 0.0), _MOST_PERSISTENCE) for seen in (lag_1, lag_2)
    )
    likely = max(first, min(math.sqrt(second), _MOST_HIDDEN * first))
    return min(likely + math.sqrt((1 - likely * likely) / count), _MOST_PERSISTENCE)
