"""A session of the history, opened: its result, its take or its battle takes the place of what is shown."""

from dataclasses import replace

from station.app.actions.exam_actions import LeaveExam
from station.app.actions.history_actions import HistoryAction, OpenKept
from station.app.actions.practice_actions import Select
from station.app.history.open_kept import OpenedBattle, OpenedTake
from station.app.sessions.kept_battle import battle_of_history
from station.app.sessions.shown_result import SavedSession
from station.app.station_parts import StationParts
from station.core.errors import DeviceError


def look_back(parts: StationParts, action: HistoryAction) -> None:
    """What is asked of the history; raises `DeviceError` where nothing can be opened now."""
    if isinstance(action, OpenKept):
        _refuse(parts)
    parts.history.act(action)


def _refuse(parts: StationParts) -> None:
    if parts.sessions.practice.is_playing:
        raise DeviceError("end the session first: the one that you open comes in its place")
    if parts.editor.is_open:
        raise DeviceError("close the editor first: the session that you open comes in its place")


def show_opened(parts: StationParts) -> None:
    """Show the session that was opened, once it is judged; raises `StationError`."""
    opened = parts.history.opened()
    if opened is None:
        return
    _refuse(parts)
    if parts.exam.is_on:
        parts.exam.act(LeaveExam())
    parts.battle.leave()
    match opened.what:
        case SavedSession():
            parts.sessions.look_at(opened.what)
        case OpenedTake(take, click):
            parts.sessions.dismiss()
            parts.chooser.act(Select(replace(parts.chooser.selection, free=True)))
            parts.chooser.update()  # the kit alone is shown
            listening = parts.sessions.practice.free.recall(take, click)
            if listening is not None:
                parts.sessions.listen_to(listening)
        case OpenedBattle(result, folder):
            parts.sessions.dismiss()
            parts.sessions.look_at(battle_of_history(result, folder))
