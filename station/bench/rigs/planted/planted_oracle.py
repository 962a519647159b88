"""The smallest effect that an oracle finds: one who knows which strokes are concerned, and how much everybody scatters.

The oracle estimates an effect of known shape by generalised least squares over all strokes, with the true covariance:
the AR(1) deviation of the moments, each stroke's own part, the leans of pieces, the lead over a click or, without one,
an unknown tempo with its slow wander. It says "fault" when the estimate lies z₁ standard errors from zero, z₁ chosen
so that the words together are wrong in 1 % of faultless takes; an effect of z₁ + z₂ errors is then found in 99 %.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.planted.planted_player import (
    LAG_1,
    LEAD_MS,
    LEVEL_SD_DB,
    OWN_SHARE,
    PIECE_LEAN_MS,
    PIECE_LEVEL_DB,
    WANDER_PERIOD_S,
    WANDER_SD,
    Conditions,
    leans_of,
)
from station.bench.rigs.planted.planted_strokes import Floats, Mask, Written

Z_FALSE_ALARM = 3.48
"""One-sided normal quantile of 1 % shared by 40 words."""
Z_POWER = 2.33
"""And of 99 %."""
ERRORS = Z_FALSE_ALARM + Z_POWER
TELL_APART = 2 * Z_POWER
"""Standard errors between two explanations that are confused in 1 % of takes, whichever is true."""
SAME_STROKES = 0.9
"""Share of common strokes from which two words mean the same to a listener, whatever an oracle can tell; our choice."""

_WAVES = 12
"""Periods by which the wander's covariance is integrated."""
_FREE = 1e6
"""Variance of what nobody knows (an offset, a rate), against some hundred."""


def timing_precision(written: Written, conditions: Conditions) -> NDArray[np.float64]:
    """Inverse covariance in ms⁻² of the deviations of all strokes but graces, (m, m)."""
    main = written.main
    moment, at_s, piece = written.moment[main], written.time_s[main], written.score.notes["piece"][main]
    apart = np.abs(moment[:, None] - moment[None, :])
    shared, own = conditions.sd_ms**2 * (1 - OWN_SHARE), conditions.sd_ms**2 * OWN_SHARE
    covariance = shared * (LAG_1 / (1 - OWN_SHARE)) ** apart + own * np.eye(len(piece))
    of_piece = leans_of(written)[np.searchsorted(written.pieces, piece)]
    covariance += PIECE_LEAN_MS**2 * of_piece @ of_piece.T
    if conditions.clocked:
        covariance += LEAD_MS[1] ** 2
    else:
        middle_s = at_s - at_s.mean()
        covariance += _FREE + _FREE * np.outer(middle_s, middle_s) / max(float(middle_s.var()), 1e-9)
        for period_s in np.linspace(*WANDER_PERIOD_S, _WAVES):
            swing_ms = 1000 * WANDER_SD * period_s / (2 * np.pi)  # of each of two waves, of random phase
            angle = 2 * np.pi * at_s / period_s
            covariance += swing_ms**2 / _WAVES * np.cos(angle[:, None] - angle[None, :])
    return np.asarray(np.linalg.inv(covariance), np.float64)


def level_precision(written: Written) -> NDArray[np.float64]:
    """Inverse covariance in dB⁻² of the levels of all strokes, (n, n)."""
    piece = written.score.notes["piece"]
    covariance = LEVEL_SD_DB**2 * np.eye(len(piece)) + PIECE_LEVEL_DB**2 * (piece[:, None] == piece[None, :]) + _FREE
    return np.asarray(np.linalg.inv(covariance), np.float64)


def smallest_shift(precision: NDArray[np.float64], shape: Floats) -> float:
    """The smallest factor of `shape` that is found, in the unit of the deviations for a shape of ones."""
    information = float(shape @ precision @ shape)
    return ERRORS / float(np.sqrt(information)) if information > 0 else np.inf


@dataclass(frozen=True, eq=False)
class Explanations:
    """What words say of the strokes: each a shape of deviations, and what the oracle's noise leaves of it.

    `gram` (k, k) holds xᵀPy of the words' shapes x and y for a size of 1, `signs` (k, m) which strokes go which way.
    """

    names: tuple[str, ...]
    signs: NDArray[np.int8]
    gram: Floats

    @classmethod
    def of(cls, shapes: Mapping[str, Floats], precision: NDArray[np.float64]) -> "Explanations":
        """The explanations by name; shapes without a stroke are left out."""
        kept = {name: shape for name, shape in shapes.items() if shape.any()}
        stacked = np.stack(list(kept.values())) if kept else np.zeros((0, len(precision)))
        return cls(tuple(kept), np.sign(stacked).astype(np.int8), stacked @ precision @ stacked.T)

    def as_good(self, sizes: Mapping[str, float]) -> frozenset[str]:
        """The single words that say the same as these together, so far as the data tell.

        A word does where its own best size leaves a misfit that the oracle cannot tell from none, or where its
        strokes are those of a single word of `sizes` to nine tenths, in the same direction.
        """
        size = np.array([sizes.get(name, 0.0) for name in self.names])
        cross, own = self.gram @ size, np.diag(self.gram)
        misfit = float(size @ self.gram @ size) - cross**2 / np.maximum(own, 1e-12)
        good = {name for name, c, d in zip(self.names, cross, misfit, strict=True) if c > 0 and d < TELL_APART**2}
        if len(sizes) == 1:
            (name,) = sizes
            good |= {name} | set(self._of_the_same_strokes(name))
        return frozenset(good)

    def _of_the_same_strokes(self, name: str) -> list[str]:
        mine = self.signs[self.names.index(name)]
        common = np.sum((self.signs == mine) & (mine != 0), axis=1)
        either = np.sum((self.signs != 0) | (mine != 0), axis=1)
        return [self.names[k] for k in np.flatnonzero(common >= SAME_STROKES * either)]

    def overlap(self, one: str, other: str) -> float:
        """How much of one word's information the other takes away where both are unknown, 0–1."""
        i, k = self.names.index(one), self.names.index(other)
        return float(self.gram[i, k] ** 2 / (self.gram[i, i] * self.gram[k, k]))


def smallest_sd_ms(conditions: Conditions, concerned: Mask, others: Mask | None) -> float:
    """The smallest total SD of some strokes that is told from everybody's."""
    correlated = (1 + LAG_1**2) / (
        1 - LAG_1**2
    )  # how many strokes of AR(1) noise tell a variance as well as one of white
    inverse = _inverse(concerned) + (0.0 if others is None else _inverse(others))
    return conditions.sd_ms * float(np.exp(ERRORS * np.sqrt(inverse * correlated / 2)))


def smallest_share(count: int, usual: float) -> float:
    """The smallest share of `count` strokes that is told from the usual share."""
    for share in np.arange(usual, 0.6, 0.005):
        errors = [np.sqrt(max(p * (1 - p), 1e-4) / max(count, 1)) for p in (usual, share)]
        if share - usual >= Z_FALSE_ALARM * errors[0] + Z_POWER * errors[1]:
            return float(share)
    return float(np.inf)


def _inverse(mask: Mask) -> float:
    return 1 / max(int(mask.sum()), 1e-9)
