"""Whether what a history holds of the sessions of `history_children` is whole."""

import hashlib

from station.store.history import History
from station.store.rows import SessionRow
from tests.fakes.history_children import memory_of, session_of


def faults_in(history: History, student: str) -> list[str]:
    """What is not whole of a student's sessions and of what was learnt in them; empty where all is."""
    rows = history.sessions(student)
    mastery = {row.lesson: row for row in history.mastery(student)}
    levels = history.levels(student)
    numbers = {int(row.name.removeprefix("session-")) for row in rows}
    faults = [fault for row in rows for fault in _faults(history, row)]
    for number in numbers:
        learnt = memory_of(number)
        if mastery.get(learnt.lesson) != learnt or levels.get(learnt.lesson) != "beginner":
            faults.append(f"{student}: what was learnt in session {number} is not there")
    more = set(mastery) - {memory_of(number).lesson for number in numbers}
    return [*faults, *(f"{student}: {lesson} was learnt in no session" for lesson in sorted(more))]


def _faults(history: History, row: SessionRow) -> list[str]:
    number = int(row.name.removeprefix("session-"))
    should = session_of(row.student, number)
    figures = {each.figure.name: each.figure for each in history.figures(row.student) if each.session_id == row.id}
    checks = {
        "row": (row.score, row.started, row.notes) == (should.row.score, should.row.started, should.row.notes),
        "figures": figures == {figure.name: figure for figure in should.figures},
        "judgements": tuple(history.judgements(row.id)) == should.judgements,
        "documents": all(history.document(row.id, name) == body for name, body in should.documents.items()),
        "checksum": row.capture_sha256 == hashlib.sha256(should.capture or b"").hexdigest(),
        "capture": history.capture(row.capture_sha256 or "") == should.capture,
    }
    return [f"{row.student}: {row.name}: {name}" for name, holds in checks.items() if not holds]
