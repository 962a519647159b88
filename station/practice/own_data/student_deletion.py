"""Everything of a student, deleted: first their folder, so that nothing of it is taken in again, then the history."""

from dataclasses import dataclass
from pathlib import Path

from station.core.counts import counted
from station.core.disk.file_names import folder_name
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.practice.exchange.teacher_store import RETURNS_FOLDER
from station.practice.history.session_files import student_folder
from station.practice.own_data.emptying import delete_tree
from station.practice.own_data.student_files import FolderFiles
from station.practice.own_data.take_away import all_sessions, own_settings
from station.store.backup import copies_known
from station.store.history import History

_MOST_NAMED = 3
"""Our choice: so many faults are read in one line."""


@dataclass(frozen=True, slots=True)
class Theirs:
    """What there is of `student` in the history, in their `folder` and in the settings.

    `link` is where the folder leads, None where it is no link; `elsewhere` are folders of sessions that lie outside,
    `copies` says where backups of the history lie, `returns` are folders of a teacher; the history `is_shared` where
    it is a server's.
    """

    student: str
    sessions: int
    lessons: int
    notes: int
    folder: Path
    files: int
    link: Path | None
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
        there = "a link, which goes" if self.link is not None else counted(self.files, "file")
        lines = [f"from the history: {known}; {memory}", f"the folder {self.folder}: {there}"]
        return [*lines, *(["their entry in the settings"] if self.has_settings else [])]

    @property
    def stays(self) -> list[str]:
        """What cannot be deleted from here, a line each."""
        return [
            *([f"{self.link}, to which the folder's link leads: delete it by hand"] if self.link is not None else []),
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
    folder = student_folder(settings.sessions_dir, student)
    is_link = folder.is_symlink()
    try:
        files = 0 if is_link else FolderFiles.of(folder).count
    except OSError as fault:
        raise DeviceError(f"{fault.filename}: cannot be read: {fault.strerror}") from fault
    top = folder.resolve()
    own = own_settings(settings, student)
    mastery, notes, levels = history.mastery(student), history.notes(student), history.levels(student)
    if not (rows or mastery or notes or levels or own or folder.exists() or is_link):
        raise BadInput(student, "", "nothing is kept of a student of that name")
    placed = {Path(row.folder) for row in rows if row.folder}
    return Theirs(
        student,
        len(rows),
        len({row.lesson for row in mastery} | set(levels)),
        len(notes),
        folder,
        files,
        top if is_link else None,
        bool(own),
        tuple(sorted(path for path in placed if path.is_dir() and not path.resolve().is_relative_to(top))),
        tuple(copies_known(history)),
        tuple(sorted((settings.sessions_dir / RETURNS_FOLDER).glob(f"*/{folder_name(student)}"))),
        history.database.path is None,
    )


def delete_theirs(history: History, theirs: Theirs) -> str | None:
    """Delete the folder, then what the history has; what is left of that in its files, None where nothing is.

    Raises `DeviceError` that says what is left; then it can be done again.
    """
    faults = delete_tree(theirs.folder)
    if faults:
        named = "; ".join(f"{fault.filename}: {fault.strerror}" for fault in faults[:_MOST_NAMED])
        left = f"{counted(len(faults), 'file')} could not be deleted"
        raise DeviceError(f"{left}, and the history stays until they can: mend it and run this again; {named}")
    try:
        history.delete_student(theirs.student)
    except DeviceError as fault:
        raise DeviceError(f"the folder is deleted, the history is not yet: run this again; {fault}") from fault
    return history.scrub()
