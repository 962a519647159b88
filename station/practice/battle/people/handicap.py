"""What a player may expect of themselves, by their own earlier rounds, and what it is worth to do better.

Where players are measured against themselves a turn is worth

    50 + 50 · surprise, from 0 to 100

so that whoever plays as they always do earns 50, child or parent, and whoever improves earns more.

* A phrase of step s that was repeated: surprise = won − p(s), as an Elo rating has it (A. E. Elo, The Rating of
  Chessplayers, 1978): p(s) is how often the player wins such a phrase, by the `Staircase` of their earlier answers. Of
  the calls of a battle those count for a player that were as hard as *they* need them.
* An improvisation: surprise = (points − mean) / (`WIDTH` · spread), within ±1; mean and spread of the last `MEMORY`
  turns; fewer than `SURE_AFTER` are filled up with what is usual, so that few say little.

Playing badly on purpose shall not pay: a turn far below the others counts as `WORST` spreads below, and what is
expected falls at most `FALL_SPREADS`, or `FALL_STEPS`, below the highest that it has been.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from station.practice.battle.repeating.staircase import Answered, Staircase

USUAL_POINTS, USUAL_SPREAD = 55.0, 10.0
"""Of a turn of whom nothing is known (our choice: half way from silence to the best, a virtual player's spread)."""
LEAST_SPREAD = 2.0
"""Nobody is so even (our choice); less would make a point or two decide."""
SURE_AFTER = 8
"""Turns after which a player's own alone count (our choice: a battle)."""
MEMORY = 20
"""So many turns back an expectation reaches (as the last 20 scores of golf's World Handicap System, rule 5.2)."""
WIDTH = 2.0
"""Spreads above the mean that earn all (our choice: one turn in forty)."""
WORST = 1.5
"""A turn counts as at most so many spreads below the median (our choice: one honest turn in fifteen is worse)."""
FALL_SPREADS, FALL_STEPS = 0.5, 1
"""Our choice, after the caps on how far a golfer's handicap may rise above the year's lowest (rule 5.8): half of what
separates a good day from a usual one."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """What is expected: `answered` are the last answers, `eased` the steps by which they were too bad to be true."""

    answered: tuple[Answered, ...]
    eased: int
    points: float
    spread: float

    def of_answer(self, step: int, is_won: bool, staircase: Staircase) -> float:
        """What an answer is worth, 0–100."""
        return 50.0 + 50.0 * (is_won - staircase.wins_at(step - self.eased, self.answered))

    def of_improvisation(self, points: float) -> float:
        """What a turn is worth, 0–100."""
        surprise = (points - self.points) / (WIDTH * self.spread)
        return 50.0 + 50.0 * min(max(surprise, -1.0), 1.0)


def expectation(answered: Sequence[Answered], points: Sequence[float], staircase: Staircase) -> Expectation:
    """What is expected after earlier answers and the points of earlier improvised turns, each in order."""
    last = tuple(answered[-MEMORY:])
    before = (answered[end - MEMORY : end] for end in range(MEMORY, len(answered)))
    highest = max(map(staircase.threshold, before), default=0.0)
    eased = max(0, round(highest - FALL_STEPS - staircase.threshold(last)))
    mean, spread = _points_expected(points[-MEMORY:])
    windows = (_points_expected(points[end - MEMORY : end]) for end in range(MEMORY, len(points)))
    least = max((best - FALL_SPREADS * own for best, own in windows), default=0.0)
    return Expectation(last, eased, max(mean, least), spread)


def _points_expected(points: Sequence[float]) -> tuple[float, float]:
    """The mean and the spread of a player's points."""
    if not len(points):
        return USUAL_POINTS, USUAL_SPREAD
    usual, known = max(SURE_AFTER - len(points), 0), np.array(points)
    squares = usual * USUAL_SPREAD**2 + float(((known - known.mean()) ** 2).sum())
    spread = max(sqrt(squares / (usual + len(known) - 1)), LEAST_SPREAD)
    counted = np.maximum(known, np.median(known) - WORST * spread)
    return (usual * USUAL_POINTS + float(counted.sum())) / (usual + len(known)), spread
