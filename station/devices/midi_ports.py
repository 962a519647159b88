"""MIDI ports through rtmidi: ALSA, JACK, CoreMIDI, Windows; the only module that knows rtmidi.

Messages are polled, never taken in rtmidi's callback: beside a busy Python thread a callback waits for the interpreter
lock inside the driver's thread, which loses notes. Nothing is filtered: a message carries the time since the one before
it, be that active sensing or clock, and a capture holds every byte.

Without a sequencer device (a container, a kernel without ALSA) rtmidi's ALSA fails; then JACK is tried where this
rtmidi has it. Drivers write to standard error of their own accord; it is closed to them while they start.
"""

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

import rtmidi

from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_S
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

RECONNECT_NS = 2 * NS_PER_S
"""How often a JACK client that sees no port asks for a new server: joining one disturbs it a little (our choice)."""

MonotonicNs = Callable[[], int]


def compiled_drivers() -> tuple[str, ...]:
    """The drivers that this rtmidi was built with, in the order in which they are tried."""
    compiled = rtmidi.get_compiled_api()
    return tuple(name for name, api in _APIS.items() if api in compiled)


class MidiDirectory:
    """The MIDI inputs of this computer, by the first driver that works or by the one that is asked for."""

    def __init__(self, driver: str = "auto", now_ns: MonotonicNs = time.monotonic_ns) -> None:
        """Raises `BadInput` for a driver that there is not, `DeviceError` where none works."""
        compiled = compiled_drivers()
        if driver not in ("auto", *compiled):
            raise BadInput(driver, "", f"no such MIDI driver here; there are auto, {', '.join(compiled)}")
        self._now_ns = now_ns
        self._candidates = compiled if driver == "auto" else (driver,)
        self._scanner, self.driver = self._start_scanner()
        self._joined_ns = now_ns()

    def _start_scanner(self) -> tuple[rtmidi.MidiIn, str]:
        faults: list[str] = []
        for driver in self._candidates:
            try:
                return _new_input(driver, "scan"), driver
            except (rtmidi.RtMidiError, OSError, RuntimeError) as fault:
                faults.append(f"{_TITLES[driver]}: {_REMEDIES.get(driver, fault)}")
        raise DeviceError("no MIDI driver works. " + ". ".join(faults or ["rtmidi was built without any"]))

    def names(self) -> list[str]:
        """The inputs that are there now; none where the driver's server has gone."""
        ports = self._ports()
        if not ports and self.driver == "jack" and self._now_ns() - self._joined_ns > RECONNECT_NS:
            self._joined_ns = self._now_ns()
            with suppress(DeviceError):  # a client does not outlive its server: perhaps there is a new one
                fresh, self.driver = self._start_scanner()
                self._scanner.delete()
                self._scanner = fresh
                ports = self._ports()
        return ports

    def _ports(self) -> list[str]:
        try:
            return [port for port in self._scanner.get_ports() if CLIENT_NAME not in port]
        except (rtmidi.RtMidiError, UnicodeDecodeError):
            return []

    def open(self, port: str) -> "MidiPort":
        """Open the input called `port`; raises `DeviceError` where it has gone or is taken."""
        try:
            connection = _new_input(self.driver, "kit")
            index = connection.get_ports().index(port)
            with _quiet_drivers():
                connection.open_port(index, "in")
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            raise DeviceError(f"{port}: this MIDI port cannot be opened: {fault}") from fault
        return MidiPort(stable_name(port), connection, self._now_ns)

    def close(self) -> None:
        """Leave the driver; ports that were opened stay open."""
        self._scanner.delete()


class MidiPort:
    """One open MIDI input."""

    def __init__(self, name: str, connection: rtmidi.MidiIn, now_ns: MonotonicNs) -> None:
        self._name = name
        self._connection: rtmidi.MidiIn | None = connection
        self._now_ns = now_ns
        self._clock = DriverClock()

    @property
    def name(self) -> str:
        """The port's name, the same after it is unplugged and plugged in again."""
        return self._name

    def read(self) -> list[Packet]:
        """The messages since the last call, each with the driver's own time moved to session time."""
        packets: list[Packet] = []
        while self._connection is not None:
            item = self._connection.get_message()
            if item is None:
                break
            message, delta_s = item
            packets.append(Packet(bytes(message), self._clock.stamp(delta_s, self._now_ns())))
        return packets

    def close(self) -> None:
        """End the connection; a closed port reads as empty."""
        if self._connection is not None:
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
