"""What whoever asks the model wants of the bars that it continues with."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.beat_steps import Music
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.played_divisions import DIVISIONS


@dataclass(frozen=True, eq=False)
class Wanted:
    """How the bars shall be that come next; all of it may be left as it is.

    `music` is style, feel, tempo, and where the first wanted bar stands in a phrase of four. `boldness` from 0, always
    the likeliest, over 0.5, as drummers play, to 1, the unusual. `memory` is how much the player's own bars count: 0
    not at all, 1 as much as predicts them best, up to 1.5 for a mirror. Only `instruments` are struck, and beats are
    only cut into `divisions`.

    `given` fixes cells of the first beats, where `is_given` (m, 8, 9) says so, m of its beats; a beat with a fixed cell
    has the division that it has in `given`, and velocity, timing and ornament of fixed strokes are kept. So an answer
    begins like the call, or a last beat leads home. `favour` (b, 9) is added to the log-odds of each instrument, by
    beat: +1 makes a seldom stroke e times as likely; beats beyond b are left as they are.
    """

    music: Music = field(default_factory=Music)
    boldness: float = 0.5
    memory: float = 1.0
    instruments: frozenset[Instrument] = frozenset(Instrument)
    divisions: frozenset[int] = frozenset(DIVISIONS)
    given: Beats | None = None
    is_given: NDArray[np.bool_] | None = None
    favour: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        assert 0 <= self.boldness <= 1, "boldness"
        assert 0 <= self.memory <= MOST_MEMORY, "memory"
        assert self.divisions, "a beat is divided somehow"
        assert (self.given is None) == (self.is_given is None), "what is given, and where"

    @property
    def temperature(self) -> float:
        """By how much log-odds are divided."""
        return LEAST_TEMPERATURE + (MOST_TEMPERATURE - LEAST_TEMPERATURE) * self.boldness

    @property
    def least_chance(self) -> float:
        """What is less likely than this is not played, and what is as sure is played (the nucleus of a coin)."""
        return 0.5 * (1 - self.boldness) ** _NUCLEUS

    def is_fixed(self, beat: int) -> bool:
        """Whether any cell of the beat is."""
        return self.is_given is not None and beat < len(self.is_given) and bool(self.is_given[beat].any())


MOST_MEMORY = 1.5
LEAST_TEMPERATURE, MOST_TEMPERATURE = 0.6, 1.4
"""At a boldness of 0.5 the temperature is 1, at which the model plays as it has learned (our choice)."""
_NUCLEUS = 5
"""At a boldness of 0.5 chances below 1/64 are left out, at 0 all below a half: of sixteen cells and nine instruments
the unlikeliest are noise, which adds up in four bars (nucleus sampling: Holtzman et al. 2020; the size is our choice,
by the classifier of `benchmarks/battle_model.py`)."""
