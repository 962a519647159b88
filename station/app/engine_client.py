"""The engine as the controller holds it: woken when it is needed, and what it says of kits and sound, in words.

It is an `EngineLink` that remembers its own death: after the `DeviceError` of `events` that reports it nothing more is
heard, and `wake` starts another engine. A command that fails is no death yet: what was said before it is still to hear.
"""

from collections.abc import Callable
from threading import Thread
from typing import Protocol

from station.core.errors import DeviceError
from station.core.events import DeviceFound, DeviceLost, Hit
from station.engine.messages import Command, EngineEvent, Ready, SetAirDrums, SetLevel, SetPiece, Sounding, Watch
from station.practice.headless.live import EngineLink
from station.practice.session.cues.click_flash import ClickFlash


class RoomEngine(EngineLink, Protocol):
    """An engine that can be ended, so that its devices are free."""

    def close(self) -> object:
        """End it."""
        ...


WakeEngine = Callable[[], RoomEngine]
_WAKING, SILENT, DEAD = "the engine is waking", "silent", "the engine has ended"
"""What is said of the sound where there is no card."""


class EngineClient:
    """One engine after the other; `rate_hz` is the card's as far as is known."""

    def __init__(self, wake: WakeEngine, rate_hz: int) -> None:
        self._wake = wake
        self._engine = wake()
        self._resting: Thread | None = None
        self.rate_hz = rate_hz
        self.alive = True
        self.sound = _WAKING
        self.flash = ClickFlash()
        """What is clicked, as light."""
        self.struck_ns: int | None = None
        """When the last stroke was played that was heard of."""
        self._kits: list[str] = []
        self._standing: dict[object, Command] = {}

    @property
    def kits(self) -> str:
        """The kits that are connected, in words."""
        return ", ".join(self._kits)

    @property
    def devices(self) -> tuple[str, ...]:
        """The kits that are connected, by their names, in the order in which they came."""
        return tuple(self._kits)

    def wake(self) -> None:
        """Have an engine: another one where the last has died. Raises `DeviceError`."""
        if self._resting is not None:
            self._resting.join()
            self._resting = None
        if not self.alive:
            self._engine, self.alive, self.sound = self._wake(), True, _WAKING
            for command in self._standing.values():
                self.send(command)

    def rest(self) -> list[str]:
        """Let the engine end, so that others can have its devices, until it is woken; returns the kits that were here.

        It may take seconds where a sound server hangs: a thread waits for it, and `has_rested` says when it is done.
        """
        if self.alive:
            self._resting = Thread(target=self._engine.close, name="engine rests")
            self._resting.start()
        kits, self._kits, self.alive, self.sound = self._kits, [], False, "the engine rests"
        return kits

    def has_rested(self) -> bool:
        """Whether no engine that ends still holds a device."""
        return self._resting is None or not self._resting.is_alive()

    def stand(self, command: Command) -> None:
        """Send what holds for this engine and every later one; a dead engine gets it when it has been woken."""
        match command:
            case SetLevel(bus):
                self._standing[bus] = command
            case SetPiece(piece):
                self._standing[SetPiece, piece] = command
            case _:
                self._standing[type(command)] = command
        if self.alive:
            self.send(command)

    def forward(self, command: Command) -> None:
        """Send a command; what later engines need too stands. Raises `DeviceError` as `send`."""
        self.stand(command) if isinstance(command, Watch | SetAirDrums) else self.send(command)

    def send(self, command: Command) -> None:
        """Hand the engine a command; raises `DeviceError` where it has ended."""
        if not self.alive:
            raise DeviceError(self.sound)
        self._engine.send(command)
        self.flash.sent(command)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What has happened since the last call, nothing from a dead engine; its death is raised once."""
        if not self.alive:
            return []
        try:
            events = self._engine.events(wait_s)
        except DeviceError:
            self.alive, self.sound, self._kits = False, DEAD, []
            raise
        for event in events:
            self._handle(event)
        return events

    def _handle(self, event: EngineEvent) -> None:
        self.flash.handle(event)
        match event:
            case DeviceFound(_, device):
                self._kits = [*(kit for kit in self._kits if kit != device), device]
            case DeviceLost(_, device):
                self._kits = [kit for kit in self._kits if kit != device]
            case Hit(at_ns):
                self.struck_ns = at_ns
            case Ready(output, rate_hz) | Sounding(output, rate_hz):
                self.sound = output or SILENT
                self.rate_hz = rate_hz or self.rate_hz
            case _:
                pass
