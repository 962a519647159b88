"""A periodic model of several channels: each a sum of circular Gaussians over the phase.

J. E. Boyd and A. Godbout, "Multi-dimensional synchronization for rhythmic sonification", ICAD 2012, § 3.1:

    f_i(φ) = Σ_j w_ij g(φ; μ_j, σ),   μ_j uniform on (−π, π], 2σ apart, σ = π/n_m                             (1)
    g(φ; μ, σ) = exp(−(φ − μ)² / 2σ²) / √(2π)σ, summed over all turns of φ − μ                                 (2)

The paper prints (2) without the square and with σ² below; it is a Gaussian density, and periodic. Weights are found by
least squares (3) from samples whose phase is known.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from station.sync.signals.signal import FloatArray

TURN = 2 * pi
FEWEST_CENTRES, MOST_CENTRES = 3, 4096
"""The parabola of § 3.2 needs three centres; the upper end is our choice: 16 for each of 256 strokes of a hand."""
CENTRES = 16
"""n_m of the paper's figure 2, for walking and running."""
_TURNS = 1
"""Turns of the wrapped Gaussian that are summed to each side: even with three centres the next adds less than 1e-17."""
_ALONE = 39
"""From so many centres on every other turn's part, at most exp(−n_m²/2), is nothing at all: less than any number."""
_RIDGE = 1e-10
"""Of the mean square of the basis: keeps weights finite where no sample lies near a centre (our choice)."""


def centres(count: int) -> FloatArray:
    """The phases μ_j (count,) in (−π, π], ascending, the last at π."""
    phase: FloatArray = np.arange(1, count + 1, dtype=np.float64) * (TURN / count) - pi
    return phase


def wrapped(phase_rad: FloatArray) -> FloatArray:
    """The same phases in (−π, π]."""
    within: FloatArray = pi - np.mod(pi - phase_rad, TURN)
    return np.where(within > -pi, within, pi)  # a remainder may be rounded up to the whole turn


def gaussians(phase_rad: FloatArray, count: int) -> FloatArray:
    """g(φ; μ_j, σ) of every phase and centre, (n, count)."""
    sigma = pi / count
    apart = wrapped(np.asarray(phase_rad)[:, None] - centres(count)[None, :])
    summed = np.zeros_like(apart)
    for turn in range(-_TURNS, _TURNS + 1) if count < _ALONE else (0,):
        summed += np.exp(-0.5 * ((apart + TURN * turn) / sigma) ** 2)
    density: FloatArray = summed / (sqrt(TURN) * sigma)
    return density


@dataclass(frozen=True, slots=True, eq=False)
class PeriodicModel:
    """What `channels` do over one period.

    `weights` (c, n_m) as in (1); of a sample y the model describes (y − `mean`) / `scale`, both (c,): the mean makes
    channels zero-mean, the scale is 1 where all share a unit (the paper) and their SD where they do not.
    `period_s` is that of the exemplar, None where it is not known.
    """

    channels: tuple[str, ...]
    weights: FloatArray
    mean: FloatArray
    scale: FloatArray
    period_s: float | None = None

    @property
    def centre_count(self) -> int:
        """n_m."""
        return int(self.weights.shape[1])

    def at(self, phase_rad: FloatArray) -> FloatArray:
        """f(φ) (n, c) at phases (n,), in the model's zero-mean form."""
        values: FloatArray = gaussians(phase_rad, self.centre_count) @ self.weights.T
        return values

    def values(self, phase_rad: FloatArray) -> FloatArray:
        """The channels (n, c) at phases (n,), in their own units."""
        return self.at(phase_rad) * self.scale + self.mean

    def zero_mean(self, values: FloatArray) -> FloatArray:
        """Samples (n, c), or one (c,), in the model's zero-mean form."""
        centred = values - self.mean
        return centred / self.scale if (self.scale != 1).any() else centred


@dataclass(frozen=True, slots=True, eq=False)
class Exemplar:
    """Samples (n, c) of one take, and the phase (n,) of each."""

    values: FloatArray
    phase_rad: FloatArray
    period_s: float | None = None


def fitted(
    channels: Sequence[str], exemplars: Sequence[Exemplar], centre_count: int = CENTRES, *, one_unit: bool = True
) -> PeriodicModel:
    """The model that fits all samples of one or more exemplars best (3).

    Each exemplar is made zero-mean by its own mean, for people differ in posture; the model's is the mean of these.
    `one_unit`: whether the channels share a unit; else each counts by its SD.
    """
    assert FEWEST_CENTRES <= centre_count <= MOST_CENTRES
    means = np.array([each.values.mean(axis=0) for each in exemplars])
    centred = np.concatenate([each.values - mean for each, mean in zip(exemplars, means, strict=True)])
    scale = np.ones(len(channels)) if one_unit else _spread(centred)
    basis = gaussians(np.concatenate([each.phase_rad for each in exemplars]), centre_count)
    normal = basis.T @ basis
    normal += np.eye(centre_count) * (_RIDGE * np.trace(normal) / centre_count)
    weights = _solved(normal, basis.T @ (centred / scale)).T
    periods = [each.period_s for each in exemplars if each.period_s is not None]
    period_s = float(np.mean(periods)) if periods else None
    return PeriodicModel(tuple(channels), weights, means.mean(axis=0), scale, period_s)


def _solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    solution: FloatArray = np.linalg.solve(matrix, right).astype(np.float64)
    return solution


def _spread(values: FloatArray) -> FloatArray:
    spread: FloatArray = values.std(axis=0)
    return np.where(spread > 0, spread, 1.0)
