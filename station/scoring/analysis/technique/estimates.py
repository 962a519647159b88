"""Figures with the interval that the data can bear: a mean, or the size of a scatter.

The unit stands in the name of the field that holds the figure. No data is None: a mean needs one value, a spread two,
an interval `timing_spread.MIN_SLOTS` slots.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.scoring.analysis.timing_spread import MIN_SLOTS, persistence, slot_sums, spread

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

    A pooled variance of n values in g groups has n − g degrees of freedom, fewer where values of one slot or of
    neighbouring slots (`slots` (n,)) go together or where some lie far off: 2/v, with v its squared standard error as a
    share of it. That is taken from the squares' sums over slots, never less than the normal law's 2/(n − g), times
    (1 + ρ²)/(1 − ρ²) for a lag-1 correlation ρ (Bartlett 1946). The interval is that of the variance's logarithm.
    """
    _, group = np.unique(groups, return_inverse=True)
    counts = np.bincount(group)
    repeated = counts[group] > 1
    if not repeated.any():
        return Scatter(0, None, None)
    off = (values - (np.bincount(group, weights=values) / counts)[group])[repeated]
    freedom = len(off) - int((counts > 1).sum())
    variance = float(off @ off) / freedom
    found = Scatter(len(off), variance**0.5, None)
    each = slot_sums(off, slots[repeated])
    if len(each) < _FEWEST_FOR_SD:
        return found
    if variance == 0.0:
        return replace(found, ci=(0.0, 0.0))
    squares = slot_sums(off * off * len(off) / freedom / variance - 1, slots[repeated])
    rho = persistence(each)
    share = float(squares @ squares) / (len(each) - 1) / len(each) * len(off) / freedom
    share = max(share, 2 / freedom) * (1 + rho**2) / (1 - rho**2)
    factor = float(np.exp(min(t_quantile_95(2 / share) * share**0.5 / 2, np.log(_WIDEST))))
    return replace(found, ci=(variance**0.5 / factor, variance**0.5 * factor))


_FEWEST_FOR_SD = 2 * MIN_SLOTS
"""A spread asks for more than a mean: of fewer slots that hang together intervals know nothing (simulated)."""

_WIDEST = 10.0
"""An interval's ends are at most so many times the SD away: every spread of a hand lies within, and more is no news."""
