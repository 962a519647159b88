"""A session judged so that a lag of equipment that nobody measured does not count as the student's.

Until the student has answered, what a session's own strokes have in common is left out, wherever it may be the
equipment's. What is a habit, by tempo or by pad, is judged as it was played.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from station.core.measured_latency import StoredCalibration
from station.core.units import ns_from_ms
from station.practice.lag.session_lag import LagAnswer, SessionLag, lag_target
from station.practice.session.session import SessionResult
from station.scoring.align import align
from station.scoring.analysis.device_lag import LagRun, lag_runs, shared_lag
from station.scoring.matching.alignment import Reference
from station.scoring.matching.likely_lag import likely_lag_ms

NOW = "now"
"""The take that this session's runs are of."""
_SAME_MS = 1.0
"""More than a report rounds (our choice)."""


@dataclass(frozen=True, eq=False)
class FairResult:
    """A `result` as it is judged, and its `lag`: None where no click says what was due, or too little was played."""

    result: SessionResult
    lag: SessionLag | None = None

    @property
    def is_open(self) -> bool:
        """Whether a lag is left out, and nobody has said whose it is."""
        return self.lag is not None and self.lag.answer is LagAnswer.OPEN


def judged_fairly(result: SessionResult, known: StoredCalibration, earlier: Iterable[LagRun] = ()) -> FairResult:
    """The session as it came, or with a lag left out that may be the equipment's.

    `known` is what was measured of the devices, `earlier` what other sessions on the same devices showed.
    """
    if result.alignment.reference is not Reference.CLICK or not len(result.performance):
        return FairResult(result)
    likely_ms = likely_lag_ms(result.score, result.performance)
    runs = lag_runs(result.score, _later(result, -likely_ms).alignment, likely_ms, NOW)
    if not runs:
        return FairResult(result)
    own, target = shared_lag(runs), lag_target(result, known)
    found = shared_lag((*runs, *earlier))
    lag = SessionLag(found, runs, own.lag_ms, target)
    if target is None or not found.may_be_taken_out or not own.may_be_taken_out:
        return FairResult(result, lag)
    return FairResult(_later(result, -own.lag_ms), replace(lag, answer=LagAnswer.OPEN))


def judged_as_told(result: SessionResult, left_out_ms: float) -> FairResult:
    """A session of somebody else's, whose report says that so much was left out: it is where the strokes show it."""
    fair = judged_fairly(result, StoredCalibration())
    shows = fair.lag is not None and fair.is_open and abs(fair.lag.own_ms - left_out_ms) <= _SAME_MS
    return fair if shows else FairResult(result)


def as_it_came(fair: FairResult) -> FairResult:
    """The same with nothing left out: the student wants the lag to count."""
    if fair.lag is None:
        return fair
    return FairResult(_later(fair.result, fair.lag.out_ms), replace(fair.lag, answer=LagAnswer.LEFT))


def _later(result: SessionResult, by_ms: float) -> SessionResult:
    """The session as if every stroke had come so much later."""
    if not by_ms:
        return result
    performance = result.performance.shifted(ns_from_ms(by_ms))
    return replace(result, performance=performance, alignment=align(result.score, performance, clocked=True))
