"""Whether a signal goes through the model's cycle at all: E_max alone cannot tell, for it knows neither size nor speed.

Over the last third of a period or so (exponentially weighted) three things are asked, and the answers multiplied:
how like the model the samples are where the tracker is; how fast its phase went forward; how large the signal was
beside the model. Somebody who stands still makes no phase; who walks backwards drags it against its cadence, or is
unlike the model; other motion is unlike it too; and the tremor of a sensor at rest is small.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np
import numpy.typing as npt

from station.sync.phase.periodic_model import TURN
from station.sync.signals.signal import FloatArray

MEMORY_TURNS = 1 / 3
"""Of a period at Δφ: as short as tells a step from a twitch (our choice; the paper converges in half a cycle)."""
LIKENESS = (0.5, 0.85)
SPEED = (0.15, 0.4)
SIZE = (0.15, 0.35)
LARGEST_SIZE = (5.0, 3.0)
"""Where confidence begins and where it is full: in likeness E1, in Δφ, and in the model's own size. Our choice from the
CMU trials (docs/phase.md): walks have E1 0.85 to 0.99 with a model of another person, and runs twice a walk's size."""
LOCKED, LOST = 0.6, 0.3
"""Confidence that locks, and below which the lock is lost (our choice: a doubtful step does not flicker)."""
_FULL_ENERGY = (SIZE[1] ** 2, LARGEST_SIZE[1] ** 2)
MOST_ENERGY = LARGEST_SIZE[0] ** 2
"""A sample counts as so many times the energy that is expected of it at most: a single wild one does not unlock."""


def weight_of_newest(cadence_rad: float) -> float:
    """The weight of the newest sample in the means, where the phase goes so far in a sample."""
    return min(1.0, cadence_rad / (TURN * MEMORY_TURNS))


@dataclass(slots=True)
class Confidence:
    """The running means of one signal: `likeness`, `speed` in Δφ, `energy` of the signal and that `expected` of it."""

    weight: float
    likeness: float = 0.0
    speed: float = 0.0
    energy: float = 0.0
    expected: float = 0.0
    is_locked: bool = False

    def step(self, likeness: float, speed: float, energy: float, expected: float) -> float:
        """The confidence after one more sample."""
        weight = self.weight
        energy = min(energy, MOST_ENERGY * expected)
        self.likeness = alike = self.likeness + weight * (likeness - self.likeness)
        self.speed = fast = self.speed + weight * (speed - self.speed)
        self.energy += weight * (energy - self.energy)
        self.expected += weight * (expected - self.expected)
        size = self.energy / self.expected if self.expected else 0.0
        if alike >= LIKENESS[1] and fast >= SPEED[1] and _FULL_ENERGY[0] <= size <= _FULL_ENERGY[1]:
            sure = 1.0
        else:
            size = sqrt(size)
            sure = _part(alike, LIKENESS) * _part(fast, SPEED) * _part(size, SIZE) * _part(size, LARGEST_SIZE)
        self.is_locked = sure >= (LOST if self.is_locked else LOCKED)
        return sure


def confidences(means: FloatArray) -> FloatArray:
    """The confidence (n,) of the running means (4, n), in the order of `Confidence`."""
    alike, fast, energy, expected = means
    size = np.sqrt(np.divide(energy, expected, out=np.zeros_like(energy), where=expected > 0))
    parts = ((alike, LIKENESS), (fast, SPEED), (size, SIZE), (size, LARGEST_SIZE))
    sure: FloatArray = np.prod([np.clip((at - low) / (high - low), 0, 1) for at, (low, high) in parts], axis=0)
    return sure


def locks(confidence: FloatArray) -> npt.NDArray[np.bool_]:
    """Where the signal is locked, by its confidence (n,), from unlocked on."""
    said = np.where(confidence >= LOCKED, 1, np.where(confidence < LOST, -1, 0))
    last = np.maximum.accumulate(np.where(said != 0, np.arange(len(said)), 0))
    locked: npt.NDArray[np.bool_] = said[last] > 0
    return locked


def _part(value: float, ramp: tuple[float, float]) -> float:
    """0 before the ramp's beginning, 1 after its end, which may lie below."""
    begin, end = ramp
    part = (value - begin) / (end - begin)
    return 0.0 if part <= 0 else 1.0 if part >= 1 else part
