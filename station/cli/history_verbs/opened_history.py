"""The history as a command opens it: what lies in a student's folders and is not yet in it comes in first."""

from dataclasses import replace
from typing import TYPE_CHECKING

from station.cli.console import say
from station.cli.input.caught_up import shown_intake
from station.cli.today import settings_of
from station.core.settings import Settings

if TYPE_CHECKING:
    from station.store.history import History


def opened_history(settings: Settings, student: str) -> "History":
    """The history of `settings` with all sessions of `student`; says which folders cannot be taken in.

    Raises `BadInput` and `DeviceError`.
    """
    from station.practice.history.old_mastery import begun_anew, untold_faults
    from station.practice.history.session_intake import everything_in
    from station.practice.history.student_history import StudentHistory

    history = StudentHistory(settings, student).open()
    for fault in untold_faults(history, StudentHistory(settings, student).folder):
        say(fault)
    with shown_intake() as progress:
        found = everything_in(history, settings.sessions_dir, student, progress)
    for fault in found.faults:
        say(fault)
    if history.was_empty and found.sessions:
        say(begun_anew(history))
    return history


def settings_for(named: str | None, *, must_have_played: bool = True) -> Settings:
    """The settings with the student who is `named`, spelled as they are here, else with who plays (None).

    Raises `BadInput` for a name that nobody has; where nobody is named, too, where nothing is kept of who plays and
    something is of others, unless it need not (`must_have_played`); `DeviceError`.
    """
    from station.app.settings.students import switched
    from station.practice.history.who_is_here import student_named, student_playing
    from station.store.opening import history_of
    from station.store.student_names import student_key

    settings = settings_of(None)
    if named is None and not must_have_played:
        return settings
    history = history_of(settings)
    if named is None:
        return replace(settings, student=student_playing(history, settings))
    student = student_named(history, settings, named)
    is_playing = student_key(student) == student_key(settings.student)
    return replace(settings, student=student) if is_playing else switched(settings, student)
