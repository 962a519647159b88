"""What a player may expect of themselves, by their own earlier rounds, and what it is worth to do better.

Where players are measured against themselves a round is worth

    50 + 50 · surprise, from 0 to 100

so that whoever plays as they always do earns 50, child or parent, and whoever improves earns more.

* A phrase of step s that was repeated: surprise = won − p(s), as an Elo rating has it (A. E. Elo, The Rating of
  Chessplayers, 1978): p(s) is how often the player wins such a phrase, by the `Staircase` of their earlier answers.
* An improvisation: surprise = (points − mean) / (`WIDTH` · spread), within ±1; mean and spread of earlier turns, each
  drawn towards what is usual by `PRIOR_ROUNDS` rounds, so that few rounds say little.

Playing badly on purpose shall not pay: a turn far below the mean counts as `WORST` spreads below it, and an expectation
falls at most `FALL_SPREADS`, or `FALL_STEPS`, below the highest that it has been.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

from station.practice.battle.repeating.staircase import Answered, Staircase

USUAL_POINTS, USUAL_SPREAD = 55.0, 10.0
"""Of a turn of whom nothing is known (our choice: half way between silence and the best, and a spread as virtual players
show)."""
PRIOR_ROUNDS = 2
"""So many rounds the usual weighs (our choice: after a battle a player's own rounds weigh four times as much)."""
MEMORY = 20
"""So many rounds back an expectation reaches (as the last 20 scores of golf's World Handicap System, rule 5.2)."""
WIDTH = 2.0
"""Spreads above the mean that earn all (our choice: one round in forty)."""
WORST = 1.5
FALL_SPREADS, FALL_STEPS = 0.5, 1.0
"""Our choice, after the caps on how far a golfer's handicap may rise above the year's lowest (rule 5.8): half of what
separates a good day from a usual one."""
SURE_AFTER = 8
"""Rounds until an expectation is so well known that it holds one up (our choice: a battle)."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """What is expected of a player: the step at which they win as often as the staircase aims at, and their points."""

    threshold: float
    points: float
    spread: float

    def of_answer(self, step: int, is_won: bool, most_step: int) -> float:
        """What an answer is worth, 0–100."""
        return 50.0 + 50.0 * (is_won - Staircase(most_step, 0).wins_at(step, self.threshold))

    def of_improvisation(self, points: float) -> float:
        """What a turn is worth, 0–100."""
        surprise = (points - self.points) / (WIDTH * self.spread)
        return 50.0 + 50.0 * min(max(surprise, -1.0), 1.0)


def expectation(answered: Sequence[Answered], points: Sequence[float], staircase: Staircase) -> Expectation:
    """What is expected after earlier answers and the points of earlier improvised turns, each in order."""
    mean, spread = _points_expected(points)
    return Expectation(_threshold_expected(answered, staircase), mean, spread)


def _points_expected(points: Sequence[float]) -> tuple[float, float]:
    mean, variance, highest = USUAL_POINTS, USUAL_SPREAD**2, -1.0
    for known, one in enumerate(points):
        off = max(one - mean, -WORST * sqrt(variance))
        share = 1.0 / (min(known, MEMORY) + 1 + PRIOR_ROUNDS)
        mean += share * off
        variance += share * (off**2 - variance)
        if known + 1 >= SURE_AFTER:
            mean = max(mean, highest - FALL_SPREADS * sqrt(variance))
            highest = max(highest, mean)
    return mean, sqrt(variance)


def _threshold_expected(answered: Sequence[Answered], staircase: Staircase) -> float:
    def known(until: int) -> float:
        return staircase.threshold(answered[max(until - MEMORY, 0) : until])

    highest = max((known(until) for until in range(SURE_AFTER, len(answered) + 1)), default=0.0)
    return max(known(len(answered)), highest - FALL_STEPS)
