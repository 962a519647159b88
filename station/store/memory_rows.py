"""What is remembered of a student beside their sessions: mastery, levels, teachers' notes; on one connection."""

import zlib
from collections.abc import Iterable, Mapping
from datetime import datetime

from sqlalchemy import Connection, select

from station.store.rows import MasteryRow, TeacherNoteRow
from station.store.student_names import student_key
from station.store.students import student_id
from station.store.tables import LEVELS, MASTERY, STUDENTS, TEACHER_NOTES
from station.store.upserts import put, put_if_new

_NOTE_FIELDS = ("note", "assignment", "title", "teacher", "made", "words", "next")


def put_mastery(connection: Connection, student: str, row: MasteryRow) -> None:
    """Remember it in place of what was known of these bars."""
    keys = {
        "student_id": student_id(connection, student),
        "lesson": row.lesson,
        "first_bar": row.first_bar,
        "last_bar": row.last_bar,
    }
    put(connection, MASTERY, [keys | {"document": row.document, "written": _now()}], list(keys))


def mastery_of(connection: Connection, key: str, lesson: str | None = None) -> list[MasteryRow]:
    """What is known of a student's lessons, or of one lesson, by name and bars."""
    columns = MASTERY.c.lesson, MASTERY.c.first_bar, MASTERY.c.last_bar, MASTERY.c.document
    wanted = select(*columns).join(STUDENTS).where(STUDENTS.c.key == key)
    wanted = wanted if lesson is None else wanted.where(MASTERY.c.lesson == lesson)
    return [MasteryRow(*each) for each in connection.execute(wanted.order_by(*columns[:3]))]


def put_level(connection: Connection, student: str, lesson: str, level: str) -> None:
    """Judge a lesson at that level from now on."""
    keys = {"student_id": student_id(connection, student), "lesson": lesson}
    put(connection, LEVELS, [keys | {"level": level, "written": _now()}], list(keys))


def levels_of(connection: Connection, key: str) -> Mapping[str, str]:
    """The level of each lesson of a student by its name."""
    wanted = select(LEVELS.c.lesson, LEVELS.c.level).join(STUDENTS).where(STUDENTS.c.key == key)
    return {each.lesson: each.level for each in connection.execute(wanted)}


def put_new(connection: Connection, student: str, mastery: Iterable[MasteryRow], levels: Mapping[str, str]) -> None:
    """Remember what is known of bars and lessons of which nothing is."""
    key = student_key(student)
    known = {(row.lesson, row.first_bar, row.last_bar) for row in mastery_of(connection, key)}
    judged = levels_of(connection, key)
    for row in mastery:
        if (row.lesson, row.first_bar, row.last_bar) not in known:
            put_mastery(connection, student, row)
    for lesson, level in levels.items():
        if lesson not in judged:
            put_level(connection, student, lesson, level)


def put_note(connection: Connection, student: str, row: TeacherNoteRow) -> None:
    """Keep a teacher's note; one that is there stays."""
    values = {name: getattr(row, name) for name in _NOTE_FIELDS}
    values |= {"student_id": student_id(connection, student), "day": row.made.date(), "body": zlib.compress(row.body)}
    put_if_new(connection, TEACHER_NOTES, [values], ["student_id", "note"])


def notes_of(connection: Connection, key: str) -> list[TeacherNoteRow]:
    """The notes of a student's teachers, in the order in which they were written."""
    columns = [TEACHER_NOTES.c[name] for name in (*_NOTE_FIELDS, "body")]
    wanted = (
        select(*columns)
        .join(STUDENTS)
        .where(STUDENTS.c.key == key)
        .order_by(TEACHER_NOTES.c.made, TEACHER_NOTES.c.note)
    )
    rows = connection.execute(wanted).mappings()
    return [TeacherNoteRow(**{**each, "body": zlib.decompress(each["body"])}) for each in rows]


def _now() -> datetime:
    return datetime.now()
