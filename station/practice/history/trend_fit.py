"""A straight line through days of practice, with an interval that the data bear.

Sessions of a day share the day: its form, its mood, its kit. So a day is one observation, the mean of its sessions.
What was played on one device, at one level and near one tempo is a `stratum`, which has a height of its own; within
it the rest of the tempo's effect is taken out as linear in its logarithm. The slope, which all strata share, is
therefore what changed among like and like: who slows down gets no better by it, and a harder level is no step back.

The line is fitted by Huber's M-estimate with his pseudo-values (Huber 1981, Robust Statistics, section 7.10), so that a
session in which the telephone rang does not turn it; interval by Student's t, with the days less the parameters as its
freedom. Days are taken to be independent given the line; where neighbours go together, as form does, the variance is
widened by their lag-1 correlation (Bartlett 1946: (1 + ρ)/(1 − ρ)). A form that keeps 0.7 of itself from one day to
the next, every day, is more than that can see: then 95 % intervals hold the truth 84 to 88 times in 100.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile, t_quantile_95

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

LEAST_FREEDOM = 3
"""So many days beyond the parameters are needed (our choice: below it Student's t is 4 and more, and tells nothing)."""
_CORNER = 2.0
"""Huber's corner in SDs (our choice between 1.345 for asymptotics and none: few days bear little trimming)."""
_STEPS = 30
_STANDS_STILL = 1e-9
_RANK = 1e-7
_MAD = 1.4826
"""A normal law's SD for its median size."""
_LEAST_SCALE = 0.5
"""Of the plain SD: so that a handful of equal days makes no outliers of the others (our choice)."""
_FEWEST_FOR_LAG = 8
_MOST_RHO = 0.8
SAME_TEMPO = 0.01
"""Tempi this close, in their logarithm, nobody tells apart (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Observations:
    """Sessions: their `day` (n,) in days from any date, `value`, natural `log_tempo`, `stratum` from 0."""

    day: Floats
    value: Floats
    log_tempo: Floats
    stratum: Indices


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A line through days (d,): `slope` a day with its standard error, and the `half` width of a 95 % interval in SEs.

    `days` are those with sessions, in order, `values` what was measured on them with all strata brought to the height
    of the one that was played most; `freedom` is what the parameters leave of them for the errors. `height` is the
    line's at the `centre`, with its own standard error and the `covariance` of both.
    """

    days: Floats
    values: Floats
    slope: float
    slope_error: float
    half: float
    freedom: int
    centre: float
    height: float
    height_error: float
    covariance: float

    def at(self, day: Floats) -> Floats:
        """The line at `day` (n,)."""
        return self.height + self.slope * (day - self.centre)

    def is_surely_sloped(self, false: float) -> bool:
        """Whether of level lines a share of `false` at most, in either direction, look as steep as this one."""
        return abs(self.slope) > t_quantile(self.freedom, 1.0 - false) * self.slope_error

    def half_width(self, day: Floats) -> Floats:
        """Half the 95 % interval of the line at `day` (n,)."""
        off = day - self.centre
        variance = self.height_error**2 + 2 * off * self.covariance + (off * self.slope_error) ** 2
        return self.half * np.sqrt(np.maximum(variance, 0.0))


def fit_line(seen: Observations) -> Line | None:
    """The line, None where there are too few days, or where time cannot be told from tempo and stratum."""
    days, of_day = np.unique(np.floor(seen.day), return_inverse=True)
    count = np.bincount(of_day).astype(np.float64)

    def of_days(column: Floats) -> Floats:
        return np.bincount(of_day, weights=column) / count

    centre = float(days.mean())
    time = days - centre
    apart = _independent([of_days(column) for column in _columns(seen)])
    design = np.column_stack([*apart, time])
    freedom = len(days) - design.shape[1]
    if freedom < LEAST_FREEDOM or len(_independent([*apart, time])) == len(apart):
        return None
    beta, residual, covariance = _robust(design, of_days(seen.value), freedom)
    covariance = covariance * _widening(days, residual)
    return Line(
        days=days,
        values=beta[0] + beta[-1] * time + residual,
        slope=float(beta[-1]),
        slope_error=float(np.sqrt(covariance[-1, -1])),
        half=t_quantile_95(float(freedom)),
        freedom=freedom,
        centre=centre,
        height=float(beta[0]),
        height_error=float(np.sqrt(covariance[0, 0])),
        covariance=float(covariance[0, -1]),
    )


def _columns(seen: Observations) -> list[Floats]:
    """What is not time, a column (n,) each: the usual stratum's height, what each other adds, the tempo within them."""
    sizes = np.bincount(seen.stratum)
    within = seen.log_tempo - (np.bincount(seen.stratum, weights=seen.log_tempo) / np.maximum(sizes, 1))[seen.stratum]
    others = [int(each) for each in np.argsort(-sizes, kind="stable")[1:] if sizes[each]]
    columns = [np.ones(len(seen.day))] + [(seen.stratum == each).astype(np.float64) for each in others]
    return [*columns, within] if np.sqrt(np.mean(within**2)) > SAME_TEMPO else columns


def _independent(columns: list[Floats]) -> list[Floats]:
    """The columns (d,) that are no sum of those before them."""
    kept: list[Floats] = []
    basis: list[Floats] = []
    for column in columns:
        left = column - sum((other * float(other @ column) for other in basis), np.zeros(len(column)))
        length = float(np.linalg.norm(left))
        if length > _RANK * max(float(np.linalg.norm(column)), _RANK):
            kept.append(column)
            basis.append(left / length)
    return kept


def _robust(design: Floats, value: Floats, freedom: int) -> tuple[Floats, Floats, Floats]:
    """Coefficients (p,), residuals (d,) and the coefficients' covariance (p, p)."""
    inverse = np.linalg.inv(design.T @ design)
    beta = inverse @ (design.T @ value)
    residual = value - design @ beta
    pulled = residual
    scale = _scale(residual, freedom)
    for _ in range(_STEPS):
        pulled = np.clip(residual, -_CORNER * scale, _CORNER * scale)
        step = inverse @ (design.T @ pulled)
        beta, residual = beta + step, residual - design @ step
        if float(np.max(np.abs(design @ step), initial=0.0)) <= _STANDS_STILL * max(scale, _STANDS_STILL):
            break
        scale = _scale(residual, freedom)
    inside = float(np.mean(np.abs(residual) <= _CORNER * scale)) if scale > 0 else 1.0
    variance = float(pulled @ pulled) / freedom
    correction = 1.0 + design.shape[1] / len(value) * (1.0 - inside) / inside
    return beta, residual, inverse * variance * (correction / inside) ** 2


def _scale(residual: Floats, freedom: int) -> float:
    """The SD of residuals (d,), by their median size where few lie far off."""
    middle = float(np.median(np.abs(residual))) * _MAD * np.sqrt(len(residual) / freedom)
    return max(float(middle), float(np.sqrt(residual @ residual / freedom)) * _LEAST_SCALE)


def _widening(days: Floats, residual: Floats) -> float:
    """How much days that go together widen the variance: their lag-1 correlation, where it is more than chance."""
    square = float(residual @ residual)
    if len(days) < _FEWEST_FOR_LAG or square == 0.0:
        return 1.0
    rho = float(residual[1:] @ residual[:-1]) / square + 2.0 / len(days)
    return (1 + min(rho, _MOST_RHO)) / (1 - min(rho, _MOST_RHO)) if rho > 0 else 1.0
