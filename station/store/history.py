"""The history of one database: all that a station remembers, and the only way to it.

Every method is one transaction; all of them raise `DeviceError` where the database cannot be reached or refuses.
"""

from collections.abc import Callable, Iterable, Mapping
from datetime import datetime
from pathlib import Path

from station.store import memory_rows, sessions, students
from station.store.database import Database
from station.store.rows import (
    FigureRow,
    JudgementRow,
    KeptSession,
    MasteryRow,
    SessionKind,
    SessionRow,
    SessionState,
    StudentRow,
    TeacherNoteRow,
    TimedFigure,
)
from station.store.schema_version import make_ready
from station.store.scrubbing import scrub
from station.store.student_names import student_key


def _is_empty(path: Path) -> bool:
    return path.is_file() and path.stat().st_size == 0


class History:
    """What is kept in `database`, whose tables are made or migrated first.

    Raises `BadInput` where the database is a newer station's or another program's.
    """

    def __init__(self, database: Database) -> None:
        self.database = database
        self.was_empty = database.path is not None and _is_empty(database.path)
        """Whether its file was there without a byte: what it knew is lost, and it begins anew."""
        try:
            make_ready(database)
        except BaseException:
            database.close()
            raise

    @property
    def name(self) -> str:
        """The file, or the server without its password."""
        return self.database.name

    # --- sessions ----------------------------------------------------------------------------------------------------

    def begin(self, row: SessionRow) -> None:
        """Remember that a session was begun, so that it is offered where it is cut off."""
        with self.database.writing() as connection:
            sessions.put_begun(connection, row)

    def drop_begun(self, student: str, name: str) -> None:
        """Forget a session that was begun and in which nothing was played."""
        with self.database.writing() as connection:
            sessions.drop_begun(connection, student, name)

    def keep(
        self,
        kept: KeptSession,
        mastery: Iterable[MasteryRow] = (),
        levels: Mapping[str, str] | None = None,
    ) -> int:
        """Keep a session that is over, and what was learnt in it, all or nothing; its id."""
        with self.database.writing() as connection:
            number = sessions.put_session(connection, kept)
            for row in mastery:
                memory_rows.put_mastery(connection, kept.row.student, row)
            for lesson, level in (levels or {}).items():
                memory_rows.put_level(connection, kept.row.student, lesson, level)
        return number

    def move(self, folders: Mapping[int, str]) -> None:
        """Say where the files of sessions lie now, by their ids."""
        with self.database.writing() as connection:
            sessions.move_sessions(connection, folders)

    def sessions(
        self,
        student: str,
        since: datetime | None = None,
        until: datetime | None = None,
        state: SessionState = SessionState.KEPT,
    ) -> list[SessionRow]:
        """A student's sessions in the order in which they began, from `since` until before `until`."""
        with self.database.reading() as connection:
            return sessions.sessions_of(connection, student_key(student), state, since, until)

    def latest(
        self,
        student: str,
        most: int,
        kind: SessionKind = SessionKind.LESSON,
        lesson: str | None = None,
        until: datetime | None = None,
    ) -> list[SessionRow]:
        """The last sessions of a kind that are kept, the newest first; of one lesson, or of any (None).

        Those that were begun before `until`, or whenever (None).
        """
        with self.database.reading() as connection:
            return sessions.latest_of(connection, student_key(student), most, kind, lesson, until)

    def session_names(self, student: str, state: SessionState = SessionState.KEPT) -> frozenset[str]:
        """What a student's sessions are called."""
        with self.database.reading() as connection:
            return sessions.session_names(connection, student_key(student), state)

    def session_folders(self, student: str) -> Mapping[str, tuple[int, str]]:
        """Id and folder of a student's sessions, begun or kept, by their names."""
        with self.database.reading() as connection:
            return sessions.session_folders(connection, student_key(student))

    def session(self, number: int) -> SessionRow | None:
        """The session with that id, None where there is none."""
        with self.database.reading() as connection:
            return sessions.session_by_id(connection, number)

    def session_in(self, folder: str) -> SessionRow | None:
        """The session whose files lie in that folder, None where there is none."""
        with self.database.reading() as connection:
            return sessions.session_in(connection, folder)

    def judgements(self, number: int) -> list[JudgementRow]:
        """The judgements of the session with that id, in order."""
        with self.database.reading() as connection:
            return sessions.judgements_of(connection, number)

    def document(self, number: int, name: str) -> bytes | None:
        """A file of a session by its name, such as report.json; None where it has none."""
        with self.database.reading() as connection:
            return sessions.document_in(connection, number, name)

    def document_names(self, number: int) -> list[str]:
        """What the files of the session with that id are called, by the alphabet."""
        with self.database.reading() as connection:
            return sessions.document_names(connection, number)

    def documents(self, student: str, name: str, most: int | None = None) -> list[tuple[SessionRow, bytes]]:
        """The files of that name of a student's sessions, the newest session first, `most` of them (None: all)."""
        with self.database.reading() as connection:
            return sessions.documents_of(connection, student_key(student), name, most)

    def every_document(self, name: str, most: int) -> list[bytes]:
        """The newest files of that name of all students, the newest first."""
        with self.database.reading() as connection:
            return sessions.every_document(connection, name, most)

    def capture(self, checksum: str) -> bytes | None:
        """The capture with that SHA-256 (hexadecimal), None where it is not kept."""
        with self.database.reading() as connection:
            return sessions.capture_by(connection, checksum)

    def figures(self, student: str, since: datetime | None = None) -> list[TimedFigure]:
        """Figures by limb and piece of a student's sessions from `since` on, in the order in which these began."""
        with self.database.reading() as connection:
            return sessions.figures_of(connection, student_key(student), since)

    def session_figures(self, number: int) -> list[FigureRow]:
        """Figures by limb and piece of the session with that id."""
        with self.database.reading() as connection:
            return sessions.session_figures(connection, number)

    # --- what is remembered of a student -----------------------------------------------------------------------------

    def mastery(self, student: str, lesson: str | None = None) -> list[MasteryRow]:
        """What is known of a student's lessons, or of one of them, by name and bars."""
        with self.database.reading() as connection:
            return memory_rows.mastery_of(connection, student_key(student), lesson)

    def remember(
        self, student: str, mastery: Iterable[MasteryRow] = (), levels: Mapping[str, str] | None = None
    ) -> None:
        """Remember it in place of what was known of these bars, and judge these lessons at these levels from now on."""
        with self.database.writing() as connection:
            for row in mastery:
                memory_rows.put_mastery(connection, student, row)
            for lesson, level in (levels or {}).items():
                memory_rows.put_level(connection, student, lesson, level)

    def remember_new(self, student: str, mastery: Iterable[MasteryRow], levels: Mapping[str, str]) -> None:
        """Remember what is known of other bars and lessons than those that are remembered already."""
        with self.database.writing() as connection:
            memory_rows.put_new(connection, student, mastery, levels)

    def levels(self, student: str) -> Mapping[str, str]:
        """The level of each lesson of a student, by the lesson's name."""
        with self.database.reading() as connection:
            return memory_rows.levels_of(connection, student_key(student))

    def keep_note(self, student: str, row: TeacherNoteRow) -> None:
        """Keep a teacher's note; one that is there stays."""
        with self.database.writing() as connection:
            memory_rows.put_note(connection, student, row)

    def notes(self, student: str) -> list[TeacherNoteRow]:
        """The notes of a student's teachers, in the order in which they were written."""
        with self.database.reading() as connection:
            return memory_rows.notes_of(connection, student_key(student))

    # --- students ----------------------------------------------------------------------------------------------------

    def students(self) -> list[StudentRow]:
        """Everyone, who played last first."""
        with self.database.reading() as connection:
            return students.students_known(connection)

    def delete_student(self, student: str, meanwhile: Callable[[], None] = lambda: None) -> bool:
        """Forget a student and all that is theirs, and nothing where that fails; whether there was anything.

        What cannot be undone is done `meanwhile`: nobody else writes, and where it fails, too, nothing is forgotten.
        `scrub` leaves nothing of them.
        """
        with self.database.writing() as connection:
            was_there = students.delete_student(connection, student)
            meanwhile()
        return was_there

    def scrub(self) -> str | None:
        """Leave nothing of what was deleted in the database's files; why that could not be done, None if it was."""
        return scrub(self.database)
