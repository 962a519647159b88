"""Sessions as they are begun, kept and found: statements on one connection."""

import hashlib
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, Row, Select, bindparam, delete, insert, select, update

from station.store.rows import (
    FigureRow,
    JudgementRow,
    KeptSession,
    Part,
    SessionKind,
    SessionRow,
    SessionState,
    TimedFigure,
)
from station.store.students import student_id
from station.store.tables import CAPTURES, DOCUMENTS, FIGURES, JUDGEMENTS, SESSIONS, STUDENTS
from station.store.upserts import put, put_if_new

_KEYS = ("student_id", "name")
_OF_THE_ROW = [each.name for each in fields(SessionRow) if each.name not in ("student", "id")]
_OF_A_FIGURE = [FIGURES.c[each.name] for each in fields(FigureRow)]


def put_session(connection: Connection, kept: KeptSession) -> int:
    """Keep a session, in place of what was kept of it before; its id."""
    checksum = None if kept.capture is None else _put_capture(connection, kept.capture)
    values = _values(connection, kept.row) | {"capture_sha256": checksum}
    put(connection, SESSIONS, [values], _KEYS)
    same = (SESSIONS.c.student_id == values["student_id"]) & (SESSIONS.c.name == kept.row.name)
    number = int(connection.execute(select(SESSIONS.c.id).where(same)).scalar_one())
    for table in (FIGURES, JUDGEMENTS, DOCUMENTS):
        connection.execute(delete(table).where(table.c.session_id == number))
    rows: tuple[tuple[Any, list[dict[str, Any]]], ...] = (
        (FIGURES, [asdict(figure) for figure in kept.figures]),
        (JUDGEMENTS, [{"number": n, **judged._asdict()} for n, judged in enumerate(kept.judgements)]),
        (DOCUMENTS, [{"name": name, "body": zlib.compress(body)} for name, body in kept.documents.items()]),
    )
    for table, values_of in rows:
        if values_of:
            connection.execute(insert(table), [{"session_id": number, **each} for each in values_of])
    return number


def put_begun(connection: Connection, row: SessionRow) -> None:
    """Remember that a session was begun; one that is kept already stays."""
    put_if_new(connection, SESSIONS, [_values(connection, row)], _KEYS)


def drop_begun(connection: Connection, student: str, name: str) -> None:
    """Forget a session that was begun and in which nothing was played."""
    connection.execute(
        delete(SESSIONS).where(
            SESSIONS.c.student_id == student_id(connection, student),
            SESSIONS.c.name == name,
            SESSIONS.c.state == SessionState.BEGUN.value,
        )
    )


def _values(connection: Connection, row: SessionRow) -> dict[str, Any]:
    values = {name: getattr(row, name) for name in _OF_THE_ROW}
    return values | {
        "student_id": student_id(connection, row.student),
        "kind": row.kind.value,
        "state": row.state.value,
        "written": datetime.now(),
    }


def _put_capture(connection: Connection, data: bytes) -> str:
    checksum = hashlib.sha256(data).hexdigest()
    is_there = connection.execute(select(CAPTURES.c.sha256).where(CAPTURES.c.sha256 == checksum)).first()
    if is_there is None:
        values = {"sha256": checksum, "length": len(data), "body": zlib.compress(data)}
        put_if_new(connection, CAPTURES, [values], ["sha256"])
    return checksum


# --- finding ----------------------------------------------------------------------------------------------------------


def _all() -> Select[Any]:
    columns = (SESSIONS.c[name] for name in _OF_THE_ROW)
    return select(*columns, SESSIONS.c.id, STUDENTS.c.name.label("student")).join(
        STUDENTS, SESSIONS.c.student_id == STUDENTS.c.id
    )


def sessions_of(
    connection: Connection, key: str, state: SessionState, since: datetime | None, until: datetime | None
) -> list[SessionRow]:
    """A student's sessions in the order in which they began, from `since` until before `until`."""
    wanted = _all().where(STUDENTS.c.key == key, SESSIONS.c.state == state.value)
    wanted = wanted if since is None else wanted.where(SESSIONS.c.started >= since)
    wanted = wanted if until is None else wanted.where(SESSIONS.c.started < until)
    return [_row(each) for each in connection.execute(wanted.order_by(SESSIONS.c.started, SESSIONS.c.name))]


def latest_of(
    connection: Connection, key: str, most: int, kind: SessionKind, lesson: str | None, until: datetime | None
) -> list[SessionRow]:
    """The last sessions of a kind that a student has kept, the newest first; of one lesson, or of any (None)."""
    wanted = _all().where(
        STUDENTS.c.key == key, SESSIONS.c.state == SessionState.KEPT.value, SESSIONS.c.kind == kind.value
    )
    wanted = wanted if lesson is None else wanted.where(SESSIONS.c.lesson == lesson)
    wanted = wanted if until is None else wanted.where(SESSIONS.c.started < until)
    newest = wanted.order_by(SESSIONS.c.started.desc(), SESSIONS.c.name.desc()).limit(most)
    return [_row(each) for each in connection.execute(newest)]


def session_names(connection: Connection, key: str, state: SessionState) -> frozenset[str]:
    """What a student's sessions in that state are called."""
    wanted = select(SESSIONS.c.name).join(STUDENTS).where(STUDENTS.c.key == key, SESSIONS.c.state == state.value)
    return frozenset(connection.execute(wanted).scalars())


def session_by_id(connection: Connection, number: int) -> SessionRow | None:
    """The session with that id."""
    found = connection.execute(_all().where(SESSIONS.c.id == number)).first()
    return None if found is None else _row(found)


def session_in(connection: Connection, folder: str) -> SessionRow | None:
    """The session whose files lie in that folder, the newest where there are several."""
    wanted = _all().where(SESSIONS.c.folder == folder).order_by(SESSIONS.c.started.desc()).limit(1)
    found = connection.execute(wanted).first()
    return None if found is None else _row(found)


def session_folders(connection: Connection, key: str) -> dict[str, tuple[int, str]]:
    """Id and folder of a student's sessions, begun or kept, by their names."""
    wanted = select(SESSIONS.c.name, SESSIONS.c.id, SESSIONS.c.folder).join(STUDENTS).where(STUDENTS.c.key == key)
    return {name: (number, folder) for name, number, folder in connection.execute(wanted)}


def move_sessions(connection: Connection, folders: Mapping[int, str]) -> None:
    """Say where the files of sessions lie now, by their ids."""
    moved = update(SESSIONS).where(SESSIONS.c.id == bindparam("number")).values(folder=bindparam("there"))
    connection.execute(moved, [{"number": number, "there": folder} for number, folder in folders.items()])


def judgements_of(connection: Connection, number: int) -> list[JudgementRow]:
    """The judgements of a session, in order."""
    columns = [JUDGEMENTS.c[name] for name in JudgementRow._fields]
    wanted = select(*columns).where(JUDGEMENTS.c.session_id == number).order_by(JUDGEMENTS.c.number)
    return [JudgementRow(*each) for each in connection.execute(wanted)]


def document_in(connection: Connection, number: int, name: str) -> bytes | None:
    """A file of a session, None where it has none of that name."""
    wanted = select(DOCUMENTS.c.body).where(DOCUMENTS.c.session_id == number, DOCUMENTS.c.name == name)
    body = connection.execute(wanted).scalar()
    return None if body is None else zlib.decompress(body)


def document_names(connection: Connection, number: int) -> list[str]:
    """What the files of a session are called, by the alphabet."""
    return sorted(connection.execute(select(DOCUMENTS.c.name).where(DOCUMENTS.c.session_id == number)).scalars())


def documents_of(connection: Connection, key: str, name: str, most: int | None) -> list[tuple[SessionRow, bytes]]:
    """The files of that name of a student's sessions, the newest session first, `most` of them (None: all)."""
    wanted = _all().add_columns(DOCUMENTS.c.body).join(DOCUMENTS, DOCUMENTS.c.session_id == SESSIONS.c.id)
    wanted = wanted.where(STUDENTS.c.key == key, DOCUMENTS.c.name == name)
    wanted = wanted.order_by(SESSIONS.c.started.desc(), SESSIONS.c.name.desc()).limit(most)
    return [(_row(each), zlib.decompress(each.body)) for each in connection.execute(wanted)]


def every_document(connection: Connection, name: str, most: int) -> list[bytes]:
    """The newest files of that name of all students."""
    wanted = select(DOCUMENTS.c.body).join(SESSIONS).where(DOCUMENTS.c.name == name)
    newest = wanted.order_by(SESSIONS.c.started.desc(), SESSIONS.c.name.desc()).limit(most)
    return [zlib.decompress(body) for body in connection.execute(newest).scalars()]


def capture_by(connection: Connection, checksum: str) -> bytes | None:
    """The capture with that checksum."""
    body = connection.execute(select(CAPTURES.c.body).where(CAPTURES.c.sha256 == checksum)).scalar()
    return None if body is None else zlib.decompress(body)


def figures_of(connection: Connection, key: str, since: datetime | None) -> list[TimedFigure]:
    """The figures of a student's sessions from `since` on, in the order in which these began."""
    wanted = (
        select(*_OF_A_FIGURE, SESSIONS.c.started, FIGURES.c.session_id, SESSIONS.c.lesson)
        .join(SESSIONS, FIGURES.c.session_id == SESSIONS.c.id)
        .join(STUDENTS, SESSIONS.c.student_id == STUDENTS.c.id)
        .where(STUDENTS.c.key == key)
    )
    wanted = wanted if since is None else wanted.where(SESSIONS.c.started >= since)
    ordered = wanted.order_by(SESSIONS.c.started, SESSIONS.c.name, FIGURES.c.part, FIGURES.c.name)
    return [
        TimedFigure(started, number, lesson, _figure(of_figure))
        for *of_figure, started, number, lesson in connection.execute(ordered)
    ]


def session_figures(connection: Connection, number: int) -> list[FigureRow]:
    """The figures of a session, limbs before pieces."""
    wanted = select(*_OF_A_FIGURE).where(FIGURES.c.session_id == number).order_by(FIGURES.c.part, FIGURES.c.name)
    return [_figure(each) for each in connection.execute(wanted)]


def _figure(found: Sequence[Any]) -> FigureRow:
    part, *others = found
    return FigureRow(Part(part), *others)


def _row(found: Row[Any]) -> SessionRow:
    """The session of a row of `_all`; by place, for by name a thousand rows take three times as long."""
    values = dict(zip(_OF_THE_ROW, found, strict=False))
    values |= {"kind": SessionKind(values["kind"]), "state": SessionState(values["state"])}
    return SessionRow(student=found.student, id=found.id, **values)
