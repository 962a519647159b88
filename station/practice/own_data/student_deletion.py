"""Everything of a student, deleted: folders and history at once, as far as a disk and a database can be."""

import os
from dataclasses import dataclass
from pathlib import Path

from station.core.counts import counted
from station.core.disk.file_lock import is_locked
from station.core.disk.file_names import folder_name
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.practice.exchange.teacher_store import RETURNS_FOLDER
from station.practice.history.session_files import (
    BATTLE_CAPTURE_NAME,
    CAPTURE_NAME,
    student_folder,
    student_folders,
)
from station.practice.own_data.emptying import delete_tree
from station.practice.own_data.student_files import FolderFiles
from station.practice.own_data.take_away import all_sessions, own_settings
from station.store.backup import copies_known
from station.store.history import History
from station.store.rows import SessionRow, SessionState

_MOST_NAMED = 3
"""Our choice: so many faults are read in one line."""


@dataclass(frozen=True, slots=True)
class Theirs:
    """What there is of `student` in the history, in their `folder` and in the settings.

    Another spelling of the name may have a folder, too. `links` are where folders lead that are links; `elsewhere` are
    folders of sessions that lie outside, `copies` says where backups of the history lie, `returns` are folders of a
    teacher; the history `is_shared` where it is a server's.
    """

    student: str
    sessions: int
    lessons: int
    notes: int
    folders: tuple[Path, ...]
    files: tuple[int, ...]
    links: tuple[Path, ...]
    has_settings: bool
    elsewhere: tuple[Path, ...]
    copies: tuple[str, ...]
    returns: tuple[Path, ...]
    is_shared: bool

    @property
    def lines(self) -> list[str]:
        """What will be deleted, a line each."""
        known = f"{counted(self.sessions, 'session')} with their judgements, captures and reports"
        memory = f"what is known of {counted(self.lessons, 'lesson')}, {counted(self.notes, 'note')} of teachers"
        there = ["a link, which goes" if each.is_symlink() else "" for each in self.folders]
        files = zip(self.folders, self.files, there, strict=True)
        lines = [f"the folder {folder}: {link or counted(count, 'file')}" for folder, count, link in files]
        return [
            f"from the history: {known}; {memory}",
            *lines,
            *(["their entry in the settings"] if self.has_settings else []),
        ]

    @property
    def stays(self) -> list[str]:
        """What cannot be deleted from here, a line each."""
        return [
            *(f"{link}, to which the folder's link leads: delete it by hand" for link in self.links),
            *(f"{folder}, where a session's files were put on purpose: delete it by hand" for folder in self.elsewhere),
            *(f"{copy}, an older copy of the history: delete it by hand" for copy in self.copies),
            *(f"{folder}, returns that a teacher keeps here: delete it by hand" for folder in self.returns),
            *(["folders of theirs on other computers that use this history"] if self.is_shared else []),
            "backups and exports that were made, returns that were sent to a teacher, others' battles with them,"
            " lessons that came with assignments, which all students share",
        ]


def what_is_theirs(history: History, settings: Settings, student: str) -> Theirs:
    """All that there is of a student; raises `BadInput` where nothing is, and `DeviceError`."""
    rows = all_sessions(history, student)
    own_folder = student_folder(settings.sessions_dir, student)
    folders = student_folders(settings.sessions_dir, student) or [own_folder]
    try:
        files = [0 if folder.is_symlink() else FolderFiles.of(folder).count for folder in folders]
    except OSError as fault:
        raise DeviceError(f"{fault.filename}: cannot be read: {fault.strerror}") from fault
    tops = [folder.resolve() for folder in folders]
    own = own_settings(settings, student)
    mastery, notes, levels = history.mastery(student), history.notes(student), history.levels(student)
    if not (rows or mastery or notes or levels or own or any(map(os.path.lexists, folders))):
        raise BadInput(student, "", "nothing is kept of a student of that name")
    placed = {Path(row.folder) for row in rows if row.folder}
    return Theirs(
        student,
        len(rows),
        len({row.lesson for row in mastery} | set(levels)),
        len(notes),
        tuple(folders),
        tuple(files),
        tuple(top for folder, top in zip(folders, tops, strict=True) if folder.is_symlink()),
        bool(own),
        tuple(sorted(path for path in placed if path.is_dir() and not any(map(path.resolve().is_relative_to, tops)))),
        tuple(copies_known(history)),
        tuple(sorted((settings.sessions_dir / RETURNS_FOLDER).glob(f"*/{folder_name(student)}"))),
        history.database.path is None,
    )


def delete_theirs(history: History, theirs: Theirs) -> str | None:
    """Delete folders and what the history has; what is left of that in its files, None where nothing is.

    The history has its turn first and lets go of them last, so that a history that refuses leaves all as it is. Raises
    `DeviceError` that says what is left, then it can be done again, and where one of their sessions runs.
    """
    running = next((each for row in _begun(history, theirs.student) if (each := _is_running(row)) is not None), None)
    if running is not None:
        raise DeviceError(f"{running}: this session runs in another program right now: end it first")
    gone: list[Path] = []

    def delete_folders() -> None:
        for folder in theirs.folders:
            _delete_folder(folder)
            gone.append(folder)

    try:
        history.delete_student(theirs.student, delete_folders)
    except _LeftOver:
        raise
    except DeviceError as fault:
        if not gone:
            raise
        raise DeviceError(f"the folder is deleted, the history is not yet: run this again; {fault}") from fault
    return history.scrub()


class _LeftOver(DeviceError):
    """Files of theirs that the disk does not let go."""


def _delete_folder(folder: Path) -> None:
    faults = delete_tree(folder)
    if faults:
        named = "; ".join(f"{fault.filename}: {fault.strerror}" for fault in faults[:_MOST_NAMED])
        left = f"{counted(len(faults), 'file')} could not be deleted"
        raise _LeftOver(f"{left}, and the history stays until they can: mend it and run this again; {named}")


def _begun(history: History, student: str) -> list[SessionRow]:
    return history.sessions(student, state=SessionState.BEGUN)


def _is_running(row: SessionRow) -> Path | None:
    """The folder of a begun session whose capture somebody writes right now."""
    folder = Path(row.folder)
    return folder if any(is_locked(folder / name) for name in (CAPTURE_NAME, BATTLE_CAPTURE_NAME)) else None
