"""What the graph panel shows: a drummer over the score, where the play line is, and what the student played.

Times are seconds from the score's tick 0; asynchronies played − written in ms, negative is early; NaN where there is
nothing to show.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.engine.engine import KEYBOARD
from station.motion.drummer import Drummer
from station.music.score import Score
from station.practice.session.session import SessionResult
from station.render.snapshot import ON_TIME_MS, PENDING, BarNumbers

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StudentStrokes:
    """The student's strokes, one a judged note (n,): `asynchrony_ms` NaN where it was missed, `velocity` 1–127.

    `label` of `Label`; so far from its note a stroke is on time as `on_time_ms` says.
    """

    time_s: Array
    label: NDArray[np.uint8]
    asynchrony_ms: Array
    velocity: Array
    written: Array
    on_time_ms: float = ON_TIME_MS


@dataclass(frozen=True, eq=False)
class ScoreCurves:
    """`position_s` is the play line, None where nothing is played; `played` None where nobody has played."""

    drummer: Drummer
    position_s: float | None
    bar_numbers: BarNumbers
    played: StudentStrokes | None = None

    @property
    def score(self) -> Score:
        """The music under the curves."""
        return self.drummer.score


def played_of_marks(score: Score, marks: NDArray[np.void], on_time_ms: float) -> StudentStrokes:
    """What the student has been shown of the strokes so far; `marks` (n,) of `MARK_DTYPE`."""
    judged = marks["label"] != PENDING
    written = score.notes["velocity"][judged].astype(np.float64)
    asynchrony_ms = marks["asynchrony_ms"][judged].astype(np.float64)
    label = marks["label"][judged].astype(np.uint8)
    return StudentStrokes(
        score.onset_s[judged], label, asynchrony_ms, written + marks["velocity_error"][judged], written, on_time_ms
    )


def played_of_result(result: SessionResult) -> StudentStrokes:
    """Every note of a session that is over."""
    hit = result.alignment.hit_of_note
    paired = hit >= 0
    asynchrony_ms, velocity = np.full((2, len(hit)), np.nan)
    asynchrony_ms[paired] = result.alignment.asynchrony_ns[paired] / NS_PER_MS
    if result.device != KEYBOARD:  # keys cannot tell how hard they are struck
        velocity[paired] = result.performance.fine_velocity[hit[paired]]
    written = result.score.notes["velocity"].astype(np.float64)
    on_time_ms = result.plan.level.windows.on_time_ms
    label = result.alignment.note_label
    return StudentStrokes(result.score.onset_s, label, asynchrony_ms, velocity, written, on_time_ms)
