"""When a virtual student strikes each stroke of a score: `student_timing`, habits, grace strokes and sway together.

A stroke's asynchrony = bias + the limb's lean + timekeeper + motor noise + habits + sway of the tempo. A grace stroke
keeps its lead before its main stroke, with a spread of its own. Strokes of one piece never overtake each other: which
is which would be nobody's truth. Times are score time; shifts are in ms, **negative is early**.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S, ms_from_ns
from station.music.judgement import Label
from station.music.passages import slots
from station.music.score import Score
from station.practice.student_faults import Habits
from station.practice.student_slips import Slips, main_of_rows
from station.practice.student_spec import StudentSpec
from station.practice.student_timing import MOTOR_SHARE, Timekeeper, leans, sway_s

Floats = NDArray[np.float64]

SMALLEST_SD_MS = 5.0
"""Motor noise alone keeps a named player from less (HUMANS: σ_M 4–8 ms)."""
LARGEST_SD_MS = 60.0
"""Long intervals are counted out, so that a named player's SD stops growing; our choice."""
GRACE_SPREAD = 0.3
"""A lead spreads by this share of the student's SD (our choice: one drop of both hands, not the timekeeper's), …"""
GRACE_SPREAD_LIMIT = 0.2
"""… by no more than this share of itself, …"""
SMALLEST_LEAD_MS = 6.0
"""… and is at least the mask time of a pad (PEERS, edrumulus), within which two strokes are one hit."""
_MOTOR_SD = float(np.sqrt(MOTOR_SHARE))
_LIMBS = 4


@dataclass(frozen=True, slots=True)
class Streams:
    """Where the timing draws its chances from."""

    keeper: np.random.Generator
    motor: np.random.Generator
    grace: np.random.Generator
    extra: np.random.Generator
    pattern: np.random.Generator


@dataclass(frozen=True, eq=False)
class Timing:
    """One playing's timing without habits and sway: `shift_ms` (n,) of each row, `shared_ms` (k,) of each slot."""

    sd_ms: float
    shift_ms: Floats
    shared_ms: Floats


class OnsetPlayer:
    """The timing of one student; it goes on from one score to the next."""

    def __init__(self, spec: StudentSpec, streams: Streams) -> None:
        self._spec = spec
        self._streams = streams
        self._timekeeper = Timekeeper(streams.keeper)
        self._reach = streams.pattern.uniform(-1.0, 1.0, _LIMBS)
        self._since_slot_ns = 0
        self._elapsed_ns = 0

    def time(self, score: Score, limbs: NDArray[np.int8]) -> Timing:
        """Draw the timing of `score` played by `limbs` (n,)."""
        ticks, slot_of_row = slots(score)
        keeper, lead_motor = self._timekeeper.run(self._waits_s(score, ticks))
        mains = np.flatnonzero(~score.is_grace)
        motor = _MOTOR_SD * self._streams.motor.standard_normal(len(score))
        slot_of_lead, first = np.unique(slot_of_row[mains], return_index=True)
        motor[mains[first]] = lead_motor[slot_of_lead]
        lean = np.zeros(len(score))
        lean[mains] = leans(limbs[mains], self._reach)
        sd_ms = sd_in(score, self._spec)
        process_ms = sd_ms * float(np.sqrt(1.0 - np.mean(lean[mains] ** 2))) if len(mains) else sd_ms
        shift = self._spec.bias_ms + sd_ms * lean + process_ms * (keeper[slot_of_row] + motor)
        return Timing(sd_ms, shift[main_of_rows(score)], self._spec.bias_ms + process_ms * keeper)

    def onsets_ns(self, score: Score, timing: Timing, habits: Habits, slips: Slips) -> NDArray[np.int64]:
        """When each row is struck, missed or not, shape (n,)."""
        shift_ms = timing.shift_ms + habits.shift_ms[main_of_rows(score)] - self._leads_ms(score, timing, habits)
        at_ns = self._written_ns(score, score.notes["tick"]) + shift_ms * NS_PER_MS
        onsets = np.rint(at_ns).astype(np.int64)
        for piece in np.unique(slips.piece):
            rows = np.flatnonzero((slips.piece == piece) & (slips.label == Label.MATCH))
            rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
            onsets[rows] = np.sort(onsets[rows])
        return onsets

    def extra_onsets_ns(self, score: Score, timing: Timing, ticks: NDArray[np.int64]) -> NDArray[np.int64]:
        """When strokes that nobody wrote fall, at `ticks` (e,) with what the slot before them shares."""
        slot = np.maximum(np.searchsorted(slots(score)[0], ticks, side="right") - 1, 0)
        own_ms = timing.sd_ms * _MOTOR_SD * self._streams.extra.standard_normal(len(ticks))
        at_ns = self._written_ns(score, ticks) + (timing.shared_ms[slot] + own_ms) * NS_PER_MS
        return np.rint(at_ns).astype(np.int64)

    def finish(self, score: Score) -> None:
        """`score` has been played: what comes next is later."""
        self._elapsed_ns += score.length_ns

    def _waits_s(self, score: Score, ticks: NDArray[np.int64]) -> Floats:
        """Time from slot to slot, the first since the last slot of the score before."""
        slot_ns = score.tempo_map.ns_at(ticks)
        waits: Floats = np.diff(slot_ns, prepend=-self._since_slot_ns) / NS_PER_S
        last_ns = int(slot_ns[-1]) if len(slot_ns) else -self._since_slot_ns
        self._since_slot_ns = score.length_ns - last_ns
        return waits

    def _written_ns(self, score: Score, ticks: NDArray[np.int64]) -> Floats:
        """Written times on this student's swaying tempo."""
        click_ns = score.tempo_map.ns_at(ticks)
        at_s = (click_ns + self._elapsed_ns) / NS_PER_S
        swayed: Floats = click_ns + sway_s(at_s, self._spec.drift_pct / 100.0) * NS_PER_S
        return swayed

    def _leads_ms(self, score: Score, timing: Timing, habits: Habits) -> Floats:
        """How far each row comes before its main stroke: 0 but for grace strokes."""
        written_ms = score.notes["lead_ms"].astype(np.float64)
        spread_ms = np.minimum(GRACE_SPREAD * timing.sd_ms, GRACE_SPREAD_LIMIT * written_ms)
        lead_ms = written_ms + habits.lead_ms + spread_ms * self._streams.grace.standard_normal(len(score))
        return np.where(score.is_grace, np.maximum(lead_ms, np.minimum(written_ms, SMALLEST_LEAD_MS)), 0.0)


def sd_in(score: Score, spec: StudentSpec) -> float:
    """The SD of the asynchronies in ms: as said, or the said share of the median wait between the slots of `score`."""
    if spec.sd_ms is not None:
        return spec.sd_ms
    slot_ns = score.tempo_map.ns_at(slots(score)[0])
    usual_ms = ms_from_ns(int(np.median(np.diff(slot_ns)))) if len(slot_ns) > 1 else 0.0
    return min(max(spec.sd_interval_pct / 100.0 * usual_ms, SMALLEST_SD_MS), LARGEST_SD_MS)
