"""The phase of a signal against a periodic model (Boyd and Godbout 2012, § 3.2), and beyond it.

    E(φ) = E1(φ) − λ E2(φ)                                                                                     (6)
    E1 = f(φ)·y / |f(φ)||y|, the normalised correlation over channels                                          (4)
    E2 = (wrap(φ − (φ̂(k−1) + Δφ)) / 2π)²                                                                       (5)

E is evaluated at the n_m centres; a parabola through the best and its neighbours gives φ̂ = μ_j + x 2π/n_m and E_max.
The paper's (17) prints π/n_m, half the step between centres.

Beyond the paper, as `TrackerSettings` says: the expected Δφ follows the signal (`cadence`), y may hold older samples
too (`templates`), and `confidence` says what E_max cannot.

`PhaseTracker` takes a signal sample by sample, `tracked` as a whole; both give the same to 1e-9. Inside, phases are
*places*: in steps between centres, place j at centre μ_j (from 0).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, pi, sqrt
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from station.sync.phase.cadence import DOUBTFUL, CadenceRule, doubt_weight
from station.sync.phase.confidence import MOST_ENERGY, Confidence, confidences, locks, weight_of_newest
from station.sync.phase.objective import Objective
from station.sync.phase.parallel_lanes import Lanes
from station.sync.phase.periodic_model import TURN, PeriodicModel, wrapped
from station.sync.phase.templates import Past, Seen, Templates, templates
from station.sync.signals.running_mean import running_means
from station.sync.signals.signal import FloatArray


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """How a signal is tracked; the defaults are the paper's for walking and running at 120 samples a second (§ 4.1).

    `cadence_rad`: Δφ, the phase expected from sample to sample. `smoothing`: λ, how much that counts beside the signal.
    `start_rad`: φ̂ before the first sample; None begins where the first sample fits best.
    `feedback`: the part of each surprise by which the expected cadence changes, 0 in the paper; it stays within
    `span` times Δφ and Δφ / `span`. `most_doubt`: how much less the signal may be like the model at the tracker's phase
    than at another, for some time, before it begins anew there; None in the paper, which waits. `lags`: the samples
    that are compared together, by their age, the newest (0) first; further ones make a phase unique where one instant
    is not, as with a single channel.
    """

    cadence_rad: float = 0.05
    smoothing: float = 100.0
    start_rad: float | None = 0.0
    feedback: float = 0.0
    span: float = 2.5
    most_doubt: float | None = None
    lags: tuple[int, ...] = (0,)

    def __post_init__(self) -> None:
        assert 0 < self.cadence_rad < pi
        assert self.smoothing >= 0
        assert 0 <= self.feedback < 1 <= self.span
        assert self.most_doubt is None or self.most_doubt > 0
        assert self.lags[0] == min(self.lags) == 0


PAPER = TrackerSettings()
ADAPTIVE = TrackerSettings(start_rad=None, feedback=0.02, most_doubt=0.3)
"""The tracker beyond the paper. Feedbacks from 0.01 to 0.2 lock alike on the CMU walks at half to two and a half times
their tempo, a smaller one holds better on uneven ground (docs/phase.md); the span leaves room beyond half and double;
doubts of 0.2 to 0.4 serve alike."""


class PhaseStep(NamedTuple):
    """What is known after a sample.

    `phase_rad` in (−π, π]; `quality` the paper's E_max, at most about 1; `confidence` 0 … 1 that the signal goes
    through the model's cycle, forwards; `cadence_rad` the phase that is expected to pass until the next sample;
    `locked` whether the phase can be used: confidence with hysteresis.
    """

    phase_rad: float
    quality: float
    confidence: float
    cadence_rad: float
    locked: bool


@dataclass(frozen=True, slots=True, eq=False)
class PhaseTrack:
    """What a `PhaseStep` holds, for every sample of a signal: arrays (n,)."""

    phase_rad: FloatArray
    quality: FloatArray
    confidence: FloatArray
    cadence_rad: FloatArray
    locked: npt.NDArray[np.bool_]


class _Parts:
    """What both forms are made of."""

    def __init__(self, model: PeriodicModel, settings: TrackerSettings) -> None:
        self.step_rad = TURN / model.centre_count
        self.usual = settings.cadence_rad / self.step_rad
        span = settings.span if settings.feedback else 1.0
        most_doubt = inf if settings.most_doubt is None else settings.most_doubt
        weight = doubt_weight(settings.cadence_rad)
        self.cadence = CadenceRule(
            settings.feedback, self.usual, self.usual / span, self.usual * span, most_doubt, weight
        )
        ends_rad = settings.cadence_rad / span, settings.cadence_rad * span
        self.templates: Templates = templates(model, settings.lags, *ends_rad)
        self.objective = Objective(model.centre_count, settings.smoothing)
        self.start_rad = settings.start_rad
        self.table = self.templates.table(settings.cadence_rad)
        self.newest = weight_of_newest(settings.cadence_rad)

    def start(self, seen: FloatArray) -> float:
        """The place from 0 to n_m before the first sample (lags·c,)."""
        if self.start_rad is None:
            place = float(self.templates.directions[self.table].dot(seen).argmax()) - self.usual
        else:
            place = (self.start_rad + pi) / self.step_rad - 1
        return place % self.objective.count


class PhaseTracker:
    """Follows one signal. `step` takes its samples one by one, in the model's channels and their own units."""

    def __init__(self, model: PeriodicModel, settings: TrackerSettings = PAPER) -> None:
        parts = _Parts(model, settings)
        self._templates, self._cadence, self._best = parts.templates, parts.cadence, parts.objective.best
        self._directions, self._energy = list(self._templates.directions), self._templates.energy.tolist()
        self._table, self._start = parts.table, parts.start
        self._are_several = len(self._directions) > 1
        self._mean, self._per_scale = model.mean, (1 / model.scale if (model.scale != 1).any() else None)
        self._count, self._step_rad = model.centre_count, parts.step_rad
        self._place: float | None = None
        self._pace = self._usual = parts.usual
        self._past = Past(settings.lags) if len(settings.lags) > 1 else None
        self._sureness, self._doubt = Confidence(parts.newest), 0.0

    def step(self, sample: Sequence[float] | FloatArray) -> PhaseStep:
        """The phase after one more sample (c,)."""
        seen: FloatArray = sample - self._mean
        if self._per_scale is not None:
            seen *= self._per_scale
        if self._past is not None:
            seen = self._past.with_older(seen)
        energy = float(seen.dot(seen))
        per_length = 1 / sqrt(energy) if energy else 0.0
        products = self._directions[self._table].dot(seen)
        pace, count, cadence = self._pace, self._count, self._cadence
        expected = (self._start(seen) if self._place is None else self._place) + pace
        centre, beyond, quality, likeness, surprise = self._best(products, per_length, expected)
        better = float(products.max()) * per_length - likeness if likeness < DOUBTFUL else 0.0
        self._doubt += cadence.doubt_weight * (better - self._doubt)
        is_lost = self._doubt > cadence.most_doubt
        if is_lost:
            fitting = float(products.argmax())
            centre, beyond, quality, likeness, surprise = self._best(products, per_length, fitting)
            self._doubt = 0.0
        self._place = place = centre + beyond
        speed = 0.0 if is_lost else (pace + surprise) / self._usual
        sureness = self._sureness
        sure = sureness.step(likeness, speed, energy, self._energy[self._table][centre])
        if cadence.feedback:
            self._pace = pace = self._usual if is_lost else cadence.after(pace, likeness, surprise)
            if self._are_several:
                self._table = self._templates.table(pace * self._step_rad)
        phase_rad = pi - ((count - 1 - place) * self._step_rad) % TURN
        if phase_rad <= -pi:  # a remainder may be rounded up to the whole turn
            phase_rad = pi
        return PhaseStep(phase_rad, quality, sure, pace * self._step_rad, sureness.is_locked)


def tracked(model: PeriodicModel, values: FloatArray, settings: TrackerSettings = PAPER) -> PhaseTrack:
    """The phase at every sample of `values` (n, c), which are in the model's channels and their own units."""
    parts = _Parts(model, settings)
    lanes = Lanes(parts.objective, parts.templates, parts.cadence)
    if len(values) >= lanes.worth:
        return _in_lanes(parts, lanes, Seen(model, values, settings.lags))
    tracker = PhaseTracker(model, settings)
    steps = np.array([tracker.step(sample) for sample in values], dtype=np.float64).reshape(-1, len(PhaseStep._fields))
    phase_rad, quality, confidence, cadence_rad, locked = steps.T
    return PhaseTrack(phase_rad, quality, confidence, cadence_rad, locked > 0)


def _in_lanes(parts: _Parts, lanes: Lanes, seen: Seen) -> PhaseTrack:
    start = parts.start(seen.at(np.zeros(1, np.int64))[0])
    means = np.zeros((4, 1))
    rows = []
    for way in lanes.ways(seen, start, parts.usual):
        energy = np.minimum(way.energy, MOST_ENERGY * way.expected)
        asked = np.array([way.likeness, way.speed / parts.usual, energy, way.expected])
        means = running_means(asked, parts.newest, means[:, -1])
        phase_rad = wrapped((way.place + 1) * parts.step_rad - pi)
        rows.append(np.array([phase_rad, way.quality, confidences(means), way.pace * parts.step_rad]))
    phase_rad, quality, confidence, cadence_rad = np.concatenate(rows, axis=1)
    return PhaseTrack(phase_rad, quality, confidence, cadence_rad, locks(confidence))
