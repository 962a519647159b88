"""Another student plays: what is the one's before is put away, what is theirs comes back."""

from station.app.actions.exam_actions import LeaveExam
from station.app.actions.settings_actions import AskWhoPlays, PlayAs
from station.app.station_parts import StationParts
from station.core.errors import DeviceError


def ask_who_plays(parts: StationParts, action: AskWhoPlays) -> None:
    """Show the list of students, or put it away; raises `DeviceError` where none of them may come now."""
    if action.on:
        _refuse(parts)
    parts.who.ask(action.on)


def _refuse(parts: StationParts) -> None:
    if parts.sessions.practice.is_playing:
        raise DeviceError("end the session first: it is kept for who plays it")
    if parts.editor.is_open:
        raise DeviceError("close the editor first: then another student plays")


def play_as(parts: StationParts, action: PlayAs) -> str | None:
    """Let that student play, at once; returns who does. Raises `StationError`, and then all stays as it was."""
    _refuse(parts)
    before = parts.store.now.student
    name = parts.students.play_as(action.name)
    parts.who.ask(on=False)
    if name == before:
        return None
    if parts.exam.is_on:
        parts.exam.act(LeaveExam())
    parts.battle.leave()
    parts.sessions.put_away()
    parts.chooser.change_student()
    parts.today.begin_anew()
    parts.assigned.begin_anew()
    parts.history.begin_anew()
    return f"{name} plays"
