"""Fairness of improvised battles by simulation: players are normal in their points, drawn apart from our constants.

An improvement is the same where the points rise by the same in the player's own spread.
"""

from collections.abc import Sequence

import numpy as np
import pytest

from station.practice.battle.people.handicap import Expectation, expectation

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
        expected = [expectation([], turns(who, rounds, rng)) for who in (CHILD, PARENT)]
        child, parent = (turns(who, 8, rng, better=0.5) for who in (CHILD, PARENT))
        fair += worth(expected[0], child) > worth(expected[1], parent)
        unfair += sum(child) > sum(parent)
    assert 0.45 <= fair / 600 <= 0.55
    assert unfair / 600 < 0.01


def test_whoever_improves_more_wins_mostly() -> None:
    rng = np.random.default_rng(3)
    won = 0
    for _ in range(300):
        expected = [expectation([], turns(who, 20, rng)) for who in (CHILD, PARENT)]
        won += worth(expected[0], turns(CHILD, 8, rng, 1.0)) > worth(expected[1], turns(PARENT, 8, rng))
    assert won / 300 > 0.85


def test_playing_badly_on_purpose_for_a_battle_and_a_half_pays_little() -> None:
    """Twelve turns two spreads below one's own after forty honest ones."""
    rng = np.random.default_rng(4)
    won = 0
    for _ in range(400):
        before = [*turns(PARENT, 40, rng), *turns(PARENT, 12, rng, better=-2.0)]
        cheat, honest = expectation([], before), expectation([], turns(CHILD, 52, rng))
        won += worth(cheat, turns(PARENT, 8, rng)) > worth(honest, turns(CHILD, 8, rng))
    assert won / 400 < 0.75, "an honest player wins 0.5"


def test_a_player_of_whom_nothing_is_known_is_expected_to_play_as_usual() -> None:
    assert expectation([], []).of_improvisation(55.0) == 50.0
    assert expectation([], []).of_improvisation(75.0) == 100.0, "two spreads of ten"
