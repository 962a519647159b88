"""How far each hand is from where the loop is: strokes of the sticks against the phase that both together have.

A stroke comes at a phase; the written stroke of that hand that is nearest to it has another. The difference, as time at
the student's own cadence, says how the hand leans against the motion as a whole, whatever the click does. Positive is
late. The phase is that of both hands: where one leans by ten milliseconds, and both count alike, five of them are in
the phase.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import PhaseEstimate, StickStroke
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.scoring.analysis.timing_spread import spread
from station.sync.drill.drill_model import HANDS, DrillModel

Array = NDArray[np.float64]

NEAR_S = 0.03
"""A stroke farther than this from any phase was not tracked: three steps of the tracker (our choice)."""
LEAST_STROKES = 4
"""Of fewer strokes nothing is said (our choice)."""
FAR_SD, SD_OF_MEDIAN = 4.5, 1.4826
"""Strokes farther from their median, in SD as the median deviation tells it, are slips (as in `scoring.matching`)."""
LEAST_REACH_MS = 10.0
"""Nobody's stroke is a slip for so little (our choice)."""


@dataclass(frozen=True, slots=True)
class StrokeOffset:
    """A stroke of `limb`: how long after its phase's place it came, and which part of a beat that is at their tempo."""

    at_ns: int
    limb: Limb
    late_ms: float
    late_beats: float


@dataclass(frozen=True, slots=True)
class HandLean:
    """How a hand leans over `strokes` strokes: mean and SD, and the mean's 95 % interval, None of too few."""

    limb: Limb
    late_ms: float
    sd_ms: float
    ci_ms: tuple[float, float] | None
    late_beats: float
    strokes: int


def stroke_offsets(
    model: DrillModel, estimates: Sequence[PhaseEstimate], strokes: Sequence[StickStroke], beat_s: float
) -> tuple[StrokeOffset, ...]:
    """Every stroke that fell while the phase was locked, in order; the score's beat lasts `beat_s` at its own tempo."""
    locked = [estimate for estimate in estimates if estimate.locked]
    if not locked:
        return ()
    at_ns = np.array([estimate.at_ns for estimate in locked], np.int64)
    written = {hand: np.unique(model.onset_s[model.limb == hand] % model.cycle_s) for hand in HANDS}
    found = []
    for stroke in strokes:
        after = min(int(np.searchsorted(at_ns, stroke.at_ns)), len(locked) - 1)
        near = (max(after - 1, 0), after)
        estimate = min((locked[row] for row in near), key=lambda each: abs(each.at_ns - stroke.at_ns))
        since_s = (stroke.at_ns - estimate.at_ns) / NS_PER_S
        if abs(since_s) <= NEAR_S and len(written.get(stroke.limb, ())):
            place_s = _place_s(model, estimate, since_s)
            off_s = (place_s - written[stroke.limb] + model.cycle_s / 2) % model.cycle_s - model.cycle_s / 2
            late_s = float(off_s[np.argmin(np.abs(off_s))])
            tempo = estimate.cadence_rad_s * model.cycle_s / (2 * np.pi)
            found.append(StrokeOffset(stroke.at_ns, stroke.limb, late_s / tempo * 1e3, late_s / beat_s))
    return tuple(found)


def _place_s(model: DrillModel, estimate: PhaseEstimate, since_s: float) -> float:
    """Where in the shortest repeat, seconds of the score, the student is so long after an estimate."""
    return (estimate.phase_rad + estimate.cadence_rad_s * since_s) / (2 * np.pi) * model.cycle_s


def hand_leans(offsets: Sequence[StrokeOffset]) -> tuple[HandLean, ...]:
    """How each hand leans; one of too few strokes is left out."""
    leans = []
    for hand in HANDS:
        mine = [offset for offset in offsets if offset.limb is hand]
        if len(mine) >= LEAST_STROKES:
            late_ms = np.array([offset.late_ms for offset in mine])
            own = np.flatnonzero(_is_usual(late_ms))
            told = spread(late_ms[own], own)
            beats = float(np.mean([mine[row].late_beats for row in own.tolist()]))
            assert told.mean_ms is not None, "half of them are usual"
            assert told.sd_ms is not None, "half of them are usual"
            leans.append(HandLean(hand, told.mean_ms, told.sd_ms, told.ci_ms, beats, len(own)))
    return tuple(leans)


def _is_usual(late_ms: Array) -> NDArray[np.bool_]:
    """Which strokes (n,) belong to their places; the others, of a slip or of a phase that was wrong, lie far off."""
    off_ms = np.abs(late_ms - np.median(late_ms))
    return np.asarray(off_ms <= max(FAR_SD * SD_OF_MEDIAN * float(np.median(off_ms)), LEAST_REACH_MS))
