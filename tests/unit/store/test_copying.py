"""A history that is copied into another is found there, newer beside older, whole or not at all."""

from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import pytest
from sqlalchemy import Table, update

from station.core.errors import BadInput, DeviceError
from station.store.copying import Copied, copy_history
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.rows import (
    FigureRow,
    JudgementRow,
    KeptSession,
    MasteryRow,
    Part,
    SessionRow,
    SessionState,
    TeacherNoteRow,
)
from station.store.tables import LEVELS, MASTERY, SESSIONS

_FIGURE = FigureRow(Part.PIECE, "snare", 10, 8, 1, 1, 8, -3.5, 12.0)
_MATCH = JudgementRow("match", 1, 2, 1.5, 0, 0.5, 38, 0, 0.512, 38, "snare", "head", "normal", 64.25, None)
_NOTE = TeacherNoteRow("n1", "a1", "Week 1", "Carla", datetime(2026, 5, 5, 9), "Good.", "Slower", b"file")
_OLD, _NEW = datetime(2026, 5, 1), datetime(2026, 5, 2)


@pytest.fixture
def other(tmp_path: Path) -> Iterator[History]:
    """Another, empty history, in a file."""
    made = History(Database(sqlite_url(tmp_path / "other" / "history.sqlite3")))
    yield made
    made.database.close()


def _row(name: str = "one", student: str = "Ann", folder: str = "/here", **others: object) -> SessionRow:
    return SessionRow(student, name, datetime(2026, 5, 3, 18, 30, 0, 125), folder, **others)  # type: ignore[arg-type]


def _kept(name: str = "one", student: str = "Ann") -> KeptSession:
    row = _row(name, student, score=81.5)
    return KeptSession(row, (_FIGURE,), (_MATCH, _MATCH), {"report.json": name.encode()}, f"{student}'s".encode())


def _fill(history: History) -> None:
    history.keep(_kept(), [MasteryRow("rock-1", 0, 3, "{}")], {"rock-1": "beginner"})
    history.keep(_kept("two"))
    history.keep(_kept("one", "Ben"))
    history.keep_note("Ann", _NOTE)
    history.begin(_row("three", state=SessionState.BEGUN))


def _written(history: History, table: Table, at: datetime) -> None:
    with history.database.writing() as connection:
        connection.execute(update(table).values(written=at))


def _all_of(history: History, student: str) -> list[object]:
    """Everything that a history tells of a student, without the ids that are its own."""
    kept = history.sessions(student)
    return [
        [[getattr(row, name) for name in SessionRow.__slots__ if name != "id"] for row in kept],
        [(history.judgements(row.id), history.document(row.id, "report.json")) for row in kept],
        [history.capture(row.capture_sha256) for row in kept if row.capture_sha256],
        [(each.started, each.lesson, each.figure) for each in history.figures(student)],
        history.session_names(student, SessionState.BEGUN),
        history.mastery(student),
        history.levels(student),
        history.notes(student),
    ]


@pytest.mark.parametrize("there_first", [False, True])
def test_all_rows_arrive_in_either_direction(history: History, other: History, there_first: bool) -> None:
    source, target = (other, history) if there_first else (history, other)
    target.keep(_kept("older", "Zoe"))  # so that ids there are others
    _fill(source)
    copied = copy_history(source, target)
    assert (copied.students, copied.added, copied.replaced, copied.stayed) == (2, 4, 0, ())
    for student in ("Ann", "Ben"):
        assert _all_of(target, student) == _all_of(source, student)
    assert len(target.sessions("Ann")) == 2
    assert target.judgements(target.sessions("Ben")[0].id) == [_MATCH, _MATCH]
    assert len(target.sessions("Zoe")) == 1
    assert copy_history(source, target) == Copied(students=2, added=0, replaced=0)


def test_one_student_moves_and_the_others_stay(history: History, other: History) -> None:
    _fill(history)
    assert copy_history(history, other, "ANN").students == 1
    assert [each.name for each in other.students()] == ["Ann"]
    assert other.capture(history.sessions("Ben")[0].capture_sha256 or "") is None
    with pytest.raises(BadInput, match="knows no student Eve"):
        copy_history(history, other, "Eve")


def test_the_later_written_stays(history: History, other: History) -> None:
    for here, folder, score, at in ((history, "/school", 90.0, _NEW), (other, "/home", 70.0, _OLD)):
        row = _row(folder=folder, score=score)
        known = [MasteryRow("rock-1", 0, 3, f"{score}")]
        here.keep(KeptSession(row, (), (_MATCH,) * int(score), {"report.json": f"{score}".encode()}), known)
        here.remember("Ann", levels={"rock-1": f"{score}"})
        for table in (SESSIONS, MASTERY, LEVELS):
            _written(here, table, at)
    stayed = copy_history(other, history)
    assert stayed == Copied(students=1, added=0, replaced=0, stayed=("Ann: one",))
    assert history.sessions("Ann")[0].score == 90.0
    assert history.mastery("Ann") == [MasteryRow("rock-1", 0, 3, "90.0")]
    assert copy_history(history, other) == Copied(students=1, added=0, replaced=1)
    (found,) = other.sessions("Ann")
    assert (found.score, found.folder) == (90.0, "/home")
    assert len(other.judgements(found.id)) == 90
    assert other.document(found.id, "report.json") == b"90.0"
    assert other.mastery("Ann") == [MasteryRow("rock-1", 0, 3, "90.0")]
    assert other.levels("Ann") == {"rock-1": "90.0"}


def test_a_begun_session_gives_way_to_its_end_and_never_takes_its_place(history: History, other: History) -> None:
    other.begin(_row(state=SessionState.BEGUN))
    history.keep(_kept())
    _written(history, SESSIONS, _OLD)
    assert copy_history(other, history) == Copied(students=1, added=0, replaced=0)
    assert [row.score for row in history.sessions("Ann")] == [81.5]
    assert copy_history(history, other) == Copied(students=1, added=0, replaced=1)
    assert [row.score for row in other.sessions("Ann")] == [81.5]
    assert other.sessions("Ann", state=SessionState.BEGUN) == []


def test_two_sessions_of_one_name_are_told_apart(history: History, other: History) -> None:
    other.keep(KeptSession(SessionRow("Ann", "one", datetime(2026, 5, 4), "/home", score=1.0)))
    history.keep(_kept())
    assert copy_history(history, other).stayed == ("Ann: one",)
    assert [row.score for row in other.sessions("Ann")] == [1.0]


def test_a_copy_that_fails_leaves_nothing(history: History, other: History) -> None:
    _fill(history)
    _refuse_documents(other)
    with pytest.raises(DeviceError, match="no more room"):
        copy_history(history, other)
    assert other.students() == []
    assert other.session_names("Ann") == frozenset()


def _refuse_documents(history: History) -> None:
    with history.database.writing() as connection:
        refusal = "CREATE TRIGGER full BEFORE INSERT ON documents BEGIN SELECT RAISE(ABORT, 'no more room'); END"
        connection.exec_driver_sql(refusal)


def test_a_history_is_not_copied_into_itself(history: History, url: str) -> None:
    same = History(Database(url))
    with pytest.raises(BadInput, match="is the history itself"):
        copy_history(history, same)
    same.database.close()
