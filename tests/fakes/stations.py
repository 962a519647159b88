"""A station without a window, on an engine by hand."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from station.app.actions.practice_actions import Begin, Select
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.equipment.calibration import MeasuringProcess, Running
from station.app.equipment.latency_methods import MeasureRequest
from station.app.room_state import RoomState
from station.app.sessions.launch import Launch
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.settings import Settings, save_settings
from station.engine.messages import CaptureSaved, Command, EngineEvent, RecordCapture
from station.render.snapshot import Snapshot


class Line:
    """The other end of an engine: says what it was given to say; dead, it refuses as the process does."""

    def __init__(self) -> None:
        self.says: list[EngineEvent] = []
        self.heard: list[Command] = []
        self.dead = False

    def send(self, command: Command) -> None:
        self._live()
        self.heard.append(command)
        if isinstance(command, RecordCapture):
            self.says.append(CaptureSaved(command.path))

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        del wait_s
        self._live()
        said, self.says = self.says, []
        return said

    def close(self) -> None:
        self.dead = True

    def _live(self) -> None:
        if self.dead:
            raise DeviceError("the engine has ended")


def store_with(sessions: Path, **chosen: object) -> SettingsStore:
    """Settings in a file of their own; sessions are kept in the folder."""
    settings = Settings(sessions=str(sessions), **chosen)  # type: ignore[arg-type] # what a test chooses
    return SettingsStore(save_settings(settings, sessions / "settings.toml"))


def station_on(
    lines: Sequence[Line],
    store: SettingsStore,
    launch: Launch,
    measure: Callable[[MeasureRequest], Running] = MeasuringProcess,
) -> Controller:
    """A station whose engines are `lines`, one after the other; `measure` begins a measurement."""
    waiting = iter(lines)
    return Controller(ChildPrograms(lambda: next(waiting), measure), store, launch)


def shown(station: Controller, now_ns: int) -> Snapshot:
    """The picture of the next frame."""
    station.update(now_ns)
    snapshot = station.view().snapshot
    assert snapshot is not None
    return snapshot


def choose(station: Controller, **chosen: object) -> None:
    """Change what is chosen."""
    station.dispatch(Select(replace(station.view().selection, **chosen)))  # type: ignore[arg-type] # what a test chooses


def just_play(station: Controller, tempo_bpm: float = 100.0) -> None:
    """Begin a free take."""
    choose(station, free=True, tempo_bpm=tempo_bpm)
    station.dispatch(Begin())


def room(station: Controller) -> RoomState:
    """What goes on."""
    return station.view().room
