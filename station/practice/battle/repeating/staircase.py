"""How hard the next phrase is: where a player is expected to win `TARGET` of their answers, by all they have answered.

A Bayesian staircase (A. B. Watson, D. G. Pelli, QUEST, Perception & Psychophysics 33, 1983; threshold and slope
together as L. L. Kontsevich, C. W. Tyler, Vision Research 39, 1999). A player wins an answer at step s with probability

    p(s) = LAPSE + (1 − 2·LAPSE) / (1 + exp((s − threshold) / slope − ln(TARGET / (1 − TARGET))))

so that `threshold` is the step that they win with `TARGET`. After each answer the weights of a grid of thresholds and
slopes are multiplied by what they foretold; the next phrase stands at the mean threshold. Answers at any steps count,
in any order, so that a verdict which a late stroke changes changes the estimate as if it had been so from the start.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import log
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.scoring.matching.hit_windows import Level

TARGET = 0.75
"""Our choice: three of four phrases are won, which players call fun and learn by (TEACHING: 70 to 85 % success)."""
FIRST_STEPS: Mapping[Level, int] = MappingProxyType(
    {Level.BEGINNER: 1, Level.ELEMENTARY: 3, Level.INTERMEDIATE: 6, Level.ADVANCED: 10, Level.STUDIO: 15}
)
"""Where a player begins of whom no battle is known, by the level at which they are judged (our choice, by `demands`): a
beginner with a bar for the hands alone, then with the kick, with accents, with two bars over the kit, with four limbs
and four bars. Each is low for its level, so that the first battle begins with a phrase that goes."""
LAPSE = 0.03
"""So often is an answer lost, or won, whatever the step (our choice)."""
SLOPES = (0.5, 1.0, 2.0, 3.0)
"""Steps over which the odds change e-fold (our choice: from who has a sharp limit to who has hardly one)."""
PRIOR_SD = 5.0
"""How far from the first step thresholds lie before one is known (our choice: a fifth of the steps)."""
_BETWEEN = 4
_BEYOND = 12
"""So many steps below the first and above the last a player's threshold may lie (our choice: half of the steps)."""
"""Grid points a step."""


class Answered(NamedTuple):
    """An answer to a phrase of `step`."""

    step: int
    is_won: bool


@dataclass(frozen=True, slots=True)
class Staircase:
    """Steps from 0 to `most_step`; the first phrase is of `first_step`."""

    most_step: int
    first_step: int

    def next_step(self, answered: Iterable[Answered]) -> int:
        """The step of the next phrase."""
        answered = list(answered)
        if not answered:
            return self.first_step
        return min(max(round(self.threshold(answered)), 0), self.most_step)

    def threshold(self, answered: Iterable[Answered]) -> float:
        """The step that the player wins with `TARGET`, as far as their answers show."""
        thresholds, weight = _prior(self.most_step, self.first_step)
        for step, is_won in answered:
            weight = weight * _likelihood(self.most_step, step, is_won)
        weight = weight.sum(axis=1)
        return float(thresholds @ weight / weight.sum())

    def wins_at(self, step: int, answered: Iterable[Answered]) -> float:
        """How often a player who has `answered` so wins a phrase of `step`, as far as their answers show."""
        _, weight = _prior(self.most_step, self.first_step)
        for earlier, is_won in answered:
            weight = weight * _likelihood(self.most_step, earlier, is_won)
        return float((weight * _likelihood(self.most_step, step, True)).sum() / weight.sum())


def _won(off: NDArray[np.float64]) -> NDArray[np.float64]:
    """The probability of winning `off` slopes beyond the threshold."""
    return LAPSE + (1 - 2 * LAPSE) / (1 + np.exp(off - log(TARGET / (1 - TARGET))))


@lru_cache(maxsize=8)
def _grid(most_step: int) -> NDArray[np.float64]:
    """The thresholds (n,) that are weighed."""
    return np.arange(-_BEYOND * _BETWEEN, (most_step + _BEYOND) * _BETWEEN + 1) / _BETWEEN


def _prior(most_step: int, first_step: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The thresholds (n,) and the weights (n, slopes) of each with each slope."""
    thresholds = _grid(most_step)
    weight = np.exp(-0.5 * ((thresholds - first_step) / PRIOR_SD) ** 2)
    return thresholds, np.repeat(weight[:, None], len(SLOPES), axis=1)


@lru_cache(maxsize=128)
def _likelihood(most_step: int, step: int, is_won: bool) -> NDArray[np.float64]:
    """How likely the outcome is, (n, slopes)."""
    won = _won((step - _grid(most_step)[:, None]) / np.array(SLOPES))
    return np.asarray(won if is_won else 1 - won)
