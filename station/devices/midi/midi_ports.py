"""MIDI ports through rtmidi: ALSA, JACK, CoreMIDI, Windows.

Messages are polled, never taken in rtmidi's callback: beside a busy Python thread a callback waits for the interpreter
lock inside the driver's thread, which loses notes. Nothing is filtered: a message carries the time since the one before
it, be that active sensing or clock, and a capture holds every byte.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext

import rtmidi

from station.core.clock import monotonic_ns
from station.core.errors import BadInput, DeviceError
from station.devices.driver_clocks import DriverClock
from station.devices.mapping.presets import stable_name
from station.devices.midi.midi_clients import CLIENT_NAME, NoSoundServer, SoundServer, compiled_drivers, first_client
from station.devices.transport import Packet

MonotonicNs = Callable[[], int]


class MidiDirectory:
    """The MIDI inputs of this computer, by the first driver that works or by the one that is asked for.

    Raises `BadInput` for a driver that there is not, `DeviceError` where none works.
    """

    def __init__(
        self, driver: str = "auto", now_ns: MonotonicNs = monotonic_ns, sound: SoundServer | None = None
    ) -> None:
        compiled = compiled_drivers()
        if driver not in ("auto", *compiled):
            raise BadInput(driver, "", f"no such MIDI driver here; there are auto, {', '.join(compiled)}")
        self._now_ns = now_ns
        self._sound: SoundServer = NoSoundServer() if sound is None else sound
        self._client = first_client(compiled if driver == "auto" else (driver,), now_ns(), self._sound)

    @property
    def driver(self) -> str:
        """The driver in use, one of `compiled_drivers()`."""
        return self._client.driver

    def names(self) -> list[str]:
        """The inputs that are there now, our own left out; none where the driver's server has gone."""
        if not self._client.is_alive(self._now_ns()):
            return []
        return [port for port in self._client.ports() if CLIENT_NAME not in port]

    def open(self, port: str) -> "MidiPort":
        """Open the input called `port`; raises `DeviceError` where it has gone or is taken."""
        with self._disturbing():
            try:
                connection = self._client.connect(port)
            except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
                raise DeviceError(f"{port}: this MIDI port cannot be opened: {fault}") from fault
        return MidiPort(stable_name(port), connection, self._now_ns, self._leave)

    def close(self) -> None:
        """Leave the driver; ports that were opened stay open."""
        with self._disturbing():
            self._client.close()

    def _leave(self, connection: rtmidi.MidiIn) -> None:
        with self._disturbing():
            self._client.disconnect(connection)

    def _disturbing(self) -> AbstractContextManager[None]:
        return self._sound.paused() if self.driver == "jack" else nullcontext()


class MidiPort:
    """One open MIDI input."""

    def __init__(
        self, name: str, connection: rtmidi.MidiIn, now_ns: MonotonicNs, leave: Callable[[rtmidi.MidiIn], None]
    ) -> None:
        self._name = name
        self._connection: rtmidi.MidiIn | None = connection
        self._now_ns = now_ns
        self._leave = leave
        self._clock = DriverClock()
        self._polled_ns = now_ns()

    @property
    def name(self) -> str:
        """The port's name, the same after it is unplugged and plugged in again."""
        return self._name

    def read(self) -> list[Packet]:
        """The messages since the last call, each with the driver's own time moved to session time."""
        messages: list[bytes] = []
        found: list[tuple[float, int]] = []
        emptied_ns, self._polled_ns = self._polled_ns, self._now_ns()
        while self._connection is not None:
            item = self._connection.get_message()
            if item is None:
                break
            message, delta_s = item
            messages.append(bytes(message))
            found.append((delta_s, self._now_ns()))
        if not messages:
            return []
        return [Packet(*pair) for pair in zip(messages, self._clock.stamps(found, emptied_ns), strict=True)]

    def close(self) -> None:
        """End the connection; a closed port reads as empty."""
        if self._connection is not None:
            self._leave(self._connection)
            self._connection = None
