"""What a player may expect of themselves, by their own earlier rounds, and what it is worth to do better.

Where players are measured against themselves a turn is worth 0 to 100, and 50 on the mean to whoever plays as they
always do, child or parent; whoever improves earns more.

* A phrase that was repeated is worth the percentage of the player's earlier answers that had fewer points, those that
  had as many by half: its rank. As long as somebody plays as they did every rank is as likely, so that its mean is 50
  whatever their points are like, even or scattered, at the first step or at the last. Everybody gets phrases of their
  own step, and answers to others' tell nothing. (Odds of winning foretold by a curve over the steps, as an Elo rating
  has them, left whoever is below the first step or above the last far from 50 for ever.)
* An improvisation: 50 + 50 · (points − mean) / (`WIDTH` · spread), within 0 and 100.

The last `MEMORY` turns count; fewer than `SURE_AFTER` are filled up with what is usual, so that few say little. Playing
badly on purpose shall not pay: an improvised turn far below the others counts as `WORST` spreads below, and the mean
falls at most `FALL_SPREADS` below the highest that it has been; of answers the best `MEMORY` in a row count where the
last fell more than `FALLEN_SPREADS` below them.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

import numpy as np

from station.practice.battle.repeating.staircase import Answered

USUAL_POINTS, USUAL_SPREAD = 55.0, 10.0
"""Of a turn of whom nothing is known (our choice: half way from silence to the best, a virtual player's spread)."""
USUAL_ANSWERS = (95.0, 91.0, 100.0, 80.0, 97.0, 93.0, 100.0, 60.0)
"""Points of answers at one's own step, three of four of which are won at 90 (our choice; the first few are alike)."""
LEAST_SPREAD = 2.0
"""Nobody is so even (our choice); less would make a point or two decide."""
SURE_AFTER = len(USUAL_ANSWERS)
"""Turns after which a player's own alone count (our choice: a battle)."""
MEMORY = 20
"""So many turns back an expectation reaches (as the last 20 scores of golf's World Handicap System, rule 5.2)."""
WIDTH = 2.0
"""Spreads above the mean that earn all (our choice: one turn in forty)."""
WORST = 1.5
"""A turn counts as at most so many spreads below the median (our choice: one honest turn in fifteen is worse)."""
FALL_SPREADS = 0.5
"""Our choice, after the caps on how far a golfer's handicap may rise above the year's lowest (rule 5.8): half of what
separates a good day from a usual one."""
FALLEN_SPREADS, LEAST_FALLEN = 1.5, 4.0
"""Spreads, and points at the least: the mean of twenty honest answers strays by a quarter of a spread (our choice)."""
_PLACES = 3
"""Of points, as a battle's document keeps them: equal answers are to be equal."""


class Earlier(NamedTuple):
    """An earlier answer to a phrase of `step`, with its `points`, 0–100; `is_own` where the step was theirs."""

    step: int
    is_won: bool
    points: float
    is_own: bool = True


@dataclass(frozen=True, slots=True)
class Expectation:
    """What is expected: by the phrases `answered`, and by the points `had`, rising; of improvisations two figures."""

    answered: tuple[Answered, ...]
    had: tuple[float, ...]
    points: float
    spread: float

    def of_answer(self, points: float) -> float:
        """What an answer is worth, 0–100."""
        points = round(points, _PLACES)
        return 50.0 * (bisect_left(self.had, points) + bisect_right(self.had, points)) / len(self.had)

    def of_improvisation(self, points: float) -> float:
        """What a turn is worth, 0–100."""
        surprise = (points - self.points) / (WIDTH * self.spread)
        return 50.0 + 50.0 * min(max(surprise, -1.0), 1.0)


def expectation(answers: Sequence[Earlier], points: Sequence[float]) -> Expectation:
    """What is expected after earlier answers and the points of earlier improvised turns, each in order."""
    counted = _counted([one for one in answers if one.is_own])
    had = [*(round(one.points, _PLACES) for one in counted), *USUAL_ANSWERS[len(counted) :]]
    mean, spread = _points_expected(points[-MEMORY:])
    windows = (_points_expected(points[end - MEMORY : end]) for end in range(MEMORY, len(points)))
    least = max((best - FALL_SPREADS * own for best, own in windows), default=0.0)
    answered = tuple(Answered(one.step, one.is_won) for one in counted or answers[-MEMORY:])
    return Expectation(answered, tuple(sorted(had)), max(mean, least), spread)


def _counted(answers: Sequence[Earlier]) -> Sequence[Earlier]:
    """The last answers, or the best in a row where the last fell too far below these."""
    last = answers[-MEMORY:]
    rows = [answers[end - MEMORY : end] for end in range(MEMORY, len(answers))]
    if not rows:
        return last
    best = max(rows, key=_mean)
    spread = float(np.std([one.points for one in best]))
    return best if _mean(last) < _mean(best) - max(FALLEN_SPREADS * spread, LEAST_FALLEN) else last


def _mean(answers: Sequence[Earlier]) -> float:
    return sum(one.points for one in answers) / len(answers)


def _points_expected(points: Sequence[float]) -> tuple[float, float]:
    """The mean and the spread of a player's points."""
    if not len(points):
        return USUAL_POINTS, USUAL_SPREAD
    usual, known = max(SURE_AFTER - len(points), 0), np.array(points)
    squares = usual * USUAL_SPREAD**2 + float(((known - known.mean()) ** 2).sum())
    spread = max(sqrt(squares / (usual + len(known) - 1)), LEAST_SPREAD)
    counted = np.maximum(known, np.median(known) - WORST * spread)
    return (usual * USUAL_POINTS + float(counted.sum())) / (usual + len(known)), spread
