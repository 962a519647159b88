"""The tables of the history, the same on SQLite and on PostgreSQL.

Times are naive, by the wall clock of the station that wrote them; `_ms` and `_s` are what they say, early is negative;
NULL is no data. `migrations` makes an older database like this one.
"""

from sqlalchemy import (
    Boolean,
    Column,
    Date,
    DateTime,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
)

METADATA = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "pk": "pk_%(table_name)s",
    }
)


def _of(table: str, *, is_key: bool = False, nullable: bool = False) -> Column[int]:
    """A column for the id of a row of `table`, with which this one goes."""
    name = f"{table.removesuffix('s')}_id"
    key = ForeignKey(f"{table}.id", ondelete="CASCADE")
    return Column(name, Integer, key, primary_key=is_key, nullable=nullable, autoincrement=False)


STUDENTS = Table(
    "students",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("key", String, nullable=False, unique=True),  # what two spellings of a name share
    Column("name", String, nullable=False),
)

CAPTURES = Table(
    "captures",
    METADATA,
    Column("sha256", String(64), primary_key=True),
    Column("length", Integer, nullable=False),  # bytes as they were captured
    Column("body", LargeBinary, nullable=False),  # compressed by zlib
)

SESSIONS = Table(
    "sessions",
    METADATA,
    Column("id", Integer, primary_key=True),
    _of("students"),
    Column("name", String, nullable=False),  # its folder's
    Column("kind", String(20), nullable=False),
    Column("state", String(20), nullable=False),
    Column("started", DateTime, nullable=False),
    Column("folder", Text, nullable=False),
    Column("lesson", String, nullable=False),
    Column("title", Text, nullable=False),
    Column("device", Text, nullable=False),
    Column("played_s", Float, nullable=False),
    Column("complete", Boolean, nullable=False),
    Column("score", Float),
    Column("level", String(20), nullable=False),
    Column("beats_a_minute", Float),
    Column("notes", Integer, nullable=False),
    Column("right", Integer, nullable=False),
    Column("strokes", Integer, nullable=False),  # that mean and SD rest on
    Column("mean_ms", Float),
    Column("sd_ms", Float),
    Column("exam", Text, nullable=False),
    Column("capture_sha256", String(64), ForeignKey("captures.sha256")),
    UniqueConstraint("student_id", "name"),
    Index("ix_sessions_student_started", "student_id", "started"),
)

DOCUMENTS = Table(
    "documents",
    METADATA,
    _of("sessions", is_key=True),
    Column("name", String, primary_key=True),  # the file's: report.json, exam.json …
    Column("body", LargeBinary, nullable=False),  # the file's bytes, compressed by zlib
)

FIGURES = Table(
    "figures",
    METADATA,
    _of("sessions", is_key=True),
    Column("part", String(20), primary_key=True),  # limb or piece
    Column("name", String(40), primary_key=True),
    Column("notes", Integer, nullable=False),
    Column("matched", Integer, nullable=False),
    Column("misses", Integer, nullable=False),
    Column("wrong_piece", Integer, nullable=False),
    Column("strokes", Integer, nullable=False),
    Column("mean_ms", Float),
    Column("sd_ms", Float),
)

JUDGEMENTS = Table(
    "judgements",
    METADATA,
    _of("sessions", is_key=True),
    Column("number", Integer, primary_key=True, autoincrement=False),  # its line in pairs.csv, from 0
    Column("label", String(20), nullable=False),
    Column("pass_number", Integer, nullable=False),  # as the bar and the beat from 1
    Column("bar", Integer, nullable=False),
    Column("beat", Float, nullable=False),
    Column("note_index", Integer),
    Column("note_time_s", Float),
    Column("note_midi", Integer),
    Column("hit_index", Integer),
    Column("hit_time_s", Float),
    Column("hit_midi", Integer),
    Column("hit_piece", String(20)),
    Column("hit_zone", String(20)),
    Column("hit_articulation", String(20)),
    Column("hit_velocity", Float),
    Column("hit_openness", Float),
)

MASTERY = Table(
    "mastery",
    METADATA,
    _of("students", is_key=True),
    Column("lesson", String, primary_key=True),
    Column("first_bar", Integer, primary_key=True, autoincrement=False),  # from 0
    Column("last_bar", Integer, primary_key=True, autoincrement=False),
    Column("document", Text, nullable=False),  # drum-station/mastery/1
)

LEVELS = Table(
    "levels",
    METADATA,
    _of("students", is_key=True),
    Column("lesson", String, primary_key=True),
    Column("level", String(20), nullable=False),
)

TEACHER_NOTES = Table(
    "teacher_notes",
    METADATA,
    _of("students", is_key=True),
    Column("note", String, primary_key=True),  # its id
    Column("assignment", String, nullable=False),
    Column("title", Text, nullable=False),
    Column("teacher", Text, nullable=False),
    Column("made", DateTime, nullable=False),
    Column("day", Date, nullable=False),
    Column("words", Text, nullable=False),
    Column("next", Text, nullable=False),
    Column("body", LargeBinary, nullable=False),  # the note's file, compressed by zlib
)
