"""The same deeds leave the same on SQLite and on PostgreSQL, whatever texts, numbers and moments are kept."""

import math
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, Phase, example, given, settings
from hypothesis import strategies as st

from station.core.errors import StationError
from station.store.database import Database
from station.store.database_url import sqlite_url
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
    TeacherNoteRow,
)
from tests.fakes.postgres_server import PostgresServer

Deed = Callable[[History], object]

_NAMES = st.sampled_from(["Ann", "ANN", "ann", "Zoë", "zoe", "Ben", "b", "B", "鼓手", "a b", "a-b"])
_TEXTS = st.one_of(
    st.sampled_from(["", "rock-1", "Rock-1", "ärger", "z", "Z", "_", "a\0b", "half \ud83d", "\U0001f941", "x" * 30]),
    st.text(max_size=8),
)
_WHOLE = st.integers(-3, 2**31 + 1)
_REALS = st.one_of(st.none(), st.floats(allow_nan=True), st.sampled_from([0.1, -0.0, 1e-300, 81.5]))
_MOMENTS = st.datetimes(datetime(1999, 12, 31), datetime(2030, 1, 1))


_FIGURES: st.SearchStrategy[FigureRow] = st.builds(
    FigureRow, st.sampled_from(Part), _TEXTS, _WHOLE, _WHOLE, _WHOLE, _WHOLE, _WHOLE, _REALS, _REALS
)
_OPTIONAL = [st.none() | _WHOLE, _REALS, st.none() | _WHOLE]
_JUDGEMENTS = st.builds(
    JudgementRow,
    _TEXTS,
    _WHOLE,
    _WHOLE,
    st.floats(0, 8),
    *_OPTIONAL,
    *_OPTIONAL,
    *[st.none() | _TEXTS] * 3,
    _REALS,
    _REALS,
)
_ROWS = st.builds(
    SessionRow,
    _NAMES,
    _TEXTS,
    _MOMENTS,
    _TEXTS,
    kind=st.sampled_from(SessionKind),
    state=st.just(SessionState.KEPT),
    lesson=_TEXTS,
    title=_TEXTS,
    played_s=st.floats(0, 1e6),
    complete=st.booleans(),
    score=_REALS,
    level=_TEXTS,
    notes=_WHOLE,
    mean_ms=_REALS,
)
_MASTERY = st.builds(MasteryRow, _TEXTS, st.integers(0, 3), st.integers(0, 3), _TEXTS)
_NOTES = st.builds(TeacherNoteRow, _TEXTS, _TEXTS, _TEXTS, _TEXTS, _MOMENTS, _TEXTS, _TEXTS, st.binary(max_size=9))
_KEPT = st.builds(
    KeptSession,
    _ROWS,
    st.lists(_FIGURES, max_size=3, unique_by=lambda figure: (figure.part, figure.name)).map(tuple),
    st.lists(_JUDGEMENTS, max_size=3).map(tuple),
    st.dictionaries(st.sampled_from(["report.json", "exam.json", "Ä.txt"]), st.binary(max_size=20), max_size=2),
    st.none() | st.binary(max_size=20),
)
_DEEDS: st.SearchStrategy[Deed] = st.one_of(
    st.builds(
        lambda kept, known, level: lambda history: history.keep(kept, known, {level: "beginner"}),
        _KEPT,
        st.lists(_MASTERY, max_size=3),
        _TEXTS,
    ),
    st.builds(lambda row: lambda history: history.begin(row), _ROWS),
    st.builds(lambda who, what: lambda history: history.drop_begun(who, what), _NAMES, _TEXTS),
    st.builds(lambda who, note: lambda history: history.keep_note(who, note), _NAMES, _NOTES),
    st.builds(lambda who: lambda history: history.delete_student(who), _NAMES),
)


def _kept_at_one_moment(name: str, score: float | None = None) -> Deed:
    row = SessionRow("Ann", name, datetime(2026, 5, 3), "/here", score=score)
    return lambda history: history.keep(KeptSession(row, documents={name: b""}), [MasteryRow(name, 0, 3, "{}")])


def _done(history: History, deed: Deed) -> bool:
    """Whether the history took it: both take the same and refuse the same."""
    try:
        deed(history)
    except StationError:
        return False
    return True


def _plain(value: Any) -> Any:  # noqa: ANN401 - any row
    """A value without the ids that a database gives."""
    if isinstance(value, SessionRow):
        return [getattr(value, name) for name in SessionRow.__slots__ if name != "id"]
    return value


def _told(history: History) -> list[Any]:
    """All that a history tells, in the order in which it tells it."""
    told: list[Any] = [history.students()]
    for who in [each.name for each in history.students()]:
        rows = history.sessions(who)
        told += [[_plain(row) for row in rows], [_plain(row) for row in history.latest(who, 3)]]
        told += [history.sessions(who, state=SessionState.BEGUN) and "begun", history.session_names(who)]
        told += [[(each.started, each.lesson, each.figure) for each in history.figures(who)]]
        told += [[history.judgements(row.id), history.document_names(row.id)] for row in rows]
        told += [[history.capture(row.capture_sha256) for row in rows if row.capture_sha256]]
        told += [[(_plain(row), body) for row, body in history.documents(who, "report.json")]]
        told += [history.mastery(who), history.levels(who), history.notes(who)]
    return [*told, history.every_document("report.json", 5)]


def _emptied(history: History) -> None:
    for each in history.students():
        history.delete_student(each.name)


def test_both_databases_tell_the_same_of_the_same_deeds(postgres: PostgresServer, tmp_path: Path) -> None:
    file = History(Database(sqlite_url(tmp_path / "history.sqlite3")))
    german = ("-T", "template0", "-E", "UTF8", "--locale-provider=icu", "--icu-locale=de")  # it sorts a, B, z
    server = History(Database(postgres.new_database(*german)))

    @settings(max_examples=15, phases=[Phase.explicit, Phase.generate], suppress_health_check=list(HealthCheck))
    @example([_kept_at_one_moment(name) for name in "aBz_Zä鼓"])
    @example([_kept_at_one_moment(f"{score}", score=score) for score in (math.nan, math.inf, -math.inf)])
    @given(st.lists(_DEEDS, min_size=1, max_size=6))
    def agree(deeds: list[Deed]) -> None:
        for history in (file, server):
            _emptied(history)
        for deed in deeds:
            assert _done(file, deed) == _done(server, deed)
        assert _told(file) == _told(server)

    agree()
    server.database.close()
