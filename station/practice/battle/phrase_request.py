"""What a battle asks its drummer for, shortly before it is to sound."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.phrase import Phrase, Turn


class Asked(Enum):
    """What for."""

    TO_REPEAT = "to_repeat"
    TO_ANSWER = "to_answer"
    TIME = "time"


@dataclass(frozen=True, eq=False)
class PhraseRequest:
    """A phrase for the turn `index`: of `step` to repeat, `bars` improvised ones, or `bars` of time kept.

    `heard` is what the players have played so far, the last as far as it was heard by now, and `said` what the drummer
    improvised itself; each in order, the last the newest.
    """

    rules: BattleRules
    index: int
    asked: Asked
    bars: int
    step: int | None = None
    heard: tuple[Turn, ...] = ()
    said: tuple[Turn, ...] = ()

    @property
    def rng(self) -> np.random.Generator:
        """Chance for this phrase alone, so that one phrase draws nothing from another."""
        return np.random.default_rng([self.rules.seed, self.index])


Drum = Callable[[PhraseRequest], Phrase]
"""Whoever plays the drummer's part; the same request is the same phrase."""
