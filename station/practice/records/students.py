"""Who practises here: the students whose folders lie under the folder of all sessions, and which names stay apart."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path

from station.core.disk.file_names import alike, folder_name
from station.core.errors import BadInput
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME, OWN_FOLDERS, VIRTUAL_STUDENT, student_folder
from station.store.student_names import student_key

_SESSIONS = "????-??-??T??-??-??_*"
_MARKS = ("mastery", "book")
"""What else a student's folder has."""


@dataclass(frozen=True, slots=True)
class KnownStudent:
    """A student by name, and the day on which they played last; None where nothing is kept yet."""

    name: str
    last: date | None = None

    def words(self, today: date) -> str:
        """When that was."""
        if self.last is None:
            return "nothing played yet"
        ago = (today - self.last).days
        return {0: "played today", 1: "played yesterday"}.get(ago) or f"played on {self.last.day} {self.last:%B %Y}"


def known_students(sessions: Path, named: Iterable[str]) -> tuple[KnownStudent, ...]:
    """Those who are `named`, in this order, then whoever else has a folder under `sessions`, who played last first.

    Who is not named goes by the word of their last report, else by the folder's name.
    """
    found: dict[str, tuple[str, list[str]]] = {}
    for name in named:
        folder = student_folder(sessions, name)
        found.setdefault(alike(folder.name), (name, _started(folder)))
    first = len(found)
    for folder in _folders(sessions):
        started = _started(folder)
        if folder.name == folder_name(VIRTUAL_STUDENT):
            continue
        if alike(folder.name) not in found and (started or any((folder / mark).is_dir() for mark in _MARKS)):
            found[alike(folder.name)] = _reported_name(folder, started), started
    everyone = list(found.values())
    others = sorted(everyone[first:], key=lambda one: max(one[1], default=""), reverse=True)
    return tuple(KnownStudent(name, _day(started)) for name, started in [*everyone[:first], *others])


def shares_folder(name: str, other: str) -> bool:
    """Whether two names are of one student, as they have one folder."""
    return student_key(name) == student_key(other)


def sharing(sessions: Path, name: str, others: Sequence[str]) -> str | None:
    """Which of the `others` has the folder that `name` would have, on any file system; None where nobody has."""
    wanted = _folder_of(sessions, name)
    return next((each for each in others if each != name and _folder_of(sessions, each) == wanted), None)


def _folder_of(sessions: Path, name: str) -> str:
    return alike(student_folder(sessions, name).name)


def _folders(sessions: Path) -> list[Path]:
    try:
        inside = sorted(sessions.iterdir())
    except OSError:
        return []
    return [path for path in inside if path.is_dir() and path.name.casefold() not in OWN_FOLDERS]


def _started(folder: Path) -> list[str]:
    """The names of its sessions, which begin with when they began, in order."""
    return sorted(path.name for path in folder.glob(_SESSIONS) if path.is_dir())


def _day(started: Sequence[str]) -> date | None:
    try:
        return datetime.strptime(started[-1][:10], "%Y-%m-%d").date() if started else None
    except ValueError:
        return None


def _reported_name(folder: Path, started: Sequence[str]) -> str:
    """What the last report calls the student, where that name has this folder."""
    try:
        document = kept_document(folder / started[-1] / DOCUMENT_NAME) if started else None
    except BadInput:
        return folder.name
    session = document.get("session") if isinstance(document, dict) else None
    name = session.get("student") if isinstance(session, dict) else None
    is_theirs = isinstance(name, str) and name.isprintable() and student_folder(folder.parent, name) == folder
    return str(name) if is_theirs else folder.name
