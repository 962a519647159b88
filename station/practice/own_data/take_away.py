"""Everything that a student owns, written as plain files: tables in CSV, documents in JSON, captures, their folder."""

import json
import os
import shutil
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import IO

from station.core.disk.file_names import folder_name
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings, StudentSettings
from station.practice.exchange.parcel import Kind
from station.practice.history.kept_rows import figure_fields, session_fields
from station.practice.history.session_files import student_folder
from station.practice.own_data import table_columns as tables
from station.practice.own_data.new_files import NewFile, check_free, new_files
from station.practice.own_data.read_me import NAME, readme_text
from station.practice.own_data.safe_csv import write_csv
from station.practice.own_data.student_files import FolderFiles
from station.store.history import History
from station.store.rows import SessionRow, SessionState
from station.store.student_names import student_key

SCHEMAS = {"mastery.json": "drum-station/own-mastery/1", "notes.json": "drum-station/own-notes/1"}
SETTINGS_SCHEMA = "drum-station/own-settings/1"


@dataclass(frozen=True, slots=True)
class TakenAway:
    """How much was written; `left_out` are links and what else in the folder is no plain file."""

    sessions: int
    judgements: int
    captures: int
    files: int
    left_out: tuple[Path, ...]


def take_away(history: History, settings: Settings, student: str, out: Path, now: datetime) -> TakenAway:
    """Write all of `student` into `out`, a folder or an archive that is new, whole or not at all.

    Raises `BadInput` where nothing is kept of them, `out` is there already or lies in their folder, and `DeviceError`.
    """
    check_free(out)
    folder = student_folder(settings.sessions_dir, student)
    if out.resolve().is_relative_to(folder.resolve()):
        raise BadInput(out, "", "lies in the student's own folder: choose another place")
    if any(each.parent == settings.sessions_dir.resolve() for each in out.resolve().parents):
        raise BadInput(out, "", "lies in a student's folder: choose another place")
    rows = all_sessions(history, student)
    files = FolderFiles.of(folder)
    if not (rows or files.count or own_settings(settings, student)):
        raise BadInput(student, "", "nothing is kept of a student of that name")
    with new_files(out) as new:
        judgements = _write_tables(new, history, student, rows)
        _write_memory(new, history, student)
        _write_json(new, "settings.json", SETTINGS_SCHEMA, "settings", own_settings(settings, student))
        captures = _write_sessions(new, history, rows)
        for path in files.plain:
            with new(f"files/{_archive_name(path.relative_to(folder))}") as stream, _opened(path) as file:
                shutil.copyfileobj(file, stream)
        with new(NAME) as stream:
            stream.write(readme_text(student, now).encode("utf-8", "backslashreplace"))
    return TakenAway(len(rows), judgements, captures, len(files.plain), tuple(files.others))


def all_sessions(history: History, student: str) -> list[SessionRow]:
    """All sessions of a student, those that were cut off too, the oldest first."""
    rows = [row for state in SessionState for row in history.sessions(student, state=state)]
    return sorted(rows, key=lambda row: (row.started, row.name))


def own_settings(settings: Settings, student: str) -> list[dict[str, str]]:
    """What the settings have for that student alone, however their name is spelled."""
    now = StudentSettings(settings.student, settings.hands, settings.course)
    key = student_key(student)
    is_told = settings.student != Settings().student or now in settings.students
    known = ([now] if is_told else []) + [each for each in settings.students if each.name != now.name]
    return [asdict(each) for each in known if student_key(each.name) == key]


# --- the files --------------------------------------------------------------------------------------------------------


def _write_tables(new: NewFile, history: History, student: str, rows: list[SessionRow]) -> int:
    """The tables; how many judgements they have."""

    def write(table: str, lines: Iterator[tuple[object, ...]]) -> int:
        with new(table) as stream:
            return write_csv(stream, tables.COLUMNS[table], lines)

    write(tables.SESSIONS, (tuple(session_fields(row).values()) for row in rows))
    write(
        tables.FIGURES,
        ((row.id, *figure_fields(each).values()) for row in rows for each in history.session_figures(row.id)),
    )
    write(tables.LEVELS, iter(sorted(history.levels(student).items())))
    return write(
        tables.JUDGEMENTS,
        ((row.id, line, *judged) for row in rows for line, judged in enumerate(history.judgements(row.id))),
    )


def _write_memory(new: NewFile, history: History, student: str) -> None:
    known = [
        {"lesson": row.lesson, "bars": [row.first_bar + 1, row.last_bar + 1], "known": _parsed(row.document)}
        for row in history.mastery(student)
    ]
    _write_json(new, "mastery.json", SCHEMAS["mastery.json"], "lessons", known)
    notes = history.notes(student)
    told = [
        {
            "note": row.note,
            "assignment": row.assignment,
            "title": row.title,
            "teacher": row.teacher,
            "made": row.made.isoformat(timespec="seconds"),
            "words": row.words,
            "next": row.next,
        }
        for row in notes
    ]
    _write_json(new, "notes.json", SCHEMAS["notes.json"], "notes", told)
    for row in notes:
        _write(new, f"notes/{folder_name(row.note)}{Kind.NOTE.ending}", row.body)


def _write_sessions(new: NewFile, history: History, rows: list[SessionRow]) -> int:
    """Documents and captures; how many captures there are."""
    for row in rows:
        for name in history.document_names(row.id):
            _write(new, f"documents/{row.id}/{folder_name(name)}", history.document(row.id, name) or b"")
    checksums = sorted({row.capture_sha256 for row in rows if row.capture_sha256 is not None})
    for checksum in checksums:
        _write(new, f"captures/{checksum}.capture", history.capture(checksum) or b"")
    return len(checksums)


def _write_json(new: NewFile, name: str, schema: str, key: str, rows: object) -> None:
    text = json.dumps({"schema": schema, key: rows}, ensure_ascii=False, indent=2)
    _write(new, name, f"{text}\n".encode("utf-8", "backslashreplace"))


def _write(new: NewFile, name: str, data: bytes) -> None:
    with new(name) as stream:
        stream.write(data)


def _opened(path: Path) -> IO[bytes]:
    try:
        return path.open("rb")
    except OSError as fault:
        raise DeviceError(f"{path}: cannot be read: {fault.strerror or fault}") from fault


def _parsed(document: str) -> object:
    try:
        return json.loads(document)
    except ValueError:
        return document


def _archive_name(path: Path) -> str:
    """A path with `/` between its parts, in letters that every archive takes."""
    return os.fsencode(path.as_posix()).decode("utf-8", "replace")
