"""A result judged again once the student has said whose its lag is; its folder's report is written anew."""

from dataclasses import replace
from pathlib import Path

from station.app.sessions.shown_result import SavedSession, shown_result
from station.core.errors import DeviceError, StationError
from station.core.settings import Settings
from station.practice.history.student_history import StudentHistory
from station.practice.lag.fair_judgement import FairResult, as_it_came
from station.practice.lag.session_lag import LagAnswer
from station.practice.records.report.next_steps import steps_in
from station.practice.records.report.session_report import practice_document
from station.practice.records.report.what_next import table_in
from station.practice.records.save_session import SessionFolder
from station.practice.session.device_latency import Latency

_KEPT = ("mastery",)
"""Keys of a report that its passes wrote, and that no lag changes."""


_TAKEN_OUT = ("input_latency_ms", "output_latency_ms", "latency")
"""Keys of its session that say what was taken out."""


def judged_again(saved: SavedSession, settings: Settings, latency: Latency | None) -> SavedSession:
    """The session with the lag out for good, where `latency` is what is known now; None: with the lag left in.

    What the disk refuses is its `fault`.
    """
    assert saved.fair is not None, "a lag was found"
    fair = as_it_came(saved.fair)
    if latency is not None and saved.fair.lag is not None:
        lag = replace(saved.fair.lag, answer=LagAnswer.TAKEN_OUT)
        fair = FairResult(replace(saved.fair.result, latency=latency), lag)
    document, steps = practice_document(fair.result, settings, fair.lag), saved.steps
    if latency is None:
        steps = steps_in(document)
    else:  # the score was this one all the while
        now, before = table_in(document, "session"), saved.report.document["session"]
        document["session"] = {**before, **{key: now[key] for key in _TAKEN_OUT}}  # type: ignore[dict-item]
    document |= {key: saved.report.document[key] for key in _KEPT if key in saved.report.document}  # type: ignore[misc]
    fault: StationError | None = None
    try:
        folder = SessionFolder(Path(saved.report.folder), StudentHistory.of(settings), is_new=False)
        folder.write(fair.result, document)
        unkept = folder.keep()
        fault = None if unkept is None else DeviceError(unkept)
    except StationError as refused:
        fault = refused
    shown = shown_result(fair.result, document, saved.report.folder, saved.report.before)
    return SavedSession(fair.result, shown, fault, saved.marks, fair, steps)
