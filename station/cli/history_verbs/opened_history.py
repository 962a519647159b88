"""The history as a command opens it: what lies in a student's folders and is not yet in it comes in first."""

from typing import TYPE_CHECKING

from station.cli.console import say
from station.core.settings import Settings

if TYPE_CHECKING:
    from station.store.history import History


def opened_history(settings: Settings, student: str) -> "History":
    """The history of `settings` with all sessions of `student`; says which folders cannot be taken in.

    Raises `BadInput` and `DeviceError`.
    """
    from station.practice.history.session_intake import everything_in
    from station.practice.history.student_history import StudentHistory

    history = StudentHistory(settings, student).open()
    for fault in everything_in(history, settings.sessions_dir, student).faults:
        say(fault)
    return history
