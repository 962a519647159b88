"""When a virtual student strikes each stroke of a score: `student_timing`, habits, grace strokes and sway together.

A stroke's asynchrony = bias + the limb's lean + timekeeper + motor noise + habits + sway of the tempo. A grace stroke
keeps its lead before its main stroke, with a spread of its own. Strokes of one piece never overtake each other: which
is which would be nobody's truth. Times are score time; shifts are in ms, **negative is early**.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.judgement import Label
from station.music.score import Score
from station.simulation.student_faults import PlantedHabits
from station.simulation.student_form import Form
from station.simulation.student_reading import StudentReading
from station.simulation.student_slips import Slips
from station.simulation.student_timing import MOTOR_SHARE, Timekeeper, leans, sway_s

Floats = NDArray[np.float64]

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

    timekeeper: np.random.Generator
    motor: np.random.Generator
    grace: np.random.Generator
    extra: np.random.Generator
    pattern: np.random.Generator


@dataclass(frozen=True, eq=False)
class OnsetTiming:
    """One playing's timing without habits and sway: `shift_ms` (n,) a row, `shared_ms` and `sd_ms` (k,) a slot."""

    shift_ms: Floats
    shared_ms: Floats
    sd_ms: Floats


class OnsetPlayer:
    """The timing of one student; it goes on from one score to the next."""

    def __init__(self, drift_pct: float, streams: Streams) -> None:
        self._sway = drift_pct / 100.0
        self._streams = streams
        self._timekeeper = Timekeeper(streams.timekeeper)
        self._reach = streams.pattern.uniform(-1.0, 1.0, _LIMBS)
        self._since_slot_ns = 0
        self._elapsed_ns = 0

    def time(self, reading: StudentReading, form: Form) -> OnsetTiming:
        """Draw the timing of `reading` played in this `form`."""
        timekeeper, lead_motor = self._timekeeper.run(self._waits_s(reading))
        mains = reading.mains
        motor = _MOTOR_SD * self._streams.motor.standard_normal(len(reading))
        slot_of_lead, first = np.unique(reading.slot[mains], return_index=True)
        motor[mains[first]] = lead_motor[slot_of_lead]
        lean = np.zeros(len(reading))
        lean[mains] = leans(reading.limbs[mains], self._reach)
        rest = float(np.sqrt(1.0 - np.mean(lean[mains] ** 2))) if len(mains) else 1.0
        shift = form.bias_ms + form.sd_ms * (lean + rest * (timekeeper[reading.slot] + motor))
        first_row = np.unique(reading.slot, return_index=True)[1]
        sd_ms = form.sd_ms[first_row]
        return OnsetTiming(shift[reading.main], form.bias_ms[first_row] + sd_ms * rest * timekeeper, sd_ms)

    def onsets_ns(
        self, reading: StudentReading, timing: OnsetTiming, habits: PlantedHabits, slips: Slips
    ) -> NDArray[np.int64]:
        """When each row is struck, missed or not, shape (n,)."""
        score = reading.score
        shift_ms = timing.shift_ms + habits.shift_ms[reading.main] - self._leads_ms(reading, timing, habits)
        shift_ms += score.notes["late_ms"].astype(np.float64)
        at_ns = self._written_ns(score, score.notes["tick"]) + shift_ms * NS_PER_MS
        onsets = np.rint(at_ns).astype(np.int64)
        for piece in np.unique(slips.piece):
            rows = np.flatnonzero((slips.piece == piece) & (slips.label == Label.MATCH))
            rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
            onsets[rows] = np.sort(onsets[rows])
        return onsets

    def extra_onsets_ns(
        self, reading: StudentReading, timing: OnsetTiming, ticks: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """When strokes that nobody wrote fall, at `ticks` (e,) with what the slot before them shares."""
        slot = np.maximum(np.searchsorted(reading.slot_ticks, ticks, side="right") - 1, 0)
        own_ms = timing.sd_ms[slot] * _MOTOR_SD * self._streams.extra.standard_normal(len(ticks))
        at_ns = self._written_ns(reading.score, ticks) + (timing.shared_ms[slot] + own_ms) * NS_PER_MS
        return np.rint(at_ns).astype(np.int64)

    def finish(self, reading: StudentReading) -> None:
        """`reading` has been played: what comes next is later."""
        self._elapsed_ns += reading.score.length_ns

    def _waits_s(self, reading: StudentReading) -> Floats:
        """Time from slot to slot, the first since the last slot of the score before."""
        slot_ns = reading.score.tempo_map.ns_at(reading.slot_ticks)
        waits: Floats = np.diff(slot_ns, prepend=-self._since_slot_ns) / NS_PER_S
        last_ns = int(slot_ns[-1]) if len(slot_ns) else -self._since_slot_ns
        self._since_slot_ns = reading.score.length_ns - last_ns
        return waits

    def _written_ns(self, score: Score, ticks: NDArray[np.int64]) -> Floats:
        """Written times on this student's swaying tempo."""
        click_ns = score.tempo_map.ns_at(ticks)
        swayed: Floats = click_ns + sway_s((click_ns + self._elapsed_ns) / NS_PER_S, self._sway) * NS_PER_S
        return swayed

    def _leads_ms(self, reading: StudentReading, timing: OnsetTiming, habits: PlantedHabits) -> Floats:
        """How far each row comes before its main stroke: 0 but for grace strokes."""
        written_ms = reading.score.notes["lead_ms"].astype(np.float64)
        spread_ms = np.minimum(GRACE_SPREAD * timing.sd_ms[reading.slot], GRACE_SPREAD_LIMIT * written_ms)
        lead_ms = written_ms + habits.lead_ms + spread_ms * self._streams.grace.standard_normal(len(reading))
        lead_ms = np.maximum(lead_ms, np.minimum(written_ms, SMALLEST_LEAD_MS))
        return np.where(reading.score.is_grace, lead_ms, 0.0)
