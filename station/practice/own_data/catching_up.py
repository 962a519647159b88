"""The first thing that a program does with the history: all that lies in folders and is not known yet comes in.

A listing and a query a student where nothing is new. Where the history cannot be reached it is said, once.
"""

from collections.abc import Callable, Iterator
from datetime import datetime
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from station.core.counts import counted
from station.core.disk.file_names import alike, folder_name
from station.core.errors import DeviceError
from station.core.settings import Settings
from station.practice.exchange.notes_kept import take_in_notes
from station.practice.history.moved_folders import follow_moved, forget_gone
from station.practice.history.named_folders import give_new_names, reported_name
from station.practice.history.old_mastery import FOLDER, begun_anew, take_in_old, untold_faults
from station.practice.history.pending_sessions import forget_arrived
from station.practice.history.session_files import (
    OWN_FOLDERS,
    VIRTUAL_STUDENT,
    leads_to_another,
    own_folder_name,
    started_in,
    student_folders,
)
from station.practice.history.session_intake import Progress, everything_in
from station.practice.history.student_history import StudentHistory
from station.store.student_names import student_key

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

_MOST_TOLD = 3
"""Our choice: so many faults are read."""


def catch_up(settings: Settings, tell: Callable[[str], None], progress: Progress = lambda _done, _all: None) -> int:
    """Take in what every student's folder has; `tell` hears what a user should read. Returns how many sessions came."""
    taken, faults = 0, []
    try:
        with StudentHistory.of(settings).reached(inf) as history:
            for folder in _all_folders(settings.sessions_dir):
                if leads_to_another(folder):
                    tell(f"{folder}: is a link to another student's folder, and is left alone")
            for student in _students(history, settings):
                whose = StudentHistory(settings, student)
                for folder in student_folders(settings.sessions_dir, student):
                    take_in_old(history, folder, student)
                    faults += untold_faults(history, folder)
                    take_in_notes(history, folder, student)
                    follow_moved(history, folder, student)
                found = everything_in(history, settings.sessions_dir, student, progress)
                forget_gone(history, student, datetime.now())
                forget_arrived(whose, history)
                taken += found.sessions
                faults += found.faults if found.sessions else ()  # what is damaged is named once, with what is not
            if history.was_empty and taken:
                tell(begun_anew(history))
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
    named = [*(row.name for row in history.students()), settings.student, *(each.name for each in settings.students)]
    give_new_names(sessions, named)
    known = {alike(own_folder_name(name)): name for name in named}
    seen = {student_key(settings.student), student_key(VIRTUAL_STUDENT)}
    yield settings.student
    for folder in _folders(sessions):
        name = known.get(alike(folder.name)) or (reported_name(folder) if _is_somebodys(folder) else None)
        if name is not None and student_key(name) not in seen:
            seen.add(student_key(name))
            yield name


def _all_folders(sessions: Path) -> list[Path]:
    try:
        return sorted(path for path in sessions.iterdir() if path.is_dir())
    except OSError:
        return []


def _folders(sessions: Path) -> list[Path]:
    others = {*OWN_FOLDERS, folder_name(VIRTUAL_STUDENT)}
    inside = _all_folders(sessions)
    return [path for path in inside if path.name.casefold() not in others and not leads_to_another(path)]


def _is_somebodys(folder: Path) -> bool:
    return any(started_in(path.name) is not None or path.name == FOLDER for path in folder.iterdir())
