"""MIDI ports through rtmidi: ALSA, JACK, CoreMIDI, Windows; the only module that knows rtmidi.

Messages are polled, never taken in rtmidi's callback: beside a busy Python thread a callback waits for the interpreter
lock inside the driver's thread, which loses notes. Nothing is filtered: a message carries the time since the one before
it, be that active sensing or clock, and a capture holds every byte.

rtmidi keeps Python's interpreter lock while it opens or closes. JACK then waits until every client has finished a
period, and a sound callback in this process cannot finish one without that lock: so whatever changes JACK's graph
happens while the process's own `Sound` is paused.

Each rtmidi object is a client of its own on JACK's server, and when a process is killed the server waits out its
time-limit (½ s by default) for each of its clients, and lets nobody join meanwhile. So there are as few as can be: the
client that lists the ports hears the first kit as well, and one that tells whether the server lives is there only where
no sound tells it.

Without a sequencer device (a container, a kernel without ALSA) rtmidi's ALSA fails; then JACK is tried where this
rtmidi has it. Drivers write to standard error of their own accord; it is closed to them while they start.
"""

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from itertools import count
from typing import Protocol

import rtmidi

from station.core.clock import monotonic_ns
from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_MS
from station.devices.presets import stable_name
from station.devices.stamps import DriverClock
from station.devices.transport import Packet

CLIENT_NAME = "drum station"
QUEUE_MESSAGES = 16_384
"""How many messages rtmidi keeps for us between two polls: 16 s of a flood of 1,000 a second."""

_APIS = {
    "alsa": rtmidi.API_LINUX_ALSA,
    "jack": rtmidi.API_UNIX_JACK,
    "coremidi": rtmidi.API_MACOSX_CORE,
    "windows": rtmidi.API_WINDOWS_MM,
}
_TITLES = {"alsa": "ALSA", "jack": "JACK", "coremidi": "CoreMIDI", "windows": "Windows MIDI"}
_REMEDIES = {
    "alsa": "/dev/snd/seq cannot be opened: sudo modprobe snd-seq, and be in the group audio",
    "jack": "no JACK server runs: start one (jackd, QjackCtl)",
}

SILENT_SERVER_NS = 1_500 * NS_PER_MS
"""A server that has passed no message on for so long has ended (our choice: far above any stall seen)."""
_ACTIVE_SENSING = (0xFE,)
_HEARTS = count(1)
"""Numbers the hearts of this process; with the process's own number each has a name of its own on the server."""

MonotonicNs = Callable[[], int]
Undisturbed = Callable[[], AbstractContextManager[None]]


class Sound(Protocol):
    """What this process sounds by, maybe on the server that its MIDI ports are on."""

    def paused(self) -> AbstractContextManager[None]:
        """Keeps still every callback that could wait for the interpreter lock."""
        ...

    def server_lives(self) -> bool | None:
        """Whether the JACK server that plays the sound runs; None where none plays it."""
        ...


class NoSound:
    """For a process that makes none."""

    def paused(self) -> AbstractContextManager[None]:
        """There is nothing to keep still."""
        return nullcontext()

    def server_lives(self) -> bool | None:
        """Nothing tells."""
        return None


def compiled_drivers() -> tuple[str, ...]:
    """The drivers that this rtmidi was built with, in the order in which they are tried."""
    compiled = rtmidi.get_compiled_api()
    return tuple(name for name, api in _APIS.items() if api in compiled)


class MidiDirectory:
    """The MIDI inputs of this computer, by the first driver that works or by the one that is asked for.

    Raises `BadInput` for a driver that there is not, `DeviceError` where none works.
    """

    def __init__(self, driver: str = "auto", now_ns: MonotonicNs = monotonic_ns, sound: Sound | None = None) -> None:
        compiled = compiled_drivers()
        if driver not in ("auto", *compiled):
            raise BadInput(driver, "", f"no such MIDI driver here; there are auto, {', '.join(compiled)}")
        self._now_ns = now_ns
        self._sound: Sound = NoSound() if sound is None else sound
        self._client = _first_client(compiled if driver == "auto" else (driver,), now_ns(), self._sound)

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


class _Client:
    """What lists the ports of one driver and connects to them.

    A JACK client goes on seeing its old ports when its server has ended. A process that has lost its server cannot
    safely join another (the library keeps one server's memory a process), so a lost server stays lost for it.
    """

    def __init__(self, driver: str, now_ns: int, sound: Sound) -> None:
        self.driver = driver
        self._joined_ns = now_ns
        self._sound = sound
        self._lister = _new_input(driver)
        self._lister_is_free = driver == "jack"
        self._is_closed = False
        self._heart = _Heart() if driver == "jack" and isinstance(sound, NoSound) else None

    def is_alive(self, now_ns: int) -> bool:
        """Whether the server that was joined still runs; drivers without one always live."""
        if self.driver != "jack":
            return True
        if self._heart is None:
            lives = self._sound.server_lives()
            if lives is not None or now_ns - self._joined_ns < SILENT_SERVER_NS:  # the sound begins after the kits
                return lives is not False
            with self._sound.paused():
                self._heart = _Heart()
        return self._heart.beats(now_ns)

    def ports(self) -> list[str]:
        """The inputs, each with a name of its own, in the driver's order."""
        try:
            return numbered(self._lister.get_ports())
        except rtmidi.RtMidiError:  # one has gone since they were counted
            return []

    def connect(self, port: str) -> rtmidi.MidiIn:
        """An input that hears `port`; raises what rtmidi raises, `ValueError` where there is none of that name."""
        number = self.ports().index(port)
        connection = self._lister if self._lister_is_free else _new_input(self.driver)
        while connection.get_message() is not None:  # what the port before it had still to say
            pass
        connection.open_port(number, "in")
        if connection is self._lister:
            self._lister_is_free = False
        return connection

    def disconnect(self, connection: rtmidi.MidiIn) -> None:
        """Hear it no more."""
        connection.close_port()
        if connection is self._lister and not self._is_closed:
            self._lister_is_free = True
        else:
            connection.delete()

    def close(self) -> None:
        """Leave the driver."""
        self._is_closed = True
        if self._lister_is_free or self.driver != "jack":
            self._lister.delete()
        if self._heart is not None:
            self._heart.close()


class _Heart:
    """Tells whether the JACK server that was joined still runs: a message to itself through it, one at a time.

    It listens to no heart but its own: another station's stops when that station leaves.
    """

    def __init__(self) -> None:
        with _quiet_drivers():
            name = f"{CLIENT_NAME} {os.getpid()}.{next(_HEARTS)}"
            self._out = rtmidi.MidiOut(_APIS["jack"], name)
        self._out.open_virtual_port("out")
        self._in = _new_input("jack")
        self._in.open_port(self._in.get_ports().index(f"{name}:out"), "presence")
        self._beat_ns: int | None = None

    def beats(self, now_ns: int) -> bool:
        """Whether the last message came back, or may still."""
        while self._in.get_message() is not None:
            self._beat_ns = None
        if self._beat_ns is None:
            self._out.send_message(_ACTIVE_SENSING)
            self._beat_ns = now_ns
        return now_ns - self._beat_ns < SILENT_SERVER_NS

    def close(self) -> None:
        """Leave the server."""
        for end in (self._in, self._out):
            end.close_port()
            end.delete()


def numbered(names: Iterable[str]) -> list[str]:
    """`names`, of which each that has come before bears its count: not every driver tells two alike devices apart."""
    given: list[str] = []
    for name in names:
        own, count = name, 1
        while own in given:
            count += 1
            own = f"{name} ({count})"
        given.append(own)
    return given


def _first_client(drivers: tuple[str, ...], now_ns: int, sound: Sound) -> _Client:
    faults: list[str] = []
    for driver in drivers:
        try:
            return _Client(driver, now_ns, sound)
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            faults.append(f"{_TITLES[driver]}: {_REMEDIES.get(driver, fault)}")
    raise DeviceError("no MIDI driver works. " + ". ".join(faults or ["rtmidi was built without any"]))


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


def _new_input(driver: str) -> rtmidi.MidiIn:
    with _quiet_drivers():
        connection = rtmidi.MidiIn(_APIS[driver], f"{CLIENT_NAME} kit", QUEUE_MESSAGES)
    connection.ignore_types(sysex=False, timing=False, active_sense=False)
    return connection


@contextmanager
def _quiet_drivers() -> Iterator[None]:
    """Close standard error to the C libraries for a moment: ALSA and JACK print what we say better."""
    if sys.stderr is not None:  # a windowed program on Windows has none
        sys.stderr.flush()
    try:
        kept = os.dup(2)
    except OSError:  # there is no standard error
        yield
        return
    try:
        with open(os.devnull, "wb") as nowhere:  # noqa: PTH123 - the name of no file
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
