"""A handicap in repeat mode, by simulated players made apart from its formulas.

A player plays each note right with a chance of their own; above the strokes a second that they master more and more
notes fail, and a beginner's other strokes come at any step. What an answer is worth in points is counted by hand from
notes right, notes asked and strokes too many. A battle has six rounds and a final that counts twice, as a real one.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.practice.battle.people.handicap import Earlier, Expectation, expectation
from station.practice.battle.repeating.staircase import Answered, Staircase

STAIRCASE = Staircase(24, 6)
ROUNDS, WON = 7, 90.0


@dataclass(frozen=True)
class Somebody:
    """Who gets `right` of the notes right up to step `limit`, fewer beyond it, and strikes `stray` a note too many."""

    right: float
    limit: float
    stray: float = 0.0

    def answer(self, step: int, rng: np.random.Generator) -> Earlier:
        notes = 4 + round(3.5 * step)
        chance = self.right / (1 + np.exp((step - self.limit - 4) / 1.5))
        right, extras = rng.binomial(notes, chance), rng.poisson(self.stray * notes)
        points = 100 * right / (notes + extras)
        return Earlier(step, bool(points >= WON), points)


BEGINNER, PRO, PUPIL = Somebody(0.82, 24, 0.03), Somebody(0.998, 40), Somebody(0.99, 3)


def battle(who: Somebody, expected: Expectation, rng: np.random.Generator) -> tuple[float, list[Earlier]]:
    """What a player's battle is worth, 0 to 100, and their answers, each at their own step."""
    played: list[Earlier] = []
    for _ in range(ROUNDS):
        before = [*expected.answered, *(Answered(one.step, one.is_won) for one in played)]
        played.append(who.answer(STAIRCASE.next_step(before), rng))
    worth = [expected.of_answer(one.points) for one in played]
    return (sum(worth) + worth[-1]) / (ROUNDS + 1), played


def known(who: Somebody, battles: int, rng: np.random.Generator) -> list[Earlier]:
    """The answers of so many battles."""
    earlier: list[Earlier] = []
    for _ in range(battles):
        earlier += battle(who, expectation(earlier, []), rng)[1]
    return earlier


def worths(who: Sequence[Somebody], history: int, battles: int, seed: int) -> np.ndarray:
    """What both get in battles after `history` others, (battles, 2)."""
    rng = np.random.default_rng(seed)
    return np.array(
        [[battle(one, expectation(known(one, history, rng), []), rng)[0] for one in who] for _ in range(battles)]
    )


def share_won(both: np.ndarray) -> float:
    return float((both[:, 0] > both[:, 1]).mean() + 0.5 * (both[:, 0] == both[:, 1]).mean())


def test_a_beginner_wins_about_half_of_the_battles_against_a_pro() -> None:
    both = worths((BEGINNER, PRO), 4, 60, seed=1)
    assert 0.35 <= share_won(both) <= 0.65
    assert np.all(np.abs(both.mean(axis=0) - 50) <= 5), "each settles at 50"


def test_a_pupil_at_their_limit_wins_about_half_of_the_battles_against_a_pro() -> None:
    both = worths((PUPIL, PRO), 4, 40, seed=2)
    assert 0.35 <= share_won(both) <= 0.65
    assert np.all(np.abs(both.mean(axis=0) - 50) <= 6)


def test_whoever_has_improved_wins_mostly() -> None:
    rng = np.random.default_rng(3)
    won = 0
    for better, was in [(replace(BEGINNER, right=0.93, stray=0.01), BEGINNER), (replace(PUPIL, limit=6.0), PUPIL)] * 15:
        improved, _ = battle(better, expectation(known(was, 4, rng), []), rng)
        usual, _ = battle(PRO, expectation(known(PRO, 4, rng), []), rng)
        won += improved > usual
    assert won / 30 > 0.75


def test_playing_badly_on_purpose_for_a_battle_and_a_half_pays_little() -> None:
    rng = np.random.default_rng(4)
    won = 0
    for _ in range(20):
        honest, cheat = known(PUPIL, 6, rng), known(PUPIL, 5, rng)
        cheat += [Earlier(one.step, False, 0.4 * one.points) for one in cheat[-10:]]
        ours, _ = battle(PUPIL, expectation(cheat, []), rng)
        theirs, _ = battle(PUPIL, expectation(honest, []), rng)
        won += ours > theirs
    assert won / 20 < 0.75, "an honest player wins 0.5"
