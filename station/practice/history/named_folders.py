"""Whose a folder is that lies among the students', also one from before names that differ had folders that differ."""

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from station.core.disk.file_names import alike, folder_name
from station.core.errors import BadInput
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME, OWN_FOLDERS, own_folder_name, started_in


def reported_name(folder: Path) -> str:
    """What the last report calls the student, where that name has this folder."""
    name = _last_name(folder)
    is_theirs = name is not None and alike(own_folder_name(name)) == alike(folder.name)
    return name if name is not None and is_theirs else folder.name


def give_new_names(sessions: Path, named: Iterable[str]) -> None:
    """Call folders as their students' are called by now: letters that a folder cannot have left no trace before.

    It goes to the first of those `named` whose it was, else to whom its last report names; where somebody has a folder
    of that name by now it stays theirs.
    """
    names = list(named)
    owned = {alike(own_folder_name(name)) for name in names}
    before = {alike(_name_before(name)): name for name in reversed(names)}
    olds = {alike(_name_before(name)) for name in names} | {folder_name("")}
    for old in sorted(olds - owned):
        for folder in _called(sessions, old):
            name = before.get(old) or _last_name(folder)
            if name is not None and alike(_name_before(name)) == old and alike(own_folder_name(name)) != old:
                _move(folder, sessions / own_folder_name(name))


def _name_before(student: str) -> str:
    name = folder_name(student)
    return f"{name}_" if name.casefold() in OWN_FOLDERS else name


def _called(sessions: Path, name: str) -> list[Path]:
    try:
        return [path for path in sessions.iterdir() if alike(path.name) == name and path.is_dir()]
    except OSError:
        return []


def _move(folder: Path, to: Path) -> None:
    """Rename it, or put into the one that is there what that has not; where the disk refuses it stays."""
    with suppress(OSError):
        if not to.exists():
            folder.rename(to)
            return
        for each in list(folder.iterdir()):
            if not (to / each.name).exists():
                each.rename(to / each.name)
        folder.rmdir()


def _last_name(folder: Path) -> str | None:
    last = max((path for path in folder.iterdir() if started_in(path.name) is not None), default=None)
    try:
        document: Any = None if last is None else kept_document(last / DOCUMENT_NAME)
        name = document["session"]["student"]
    except (BadInput, KeyError, TypeError):
        return None
    return name if isinstance(name, str) and name.isprintable() else None
