"""The tables of the history, the same on SQLite and on PostgreSQL.

Times are naive, by the wall clock of the station that wrote them; `_ms` and `_s` are what they say, early is negative;
NULL is no data. `written` is when a row was written that may be written anew: where two histories differ the later one
is right. `migrations` makes an older database like this one.
"""

from sqlalchemy import (
    Boolean,
    Column,
    Date,
    DateTime,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    Table,
    UniqueConstraint,
)

from station.store.column_types import LongWords, Number, Real, Words

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
    return Column(name, Number(), key, primary_key=is_key, nullable=nullable, autoincrement=False)


STUDENTS = Table(
    "students",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("key", Words(), nullable=False, unique=True),  # what two spellings of a name share
    Column("name", Words(), nullable=False),
)

CAPTURES = Table(
    "captures",
    METADATA,
    Column("sha256", Words(64), primary_key=True),
    Column("length", Number(), nullable=False),  # bytes as they were captured
    Column("body", LargeBinary, nullable=False),  # compressed by zlib
)

SESSIONS = Table(
    "sessions",
    METADATA,
    Column("id", Integer, primary_key=True),
    _of("students"),
    Column("name", Words(), nullable=False),  # its folder's
    Column("kind", Words(20), nullable=False),
    Column("state", Words(20), nullable=False),
    Column("started", DateTime, nullable=False),
    Column("folder", LongWords(), nullable=False),
    Column("lesson", Words(), nullable=False),
    Column("title", LongWords(), nullable=False),
    Column("device", LongWords(), nullable=False),
    Column("played_s", Real(), nullable=False),
    Column("complete", Boolean, nullable=False),
    Column("score", Real()),
    Column("level", Words(20), nullable=False),
    Column("beats_a_minute", Real()),
    Column("notes", Number(), nullable=False),
    Column("right", Number(), nullable=False),
    Column("strokes", Number(), nullable=False),  # that mean and SD rest on
    Column("mean_ms", Real()),
    Column("sd_ms", Real()),
    Column("exam", LongWords(), nullable=False),
    Column("capture_sha256", Words(64), ForeignKey("captures.sha256")),
    Column("written", DateTime),
    Column("first_bar", Number()),  # as the last bar from 1
    Column("last_bar", Number()),
    Column("click", Boolean),
    Column("gap", Words(40)),
    Column("input_latency_ms", Real()),
    Column("output_latency_ms", Real()),
    Column("top_beats_a_minute", Real()),
    UniqueConstraint("student_id", "name"),
    Index("ix_sessions_student_started", "student_id", "started"),
)

DOCUMENTS = Table(
    "documents",
    METADATA,
    _of("sessions", is_key=True),
    Column("name", Words(), primary_key=True),  # the file's: report.json, exam.json …
    Column("body", LargeBinary, nullable=False),  # the file's bytes, compressed by zlib
)

FIGURES = Table(
    "figures",
    METADATA,
    _of("sessions", is_key=True),
    Column("part", Words(20), primary_key=True),  # limb or piece
    Column("name", Words(40), primary_key=True),
    Column("notes", Number(), nullable=False),
    Column("matched", Number(), nullable=False),
    Column("misses", Number(), nullable=False),
    Column("wrong_piece", Number(), nullable=False),
    Column("strokes", Number(), nullable=False),
    Column("mean_ms", Real()),
    Column("sd_ms", Real()),
)

JUDGEMENTS = Table(
    "judgements",
    METADATA,
    _of("sessions", is_key=True),
    Column("number", Number(), primary_key=True, autoincrement=False),  # its line in pairs.csv, from 0
    Column("label", Words(20), nullable=False),
    Column("pass_number", Number(), nullable=False),  # as the bar and the beat from 1
    Column("bar", Number(), nullable=False),
    Column("beat", Real(), nullable=False),
    Column("note_index", Number()),
    Column("note_time_s", Real()),
    Column("note_midi", Number()),
    Column("hit_index", Number()),
    Column("hit_time_s", Real()),
    Column("hit_midi", Number()),
    Column("hit_piece", Words(20)),
    Column("hit_zone", Words(20)),
    Column("hit_articulation", Words(20)),
    Column("hit_velocity", Real()),
    Column("hit_openness", Real()),
)

MASTERY = Table(
    "mastery",
    METADATA,
    _of("students", is_key=True),
    Column("lesson", Words(), primary_key=True),
    Column("first_bar", Number(), primary_key=True, autoincrement=False),  # from 0
    Column("last_bar", Number(), primary_key=True, autoincrement=False),
    Column("document", LongWords(), nullable=False),  # drum-station/mastery/1
    Column("written", DateTime),
)

LEVELS = Table(
    "levels",
    METADATA,
    _of("students", is_key=True),
    Column("lesson", Words(), primary_key=True),
    Column("level", Words(20), nullable=False),
    Column("written", DateTime),
)

TEACHER_NOTES = Table(
    "teacher_notes",
    METADATA,
    _of("students", is_key=True),
    Column("note", Words(), primary_key=True),  # its id
    Column("assignment", Words(), nullable=False),
    Column("title", LongWords(), nullable=False),
    Column("teacher", LongWords(), nullable=False),
    Column("made", DateTime, nullable=False),
    Column("day", Date, nullable=False),
    Column("words", LongWords(), nullable=False),
    Column("next", LongWords(), nullable=False),
    Column("body", LargeBinary, nullable=False),  # the note's file, compressed by zlib
)

BACKUPS = Table(
    "backups",
    METADATA,
    Column("computer", Words(), primary_key=True),
    Column("file", Words(), primary_key=True),
    Column("made", DateTime, nullable=False),
)
