"""The phase of a signal against a periodic model, sample by sample (Boyd and Godbout 2012, § 3.2).

    E(φ) = E1(φ) − λ E2(φ)                                                                                     (6)
    E1 = f(φ)·y / |f(φ)||y|, the normalised correlation over channels                                          (4)
    E2 = (wrap(φ − (φ̂(k−1) + Δφ)) / 2π)²                                                                       (5)

E is evaluated at the n_m centres; a parabola through the best and its neighbours gives φ̂ = μ_j + x 2π/n_m and E_max.
The paper's (17) prints π/n_m, half the step between centres.

Inside, phases are *places*: in steps between centres, place j at centre μ_j. Centres so far from the expected place
that E1, which is at most 1, cannot make up for it are not looked at.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from station.sync.phase.periodic_model import TURN, PeriodicModel, centres
from station.sync.signals.signal import FloatArray


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """How a signal is tracked; the defaults are the paper's, § 4.1, for walking and running at 120 samples a second.

    `cadence_rad`: Δφ, the phase expected from sample to sample. `smoothing`: λ, how much that counts beside the signal.
    `start_rad`: φ̂ before the first sample.
    """

    cadence_rad: float = 0.05
    smoothing: float = 100.0
    start_rad: float = 0.0


class PhaseStep(NamedTuple):
    """What is known after a sample: the phase in (−π, π], and the quality E_max, at most about 1."""

    phase_rad: float
    quality: float


@dataclass(frozen=True, slots=True)
class PhaseTrack:
    """What is known after each sample of a signal, arrays (n,) of what a `PhaseStep` holds."""

    phase_rad: FloatArray
    quality: FloatArray


def directions(model: PeriodicModel) -> FloatArray:
    """f(μ_j) / |f(μ_j)| (n_m, c) at the centres; 0 where the model is at rest at its mean."""
    values = model.at(centres(model.centre_count))
    length = np.linalg.norm(values, axis=1, keepdims=True)
    found: FloatArray = np.divide(values, length, out=np.zeros_like(values), where=length > 0)
    return found


class PhaseTracker:
    """Follows one signal. `step` takes its samples one by one, in the model's channels and their own units."""

    def __init__(self, model: PeriodicModel, settings: TrackerSettings = TrackerSettings()) -> None:
        self._directions = directions(model)
        self._mean, self._per_scale = model.mean, 1 / model.scale
        self._count = model.centre_count
        self._step_rad = TURN / self._count
        self._price = settings.smoothing / self._count**2
        self._expected_steps = settings.cadence_rad / self._step_rad
        self._place = (settings.start_rad + pi) / self._step_rad - 1
        self._rings = [(ring, 1 - self._price * (ring - 0.5) ** 2) for ring in range(1, (self._count + 1) // 2 + 1)]

    def step(self, sample: Sequence[float] | FloatArray) -> PhaseStep:
        """The phase after one more sample (c,)."""
        expected = self._place + self._expected_steps
        place, quality = self._best(self._likeness(sample), expected)
        self._place = place
        phase_rad = _in_turn((place + 1) * self._step_rad - pi)
        return PhaseStep(phase_rad, quality)

    def _likeness(self, sample: Sequence[float] | FloatArray) -> list[float]:
        """E1 at the centres."""
        centred = (np.asarray(sample) - self._mean) * self._per_scale
        length = sqrt(centred.dot(centred))
        return (self._directions.dot(centred) / length).tolist() if length else [0.0] * self._count

    def _best(self, likeness: list[float], expected: float) -> tuple[float, float]:
        """The place of the largest E, and E there."""
        count, price = self._count, self._price
        near = round(expected)
        rest = expected - near
        middle = near % count
        if 2 * middle >= count:
            middle -= count  # so that Python's negative indices go round

        def objective(offset: int) -> float:
            apart = offset - rest
            if 2 * apart > count:
                apart -= count
            elif 2 * apart < -count:
                apart += count
            return likeness[(middle + offset) % count] - price * apart * apart

        best, at = objective(0), 0
        for ring, most in self._rings:
            if best >= most:
                break
            for offset in (-ring, ring):
                value = objective(offset)
                if value > best:
                    best, at = value, offset
        before, after = objective(at - 1), objective(at + 1)
        a, b = 0.5 * (before + after) - best, 0.5 * (after - before)
        x = -b / (2 * a) if a < 0 else 0.0
        return middle + at + x, best + 0.5 * b * x


def tracked(model: PeriodicModel, values: FloatArray, settings: TrackerSettings = TrackerSettings()) -> PhaseTrack:
    """The phase at every sample of `values` (n, c), as a tracker gives it sample by sample."""
    tracker = PhaseTracker(model, settings)
    steps = [tracker.step(sample) for sample in values]
    return PhaseTrack(np.array([step.phase_rad for step in steps]), np.array([step.quality for step in steps]))


def _in_turn(phase_rad: float) -> float:
    """The same phase in (−π, π]."""
    return pi - (pi - phase_rad) % TURN
