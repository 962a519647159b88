"""`station history delete --student NAME`: everything of a student, by one command."""

from dataclasses import dataclass

from station.app.settings.first_start import LONGEST_NAME
from station.app.settings.settings_store import SettingsStore
from station.app.settings.students import Students, forgotten
from station.cli.console import ask, is_attended, say
from station.cli.input.caught_up import caught_up
from station.cli.options.option_fields import flag, required
from station.core.did_you_mean import did_you_mean
from station.core.disk.utf8 import one_line
from station.core.errors import BadInput, DeviceError, StationError
from station.practice.history.session_files import VIRTUAL_STUDENT
from station.practice.own_data.student_deletion import Theirs, delete_theirs, what_is_theirs
from station.practice.records.students import shares_folder
from station.store.history import History


@dataclass(frozen=True, slots=True, kw_only=True)
class DeleteOptions:
    """Who is forgotten."""

    student: str = required("NAME", "who is to be forgotten, as `station history list` writes them", str)
    yes: bool = flag("ask nothing")


def run(options: DeleteOptions) -> int:
    """Say what will be deleted, ask, delete it."""
    from station.store.opening import history_of

    store = SettingsStore()
    if store.fault is not None:  # another history may be meant than the one that the defaults name
        raise store.fault
    history = history_of(store.now)
    caught_up(store.now)
    student = _known(store, history, options.student)
    theirs = what_is_theirs(history, store.now, student)
    _tell(theirs)
    if not options.yes:
        _ask(student)
    remains = delete_theirs(history, theirs)
    _forget(store, student)
    if remains is not None:
        say(f"the file still has traces of it until all programs that use it have ended: {history.name}: {remains}")
    say(f"deleted: nothing of {one_line(student)} is left here")
    return 0


def _known(store: SettingsStore, history: History, student: str) -> str:
    """The student as they are known, however they are spelled; raises `BadInput` for a name that nobody has."""
    known = [each.name for each in Students(store).known] + [each.name for each in history.students()]
    if student in (*known, VIRTUAL_STUDENT):
        return student
    same = next((each for each in known if shares_folder(each, student)), None)
    if same is None:
        near = [each for each in known if len(each) <= LONGEST_NAME]
        raise BadInput(student, "", f"no such student{did_you_mean(student, near)}")
    return same


def _tell(theirs: Theirs) -> None:
    say(f"This deletes all of {one_line(theirs.student)}:")
    for line in theirs.lines:
        say(f"  {one_line(line)}")
    say("What stays, for nobody can delete it from here:")
    for line in theirs.stays:
        say(f"  {one_line(line)}")


def _ask(student: str) -> None:
    if not is_attended():
        raise BadInput("--yes", "", "nobody is here to be asked: say --yes to delete all of this")
    if ask(f"Type the name, {one_line(student)}, to delete it: ") != student:
        raise BadInput("the name", "", "is another one: nothing was deleted")


def _forget(store: SettingsStore, student: str) -> None:
    store.update(lambda settings: forgotten(settings, student))
    try:
        store.write()
    except StationError as fault:
        raise DeviceError(f"folder and history are deleted, but the name stays in the settings: {fault}") from fault
