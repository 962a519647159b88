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
from station.sync.drill.drill_model import HANDS, DrillModel

Array = NDArray[np.float64]

NEAR_S = 0.03
"""A stroke farther than this from any phase was not tracked: three steps of the tracker (our choice)."""
LEAST_STROKES = 4
"""Of fewer strokes nothing is said (our choice)."""


@dataclass(frozen=True, slots=True)
class StrokeOffset:
    """A stroke of `limb`: how long after its phase's place it came, and which part of a beat that is at their tempo."""

    at_ns: int
    limb: Limb
    late_ms: float
    late_beats: float


@dataclass(frozen=True, slots=True)
class HandLean:
    """How a hand leans over `strokes` strokes: the median and the SD."""

    limb: Limb
    late_ms: float
    sd_ms: float
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
        estimate = locked[int(np.argmin(np.abs(at_ns - stroke.at_ns)))]
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
            late_ms = [offset.late_ms for offset in mine]
            beats = float(np.median([offset.late_beats for offset in mine]))
            leans.append(HandLean(hand, float(np.median(late_ms)), float(np.std(late_ms, ddof=1)), beats, len(mine)))
    return tuple(leans)
