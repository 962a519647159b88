"""What a student's last sessions show of a lag on the devices that they play now."""

from pathlib import Path
from typing import Any

from station.core.disk.file_names import folder_name
from station.core.errors import BadInput, StationError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME
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
    try:
        folder = settings.sessions_dir / folder_name(settings.student)
        sessions = sorted((path for path in folder.iterdir() if path.is_dir()), reverse=True)[:MOST_SESSIONS]
    except (OSError, StationError):
        return ()
    return tuple(run for path in sessions for run in _runs_in(path, _equipment(result)))


def _equipment(result: SessionResult) -> tuple[object, ...]:
    latency = result.latency
    into, out = latency.of_kit(result.device), latency.of_output(result.output)
    return result.device, result.output, into / NS_PER_MS, out / NS_PER_MS


def _runs_in(session: Path, now: tuple[object, ...]) -> tuple[LagRun, ...]:
    """The runs of one session; none on other devices, and none of a folder that holds no report of ours."""
    try:
        document: Any = kept_document(session / DOCUMENT_NAME)
        facts = document["session"]
        there = tuple(facts[key] for key in ("device", "output", "input_latency_ms", "output_latency_ms"))
        lag = document["lag"]
        counts = lag is not None and there == now and lag["answer"] != LagAnswer.TAKEN_OUT.value
        return runs_in(lag, session.name) if counts else ()  # what was taken out is in what the devices are known by
    except (BadInput, KeyError, TypeError, ValueError, AttributeError):
        return ()  # a session that was cut off, or from before reports had a lag
