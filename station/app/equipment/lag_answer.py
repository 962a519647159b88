"""What a lag that was found while playing changes in what is known of the devices: taken out, or left to the student.

A result like those of the four ways to measure, `groove`: it is stored as they are, and has the student's habit in it
as taps have.
"""

import json
from dataclasses import replace
from datetime import date
from typing import Any

from station.app.equipment.calibration_results import CalibrationResult, CalibrationResults, with_rows
from station.core.errors import DeviceError
from station.core.measured_latency import GROOVE, StoredCalibration
from station.core.settings import Settings
from station.engine.latency_measurement import Devices
from station.practice.history.session_files import DOCUMENT_NAME
from station.practice.history.student_history import StudentHistory
from station.practice.lag.session_lag import LagAnswer, LagTarget, SessionLag
from station.practice.session.device_latency import Latency
from station.scoring.analysis.device_lag import LagCause, SharedLag
from station.sound.calibration.latency_estimate import LatencyEstimate

_HABIT = "found while playing: your habit is in it, 40 ms early to 10 late as people stand beside a click"
_THIN = "it was not told from a habit: play at two tempi"
_NOTHING = "no lag is open: the last session found none, or it was answered"


def lag_row(lag: SessionLag, known: Latency) -> CalibrationResult:
    """What would be stored of an open `lag`, on top of what is `known` of its device already."""
    assert lag.target is not None, "only what is nobody's own is offered"
    before_ns = known.of_output(lag.target.name) if lag.target.what == "output" else known.of_kit(lag.target.name)
    return _row(lag.target, lag.found, sum(run.whole.moments for run in lag.runs), before_ns / 1e6)


def _row(target: LagTarget, found: SharedLag, moments: int, before_ms: float) -> CalibrationResult:
    half_ms = (found.high_ms - found.low_ms) / 2
    estimate = LatencyEstimate(found.lag_ms, found.low_ms, found.high_ms, half_ms, moments).less(-before_ms)
    estimate = estimate.remarked(_HABIT) if found.cause is LagCause.EQUIPMENT else estimate.doubted(_THIN, _HABIT)
    what = "equipment" if target.what == "output" else "kit"
    return CalibrationResult(what, target.name, estimate)


def with_lag_out(known: StoredCalibration, lag: SessionLag, latency: Latency, on: date) -> StoredCalibration:
    """What is known of the devices once `lag`, found with `latency` taken out, is stored `on` a day."""
    return with_rows(known, [lag_row(lag, latency)], GROOVE, on)


def with_lag_left(known: StoredCalibration, target: LagTarget) -> StoredCalibration:
    """The same once the student wants lags on the device to count as theirs."""
    return replace(known, left=known.left | {target.name})


# --- the terminal ----------------------------------------------------------------------------------------------------


def last_lag(settings: Settings) -> tuple[CalibrationResults, LagTarget]:
    """The lag that the student's last session left open, as a measurement; raises `DeviceError` where it left none."""
    last = StudentHistory.of(settings).ask(lambda history, student: history.documents(student, DOCUMENT_NAME, 1))
    try:
        document: Any = json.loads(last[0][1]) if last else None
        session, lag = document["session"], document["lag"]
        if lag["answer"] != LagAnswer.OPEN.value:
            raise DeviceError(_NOTHING)
        target = LagTarget(str(lag["of"]), str(lag["device"]))
        before_ms = float(session["output_latency_ms" if target.what == "output" else "input_latency_ms"])
        low_ms, high_ms = (float(each) for each in lag["ci"])
        found = SharedLag(LagCause(lag["cause"]), float(lag["found_ms"]), low_ms, high_ms)
        moments = sum(int(run["moments"]) for run in lag["runs"])
    except (KeyError, TypeError, ValueError, RecursionError):
        raise DeviceError(_NOTHING) from None
    devices = Devices(session["device"], session["output"])
    return CalibrationResults(devices, (_row(target, found, moments, before_ms),)), target
