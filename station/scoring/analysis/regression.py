"""Several effects told apart in one row of strokes: a linear mixed model with correlated errors.

    y = X·β + ε,   β_j ~ N(0, τ_j²) where τ_j is finite, free where it is infinite

y are deviations of strokes (ms or dB), the columns of X say what concerns each stroke: a constant, which piece, whether
it stands in a fill …. Pieces and limbs differ in any player, so that their columns are drawn towards 0 by τ; an effect
that could as well be such a difference gets a wide interval instead of a bold claim.

Strokes of one slot share the player's inner clock and one slot's error lives on in the next, so that errors are
correlated: two strokes of one slot by `shared`, slots k apart by ρ·`_DECAY`^(k − 1). Both numbers are estimated from
what the model leaves over. With H = XᵀX + Λ, Λ = diag(σ²/τ²):

    β̂ = H⁻¹Xᵀy,   cov(β̂ − β) = H⁻¹(cov(Xᵀε) + Λ·diag(τ²)·Λ)H⁻¹

(Henderson 1975 for the estimate; the covariance follows from β̂ − β = H⁻¹(Xᵀε − Λβ).) Single strokes far off, slips and
wrong pairs, are drawn in to `_HUBER_SDS` (Huber 1981).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.scoring.matching.slow_drift import robust_sd

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

CONSTANT = "all"
"""The name of what all strokes have in common."""

_FEWEST = 8
_HUBER_SDS = 3.0
_ROUNDS = 3
_DECAY = 0.65
"""How an error fades from slot to slot once it is correlated: linear phase correction by a third (HUMANS, Timing)."""

_LAGS = 8
"""Beyond, 0.65^8 = 3 % is left."""

_MOST_RHO = 0.8


@dataclass(frozen=True, slots=True)
class Effect:
    """An estimate with its standard error, and the number of slots that bear it."""

    value: float
    error: float
    slots: int

    @property
    def ci(self) -> tuple[float, float]:
        """The 95 % interval, by Student's t over the slots."""
        half = t_quantile_95(self.slots - 1.0) * self.error
        return self.value - half, self.value + half


@dataclass(frozen=True, eq=False)
class Fit:
    """What was fitted: `effects` by column name, `CONSTANT` among them, and `sd` of what is left over."""

    effects: dict[str, Effect]
    sd: float


@dataclass(frozen=True, eq=False)
class Column:
    """One column (n,) of the model; `tau` the SD of the effect in any player, in the unit of y, None for a free one."""

    name: str
    values: Floats
    tau: float | None = None


def fit(y: Floats, columns: list[Column], slots: Indices) -> Fit | None:
    """Estimate all columns' effects on `y` (n,); a constant is added. `slots` (n,) rise with time.

    Columns without variation are left out. None of fewer strokes than `_FEWEST` or twice the columns.
    """
    used = [column for column in columns if len(y) and np.ptp(column.values) > 0]
    x = np.column_stack([np.ones(len(y)), *(column.values for column in used)])
    if len(y) < max(2 * x.shape[1], _FEWEST):
        return None
    inverse_tau2 = np.array([0.0] + [0.0 if c.tau is None else 1.0 / c.tau**2 for c in used])
    beta, sd = _estimate(y, x, inverse_tau2)
    rest = np.clip(y - x @ beta, -_HUBER_SDS * sd, _HUBER_SDS * sd)
    ridge = sd * sd * inverse_tau2
    inverse = np.linalg.pinv(x.T @ x + np.diag(ridge))
    spread = _score_covariance(x, rest, slots) + np.diag(ridge * sd * sd)
    errors = np.sqrt(np.maximum(np.diag(inverse @ spread @ inverse), 0.0))
    slot_counts = [len(np.unique(slots)), *(_slots_of(column, slots) for column in used)]
    names = [CONSTANT, *(column.name for column in used)]
    effects = zip(beta.tolist(), errors.tolist(), slot_counts, strict=True)
    return Fit({name: Effect(*effect) for name, effect in zip(names, effects, strict=True)}, sd)


def _estimate(y: Floats, x: Floats, inverse_tau2: Floats) -> tuple[Floats, float]:
    """Coefficients and SD of the rest, strokes far off drawn in."""
    sd = max(robust_sd(y) or float(y.std()), 1e-9)
    drawn_in, beta = y, np.zeros(x.shape[1])
    for _ in range(_ROUNDS):
        beta = np.linalg.pinv(x.T @ x + np.diag(sd * sd * inverse_tau2)) @ (x.T @ drawn_in)
        rest = y - x @ beta
        sd = max(robust_sd(rest) or float(rest.std()), 1e-9)
        drawn_in = x @ beta + np.clip(rest, -_HUBER_SDS * sd, _HUBER_SDS * sd)
    return beta, sd


def _score_covariance(x: Floats, rest: Floats, slots: Indices) -> Floats:
    """Covariance of Xᵀε for errors that correlate within and between slots."""
    _, slot = np.unique(slots, return_inverse=True)
    freedom = max(len(rest) - x.shape[1], 1)
    variance = float(rest @ rest) / freedom
    if variance == 0.0:
        return np.zeros((x.shape[1], x.shape[1]))
    shared, rho = _correlations(rest, slot, float(rest @ rest) / len(rest))
    by_slot = np.zeros((int(slot.max()) + 1, x.shape[1]))
    np.add.at(by_slot, slot, x)
    total = (1 - shared) * (x.T @ x) + shared * (by_slot.T @ by_slot)
    for lag in range(1, min(_LAGS, len(by_slot) - 1) + 1):
        between = by_slot[:-lag].T @ by_slot[lag:]
        total += rho * _DECAY ** (lag - 1) * (between + between.T)
    covariance: Floats = variance * total
    return covariance


def _correlations(rest: Floats, slot: Indices, variance: float) -> tuple[float, float]:
    """Correlation of two errors of one slot, and of two of neighbouring slots; never negative."""
    counts = np.bincount(slot)
    sums = np.bincount(slot, weights=rest)
    squares = np.bincount(slot, weights=rest * rest)
    pairs = float((counts * (counts - 1)).sum())
    neighbours = float((counts[:-1] * counts[1:]).sum())
    rho = float((sums[:-1] * sums[1:]).sum()) / neighbours / variance if neighbours else 0.0
    rho = min(max(rho, 0.0), _MOST_RHO)
    shared = float((sums * sums - squares).sum()) / pairs / variance if pairs else rho
    return min(max(shared, rho), 1.0), rho


def _slots_of(column: Column, slots: Indices) -> int:
    """Slots on the rarer side of a column, for a flag: those that bear the contrast."""
    on = column.values != 0
    return int(min(len(np.unique(slots[on])), len(np.unique(slots[~on])) or len(np.unique(slots[on]))))
