"""What a student's last sessions show of a lag on the devices that they play now."""

import json
from typing import Any

from station.core.errors import BadInput
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.practice.history.session_files import DOCUMENT_NAME
from station.practice.history.student_history import StudentHistory
from station.practice.lag.fair_judgement import FairResult, judged_fairly
from station.practice.lag.lag_document import runs_in
from station.practice.lag.session_lag import LagAnswer
from station.practice.session.session import SessionResult
from station.scoring.analysis.device_lag import LagRun

MOST_SESSIONS = 8
"""So many of the last sessions are looked into (our choice: a week's; equipment changes)."""


def fair_session(result: SessionResult, settings: Settings) -> FairResult:
    """The session judged fairly, by what this user has measured and what their last sessions show.

    A file of measurements that cannot be read has been said when the session began: nothing is left out then.
    """
    try:
        known = load_calibration()
    except BadInput:
        return FairResult(result)
    return judged_fairly(result, known, earlier_runs(result, settings))


def earlier_runs(result: SessionResult, settings: Settings) -> tuple[LagRun, ...]:
    """What the student's last sessions show of the devices of `result`, with as much taken out as here."""
    last = StudentHistory.of(settings).ask(
        lambda history, student: history.documents(student, DOCUMENT_NAME, MOST_SESSIONS)
    )
    return tuple(run for row, body in last or [] for run in _runs_in(row.name, body, _equipment(result)))


def _equipment(result: SessionResult) -> tuple[object, ...]:
    latency = result.latency
    into, out = latency.of_kit(result.device), latency.of_output(result.output)
    return result.device, result.output, into / NS_PER_MS, out / NS_PER_MS


def _runs_in(session: str, report: bytes, now: tuple[object, ...]) -> tuple[LagRun, ...]:
    """The runs of one session; none on other devices, and none of what is no report of ours."""
    try:
        document: Any = json.loads(report)
        facts = document["session"]
        there = tuple(facts[key] for key in ("device", "output", "input_latency_ms", "output_latency_ms"))
        lag = document["lag"]
        counts = lag is not None and there == now and lag["answer"] != LagAnswer.TAKEN_OUT.value
        return runs_in(lag, session) if counts else ()  # what was taken out is in what the devices are known by
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError):
        return ()  # from before reports had a lag
