"""Follows the student's sticks through a drill: samples of their sensors in, where in the loop they are out.

Three steps: both sensors on one grid (`stick_grid`), the best way through phase and tempo (`phase_paths`), and from its
end, which moves in steps of the model's centres, a phase and a cadence without jitter (an α–β filter, critically
damped). The phase is that of the loop's shortest repeat; which repeat it is the kit's hits may tell (`loop_repeats`).

How alike model and sample are says whether it locked, never how well somebody plays. Who holds still is like a model at
rest: so the sticks must move about as much as the drummer's, too.
"""

from math import exp, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from station.core.events import PhaseEstimate, SensorEvent, SensorLost, SensorMounted, SensorSamples
from station.core.units import NS_PER_S
from station.sync.drill.drill_model import CENTRES_A_STROKE, DrillModel
from station.sync.drill.phase_paths import PhasePaths
from station.sync.drill.stick_grid import STEP_NS, StickGrid, StickStep

Array = NDArray[np.float64]

_STEP_S = STEP_NS / NS_PER_S
SETTLES_S = 0.15
"""Time constant of the filter: phases differ from the truth by a centre or so, for some 50 ms (our choice)."""
BENDS = 1.25
"""The filter's cadence stays so near to the way's tempo: five of its steps (our choice)."""
REMEMBERS_S = 2.0
"""Likeness is a mean over about so long: four strokes at 120 bpm."""
RESTS_S = 1.0
"""Motion and steadiness are means over about so long: a stroke every two seconds is still motion (our choice)."""
FOREIGN, OWN = 0.30, 0.50
"""The correlation of model and sample over the last seconds, of what happens when and how much of it: .44 to .9 where
other people, and other styles, play this motion; .1 to .5 where it is a foreign one (trials on six lessons' motions,
before `REST` was what it is; docs/drill-phase.md has what comes of it)."""
UNSURE, SURE = 0.5, 2.0
"""By how much the best way is ahead of any to another phase: 2 are odds of seven to one (our choice)."""
STILL, MOVES = 0.08, 0.25
"""RMS of the rates beside the drummer's: noise and a held stick, and the softest player's (our choice)."""
UNSTEADY, STEADY = 0.40, 0.20
"""SD of the cadence's logarithm: at most .19 where this motion is played, up to .57 where it is a foreign one."""
LOCKS, LETS_GO = 0.5, 0.2
"""Confidence from which on it is locked, and under which no more (our choice, hysteresis)."""


class _Lock:
    """The phase without jitter: `turn` [0, 1) of the shortest repeat, and how many turns it makes a second."""

    def __init__(self, widest: float) -> None:
        """An end that jumps by more than `widest` turns is followed at once."""
        self._widest = widest
        gone = exp(-_STEP_S / SETTLES_S)
        self._alpha, self._beta = 1 - gone * gone, (1 - gone) ** 2
        self.turn, self.per_s = 0.0, 0.0

    def step(self, turn: float, per_s: float) -> bool:
        """Take in the best way's end, which moves at `per_s`; whether it was near where it was awaited."""
        awaited = self.turn + self.per_s * _STEP_S
        off = (turn - awaited + 0.5) % 1.0 - 0.5
        if abs(off) > self._widest or self.per_s == 0.0:
            self.turn, self.per_s = turn, per_s
            return False
        self.turn = (awaited + self._alpha * off) % 1.0
        self.per_s = min(max(self.per_s + self._beta / _STEP_S * off, per_s / BENDS), per_s * BENDS)
        return True


class _Mean:
    """A mean of what is added, each by its weight; what is old counts less. `filled` 0 at first, 1 at last."""

    def __init__(self, time_constant_s: float) -> None:
        self._kept = exp(-_STEP_S / time_constant_s)
        self._sum = self._weight = 0.0
        self.filled = 0.0

    def add(self, weighted: float, weight: float = 1.0) -> None:
        self._sum = self._kept * self._sum + weighted
        self._weight = self._kept * self._weight + weight
        self.filled = self._kept * self.filled + (1 - self._kept)

    @property
    def mean(self) -> float:
        """0 before anything was added."""
        return self._sum / self._weight if self._weight else 0.0


class _Trust:
    """How sure it is that this is the motion: running means of likeness, lead, motion and cadence."""

    def __init__(self) -> None:
        self._like, self._ours, self._theirs = (_Mean(REMEMBERS_S) for _ in range(3))
        self._cadence, self._square, self._power, self._lead = (_Mean(RESTS_S) for _ in range(4))

    def step(self, scaled: Array, model: Array, lead: float, per_s: float) -> float:
        """The confidence 0 … 1 after one more sample, `scaled` (12,), with the `model` (12,) at its phase."""
        energy, cadence = float(scaled @ scaled), log(per_s)
        self._like.add(float(model @ scaled))
        self._ours.add(float(model @ model))
        self._theirs.add(energy)
        self._cadence.add(energy * cadence, energy)
        self._square.add(energy * cadence * cadence, energy)
        self._power.add(float(np.mean(scaled[_RATES] ** 2)))
        self._lead.add(lead)
        both = sqrt(self._ours.mean * self._theirs.mean)
        likeness = self._like.mean / both if both else 0.0
        swings = sqrt(max(self._square.mean - self._cadence.mean**2, 0.0))
        likely = self._like.filled * _share(likeness, FOREIGN, OWN) * _share(self._lead.mean, UNSURE, SURE)
        return likely * _share(sqrt(self._power.mean), STILL, MOVES) * _share(-swings, -UNSTEADY, -STEADY)


class DrillTracker:
    """Follows one student against one model."""

    def __init__(self, model: DrillModel) -> None:
        self._model = model
        self._grid = StickGrid(model.smoothing_s)
        self._paths = PhasePaths(model.table(), _STEP_S)
        self._lock = _Lock(CENTRES_A_STROKE / 2 / model.centre_count)
        self._trust = _Trust()
        self._locked = False

    def handle(self, event: SensorEvent) -> list[PhaseEstimate]:
        """Where the student is, a hundred times a second, told some hundredths of a second after it was so."""
        match event:
            case SensorMounted():
                self._grid.mounted(event)
            case SensorLost():
                self._grid.lost(event.device)
            case SensorSamples():
                return [self._estimate(step) for step in self._grid.handle(event)]
        return []

    def _estimate(self, step: StickStep) -> PhaseEstimate:
        values = np.where(step.present, self._model.scaled(step.values), 0.0)
        end = self._paths.step(values, step.present)
        near = self._lock.step(end.turn, end.speed / self._model.cycle_s)
        model = np.where(step.present, self._paths.model_at(self._lock.turn, end.speed), 0.0)
        confidence = self._trust.step(values, model, end.lead, self._lock.per_s)
        self._locked = near and confidence > (LETS_GO if self._locked else LOCKS)
        return PhaseEstimate(
            at_ns=step.at_ns,
            phase_rad=pi - (pi - 2 * pi * self._lock.turn) % (2 * pi),
            quality=end.match,
            confidence=confidence,
            cadence_rad_s=2 * pi * self._lock.per_s,
            locked=self._locked,
        )


_RATES = np.tile([False, False, False, True, True, True], 2)


def _share(value: float, low: float, high: float) -> float:
    """0 up to `low`, 1 from `high` on, straight between."""
    return min(max((value - low) / (high - low), 0.0), 1.0)
