"""An engine in this process, on a clock that is moved by hand, with virtual kits to play on."""

from collections.abc import Sequence

from station.core.clock import ManualClock
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.engine.engine import Engine
from station.engine.messages import Command, EngineEvent


class EngineHere:
    """An `EngineLink` (`headless.live`) with the kits called `devices`; time passes where `advance_to` moves it."""

    def __init__(self, devices: Sequence[str]) -> None:
        self._engine, self._clock = Engine(), ManualClock()
        self._engine.advance(self._clock.now_ns())
        for device in devices:
            self._engine.use_preset(device, GENERAL_MIDI_PRESET)
            self._engine.device_found(device, self._clock.now_ns())

    @property
    def now_ns(self) -> int:
        """The session time."""
        return self._clock.now_ns()

    def send(self, command: Command) -> None:
        """Hand the engine a command."""
        self._engine.handle(command)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What has happened since the last call: nothing happens while anybody waits."""
        del wait_s
        return self._engine.advance(self._clock.now_ns())

    def feed(self, device: str, data: bytes, at_ns: int) -> None:
        """Let bytes of `device` come at session time `at_ns`."""
        self._engine.feed(device, data, at_ns)

    def advance_to(self, now_ns: int) -> None:
        """Let the time pass until then; it never goes back."""
        self._clock.advance_to(max(now_ns, self._clock.now_ns()))
