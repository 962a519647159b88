"""The first thing that a program does with the history: all that lies in folders and is not known yet comes in.

A listing and a query a student where nothing is new. Where the history cannot be reached it is said, once.
"""

from collections.abc import Callable, Iterator
from datetime import datetime
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from station.core.counts import counted
from station.core.disk.file_names import alike, folder_name
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.practice.exchange.notes_kept import take_in_notes
from station.practice.history.kept_json import kept_document
from station.practice.history.moved_folders import follow_moved, forget_gone
from station.practice.history.old_mastery import FOLDER, take_in_old, untold_faults
from station.practice.history.session_files import (
    DOCUMENT_NAME,
    OWN_FOLDERS,
    VIRTUAL_STUDENT,
    started_in,
    student_folder,
)
from station.practice.history.session_intake import Progress, everything_in
from station.practice.history.student_history import StudentHistory
from station.practice.history.unarrived import forget_arrived

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

_MOST_TOLD = 3
"""Our choice: so many faults are read."""


def catch_up(settings: Settings, tell: Callable[[str], None], progress: Progress = lambda _done, _all: None) -> int:
    """Take in what every student's folder has; `tell` hears what a user should read. Returns how many sessions came."""
    taken, faults = 0, []
    try:
        with StudentHistory.of(settings).reached(inf) as history:
            for student in _students(history, settings):
                whose = StudentHistory(settings, student)
                take_in_old(history, whose.folder, student)
                faults += untold_faults(history, whose.folder)
                take_in_notes(history, whose.folder, student)
                follow_moved(history, whose.folder, student)
                found = everything_in(history, settings.sessions_dir, student, progress)
                forget_gone(history, student, datetime.now())
                forget_arrived(whose, history)
                taken += found.sessions
                faults += found.faults if found.sessions else ()  # what is damaged is named once, with what is not
    except DeviceError as fault:
        tell(f"{fault}; practice goes on, and what is played stays in its folder until the history can be reached")
    for line in faults[:_MOST_TOLD]:
        tell(line)
    if len(faults) > _MOST_TOLD:
        tell(f"{counted(len(faults) - _MOST_TOLD, 'more folder')} could not be taken into the history")
    if taken:
        tell(f"{counted(taken, 'session')} taken into the history")
    return taken


def _students(history: "History", settings: Settings) -> Iterator[str]:
    """Who plays, then whoever else has a folder under the folder of all sessions."""
    sessions = settings.sessions_dir
    named = [settings.student, *(each.name for each in settings.students), *(row.name for row in history.students())]
    known = {alike(student_folder(sessions, name).name): name for name in reversed(named)}
    yield settings.student
    for folder in _folders(sessions):
        name = known.get(alike(folder.name))
        if name is None and _is_somebodys(folder):
            yield _reported_name(folder)
        elif name not in (None, settings.student, VIRTUAL_STUDENT):
            yield name


def _folders(sessions: Path) -> list[Path]:
    try:
        inside = sorted(sessions.iterdir())
    except OSError:
        return []
    others = {*OWN_FOLDERS, folder_name(VIRTUAL_STUDENT)}
    return [path for path in inside if path.is_dir() and path.name.casefold() not in others]


def _is_somebodys(folder: Path) -> bool:
    return any(started_in(path.name) is not None or path.name == FOLDER for path in folder.iterdir())


def _reported_name(folder: Path) -> str:
    """What the last report calls the student, where that name has this folder."""
    last = max((path for path in folder.iterdir() if started_in(path.name) is not None), default=None)
    try:
        document: Any = None if last is None else kept_document(last / DOCUMENT_NAME)
        name = document["session"]["student"]
    except (BadInput, KeyError, TypeError):
        return folder.name
    is_theirs = isinstance(name, str) and name.isprintable() and student_folder(folder.parent, name) == folder
    return name if is_theirs else folder.name
