"""The clients that rtmidi gives this process of each driver: what lists the ports, and what connects to them.

rtmidi keeps Python's interpreter lock while it opens or closes. JACK then waits until every client has finished a
period, and a sound callback in this process cannot finish one without that lock: so whatever changes JACK's graph
happens while the process's own `SoundServer` is paused.

Each rtmidi object is a client of its own on JACK's server, and when a process is killed the server waits out its
time-limit (½ s by default) for all but one of its clients, and lets nobody join meanwhile. So there are as few as can
be: the client that lists the ports hears the first kit as well, and one that tells whether the server lives is there
only where no sound tells it.

Without a sequencer device (a container, a kernel without ALSA) rtmidi's ALSA fails; then JACK is tried where this
rtmidi has it. Drivers write to standard error of their own accord; it is closed to them while they start.
"""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from itertools import count
from typing import Protocol

import rtmidi

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS

CLIENT_NAME = "drum station"
QUEUE_MESSAGES = 16_384
"""How many messages rtmidi keeps for us between two polls: 16 s of a flood of 1,000 a second."""

APIS = {
    "alsa": rtmidi.API_LINUX_ALSA,
    "jack": rtmidi.API_UNIX_JACK,
    "coremidi": rtmidi.API_MACOSX_CORE,
    "windows": rtmidi.API_WINDOWS_MM,
}
_SYSTEM_DRIVERS = {"linux": ("alsa", "jack"), "darwin": ("coremidi",), "win32": ("windows",)}
"""The drivers that rtmidi's own wheels have, by Python's name of the system."""
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


class SoundServer(Protocol):
    """What this process sounds by, maybe on the server that its MIDI ports are on."""

    def paused(self) -> AbstractContextManager[None]:
        """Keeps still every callback that could wait for the interpreter lock."""
        ...

    def server_lives(self) -> bool | None:
        """Whether the JACK server that plays the sound runs; None where none plays it."""
        ...


class NoSoundServer:
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
    return tuple(name for name, api in APIS.items() if api in compiled)


def lacking_drivers() -> tuple[str, ...]:
    """The drivers of this system that this rtmidi was built without: their headers were not there."""
    compiled = compiled_drivers()
    return tuple(name for name in _SYSTEM_DRIVERS.get(sys.platform, ()) if name not in compiled)


class DriverClient:
    """What lists the ports of one driver and connects to them.

    A JACK client goes on seeing its old ports when its server has ended. A process that has lost its server cannot
    safely join another (the library keeps one server's memory a process), so a lost server stays lost for it.
    """

    def __init__(self, driver: str, now_ns: int, sound: SoundServer) -> None:
        self.driver = driver
        self._joined_ns = now_ns
        self._sound = sound
        self._lister = new_input(driver)
        self._lister_is_free = driver == "jack"
        self._is_closed = False
        self._watchdog = _Watchdog() if driver == "jack" and isinstance(sound, NoSoundServer) else None

    def is_alive(self, now_ns: int) -> bool:
        """Whether the server that was joined still runs; drivers without one always live."""
        if self.driver != "jack":
            return True
        if self._watchdog is None:
            lives = self._sound.server_lives()
            if lives is not None or now_ns - self._joined_ns < SILENT_SERVER_NS:  # the sound begins after the kits
                return lives is not False
            with self._sound.paused():
                self._watchdog = _Watchdog()
        return self._watchdog.beats(now_ns)

    def ports(self) -> list[str]:
        """The inputs, each with a name of its own, in the driver's order."""
        try:
            return numbered(self._lister.get_ports())
        except rtmidi.RtMidiError:  # one has gone since they were counted
            return []

    def connect(self, port: str) -> rtmidi.MidiIn:
        """An input that hears `port`; raises what rtmidi raises, `ValueError` where there is none of that name."""
        number = self.ports().index(port)
        connection = self._lister if self._lister_is_free else new_input(self.driver)
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
        if self._watchdog is not None:
            self._watchdog.close()


class _Watchdog:
    """Tells whether the JACK server that was joined still runs: a message to itself through it, one at a time.

    It listens to no heart but its own: another station's stops when that station leaves.
    """

    def __init__(self) -> None:
        with quiet_drivers():
            name = f"{CLIENT_NAME} {os.getpid()}.{next(_HEARTS)}"
            self._out = rtmidi.MidiOut(APIS["jack"], name)
        self._out.open_virtual_port("out")
        self._in = new_input("jack")
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


def first_client(drivers: tuple[str, ...], now_ns: int, sound: SoundServer) -> DriverClient:
    """A client of the first of `drivers` that works; raises `DeviceError` that says of each why it does not."""
    faults: list[str] = []
    for driver in drivers:
        try:
            return DriverClient(driver, now_ns, sound)
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            faults.append(why_not(driver, fault))
    raise DeviceError("no MIDI driver works. " + ". ".join(faults or ["rtmidi was built without any"]))


def why_not(driver: str, fault: Exception) -> str:
    """What to do about a `driver` that does not work, `fault` where we know no better."""
    return f"{_TITLES[driver]}: {_REMEDIES.get(driver, fault)}"


def new_input(driver: str) -> rtmidi.MidiIn:
    """An input of `driver`, connected to nothing, which will pass on all that comes."""
    with quiet_drivers():
        connection = rtmidi.MidiIn(APIS[driver], f"{CLIENT_NAME} kit", QUEUE_MESSAGES)
    connection.ignore_types(sysex=False, timing=False, active_sense=False)
    return connection


@contextmanager
def quiet_drivers() -> Iterator[None]:
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
