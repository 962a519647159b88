"""MIDI ports through rtmidi: ALSA, JACK, CoreMIDI, Windows; the only module that knows rtmidi.

Messages are polled, never taken in rtmidi's callback: beside a busy Python thread a callback waits for the interpreter
lock inside the driver's thread, which loses notes. Nothing is filtered: a message carries the time since the one before
it, be that active sensing or clock, and a capture holds every byte.

rtmidi keeps Python's interpreter lock while it opens or closes. JACK then waits until every client has finished a
period, and a sound callback in this process cannot finish one without that lock: so whatever changes JACK's graph
happens inside `undisturbed`, in which the caller keeps its sound still.

Without a sequencer device (a container, a kernel without ALSA) rtmidi's ALSA fails; then JACK is tried where this
rtmidi has it. Drivers write to standard error of their own accord; it is closed to them while they start.
"""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from itertools import count

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


def compiled_drivers() -> tuple[str, ...]:
    """The drivers that this rtmidi was built with, in the order in which they are tried."""
    compiled = rtmidi.get_compiled_api()
    return tuple(name for name, api in _APIS.items() if api in compiled)


class MidiDirectory:
    """The MIDI inputs of this computer, by the first driver that works or by the one that is asked for.

    Raises `BadInput` for a driver that there is not, `DeviceError` where none works. `undisturbed` is entered around
    all that a sound callback in this process could hold up.
    """

    def __init__(
        self, driver: str = "auto", now_ns: MonotonicNs = monotonic_ns, undisturbed: Undisturbed = nullcontext
    ) -> None:
        compiled = compiled_drivers()
        if driver not in ("auto", *compiled):
            raise BadInput(driver, "", f"no such MIDI driver here; there are auto, {', '.join(compiled)}")
        self._now_ns = now_ns
        self._undisturbed = undisturbed
        self._client = _first_client(compiled if driver == "auto" else (driver,))

    @property
    def driver(self) -> str:
        """The driver in use, one of `compiled_drivers()`."""
        return self._client.driver

    def names(self) -> list[str]:
        """The inputs that are there now; none where the driver's server has gone."""
        return self._client.ports() if self._client.is_alive(self._now_ns()) else []

    def open(self, port: str) -> "MidiPort":
        """Open the input called `port`; raises `DeviceError` where it has gone or is taken."""
        with self._disturbing():
            try:
                connection = _new_input(self.driver, "kit")
                connection.open_port(connection.get_ports().index(port), "in")
            except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
                raise DeviceError(f"{port}: this MIDI port cannot be opened: {fault}") from fault
        return MidiPort(stable_name(port), connection, self._now_ns, self._disturbing)

    def close(self) -> None:
        """Leave the driver; ports that were opened stay open."""
        with self._disturbing():
            self._client.close()

    def _disturbing(self) -> AbstractContextManager[None]:
        return self._undisturbed() if self.driver == "jack" else nullcontext()


class _Client:
    """What lists the ports of one driver.

    A JACK client goes on seeing its old ports when its server has ended. So it sends itself a message through the
    server, one at a time: while they come back, the server lives. It listens to no heart but its own: another station's
    stops when that station leaves. A process that has lost its server cannot safely join
    another (the library keeps one server's memory a process), so a lost server stays lost for this process.
    """

    def __init__(self, driver: str) -> None:
        self.driver = driver
        self._scanner = _new_input(driver, "scan")
        self._heart: rtmidi.MidiOut | None = None
        self._beat_ns: int | None = None
        if driver == "jack":
            with _quiet_drivers():
                name = f"{CLIENT_NAME} {os.getpid()}.{next(_HEARTS)}"
                self._heart = rtmidi.MidiOut(_APIS[driver], name)
                self._heart.open_virtual_port("out")
                self._scanner.open_port(self._scanner.get_ports().index(f"{name}:out"), "presence")

    def is_alive(self, now_ns: int) -> bool:
        """Whether the server that was joined still runs; drivers without one always live."""
        if self._heart is None:
            return True
        while self._scanner.get_message() is not None:
            self._beat_ns = None
        if self._beat_ns is None:
            self._heart.send_message(_ACTIVE_SENSING)
            self._beat_ns = now_ns
        return now_ns - self._beat_ns < SILENT_SERVER_NS

    def ports(self) -> list[str]:
        """The inputs, our own left out."""
        return [port for port in self._all_ports() if CLIENT_NAME not in port]

    def _all_ports(self) -> list[str]:
        try:
            ports: list[str] = self._scanner.get_ports()
        except (rtmidi.RtMidiError, UnicodeDecodeError):
            return []
        return ports

    def close(self) -> None:
        """Leave the driver."""
        self._scanner.close_port()
        self._scanner.delete()
        if self._heart is not None:
            self._heart.close_port()
            self._heart.delete()


def _first_client(drivers: tuple[str, ...]) -> _Client:
    faults: list[str] = []
    for driver in drivers:
        try:
            return _Client(driver)
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            faults.append(f"{_TITLES[driver]}: {_REMEDIES.get(driver, fault)}")
    raise DeviceError("no MIDI driver works. " + ". ".join(faults or ["rtmidi was built without any"]))


class MidiPort:
    """One open MIDI input."""

    def __init__(
        self, name: str, connection: rtmidi.MidiIn, now_ns: MonotonicNs, disturbing: Undisturbed = nullcontext
    ) -> None:
        self._name = name
        self._connection: rtmidi.MidiIn | None = connection
        self._now_ns = now_ns
        self._disturbing = disturbing
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
            with self._disturbing():
                self._connection.close_port()
                self._connection.delete()
            self._connection = None


def _new_input(driver: str, role: str) -> rtmidi.MidiIn:
    with _quiet_drivers():
        connection = rtmidi.MidiIn(_APIS[driver], f"{CLIENT_NAME} {role}", QUEUE_MESSAGES)
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
