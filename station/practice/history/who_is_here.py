"""Whose history is asked for: a name that somebody here has, as it is written here, or a line that says who is here."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from station.core.did_you_mean import FEW, did_you_mean
from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.history.session_files import VIRTUAL_STUDENT, student_folder
from station.store.student_names import student_key

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History


def student_named(history: "History", settings: Settings, named: str) -> str:
    """The student whom `named` means, however it is spelled; raises `BadInput` for a name that nobody has.

    Known are who plays by `settings`, who has played here before, and whoever has a folder of sessions.
    """
    known = [
        *(row.name for row in history.students()),
        *(each.name for each in settings.students),
        settings.student,
        VIRTUAL_STUDENT,
    ]
    if named in known:
        return named
    found = next((each for each in known if student_key(each) == student_key(named)), None)
    if found is None and not student_folder(settings.sessions_dir, named).is_dir():
        raise BadInput(one_line(named), "", f"no such student{did_you_mean(named, map(one_line, known[:-1]))}")
    return found or named


def student_playing(history: "History", settings: Settings) -> str:
    """Who plays by `settings`; raises `BadInput` where nothing of theirs is kept, and something is of others."""
    student = student_named(history, settings, settings.student)
    if not student_folder(settings.sessions_dir, student).is_dir() and not history.sessions(student):
        others = others_here(history, student)
        if others:
            raise BadInput("--student", "", f"nothing of {one_line(student)} is kept{others}")
    return student


def others_here(history: "History", student: str) -> str:
    """Who else is here, to be added to "nothing of … is kept"; empty where nobody is."""
    names = (row.name for row in history.students() if row.last is not None and row.name != VIRTUAL_STUDENT)
    return _named(one_line(name) for name in names if student_key(name) != student_key(student))


def _named(names: Iterable[str]) -> str:
    found = list(names)
    shown = ", ".join(found[:FEW]) + (" …" if len(found) > FEW else "")
    return f"; there {'is' if len(found) == 1 else 'are'} {shown}: --student NAME" if found else ""
