"""The history as a command opens it: what lies in a student's folders and is not yet in it comes in first."""

from station.cli.console import say
from station.core.settings import Settings
from station.store.history import History


def opened_history(settings: Settings, student: str) -> History:
    """The history of `settings` with all sessions of `student`; says which folders cannot be taken in.

    Raises `BadInput` and `DeviceError`.
    """
    from station.practice.history.session_intake import everything_in
    from station.store.opening import history_of

    history = history_of(settings)
    for fault in everything_in(history, settings.sessions_dir, student).faults:
        say(fault)
    return history
