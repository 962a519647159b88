"""How the expected cadence follows the signal: the feedback that Boyd and Godbout 2012, § 5, say their tracker lacks.

It is the integrator of a phase-locked loop of second order: each surprise, the way from the expected phase to the one
that was found, changes the cadence by a part of it, so that a steady tempo is followed without lag. A sample that is
unlike the model changes nothing.
"""

from dataclasses import dataclass

import numpy as np

from station.sync.signals.signal import FloatArray

DOUBTFUL = 0.6
"""Likeness up to which a sample tells nothing about the cadence; from there its weight grows to 1 (our choice: half way
between chance and the 0.85 to 0.99 of the CMU walks)."""


@dataclass(frozen=True, slots=True)
class CadenceRule:
    """Paces are in steps between centres a sample; `feedback` is the part of a surprise that stays, 0 in the paper."""

    feedback: float
    slowest: float
    fastest: float

    def after(self, pace: float, likeness: float, surprise: float) -> float:
        """The pace after one sample."""
        trust = (likeness - DOUBTFUL) / (1 - DOUBTFUL)
        if trust <= 0:
            return pace
        return min(max(pace + self.feedback * trust * surprise, self.slowest), self.fastest)

    def after_all(self, pace: FloatArray, likeness: FloatArray, surprise: FloatArray) -> FloatArray:
        """The same for several signals (n,)."""
        trust = np.maximum((likeness - DOUBTFUL) / (1 - DOUBTFUL), 0.0)
        within: FloatArray = np.clip(pace + self.feedback * trust * surprise, self.slowest, self.fastest)
        return within
