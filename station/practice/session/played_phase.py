"""Where in the drill the sticks were while a session was played, as the sensors told it.

A hundred phases a second come while the sticks are tracked; an hour of them is kept in some 10 MB. What counts is told
at the end, from the first judged stroke to the last, so that it does not matter when the session heard of a phase.
"""

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from station.core.events import PhaseEstimate, StickStroke
from station.core.units import NS_PER_S
from station.music.score import Score
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.phase_feedback import NEAR_S, StrokeOffset, stroke_offsets

SAME_PLACE = 1e-3
"""Two loops are one at two tempi where no note lies farther apart, in loops: 4 ms of two bars at 120 bpm (our choice;
a tempo is kept in whole microseconds)."""


@dataclass(frozen=True, slots=True)
class PlayedPhase:
    """Of `steps` phases so many were `locked`; `offsets` of the sticks' strokes that fell on those."""

    steps: int
    locked: int
    offsets: tuple[StrokeOffset, ...]


@dataclass(eq=False)
class PhasesHeard:
    """The phases as they are told; `model` is that of the drill that is tracked, None while none is."""

    model: DrillModel | None = None
    _at_ns: "array[int]" = field(default_factory=lambda: array("q"))
    _phase_rad: "array[float]" = field(default_factory=lambda: array("d"))
    _cadence_rad_s: "array[float]" = field(default_factory=lambda: array("d"))
    _locked: "array[int]" = field(default_factory=lambda: array("b"))

    def handle(self, estimate: PhaseEstimate) -> None:
        """Take in a phase; they come in order."""
        self._at_ns.append(estimate.at_ns)
        self._phase_rad.append(estimate.phase_rad)
        self._cadence_rad_s.append(estimate.cadence_rad_s)
        self._locked.append(estimate.locked)

    def played(
        self, section: Score, beat_ticks: int, strokes: Sequence[StickStroke], span_ns: tuple[int, int] | None
    ) -> PlayedPhase | None:
        """What was heard within `span_ns`, of `section` in a loop; None where nothing was, or of another drill."""
        if self.model is None or span_ns is None or not _is_loop_of(self.model, section):
            return None
        first, last = span_ns
        at_ns = np.array(self._at_ns, np.int64)
        rows = np.flatnonzero((at_ns >= first) & (at_ns <= last))
        if not len(rows):
            return None
        locked = np.array(self._locked, np.bool_)
        felt = [stroke for stroke in strokes if first <= stroke.at_ns <= last]
        near = self._near(at_ns, np.array([stroke.at_ns for stroke in felt], np.int64)) & locked
        beat_s = self.model.loop_s * beat_ticks / section.end_tick
        estimates = [
            PhaseEstimate(self._at_ns[row], self._phase_rad[row], 1.0, 1.0, self._cadence_rad_s[row], locked=True)
            for row in np.flatnonzero(near).tolist()
        ]
        return PlayedPhase(len(rows), int(locked[rows].sum()), stroke_offsets(self.model, estimates, felt, beat_s))

    @staticmethod
    def _near(at_ns: np.ndarray, strokes_ns: np.ndarray) -> np.ndarray:
        """Which phases (n,) lie near any of the strokes (m,)."""
        if not len(strokes_ns):
            return np.zeros(len(at_ns), np.bool_)
        ordered = np.sort(strokes_ns)
        after = np.minimum(np.searchsorted(ordered, at_ns), len(ordered) - 1)
        before = np.maximum(after - 1, 0)
        reach_ns = NEAR_S * NS_PER_S
        return np.asarray(np.minimum(abs(ordered[after] - at_ns), abs(ordered[before] - at_ns)) <= reach_ns)


def _is_loop_of(model: DrillModel, section: Score) -> bool:
    """Whether the section is the model's loop, at whatever tempo."""
    if len(section) != len(model.onset_s) or not section.length_ns:
        return False
    apart = section.onset_s * NS_PER_S / section.length_ns - model.onset_s / model.loop_s
    return bool((section.notes["piece"] == model.piece).all() and (abs(apart) < SAME_PLACE).all())


def all_phases(parts: Sequence[PlayedPhase | None]) -> PlayedPhase | None:
    """Several passes as one; None where nothing was heard in any."""
    heard = [part for part in parts if part is not None]
    if not heard:
        return None
    offsets = tuple(offset for part in heard for offset in part.offsets)
    return PlayedPhase(sum(part.steps for part in heard), sum(part.locked for part in heard), offsets)
