"""What was practised on which day: read from the reports that sessions and free takes leave in their folders.

A day may hold hundreds of sessions, and a student years of days: only the folders of the days that are asked for are
looked into, and of each report a few keys.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from datetime import date, datetime
from pathlib import Path
from typing import Any

from station.core.errors import BadInput
from station.practice.history.exam_words import exam_result
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME, EXAM_NAME, TAKE_NAME, student_folder

MOST_BYTES = 30_000_000
"""A report of an hour has a few (our choice): more is nobody's report."""
_STARTED, _STARTED_LETTERS = "%Y-%m-%dT%H-%M-%S", 19
_MOST_S = 86_400.0


@dataclass(frozen=True, slots=True)
class PractisedSession:
    """A session: when it began, of which `lesson` (empty: a free take), how long was played, and how it went.

    `score` 0–100, None where nothing was judged; `complete` whether it was played to its end; `exam` what it came to as
    an exam, in a few words, empty where it was none.
    """

    started: datetime
    lesson: str
    title: str
    played_s: float
    complete: bool
    score: float | None = None
    beats_a_minute: float | None = None
    exam: str = ""


def practised_on(sessions: Path, student: str, days: Iterable[date]) -> list[PractisedSession]:
    """All sessions of those days, in the order in which they began; folders that are none are left out."""
    top = student_folder(sessions, student)
    found = (_session(path) for day in set(days) for path in top.glob(f"{day.isoformat()}T*"))
    return sorted((one for one in found if one is not None), key=lambda one: one.started)


def days_practised(sessions: Path, student: str) -> list[date]:
    """The days on which anything was, in order."""
    top = student_folder(sessions, student)
    started = (_started(path.name) for path in top.glob("????-??-??T*"))
    return sorted({one.date() for one in started if one is not None})


def _session(folder: Path) -> PractisedSession | None:
    started = _started(folder.name)
    if started is None:
        return None
    try:
        if (folder / DOCUMENT_NAME).exists():
            return replace(_lesson(started, _document(folder / DOCUMENT_NAME)), exam=_exam(folder))
        if (folder / TAKE_NAME).exists():
            take = _document(folder / TAKE_NAME)
            return PractisedSession(started, "", "Just play", _seconds(take["length_s"]), complete=True)
    except (ValueError, KeyError, TypeError, BadInput):
        return None  # a session that was cut off, or somebody else's folder
    return None


def _exam(folder: Path) -> str:
    try:
        return exam_result(_document(folder / EXAM_NAME))
    except (BadInput, TypeError):
        return ""


def _lesson(started: datetime, document: dict[str, Any]) -> PractisedSession:
    session, score = document["session"], document["score"]
    return PractisedSession(
        started,
        lesson=str(session["lesson"]),
        title=str(session["title"]),
        played_s=_seconds(session.get("played_s", 0.0)),  # old reports tell none
        complete=bool(session["complete"]),
        score=float(score) if isinstance(score, float | int) else None,
        beats_a_minute=float(session["beats_a_minute"]),
    )


def _document(path: Path) -> dict[str, Any]:
    document = kept_document(path, MOST_BYTES)
    if not isinstance(document, dict):
        raise TypeError
    return document


def _seconds(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= _MOST_S:
        raise ValueError
    return float(value)


def _started(name: str) -> datetime | None:
    try:
        return datetime.strptime(name[:_STARTED_LETTERS], _STARTED)
    except ValueError:
        return None
