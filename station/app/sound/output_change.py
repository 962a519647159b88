"""Another sound output, block or rate: between sessions the engine is started anew for it.

Where it does not sound, it is started once more for the one that sounded before, and one line says so.
The engine opens the card in its own process; nothing here waits for it. `Ready` says whether it sounds.
"""

from collections.abc import Callable
from dataclasses import replace
from enum import Enum, auto

from station.app.actions.sound_actions import OutputChoice
from station.app.engine_client import EngineClient
from station.app.settings.settings_store import SettingsStore
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.engine.messages import EngineEvent, Notice, Ready

OPEN_WITHIN_NS = 20 * NS_PER_S
"""A driver that takes longer hangs (our choice: a cold sound server takes five)."""
_SILENT = "silent"
_PREFIX = "running silent, on the computer's own clock: "


class _Stage(Enum):
    STANDING = auto()
    RESTING = auto()
    """The engine gives its devices back."""
    OPENING = auto()
    """Another engine opens them."""


def choice_of(settings: Settings) -> OutputChoice:
    """What the settings say."""
    return OutputChoice(settings.output, settings.block_frames, settings.rate_hz)


class OutputChange:
    """Where the sound goes, by the settings of `store`; `rest` lets the engine's devices go."""

    def __init__(
        self, store: SettingsStore, engine: EngineClient, rest: Callable[[], object], notify: Callable[[str], None]
    ) -> None:
        self._store, self._engine, self._rest, self._notify = store, engine, rest, notify
        self._stage = _Stage.STANDING
        self._before: OutputChoice | None = None  # what is gone back to
        self._said = ""  # by the engine that opens it
        self._failed = ""  # why what was asked for is not had
        self._since_ns: int | None = None

    @property
    def chosen(self) -> OutputChoice:
        """What was chosen."""
        return choice_of(self._store.now)

    @property
    def is_changing(self) -> bool:
        """Whether another output is being opened."""
        return self._stage is not _Stage.STANDING

    def ask(self, choice: OutputChoice) -> None:
        """Let the sound go there; raises `DeviceError` while somebody plays."""
        if choice == self.chosen or self.is_changing:
            return
        before = self.chosen if self._engine.sound != _SILENT else None  # where nothing sounded there is no way back
        self._begin(choice)
        self._before, self._failed = before, ""

    def _begin(self, choice: OutputChoice) -> None:
        self._rest()
        self._store.update(
            lambda settings: replace(
                settings, output=choice.output, block_frames=choice.block_frames, rate_hz=choice.rate_hz
            )
        )
        self._stage, self._since_ns, self._said = _Stage.RESTING, None, ""

    def advance(self, now_ns: int) -> None:
        """Move on; raises `StationError` where no engine can be had."""
        if self._stage is _Stage.RESTING and self._engine.has_rested():
            self._stage, self._since_ns = _Stage.OPENING, now_ns
            self._engine.wake()
        elif self._stage is _Stage.OPENING and now_ns - (self._since_ns or now_ns) > OPEN_WITHIN_NS:
            self._opened(None, None, f"{self.chosen.output or 'the output'} does not open")

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine that opens it."""
        if self._stage is not _Stage.OPENING:
            return
        match event:
            case Notice(text):
                self._said = self._said or text.removeprefix(_PREFIX)
            case Ready(output, rate_hz):
                self._opened(output, rate_hz, self._said or "there is no sound")
            case _:
                pass

    def _opened(self, output: str | None, rate_hz: int | None, why: str) -> None:
        self._stage = _Stage.STANDING
        before, self._before = self._before, None
        if output is None and before is not None:
            self._failed = why
            self._begin(before)
        elif output is None:
            self._notify(why)
        elif self._failed:
            self._notify(f"{self._failed}; back to {output}")
        else:
            self._notify(f"sound goes to {output}, at {rate_hz} Hz")
