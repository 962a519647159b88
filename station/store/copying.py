"""Copies one history into another, on either kind of database: a backup, a student who moves to a school and back.

What the other history does not have is added. Where both have something, the one that was written later stays; nothing
is deleted there. A session that was only begun gives way to the same one when it is kept. Two sessions of one name that
began at different times are two sessions: the one that is there stays, and the caller is told.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from itertools import islice
from typing import Any, TypeVar

from sqlalchemy import Connection, Row, Table, delete, insert, select, update

from station.core.errors import BadInput
from station.store.history import History
from station.store.rows import SessionState
from station.store.student_names import student_key
from station.store.students import student_id
from station.store.tables import (
    CAPTURES,
    DOCUMENTS,
    FIGURES,
    JUDGEMENTS,
    LEVELS,
    MASTERY,
    SESSIONS,
    STUDENTS,
    TEACHER_NOTES,
)
from station.store.upserts import put, put_if_new

_AT_ONCE = 50
"""Sessions or captures whose rows are in memory at once (our choice: some megabytes)."""
_NOT_CONTENT = ("id", "student_id", "folder", "written")
"""Columns of a session that may differ though the session does not."""
_MEMORY = ((MASTERY, ("student_id", "lesson", "first_bar", "last_bar")), (LEVELS, ("student_id", "lesson")))

_Item = TypeVar("_Item", int, str)


@dataclass(frozen=True, slots=True)
class Copied:
    """What came of a copy: so many `students`, so many sessions `added` and `replaced` by what was written later.

    They are `renumbered` where they have other numbers there than here. `stayed` names the sessions (student: name)
    that differ and stay as they are in the history that was copied into.
    """

    students: int
    added: int
    replaced: int
    stayed: tuple[str, ...] = ()
    renumbered: bool = False


def copy_history(source: History, target: History, student: str | None = None) -> Copied:
    """Copy all that `source` holds, or what is one student's, into `target`, whole or not at all.

    Sessions keep their numbers in a file that holds none yet; elsewhere they get those of that history. All is copied
    as it was at one moment, whatever others write meanwhile. Raises `BadInput` where both are the same database or the
    student is not known, `DeviceError` where one of them fails.
    """
    if _same(source, target):
        raise BadInput(target.name, "", "is the history itself: it can be copied into another only")
    with source.database.reading() as old, target.database.writing() as new:
        students = _students(source, old, new, student)
        _captures(old, new, list(students))
        copied, numbers = _sessions(old, new, students, keeps=_is_empty_file(target, new))
        for some in _batches(numbers):
            for table in (FIGURES, JUDGEMENTS, DOCUMENTS):
                _parts(old, new, table, {number: numbers[number] for number in some})
        for table, keys in _MEMORY:
            _memory(old, new, table, keys, students)
        notes = _moved(old, TEACHER_NOTES, "student_id", students)
        put_if_new(new, TEACHER_NOTES, notes, ("student_id", "note"))
    return copied


def _same(source: History, target: History) -> bool:
    one, other = source.database, target.database
    if one.path is not None and other.path is not None:
        return one.path.samefile(other.path)
    return one.url == other.url


def _is_empty_file(target: History, new: Connection) -> bool:
    """Whether numbers are free there; a server counts on by itself and would give them out again."""
    return target.database.path is not None and new.execute(select(SESSIONS.c.id).limit(1)).first() is None


def _students(source: History, old: Connection, new: Connection, student: str | None) -> dict[int, int]:
    """The ids of students there by their ids here; they are known there from now on."""
    wanted = select(STUDENTS).order_by(STUDENTS.c.key)
    wanted = wanted if student is None else wanted.where(STUDENTS.c.key == student_key(student))
    found = {each.id: student_id(new, each.name) for each in old.execute(wanted).all()}
    if student is not None and not found:
        raise BadInput(source.name, "", f"knows no student {student}")
    return found


def _captures(old: Connection, new: Connection, students: Sequence[int]) -> None:
    named = SESSIONS.c.capture_sha256
    of_them = select(named).where(SESSIONS.c.student_id.in_(students), named.is_not(None)).distinct()
    there = set(new.execute(select(CAPTURES.c.sha256)).scalars())
    for some in _batches(sorted(set(old.execute(of_them).scalars()) - there)):
        rows = old.execute(select(CAPTURES).where(CAPTURES.c.sha256.in_(some)))
        put_if_new(new, CAPTURES, [dict(row) for row in rows.mappings()], ["sha256"])


# --- sessions ---------------------------------------------------------------------------------------------------------


def _sessions(
    old: Connection, new: Connection, students: Mapping[int, int], *, keeps: bool
) -> tuple[Copied, dict[int, int]]:
    """What became of the sessions; the ids of those that were added or replaced, there by here; it `keeps` them."""
    keys = SESSIONS.c.student_id, SESSIONS.c.name
    mine = old.execute(select(SESSIONS).where(SESSIONS.c.student_id.in_(students)).order_by(*keys)).all()
    theirs = select(SESSIONS).where(SESSIONS.c.student_id.in_(students.values()))
    there = {(each.student_id, each.name): each for each in new.execute(theirs)}
    added, replaced, stayed = [], {}, []
    for row in mine:
        other = there.get((students[row.student_id], row.name))
        if other is None:
            added.append(row)
        elif _gives_way(other, row):
            replaced[row.id] = other.id
            _replace(new, other.id, row)
        elif _differs(other, row):
            stayed.append(row)
    values = [{**_values(row), "student_id": students[row.student_id], "folder": row.folder} for row in added]
    if keeps:
        values = [{**each, "id": row.id} for each, row in zip(values, added, strict=True)]
    if values:
        new.execute(insert(SESSIONS), values)
    ids = {(each.student_id, each.name): each.id for each in new.execute(theirs)}
    numbers = replaced | {row.id: ids[students[row.student_id], row.name] for row in added}
    names = {each.id: each.name for each in old.execute(select(STUDENTS))}
    told = tuple(f"{names[row.student_id]}: {row.name}" for row in stayed)
    is_renumbered = any(here != there for here, there in numbers.items())
    return Copied(len(students), len(added), len(replaced), told, is_renumbered), numbers


def _gives_way(there: Row[Any], row: Row[Any]) -> bool:
    """Whether the session that is there is replaced by `row`."""
    if row.state == SessionState.BEGUN.value or there.started != row.started:
        return False
    return bool(there.state == SessionState.BEGUN.value) or _is_later(row.written, there.written)


def _differs(there: Row[Any], row: Row[Any]) -> bool:
    if row.state == SessionState.BEGUN.value and there.started == row.started:
        return False
    content = [name for name in SESSIONS.c.keys() if name not in _NOT_CONTENT]  # noqa: SIM118 - no dictionary
    return any(getattr(there, name) != getattr(row, name) for name in content)


def _replace(new: Connection, number: int, row: Row[Any]) -> None:
    """Give a session other values; its parts go. Its files lie where they lay."""
    new.execute(update(SESSIONS).where(SESSIONS.c.id == number).values(_values(row)))
    for table in (FIGURES, JUDGEMENTS, DOCUMENTS):
        new.execute(delete(table).where(table.c.session_id == number))


def _values(row: Row[Any]) -> dict[str, Any]:
    return {name: value for name, value in row._mapping.items() if name not in ("id", "student_id", "folder")}


def _parts(old: Connection, new: Connection, table: Table, numbers: Mapping[int, int]) -> None:
    rows = _moved(old, table, "session_id", numbers)
    if rows:
        new.execute(insert(table), rows)


# --- the rest ---------------------------------------------------------------------------------------------------------


def _memory(old: Connection, new: Connection, table: Table, keys: tuple[str, ...], students: Mapping[int, int]) -> None:
    """Copy what is remembered where it was written later than what is remembered there."""
    columns = [table.c[name] for name in (*keys, "written")]
    theirs = new.execute(select(*columns).where(table.c.student_id.in_(students.values())))
    there = {tuple(each[:-1]): each.written for each in theirs}
    rows = []
    for row in _moved(old, table, "student_id", students):
        key = tuple(row[name] for name in keys)
        if key not in there or _is_later(row["written"], there[key]):
            rows.append(row)
    put(new, table, rows, keys)


def _moved(old: Connection, table: Table, name: str, ids: Mapping[int, int]) -> list[dict[str, Any]]:
    """The rows of a table that go with `ids`, with the ids that they have there."""
    rows = old.execute(select(table).where(table.c[name].in_(ids))).mappings()
    return [{**row, name: ids[row[name]]} for row in rows]


def _is_later(one: datetime | None, other: datetime | None) -> bool:
    """Whether `one` was written later; what has no time was written first."""
    return one is not None and (other is None or one > other)


def _batches(those: Iterable[_Item]) -> Iterator[list[_Item]]:
    left = iter(those)
    while some := list(islice(left, _AT_ONCE)):
        yield some
