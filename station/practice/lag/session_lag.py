"""The lag of a session: what was found, which device it would be taken out of, and what the student has said of it."""

from dataclasses import dataclass
from enum import Enum

from station.core.measured_latency import GROOVE, TAP, StoredCalibration
from station.engine.engine import KEYBOARD
from station.practice.session.session import SessionResult
from station.scoring.analysis.device_lag import LagRun, SharedLag


class LagAnswer(Enum):
    """What became of a lag: nothing, for there is none to be taken out; nobody has said; taken out; left as it is."""

    NONE = "none"
    OPEN = "open"
    TAKEN_OUT = "taken_out"
    LEFT = "left"


@dataclass(frozen=True, slots=True)
class LagTarget:
    """The device in which a lag is kept: an `output`, or a `kit`, by its name."""

    what: str
    name: str


@dataclass(frozen=True, slots=True)
class SessionLag:
    """What was `found` over this session's `runs` and earlier ones, and the `answer`.

    `own_ms` is the mean of this session alone: what is left out of its judgement until somebody has answered. `target`
    is None where all devices are measured, or the student has left them as they are.
    """

    found: SharedLag
    runs: tuple[LagRun, ...]
    own_ms: float = 0.0
    target: LagTarget | None = None
    answer: LagAnswer = LagAnswer.NONE

    @property
    def out_ms(self) -> float:
        """What the judgement leaves out of the strokes as they were captured."""
        return self.own_ms if self.answer in (LagAnswer.OPEN, LagAnswer.TAKEN_OUT) else 0.0


def lag_target(result: SessionResult, known: StoredCalibration) -> LagTarget | None:
    """Which device of `result` a lag that all strokes share would be kept in.

    The output first: what a driver hides may be 100 ms and more, what a kit needs is seldom a tenth of that
    (docs/calibration.md). One that was tapped, or found like this, is in part the kit's and found anew.
    """
    output, kit = result.output, result.device
    if known.left & {output, kit}:
        return None
    measured = known.outputs.get(output or "")
    if output is not None and (measured is None or measured.by in (TAP, GROOVE)):
        return LagTarget("output", output)
    if kit is not None and kit != KEYBOARD and kit not in known.kits:
        return LagTarget("kit", kit)
    return None
