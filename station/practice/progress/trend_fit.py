"""The first days of practice against the last, with an interval that the data bear.

A day is one observation, the mean of its sessions. What was played alike (`stratum`) has a height of its own, and the
tempo within it is taken out as linear in its logarithm. Learning is quick at first and slow later (power law of
practice, Newell and Rosenbloom 1981): the course is a sum of the day and its logarithm, and what is told is its mean
over the last fifth of days less that over the first (a third where days are few), so that nothing is extrapolated.
Where that can hardly be told from tempo and stratum there is no answer.

What lies far off is drawn in by Huber's M-estimate and pseudo-values (Huber 1981, Robust Statistics, section 7.10).
Days that lie near each other share form: a part `share` of a day's variance goes with another's by `rho` to the power
of the days between. Neither can be read off few days, so that all their values on a grid are weighed by their
restricted likelihood and by `_PRIOR`, and the change has the mixture of the Student's t that each of them gives.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_below, t_quantile, t_quantile_95

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

LEAST_FREEDOM = 3
"""So many days beyond the parameters are needed (our choice: below it Student's t is 4 and more, and tells nothing)."""
LEAST_GROUPS, MOST_GROUPS, _A_GROUP = 3, 5, 4
"""The days in groups, and how many a further group needs (our choice: the first and the last have two and more)."""
TANGLED = 0.9
"""So much of the first days' difference from the last may go with tempo and stratum, as a correlation (our choice)."""
_MOST_ROWS = 120
"""More days are averaged with their neighbours (our choice: the likelihood takes the third power of their number)."""
_CORNER = 2.0
"""Huber's corner in SDs (our choice between 1.345 for asymptotics and none: few days bear little trimming)."""
_STEPS = 30
_STANDS_STILL = 1e-9
_RANK = 1e-7
_MAD = 1.4826
"""A normal law's SD for its median size."""
_LEAST_SCALE = 0.5
"""Of the plain SD: so that a handful of equal days makes no outliers of the others (our choice)."""
_RHOS, _SHARES = (0.3, 0.6, 0.8, 0.92), (0.5, 1.0)
_INDEPENDENT = 0.5
"""Prior weight of days that share nothing; the rest is spread evenly (our choice: diaries give a day's form an
intra-class correlation of .3 to .6, and it is not known for practice)."""
SAME_TEMPO = 0.01
"""Tempi this close, in their logarithm, nobody tells apart (our choice)."""
_BISECTIONS = 24


@dataclass(frozen=True, slots=True, eq=False)
class Observations:
    """Sessions: their `day` (n,) in days from any date, `value`, natural `log_tempo`, `stratum` from 0."""

    day: Floats
    value: Floats
    log_tempo: Floats
    stratum: Indices


@dataclass(frozen=True, eq=False)
class Compared:
    """The first days against the last: means `early` and `late` of `a_side` days each, all strata at one height.

    `days` (d,) are those with sessions, in order, `values` what was measured on them at the height of the stratum that
    was played most. The change has a mixture of Student's t of `freedom`: `weights`, `centres`, `scales` (k,) each.
    `early_days` and `late_days` are the first and the last of each side, `mean_half` half the 95 % interval of a mean.
    """

    days: Floats
    values: Floats
    a_side: int
    early_days: tuple[float, float]
    late_days: tuple[float, float]
    early: float
    late: float
    mean_half: float
    freedom: int
    weights: Floats
    centres: Floats
    scales: Floats

    @property
    def change(self) -> float:
        """By how much the last days differ from the first."""
        return self.late - self.early

    def chance_below(self, change: float) -> float:
        """How likely the true change is below this one."""
        return float(self.weights @ t_below(self.freedom, (change - self.centres) / self.scales))

    def is_surely_changed(self, false: float) -> bool:
        """Whether where nothing changed a share of `false` at most, in either direction, looks as changed as this."""
        below = self.chance_below(0.0)
        return min(below, 1.0 - below) < false / 2

    @cached_property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the change."""
        return self._quantile(0.025), self._quantile(0.975)

    def _quantile(self, share: float) -> float:
        """The mixture's, between the least and the greatest of its parts'."""
        parts = self.centres + self.scales * t_quantile(self.freedom, abs(1 - 2 * share)) * np.sign(share - 0.5)
        low, high = float(parts.min()), float(parts.max())
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if self.chance_below(middle) < share else (low, middle)
        return (low + high) / 2


def compare_days(seen: Observations) -> Compared | None:
    """The comparison, None where there are too few days, or where time cannot be told from tempo and stratum."""
    days, of_day = np.unique(np.floor(seen.day), return_inverse=True)
    count = len(days)
    together = -(-count // _MOST_ROWS)
    of_row = np.arange(count) // together

    def rows(column: Floats) -> Floats:
        a_day = np.bincount(of_day, weights=column) / np.bincount(of_day)
        return np.bincount(of_row, weights=a_day) / np.bincount(of_row)

    at, value = rows(seen.day), rows(seen.value)
    if len(at) < LEAST_FREEDOM + LEAST_GROUPS:
        return None
    groups = int(np.clip(len(at) // _A_GROUP, LEAST_GROUPS, MOST_GROUPS))
    group = np.arange(len(at)) * groups // max(len(at), 1)
    later = _course(at - at[0], group == 0, group == groups - 1)
    apart = _independent([rows(column) for column in _columns(seen)])
    design = np.column_stack([*apart, *later])
    freedom = len(at) - design.shape[1]
    if freedom < LEAST_FREEDOM or len(_independent([*apart, *later])) < design.shape[1] or _is_tangled(apart, later):
        return None
    beta, pseudo = _robust(design, value, freedom)
    weights, centres, scales = _mixture(at, design, pseudo, freedom)
    change = float(weights @ centres)
    others = np.column_stack(apart[1:]) if len(apart) > 1 else np.zeros((len(at), 0))
    level = value - others @ beta[1 : len(apart)]
    pulled = pseudo - others @ beta[1 : len(apart)]
    middle = float(pulled[(group == 0) | (group == groups - 1)].mean())
    spread = float(np.sqrt(weights @ scales**2))
    return Compared(
        days=days if together == 1 else at,
        values=level,
        a_side=int(np.sum(group == 0)) * together,
        early_days=(float(at[0]), float(at[group == 0][-1])),
        late_days=(float(at[group == groups - 1][0]), float(at[-1])),
        early=middle - change / 2,
        late=middle + change / 2,
        mean_half=t_quantile_95(float(freedom)) * spread / np.sqrt(2),
        freedom=freedom,
        weights=weights,
        centres=centres,
        scales=scales,
    )


def _course(since: Floats, is_early: NDArray[np.bool_], is_late: NDArray[np.bool_]) -> list[Floats]:
    """Columns (d,) of a course in time `since` the first day; the last one's coefficient is late less early."""
    slow = np.log1p(since)
    by, by_slow = (float(each[is_late].mean() - each[is_early].mean()) for each in (since, slow))
    return [slow - since * by_slow / by, since / by]


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


def _is_tangled(apart: list[Floats], later: list[Floats]) -> bool:
    """Whether what tells the last days from the first is, for the most part, what tells tempi and strata apart."""
    alone = _error_of_last(np.column_stack([apart[0], *later]))
    return bool(_error_of_last(np.column_stack([*apart, *later])) > alone / np.sqrt(1 - TANGLED**2))


def _error_of_last(design: Floats) -> float:
    """The standard error of the last coefficient, in SDs of independent values."""
    return float(np.sqrt(np.linalg.inv(design.T @ design)[-1, -1]))


def _robust(design: Floats, value: Floats, freedom: int) -> tuple[Floats, Floats]:
    """Coefficients (p,), and the values (d,) with what lies far off drawn in."""
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
    correction = 1.0 + design.shape[1] / len(value) * (1.0 - inside) / inside
    return beta, design @ beta + pulled * correction / inside


def _scale(residual: Floats, freedom: int) -> float:
    """The SD of residuals (d,), by their median size where few lie far off."""
    middle = float(np.median(np.abs(residual))) * _MAD * np.sqrt(len(residual) / freedom)
    return max(float(middle), float(np.sqrt(residual @ residual / freedom)) * _LEAST_SCALE)


def _mixture(at: Floats, design: Floats, value: Floats, freedom: int) -> tuple[Floats, Floats, Floats]:
    """Weights, centres and scales (k,) of the last coefficient, for each way in which days may go together.

    Each is a generalised least-squares fit, weighed by its restricted likelihood (Harville 1974).
    """
    between = np.abs(at[:, None] - at[None, :])
    same = np.eye(len(at))
    ways = np.array([same] + [share * rho**between + (1 - share) * same for rho in _RHOS for share in _SHARES])
    prior = np.array([_INDEPENDENT] + [(1 - _INDEPENDENT) / (len(ways) - 1)] * (len(ways) - 1))
    root = np.linalg.cholesky(ways)
    both = np.linalg.solve(root, np.column_stack([design, value])[None])
    r = np.linalg.qr(both).R
    size = np.abs(np.diagonal(r, axis1=1, axis2=2))
    floor = 1e-6 * np.linalg.norm(both[:, :, -1], axis=1) + 1e-150
    left = np.maximum(size[:, -1], floor)
    logs = -np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1) - np.log(size[:, :-1]).sum(axis=1)
    likelihood = logs - freedom * np.log(left) + np.log(prior)
    weights = np.exp(likelihood - likelihood.max())
    centres = r[:, -2, -1] / r[:, -2, -2]
    return weights / weights.sum(), centres, left / np.sqrt(freedom) / size[:, -2]
