"""What is kept is found again, on both databases."""

import hashlib
from datetime import datetime

from station.store.database import Database
from station.store.health import Health, health_of
from station.store.history import History
from station.store.rows import (
    FigureRow,
    JudgementRow,
    KeptSession,
    MasteryRow,
    Part,
    SessionKind,
    SessionRow,
    SessionState,
    StudentRow,
    TeacherNoteRow,
)
from station.store.schema_version import HEAD

_MATCH = JudgementRow("match", 1, 2, 1.5, 0, 0.5, 38, 0, 0.512, 38, "snare", "head", "normal", 64.25, None)
_MISS = JudgementRow("miss", 1, 2, 2.0, 1, 1.0, 36, None, None, None, None, None, None, None, None)
_FIGURE = FigureRow(Part.PIECE, "snare", 10, 8, 1, 1, 8, -3.5, 12.0)


def _session(name: str, day: int, **others: object) -> SessionRow:
    values = {"lesson": "rock-1", "title": "Rock", "score": 81.5, "mean_ms": -2.0, "sd_ms": 15.0, "strokes": 20}
    return SessionRow("Ann", name, datetime(2026, 5, day, 18, 30), f"/there/{name}", **(values | others))  # type: ignore[arg-type]


def test_a_kept_session_is_found_with_all_that_is_its_own(history: History) -> None:
    documents = {"report.json": b'{"score": 81.5}', "pairs.csv": "label\nü".encode()}
    kept = KeptSession(_session("one", 3), (_FIGURE,), (_MATCH, _MISS), documents, b"raw bytes")
    number = history.keep(kept, [MasteryRow("rock-1", 0, 3, "{}")], {"rock-1": "beginner"})
    found = history.sessions("Ann")
    assert [row.name for row in found] == ["one"]
    assert found[0] == history.session(number) == history.session_in("/there/one")
    assert found[0].score == 81.5
    assert found[0].started == datetime(2026, 5, 3, 18, 30)
    assert found[0].capture_sha256 == hashlib.sha256(b"raw bytes").hexdigest()
    assert history.capture(hashlib.sha256(b"raw bytes").hexdigest()) == b"raw bytes"
    assert history.judgements(number) == [_MATCH, _MISS]
    assert history.document(number, "pairs.csv") == "label\nü".encode()
    assert history.document(number, "exam.json") is None
    assert [(one.started.day, one.lesson, one.figure) for one in history.figures("Ann")] == [(3, "rock-1", _FIGURE)]
    assert history.mastery("Ann") == [MasteryRow("rock-1", 0, 3, "{}")]
    assert history.levels("Ann") == {"rock-1": "beginner"}


def test_what_is_kept_again_takes_the_place_of_what_was_there(history: History) -> None:
    first = history.keep(KeptSession(_session("one", 3), (_FIGURE,), (_MATCH, _MISS), {"report.json": b"old"}))
    again = history.keep(KeptSession(_session("one", 3, score=90.0), (), (_MATCH,), {"report.json": b"new"}))
    assert again == first
    assert [row.score for row in history.sessions("Ann")] == [90.0]
    assert history.judgements(first) == [_MATCH]
    assert history.document(first, "report.json") == b"new"
    assert history.figures("Ann") == []


def test_a_session_that_was_begun_waits_for_its_end(history: History) -> None:
    history.begin(_session("one", 3, state=SessionState.BEGUN))
    assert history.sessions("Ann") == []
    assert [row.name for row in history.sessions("Ann", state=SessionState.BEGUN)] == ["one"]
    history.keep(KeptSession(_session("one", 3)))
    history.begin(_session("one", 3, state=SessionState.BEGUN))
    assert history.session_names("Ann") == {"one"}
    assert history.sessions("Ann", state=SessionState.BEGUN) == []
    history.begin(_session("two", 4, state=SessionState.BEGUN))
    history.drop_begun("Ann", "two")
    history.drop_begun("Ann", "one")
    assert history.session_names("Ann", SessionState.BEGUN) == frozenset()
    assert history.session_names("Ann") == {"one"}


def test_sessions_of_some_days_and_the_latest(history: History) -> None:
    for day in (5, 3, 4):
        history.keep(KeptSession(_session(f"day-{day}", day, lesson=f"lesson-{day % 2}")))
    history.keep(KeptSession(_session("fight", 6, kind=SessionKind.BATTLE)))
    some = history.sessions("Ann", since=datetime(2026, 5, 4), until=datetime(2026, 5, 6))
    assert [row.name for row in some] == ["day-4", "day-5"]
    assert [row.name for row in history.latest("Ann", 2)] == ["day-5", "day-4"]
    assert [row.name for row in history.latest("Ann", 5, lesson="lesson-1")] == ["day-5", "day-3"]
    assert [row.name for row in history.latest("Ann", 5, SessionKind.BATTLE)] == ["fight"]
    assert [row.name for row in history.latest("Ann", 5, until=datetime(2026, 5, 5, 18, 30))] == ["day-4", "day-3"]


def test_what_is_remembered_already_outlives_what_is_remembered_anew(history: History) -> None:
    history.remember("Ann", [MasteryRow("rock-1", 0, 3, "known")], {"rock-1": "studio"})
    new = [MasteryRow("rock-1", 0, 3, "other"), MasteryRow("rock-1", 0, 1, "new"), MasteryRow("rock-2", 0, 3, "new")]
    history.remember_new("ann", new, {"rock-1": "beginner", "rock-2": "beginner"})
    assert [(row.lesson, row.last_bar, row.document) for row in history.mastery("Ann")] == [
        ("rock-1", 1, "new"),
        ("rock-1", 3, "known"),
        ("rock-2", 3, "new"),
    ]
    assert history.levels("Ann") == {"rock-1": "studio", "rock-2": "beginner"}


def test_one_student_by_any_spelling_and_none_by_another(history: History) -> None:
    history.keep(KeptSession(_session("one", 3)), [MasteryRow("rock-1", 0, 3, "{}")])
    history.remember("Ben", levels={"rock-1": "advanced"})
    assert len(history.sessions("ANN")) == 1
    assert history.sessions("Ben") == []
    assert history.students() == [StudentRow("Ann", datetime(2026, 5, 3, 18, 30)), StudentRow("Ben", None)]


def test_a_student_is_deleted_with_all_that_is_theirs_and_nothing_of_others(history: History) -> None:
    shared, own = b"shared", b"own"
    ann = history.keep(KeptSession(_session("one", 3), (_FIGURE,), (_MATCH,), {"report.json": b"x"}, shared))
    history.keep(KeptSession(_session("two", 4), capture=own), [MasteryRow("rock-1", 0, 3, "{}")], {"a": "beginner"})
    note = TeacherNoteRow("n1", "a1", "Week 1", "Carla", datetime(2026, 5, 5, 9), "Good.", "Slower", b"file")
    history.keep_note("Ann", note)
    assert history.notes("Ann") == [note]
    ben = SessionRow("Ben", "one", datetime(2026, 5, 3), "/ben")
    history.keep(KeptSession(ben, capture=shared))
    assert history.delete_student("ann")
    assert history.sessions("Ann") == []
    assert history.notes("Ann") == []
    assert history.mastery("Ann") == []
    assert history.levels("Ann") == {}
    assert history.judgements(ann) == []
    assert history.document(ann, "report.json") is None
    assert history.capture(hashlib.sha256(own).hexdigest()) is None
    assert history.capture(hashlib.sha256(shared).hexdigest()) == shared
    assert [row.name for row in history.students()] == ["Ben"]
    assert not history.delete_student("ann")


def test_what_is_deleted_leaves_nothing_in_the_file(history: History) -> None:
    history.keep(KeptSession(_session("one", 3, title="Ann's groove"), documents={"report.json": b"{}"}))
    history.keep(KeptSession(SessionRow("Ben", "one", datetime(2026, 5, 3), "/ben", title="Ben's groove")))
    history.delete_student("Ann")
    assert history.scrub() is None
    assert [row.name for row in history.students()] == ["Ben"]
    if history.database.path is not None:  # a server's files are its own
        left = b"".join(path.read_bytes() for path in history.database.path.parent.iterdir())
        assert b"Ann" not in left
        assert b"Ben's groove" in left


def test_health_is_looked_at_and_changes_nothing(url: str) -> None:
    assert health_of(url) == Health(Database(url).name)
    made = History(Database(url))
    number = made.keep(KeptSession(_session("one", 3)))
    healthy = health_of(url)
    assert (healthy.version, healthy.fault) == (HEAD, None)
    assert (healthy.size or 0) > 10_000
    assert made.session(number) is not None
    with made.database.writing() as connection:
        if made.database.path is None:  # a server that serves readers alone
            name = connection.exec_driver_sql("SELECT current_database()").scalar_one()
            connection.exec_driver_sql(f'ALTER DATABASE "{name}" SET default_transaction_read_only = on')
        else:
            connection.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'")
    made.database.close()
    assert ("read-only" if made.database.path is None else "newer station") in str(health_of(url).fault)


def test_sessions_say_where_their_files_lie_now(history: History) -> None:
    first, second = (history.keep(KeptSession(_session(name, 3))) for name in ("one", "two"))
    history.begin(_session("three", 4))
    known = history.session_folders("Ann")
    assert {name: number for name, (number, _) in known.items() if name != "three"} == {"one": first, "two": second}
    assert known["three"][1] == _session("three", 4).folder
    history.move({first: "/disk/one", known["three"][0]: "/disk/three"})
    assert [folder for _, folder in (history.session_folders("Ann")[name] for name in ("one", "two", "three"))] == [
        "/disk/one",
        _session("two", 3).folder,
        "/disk/three",
    ]
