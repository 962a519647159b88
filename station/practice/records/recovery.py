"""Sessions that were cut off (the power went, the program was killed): their capture is there, and no report.

All that was played is in the capture, so that they can be judged as they would have been at their end.
"""

import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput, StationError
from station.core.pieces import Limb
from station.core.settings import Settings
from station.devices.capture.capture import Capture, RecordKind, read_capture
from station.drills.lesson import Lesson
from station.practice.history.session_files import CAPTURE_NAME
from station.practice.history.session_intake import is_over
from station.practice.history.student_history import StudentHistory
from station.practice.records.rejudge import judge_again
from station.practice.session.adaptation import whole
from station.practice.session.plan import Plan
from station.practice.session.session import SessionResult
from station.store.rows import SessionKind, SessionState

MOST_READ = 20
"""So many captures without a report are looked into, the newest; our choice, a fraction of a second of reading."""

LARGEST = 64 * 2**20
"""A larger capture is looked into only when it is named; our choice: hours of strokes are a few megabytes."""


def cut_off(whose: StudentHistory) -> list[Path]:
    """The folders of a student's sessions that were cut off after a stroke, the newest first, wherever they lie.

    One that runs in another program right now is among them.
    """
    rows = whose.ask(lambda history, student: history.sessions(student, state=SessionState.BEGUN)) or []
    captures = [Path(row.folder) / CAPTURE_NAME for row in reversed(rows) if row.kind is SessionKind.LESSON]
    without = [path for path in captures if path.is_file() and not is_over(path.parent)]
    return [path.parent for path in without[:MOST_READ] if _is_worth_it(path)]


def offer(settings: Settings) -> str | None:
    """The line that tells the student of sessions that were cut off; None where there are none."""
    folders = cut_off(StudentHistory.of(settings))
    if not folders:
        return None
    more = f" (and {len(folders) - 1} more)" if len(folders) > 1 else ""
    command = f"station practice --recover {shlex.quote(str(folders[0]))}"
    return f"a session was cut off before it was judged: {folders[0].name}{more}; {command} judges it"


def recovered(capture: Path, with_phase: bool = True) -> SessionResult:
    """The result of the session in a capture; all passes in a row where the tempo followed the student.

    Without `with_phase` nobody tracks the sticks, which takes some seconds.

    Raises `BadInput` where the capture cannot be read, or holds no session.
    """
    return recovered_of(read_capture(capture), capture, with_phase)


def recovered_of(capture: Capture, source: str | Path, with_phase: bool = True) -> SessionResult:
    """The same of a capture that was read; raises `BadInput` of `source`."""
    results = _results(capture, with_phase)
    if not results:
        raise BadInput(source, "", "there is no session in this capture")
    return _in_a_row(results)


def session_of(capture: Capture, lesson: Lesson) -> SessionResult | None:
    """The session of `lesson`, as it is now, that a capture holds; None where it holds none."""
    try:
        results = _results(capture, with_phase=False)
    except BadInput:  # strokes without a session, or cut off within its log: there is no click to judge by
        return None
    if not results or not all(_is_of(result.plan, lesson) for result in results):
        return None
    result = _in_a_row(results)
    return replace(result, plan=replace(result.plan, lesson=lesson))


def _results(capture: Capture, with_phase: bool) -> list[SessionResult]:
    return [session.result() for session in judge_again(capture, with_phase)]


def _in_a_row(results: list[SessionResult]) -> SessionResult:
    if len(results) == 1:
        return results[0]
    bars = [result.plan.bars for result in results]
    return whole(results, (min(first for first, _ in bars), max(last for _, last in bars)))


def _is_of(plan: Plan, lesson: Lesson) -> bool:
    """Whether the bars that were practised are bars of `lesson` as it is now; whoever's limbs play them."""
    first, last = plan.bars
    if plan.lesson.name != lesson.name or last >= lesson.score.bar_count:
        return False
    return _apart_from_limbs(plan.section.notes) == _apart_from_limbs(lesson.score.bars(first, last).notes)


def _apart_from_limbs(notes: NDArray[np.void]) -> bytes:
    notes = notes.copy()
    notes["limb"] = Limb.UNKNOWN
    return notes.tobytes()


def _is_worth_it(capture: Path) -> bool:
    """Whether a session was begun in it, and anything struck."""
    try:
        if capture.stat().st_size > LARGEST:
            return False
        kinds = {record.kind for record in read_capture(capture).records}
    except (StationError, OSError):
        return False
    return RecordKind.ANNOTATION in kinds and bool(kinds & {RecordKind.BYTES, RecordKind.STROKE})
