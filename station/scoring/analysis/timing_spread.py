"""How a set of asynchronies is summed up: mean and spread apart, with the interval that the data can bear.

Asynchronies are in ms, negative is early. Grace strokes are paired but never counted here: their distance from the main
stroke is the hand's choice, not the clock's. No data is None: a mean needs one value, a spread two, an interval four
slots.

Strokes of one slot share the player's inner clock, and one slot's error is carried on in part to the next (lag-1 about
.2–.4 in HUMANS), so that n strokes say less than n independent ones. The interval therefore rests on the means of the
slots and on their number shrunk by (1 − ρ)/(1 + ρ), the effective number of a first-order autoregression.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MIN_SLOTS = 4
"""Below that a confidence interval says nothing (our choice: three degrees of freedom)."""

_MAX_LAG_1 = 0.9


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
    _, slot = np.unique(slots, return_inverse=True)
    counts = np.bincount(slot)
    if len(counts) < MIN_SLOTS:
        return None
    means = np.bincount(slot, weights=values) / counts
    off = means - means.mean()
    variance = float(off @ off) / (len(off) - 1)
    if variance == 0.0:
        return StandardError(0.0, len(off) - 1.0)
    lag_1 = float(off[1:] @ off[:-1]) / float(off @ off)
    rho = min(max(lag_1, 0.0), _MAX_LAG_1)
    effective = max(len(off) * (1 - rho) / (1 + rho), 2.0)
    return StandardError((variance / effective) ** 0.5, effective - 1)
