"""How the expected cadence follows the signal: the feedback that Boyd and Godbout 2012, § 5, say their tracker lacks.

It is the integrator of a phase-locked loop of second order: each surprise, the way from the expected phase to the one
that was found, changes the cadence by a part of it, so that a steady tempo is followed without lag. A sample that is
unlike the model says nothing of the cadence; it lets it go back towards Δφ by the same part.

A tracker that is lost would wait until the motion comes by. Where samples have been unlike the model at its phase, and
like it at another, for some time, it begins anew there: `doubt` is their difference in likeness, its running mean.
"""

from dataclasses import dataclass

import numpy as np

from station.sync.phase.periodic_model import TURN
from station.sync.signals.signal import FloatArray

DOUBTFUL = 0.6
"""Likeness up to which a sample tells nothing about the cadence; from there its weight grows to 1 (our choice: half way
between chance and the 0.85 to 0.99 of the CMU walks). Doubt counts below it alone."""
DOUBT_TURNS = 1 / 25
"""The memory of doubt, in periods at Δφ (our choice: of 1/25, 1/12 and 1/6 the best on uneven ground, CMU 03_04)."""


@dataclass(frozen=True, slots=True)
class CadenceRule:
    """Paces are in steps between centres a sample; `feedback` is the part of a surprise that stays, 0 in the paper.

    `most_doubt` is how much doubt is borne, infinity in the paper.
    """

    feedback: float
    usual: float
    slowest: float
    fastest: float
    most_doubt: float
    doubt_weight: float

    def after(self, pace: float, likeness: float, surprise: float) -> float:
        """The pace after one sample."""
        trust = (likeness - DOUBTFUL) / (1 - DOUBTFUL) if likeness > DOUBTFUL else 0.0
        pace += self.feedback * (trust * surprise + (1 - trust) * (self.usual - pace))
        return self.slowest if pace < self.slowest else self.fastest if pace > self.fastest else pace

    def after_all(self, pace: FloatArray, likeness: FloatArray, surprise: FloatArray) -> FloatArray:
        """The same for several signals (n,)."""
        trust = np.maximum((likeness - DOUBTFUL) / (1 - DOUBTFUL), 0.0)
        changed = pace + self.feedback * (trust * surprise + (1 - trust) * (self.usual - pace))
        within: FloatArray = np.clip(changed, self.slowest, self.fastest)
        return within


def doubt_weight(cadence_rad: float) -> float:
    """The weight of the newest sample in the doubt, where the phase goes so far in a sample."""
    return min(1.0, cadence_rad / (TURN * DOUBT_TURNS))
