"""How the student's own sticks moved over the loop, as a model of its own: to be kept, and to be compared with.

While the tracker is locked, every sample is counted at its phase. The mean of all repeats is a `PeriodicModel` like the
drill's, which `sync.phase.model_file` writes and reads: the student's best pass, or the teacher's. Likeness is told
against such a take and never against the animated figure, whose arms are nobody's.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.sync.drill.drill_model import AXES, CHANNELS, HANDS, DrillModel, channel_names
from station.sync.phase.periodic_model import TURN, Exemplar, PeriodicModel, centres, fitted

Array = NDArray[np.float64]

LEAST_SHARE = 0.9
"""So many of the phases must have been seen in a take, else it is none (our choice: a stroke may be left out)."""
RESTING_RAD_S = 0.3
"""RMS of the rates below which a hand rests: a fifth of the softest playing seen (our choice)."""


class TakenMotion:
    """Counts what was measured at each phase of the shortest repeat."""

    def __init__(self, model: DrillModel) -> None:
        self._cycle_s = model.cycle_s
        self._sum = np.zeros((model.centre_count, len(HANDS) * len(CHANNELS)))
        self._count = np.zeros(self._sum.shape, np.int64)

    def add(self, turn: float, values: Array, present: NDArray[np.bool_]) -> None:
        """One sample, m/s² and rad/s (12,), at a phase in turns [0, 1)."""
        row = round(turn * len(self._sum)) % len(self._sum)
        self._sum[row] += np.where(present, values, 0.0)
        self._count[row] += present

    def take(self) -> PeriodicModel | None:
        """The mean of all repeats in the channels' own units; None while too little of the loop was seen."""
        seen = self._count.min(axis=1) > 0
        if seen.mean() < LEAST_SHARE:
            return None
        phase = TURN * np.flatnonzero(seen) / len(seen)
        values = self._sum[seen] / self._count[seen]
        return fitted(channel_names(), [Exemplar(values, phase, self._cycle_s)], len(seen))


@dataclass(frozen=True, slots=True)
class MotionLikeness:
    """How one hand's motion compares with another take of the same loop.

    `shape` is the normalised correlation of the stick's turning over the loop, −1 … 1, whatever its size; `height` how
    much it turns beside the other take, 1 as much.
    """

    limb: Limb
    shape: float
    height: float


def likeness(take: PeriodicModel, reference: PeriodicModel) -> tuple[MotionLikeness, ...]:
    """Each hand of `take` beside `reference`, two takes of one loop; a hand that rests in either is left out."""
    phase = centres(max(take.centre_count, reference.centre_count))
    own, other = (each.at(phase) * each.scale for each in (take, reference))
    found = []
    for index, limb in enumerate(HANDS):
        rates = slice(index * len(CHANNELS) + AXES, (index + 1) * len(CHANNELS))
        ours, theirs = float(np.sum(own[:, rates] ** 2)), float(np.sum(other[:, rates] ** 2))
        if min(ours, theirs) > RESTING_RAD_S**2 * len(phase):
            shape = float(np.sum(own[:, rates] * other[:, rates])) / (ours * theirs) ** 0.5
            found.append(MotionLikeness(limb, shape, (ours / theirs) ** 0.5))
    return tuple(found)
