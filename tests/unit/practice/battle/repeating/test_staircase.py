"""The staircase by simulated players: logistic in the step, drawn apart from its constants."""

import numpy as np

from station.practice.battle.repeating.staircase import Answered, Staircase

STAIRCASE = Staircase(24, 8)


def test_after_eight_rounds_the_next_step_is_within_two_of_the_players_in_eight_of_ten_battles() -> None:
    """The issue's measure. The player's step is where they win three of four."""
    rng = np.random.default_rng(11)
    near = 0
    for _ in range(800):
        threshold, slope, slips = rng.uniform(2, 20), rng.uniform(0.4, 2.0), rng.uniform(0, 0.04)
        answered: list[Answered] = []
        for _ in range(8):
            step = STAIRCASE.next_step(answered)
            chance = (1 - slips) / (1 + np.exp((step - threshold) / slope - np.log(3)))
            answered.append(Answered(step, bool(rng.random() < chance)))
        near += abs(STAIRCASE.next_step(answered) - threshold) <= 2
    assert near / 800 >= 0.80


def test_it_goes_up_with_what_is_won_and_down_with_what_is_lost() -> None:
    assert STAIRCASE.next_step([]) == 8
    assert STAIRCASE.next_step([Answered(8, True)]) > 8 > STAIRCASE.next_step([Answered(8, False)])
    assert STAIRCASE.next_step([Answered(24, True)] * 20) == 24
    assert STAIRCASE.next_step([Answered(0, False)] * 20) == 0


def test_answers_count_in_whatever_order_they_came() -> None:
    answered = [Answered(8, True), Answered(12, False), Answered(10, True), Answered(3, True)]
    assert np.isclose(STAIRCASE.threshold(answered), STAIRCASE.threshold(answered[::-1]))
