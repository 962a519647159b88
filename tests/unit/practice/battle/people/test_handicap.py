"""Fairness by simulation: players are logistic in the step or normal in their points, drawn apart from our constants.

An improvement is the same where the odds, or the points in the player's own spread, rise by the same.
"""

from collections.abc import Sequence

import numpy as np
import pytest

from station.practice.battle.people.handicap import Expectation, expectation
from station.practice.battle.repeating.staircase import Answered, Staircase

STAIRCASE = Staircase(24, 8)
Improviser = tuple[float, float]
"""The mean and the spread of somebody's points."""


def turns(who: Improviser, rounds: int, rng: np.random.Generator, better: float = 0.0) -> Sequence[float]:
    drawn: list[float] = np.clip(rng.normal(who[0] + better * who[1], who[1], rounds), 0, 100).tolist()
    return drawn


def worth(expected: Expectation, points: Sequence[float]) -> float:
    return sum(map(expected.of_improvisation, points))


CHILD, PARENT = (40.0, 10.0), (80.0, 6.0)


@pytest.mark.parametrize("rounds", [8, 20, 30])
def test_equal_improvers_win_about_half_of_their_battles_and_without_it_the_better_wins(rounds: int) -> None:
    rng = np.random.default_rng(2)
    fair = unfair = 0
    for _ in range(600):
        expected = [expectation([], turns(who, rounds, rng), STAIRCASE) for who in (CHILD, PARENT)]
        child, parent = (turns(who, 8, rng, better=0.5) for who in (CHILD, PARENT))
        fair += worth(expected[0], child) > worth(expected[1], parent)
        unfair += sum(child) > sum(parent)
    assert 0.45 <= fair / 600 <= 0.55
    assert unfair / 600 < 0.01


def test_whoever_improves_more_wins_mostly() -> None:
    rng = np.random.default_rng(3)
    won = 0
    for _ in range(300):
        expected = [expectation([], turns(who, 20, rng), STAIRCASE) for who in (CHILD, PARENT)]
        won += worth(expected[0], turns(CHILD, 8, rng, 1.0)) > worth(expected[1], turns(PARENT, 8, rng))
    assert won / 300 > 0.85


def test_playing_badly_on_purpose_for_a_battle_and_a_half_pays_little() -> None:
    """Twelve turns two spreads below one's own after forty honest ones."""
    rng = np.random.default_rng(4)
    won = 0
    for _ in range(400):
        before = [*turns(PARENT, 40, rng), *turns(PARENT, 12, rng, better=-2.0)]
        cheat, honest = expectation([], before, STAIRCASE), expectation([], turns(CHILD, 52, rng), STAIRCASE)
        won += worth(cheat, turns(PARENT, 8, rng)) > worth(honest, turns(CHILD, 8, rng))
    assert won / 400 < 0.75, "an honest player wins 0.5"


def answers(threshold: float, slope: float, steps: Sequence[int], rng: np.random.Generator) -> list[Answered]:
    wins = [1 / (1 + np.exp((step - threshold) / slope - np.log(3))) for step in steps]
    return [Answered(step, bool(rng.random() < chance)) for step, chance in zip(steps, wins, strict=True)]


def test_equal_improvers_of_unequal_steps_win_about_half_of_their_repeat_battles() -> None:
    rng = np.random.default_rng(5)
    won = 0.0
    for _ in range(300):
        points = []
        for threshold, slope in ((4.0, rng.uniform(0.7, 2.0)), (15.0, rng.uniform(0.7, 2.0))):
            before: list[Answered] = []
            for _ in range(20):
                before += answers(threshold, slope, [STAIRCASE.next_step(before)], rng)
            expected, now, worths = expectation(before, [], STAIRCASE), list(before), 0.0
            for _ in range(4):
                now += answers(threshold + 0.7 * slope, slope, [STAIRCASE.next_step(now)], rng)
                worths += expected.of_answer(*now[-1], STAIRCASE)
            points.append(worths)
        won += 0.5 if points[0] == points[1] else points[0] > points[1]
    assert 0.43 <= won / 300 <= 0.57, "0.45 to 0.55, and what 300 battles leave open"


def test_a_player_of_whom_nothing_is_known_is_expected_to_play_as_usual() -> None:
    assert expectation([], [], STAIRCASE).of_improvisation(55.0) == 50.0
    assert expectation([], [], STAIRCASE).of_improvisation(75.0) == 100.0, "two spreads of ten"
