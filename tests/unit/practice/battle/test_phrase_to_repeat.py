"""What each step of the phrases to repeat asks, and that two hands and two feet can play them."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import spearmanr

from station.core.pieces import Limb, Ornament, Piece
from station.drills.difficulty import measured
from station.motion.feasibility.playable import impossible
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.phrase import Phrase
from station.practice.battle.repeating.demands import MOST_STEP, demand_at
from station.practice.battle.repeating.phrase_to_repeat import phrase_to_repeat, strokes_per_s

_STEADY = OPPONENTS["steady"]
_GROUNDS = [
    Ground(tempo, beats, unit, feel)
    for beats, unit, feel, tempo in (
        (4, 4, Feel.STRAIGHT, 60),
        (4, 4, Feel.TRIPLET, 160),
        (3, 4, Feel.TRIPLET, 60),
        (6, 8, Feel.STRAIGHT, 100),
        (5, 4, Feel.STRAIGHT, 160),
        (7, 8, Feel.STRAIGHT, 120),
    )
]


def _phrase(ground: Ground, step: int, seed: int, opponent: str = "steady") -> Phrase:
    return phrase_to_repeat(OPPONENTS[opponent], ground, step, np.random.default_rng([seed, step]))


def test_a_demand_never_falls_from_one_step_to_the_next() -> None:
    demands = [demand_at(step) for step in range(MOST_STEP + 1)]
    for lower, higher in pairwise(demands):
        assert lower.bars <= higher.bars
        assert lower.strokes_per_s < higher.strokes_per_s
        assert lower.coordination <= higher.coordination
        assert lower.dynamics <= higher.dynamics
    assert (demands[0].bars, demands[-1].bars) == (1, 4)


@pytest.mark.parametrize("ground", _GROUNDS, ids=str)
def test_harder_steps_are_harder_at_any_ground(ground: Ground) -> None:
    steps = range(0, MOST_STEP + 1, 3)
    phrases = [_phrase(ground, step, seed=1) for step in steps]
    hard = [measured(phrase.score, ground.beat_ticks).total for phrase in phrases]
    rates = [strokes_per_s(phrase.score) for phrase in phrases]
    assert spearmanr(steps, hard).statistic >= 0.9
    assert spearmanr(steps, rates).statistic >= 0.9


@pytest.mark.parametrize("opponent", OPPONENTS)
def test_every_phrase_can_be_played_and_says_who_plays_it(opponent: str) -> None:
    for step in range(0, MOST_STEP + 1, 4):
        phrase = _phrase(Ground(120), step, seed=2, opponent=opponent)
        assert impossible(phrase.score) == []
        assert (phrase.score.notes["limb"] != Limb.UNKNOWN).all()
        assert phrase.bars == demand_at(step).bars


def test_the_first_steps_ask_the_hands_alone_and_flat() -> None:
    for seed in range(6):
        notes = _phrase(Ground(100), 0, seed).score.notes
        assert Piece.KICK not in notes["piece"]
        assert len(np.unique(notes["velocity"])) == 1
        assert (notes["ornament"] == Ornament.NONE).all()


def test_the_last_steps_ask_four_limbs_ghosts_and_ornaments() -> None:
    phrases = [_phrase(Ground(100), MOST_STEP, seed) for seed in range(6)]
    limbs = [len(np.unique(phrase.score.notes["limb"])) for phrase in phrases]
    assert np.mean(limbs) > 3
    assert sum(bool((phrase.score.notes["ornament"] != Ornament.NONE).any()) for phrase in phrases) >= 4
    assert all(np.ptp(phrase.score.notes["velocity"]) > 40 for phrase in phrases)


def test_one_seed_is_one_phrase_and_another_another() -> None:
    first, again, other = (_phrase(Ground(100), 12, seed) for seed in (1, 1, 2))
    assert first.score.notes.tobytes() == again.score.notes.tobytes()
    assert first.score.notes.tobytes() != other.score.notes.tobytes()


def test_phrases_come_from_lessons_too() -> None:
    words = {_phrase(Ground(100), 12, seed, "mirror").words for seed in range(12)}
    assert "" in words
    assert len(words) > 2
