"""Figures with the interval that the data can bear: a mean, or the size of a scatter.

The unit stands in the name of the field that holds the figure. No data is None: a mean needs one value, a spread two,
an interval `timing_spread.MIN_SLOTS` slots.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.scoring.analysis.timing_spread import spread, standard_error

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Estimate:
    """`count` values, their mean, SD (n − 1) and the 95 % interval of the mean; None where unknown."""

    count: int
    mean: float | None
    sd: float | None
    ci: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class Scatter:
    """How far `count` values scatter about their groups' means: pooled SD and its 95 % interval; None if unknown."""

    count: int
    sd: float | None
    ci: tuple[float, float] | None


def figure(values: Floats, slots: Indices) -> Estimate:
    """Sum up values (n,) that come in `slots` (n,), NaNs left out."""
    known = ~np.isnan(values)
    summed = spread(values[known], slots[known])
    return Estimate(summed.count, summed.mean_ms, summed.sd_ms, summed.ci_ms)


def difference(one: Estimate, other: Estimate) -> tuple[float, float] | None:
    """95 % interval of `one`'s mean less `other`'s, taken to be independent; None where either has none."""
    if one.ci is None or other.ci is None or one.mean is None or other.mean is None:
        return None
    half = float(np.hypot(one.ci[1] - one.mean, other.ci[1] - other.mean))
    apart = one.mean - other.mean
    return apart - half, apart + half


def scatter(values: Floats, groups: Indices, slots: Indices) -> Scatter:
    """Pooled SD of values (n,) about the means of their `groups` (n,); groups of one say nothing.

    The interval is that of the mean of the squares, which come in `slots` (n,).
    """
    _, group = np.unique(groups, return_inverse=True)
    counts = np.bincount(group)
    repeated = counts[group] > 1
    if not repeated.any():
        return Scatter(0, None, None)
    means = np.bincount(group, weights=values) / counts
    squares = ((values - means[group]) ** 2 * counts[group] / np.maximum(counts[group] - 1, 1))[repeated]
    mean_square = float(squares.mean())
    error = standard_error(squares, slots[repeated])
    if error is None:
        return Scatter(len(squares), mean_square**0.5, None)
    half = t_quantile_95(error.freedom) * error.value
    low, high = (max(mean_square + side * half, 0.0) ** 0.5 for side in (-1, 1))
    return Scatter(len(squares), mean_square**0.5, (low, high))
