"""The sessions that a student practised of an assignment, put together as a return."""

from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from station.core.disk.files import read_regular
from station.core.errors import BadInput, StationError
from station.core.settings import Settings
from station.devices.capture.capture import parse_capture
from station.practice.exchange.note_file import overruled
from station.practice.exchange.parcel import Kind
from station.practice.exchange.parcel_json import MOST_JSON_BYTES
from station.practice.exchange.return_file import (
    MOST_CAPTURE_BYTES,
    MOST_PAIRS_BYTES,
    MOST_REPORTS_BYTES,
    MOST_SESSIONS,
    AssignmentWord,
    Return,
    ReturnedSession,
    size_of,
)
from station.practice.exchange.session_figures import SessionFigures, length_s, report_figures
from station.practice.exchange.student_store import TakenAssignment, session_key, verdicts_on
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME, PAIRS_NAME
from station.practice.history.student_history import StudentHistory

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

_ROOM = Kind.RETURN.value.most_bytes - (1 << 20)
"""For the sessions: what the table and the page in words take is left free (our choice)."""


@dataclass(frozen=True, slots=True)
class PractisedSession:
    """A session of the student's own in its `folder`: `name` is its lesson's in the assignment, `played` its begin."""

    folder: Path
    name: str
    played: datetime
    figures: SessionFigures


def practised(settings: Settings, one: TakenAssignment) -> list[PractisedSession]:
    """The student's sessions of an assignment since they took it, the newest first, as a note judges them.

    What cannot be read is left out.
    """
    return StudentHistory.of(settings).ask(lambda history, student: _practised(history, student, one)) or []


def _practised(history: "History", student: str, one: TakenAssignment) -> list[PractisedSession]:
    name_of = {here: name for name, here in one.taken.lessons}
    verdicts = verdicts_on(one)
    found: list[PractisedSession] = []
    for row in reversed(history.sessions(student, since=one.taken.when)):
        report = history.document(row.id, DOCUMENT_NAME) if row.lesson in name_of else None
        if report is None:
            continue
        try:
            figures = report_figures(report, f"{row.folder}/{DOCUMENT_NAME}", "")
        except BadInput:
            continue
        if one.assignment.id in figures.assignments and figures.lesson in name_of:
            name = name_of[figures.lesson]
            ruled = overruled(figures, verdicts.get(session_key(name, row.started)))
            found.append(PractisedSession(Path(row.folder), name, row.started, ruled))
    return found


@dataclass(frozen=True, slots=True)
class ReturnFacts:
    """What a return says beside its sessions: a new `id`, when it was `made` (aware), the student's own `words`."""

    id: str
    made: datetime
    words: str = ""
    most: int = MOST_SESSIONS


def return_of(settings: Settings, one: TakenAssignment, facts: ReturnFacts) -> Return:
    """The newest sessions of an assignment, as many as there is room for; raises `BadInput` where there are none."""
    ours = practised(settings, one)
    if not ours:
        raise BadInput(
            one.assignment.title, "", f"{settings.student} has practised none of its lessons since it was taken"
        )
    sessions: list[ReturnedSession] = []
    room, reports = _ROOM, MOST_REPORTS_BYTES
    for each in ours[: min(facts.most, MOST_SESSIONS)]:
        session = _packed(each, one)
        if session is not None and size_of(session) <= room and len(session.report) <= reports:
            sessions.append(session)
            room, reports = room - size_of(session), reports - len(session.report)
    if not sessions:
        raise BadInput(one.assignment.title, "", "no session of it has a capture that can be sent")
    word = AssignmentWord.of(one.assignment)
    left_out = len(ours) - len(sessions)
    return Return(facts.id, word, settings.student, facts.made, tuple(sessions[::-1]), facts.words, left_out)


def _packed(each: PractisedSession, one: TakenAssignment) -> ReturnedSession | None:
    """A session as it is sent; None where its files are not all there, or longer than may be sent."""
    lesson = one.assignment.lesson(each.name)
    assert lesson is not None, "its name was found there"
    try:
        capture = read_regular(each.folder / CAPTURE_NAME, MOST_CAPTURE_BYTES)
        report = read_regular(each.folder / DOCUMENT_NAME, MOST_JSON_BYTES)
        pairs = read_regular(each.folder / PAIRS_NAME, MOST_PAIRS_BYTES)
        seconds = length_s(parse_capture(capture))
    except StationError:
        return None
    figures = replace(each.figures, seconds=seconds)
    return ReturnedSession(each.name, each.played, figures, lesson.text, capture, report, pairs)
