"""What is said in a battle: a `Phrase` is written by whoever calls, a `Turn` is what somebody has played."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.music.performance import Performance
from station.music.score import NOTE_DTYPE, Score
from station.practice.battle.ground import Ground


@dataclass(frozen=True, eq=False)
class Phrase:
    """Whole bars at the tempo and in the meter of a ground, ready to be played.

    `score` has limbs, velocities, ornaments and each stroke's own timing (`late_ms`); its tick 0 is the first downbeat.
    `landing` (m,) of `NOTE_DTYPE`, ticks 0, is struck on the downbeat after the last bar, where the phrase comes home;
    it sounds into the next one's turn. `words` say in a few words what the phrase does, empty where there is nothing
    to say.
    """

    score: Score
    landing: NDArray[np.void] = field(default_factory=lambda: np.zeros(0, NOTE_DTYPE))
    words: str = ""

    @property
    def bars(self) -> int:
        """How many bars it has, the landing's apart."""
        return self.score.bar_count

    @property
    def with_landing(self) -> Score:
        """The score, and where there is a landing a bar more in which it stands."""
        return self.score.landing_on(self.landing)


@dataclass(frozen=True, eq=False)
class Turn:
    """What one drummer played in `bars` bars of `ground`.

    `played` is in turn time: ns from the turn's first downbeat, which an early first stroke may precede. What is played
    up to half a beat after the last bar belongs to it too, so that it holds the landing on the next downbeat.
    """

    ground: Ground
    bars: int
    played: Performance

    @property
    def length_ns(self) -> int:
        """How long the bars last."""
        return self.ground.ns_of_bars(self.bars)
