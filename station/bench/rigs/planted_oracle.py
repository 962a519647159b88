"""The smallest effect that an oracle finds: one who knows which strokes are concerned, and how much everybody scatters.

The oracle estimates an effect of known shape by generalised least squares over all strokes, with the true covariance:
the AR(1) deviation of the moments, each stroke's own part, the leans of pieces, the lead over a click or, without one,
an unknown tempo with its slow wander. It says "fault" when the estimate lies z₁ standard errors from zero, z₁ chosen
so that the words together are wrong in 1 % of faultless takes; an effect of z₁ + z₂ errors is then found in 99 %.
"""

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.planted_player import (
    LAG_1,
    LEAD_MS,
    LEVEL_SD_DB,
    OWN_SHARE,
    PIECE_LEAN_MS,
    WANDER_PERIOD_S,
    WANDER_SD,
    Conditions,
)
from station.bench.rigs.planted_strokes import Floats, Mask, Written

Z_FALSE_ALARM = 3.48
"""One-sided normal quantile of 1 % shared by 40 words."""
Z_POWER = 2.33
"""And of 99 %."""
ERRORS = Z_FALSE_ALARM + Z_POWER

_WAVES = 12
"""Periods by which the wander's covariance is integrated."""
_FREE = 1e6
"""Variance of what nobody knows (an offset, a rate), against some hundred."""


def timing_precision(written: Written, conditions: Conditions) -> NDArray[np.float64]:
    """Inverse covariance in ms⁻² of the strokes' deviations without graces, (m, m)."""
    main = written.main
    moment, at_s, piece = written.moment[main], written.time_s[main], written.score.notes["piece"][main]
    variance = conditions.sd_ms**2
    apart = np.abs(moment[:, None] - moment[None, :])
    covariance = variance * (1 - OWN_SHARE) * (LAG_1 / (1 - OWN_SHARE)) ** apart + variance * OWN_SHARE * np.eye(
        len(piece)
    )
    covariance += PIECE_LEAN_MS**2 * (piece[:, None] == piece[None, :])
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


def smallest_shift(precision: NDArray[np.float64], shape: Floats) -> float:
    """The smallest factor of `shape` (m,) that is found, in units of ms for a shape of ones."""
    information = float(shape @ precision @ shape)
    return ERRORS / np.sqrt(information) if information > 0 else np.inf


def smallest_level_db(concerned: Mask, others: Mask) -> float:
    """The smallest difference in level between two kinds of strokes."""
    return ERRORS * LEVEL_SD_DB * float(np.sqrt(_inverse(concerned) + _inverse(others)))


def smallest_fade_db(written: Written) -> float:
    """The smallest change of level from the first stroke to the last."""
    through = np.linspace(0, 1, int(written.main.sum()))
    return ERRORS * LEVEL_SD_DB / float(np.sqrt(np.sum((through - 1 / 2) ** 2)))


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
