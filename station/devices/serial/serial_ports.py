"""Serial ports: raw MIDI of home-built modules, and motion sensors; the only user of pyserial.

MIDI is 31,250 baud (MIDI 1.0 Electrical Specification), no standard rate of serial ports: pyserial sets it through the
system's own call. USB adapters hold bytes back for up to 16 ms to fill a packet (FTDI's latency timer) unless they are
told not to, so they are, where the system lets us.

Reading never waits. Bytes of MIDI are stamped one by one, by the moment of reading and by what the wire allows
(`driver_clocks.WireClock`). A sensor sends so many that they stay together as they were read, stamped with that moment:
its samples get their times later, by all that came (`imu.sample_clock`).
"""

import errno
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import serial
from serial.tools import list_ports

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.devices.driver_clocks import WireClock
from station.devices.serial.serial_names import SERIAL, device_of_port, serial_port
from station.devices.transport import Packet

MIDI_BAUD = 31_250
SLOWEST_BAUD, FASTEST_BAUD = 300, 4_000_000
"""What adapters on sale can do (FTDI and Silicon Labs data sheets, rounded outwards)."""

_NAMELESS = ("", "n/a")
_BUSY = (errno.EAGAIN, errno.EBUSY, errno.EACCES if sys.platform == "win32" else errno.EBUSY)

MonotonicNs = Callable[[], int]


@dataclass(frozen=True, slots=True)
class SerialAddress:
    """A serial port that is there: its `path` and the `title` of what it belongs to, empty where nobody says."""

    path: str
    title: str = ""

    @property
    def port(self) -> str:
        """The port's name in a list of ports."""
        return serial_port(self.path, self.title)


def no_access(path: str) -> str | None:
    """What to do where this user may not use the port at `path`; None where he may."""
    if sys.platform == "win32" or not Path(path).exists() or os.access(path, os.R_OK | os.W_OK):
        return None
    return f"permission denied; sudo usermod -aG {_group_of(path)} $USER, then log in again"


class SerialDirectory:
    """The serial ports of this computer, and the one at `asked` even where the system does not list it."""

    def __init__(
        self, baud: int = MIDI_BAUD, asked: str = "", now_ns: MonotonicNs = monotonic_ns, *, in_chunks: bool = False
    ) -> None:
        """`in_chunks` for sensors: bytes that were read together are one packet."""
        self._in_chunks = in_chunks
        self._baud = baud
        self._asked = asked
        self._now_ns = now_ns
        self._nodes: frozenset[str] = frozenset()
        self._listed: list[SerialAddress] = []

    def addresses(self) -> list[SerialAddress]:
        """The ports that are there now, in the order of their paths."""
        nodes = _device_nodes()
        if nodes is None or nodes != self._nodes:  # asking the system takes milliseconds, a look at the names does not
            self._nodes = nodes or frozenset()
            self._listed = sorted(map(_address, list_ports.comports()), key=lambda address: address.path)
        if self._asked and all(address.path != self._asked for address in self._listed) and Path(self._asked).exists():
            return [*self._listed, SerialAddress(self._asked)]
        return self._listed

    def names(self) -> list[str]:
        """The ports that are there now."""
        return [address.port for address in self.addresses()]

    def open(self, port: str) -> "SerialPort":
        """Open one of `names()`; raises `DeviceError` that says what to do where it cannot be had."""
        path = port.rpartition(SERIAL)[2]
        try:
            line = serial.Serial(path, self._baud, timeout=0, exclusive=None if sys.platform == "win32" else True)
        except (OSError, ValueError) as fault:
            raise DeviceError(f"{port}: {_why_not(path, fault)}") from fault
        with suppress(OSError, ValueError, AttributeError, NotImplementedError):  # a pty, or not Linux
            line.set_low_latency_mode(True)
        clock = None if self._in_chunks else WireClock(self._baud, self._now_ns())
        return SerialPort(device_of_port(port), line, clock, self._now_ns)


class SerialPort:
    """One open serial port; `clock` stamps byte by byte, None where what was read together stays together."""

    def __init__(self, name: str, line: serial.Serial, clock: WireClock | None, now_ns: MonotonicNs) -> None:
        self._name = name
        self._line: serial.Serial | None = line
        self._now_ns = now_ns
        self._clock = clock

    @property
    def name(self) -> str:
        """The adapter's name, or `serial:PATH` where it has none."""
        return self._name

    def read(self) -> list[Packet]:
        """The bytes since the last call; raises `DeviceError` where the port has gone."""
        if self._line is None:
            return []
        polled_ns = self._now_ns()
        try:
            waiting = self._line.in_waiting
            data = self._line.read(waiting) if waiting else b""
        except OSError as fault:
            raise DeviceError(f"{self._name}: the serial port has gone: {fault}") from fault
        if self._clock is None:
            return [Packet(data, self._now_ns())] if data else []
        times_ns = self._clock.stamp(len(data), polled_ns, self._now_ns())
        return [Packet(data[index : index + 1], at_ns) for index, at_ns in enumerate(times_ns)]

    def write(self, data: bytes) -> None:
        """Send `data`, such as a sensor's settings; raises `DeviceError` where the port has gone."""
        if self._line is None:
            raise DeviceError(f"{self._name}: the serial port is closed")
        try:
            self._line.write(data)
            self._line.flush()
        except OSError as fault:
            raise DeviceError(f"{self._name}: the serial port has gone: {fault}") from fault

    def close(self) -> None:
        """End the connection; a closed port reads as empty."""
        if self._line is not None:
            with suppress(OSError):  # it has gone already
                self._line.close()
            self._line = None


def _device_nodes() -> frozenset[str] | None:
    """The names that change when a port comes or goes; None where this system has no such names."""
    if sys.platform == "win32":
        return None
    return frozenset(name for name in os.listdir("/dev") if name.startswith(("tty", "rfcomm", "cu.")))  # noqa: PTH208 - twice as fast


def _address(found: "list_ports.ListPortInfo") -> SerialAddress:
    words = [found.description, found.serial_number] if found.description not in _NAMELESS else []
    return SerialAddress(found.device, " ".join(word for word in words if word and word not in found.device))


def _why_not(path: str, fault: Exception) -> str:
    denied = no_access(path)
    if denied is not None:
        return denied
    if getattr(fault, "errno", None) in _BUSY or isinstance(fault, PermissionError):
        return "another program has this serial port open"
    if not Path(path).exists() and sys.platform != "win32":
        return "there is no such serial port"
    if getattr(fault.__context__, "args", ())[:1] == (errno.ENOTTY,):  # how pyserial says it
        return "this is no serial port"
    return f"this serial port cannot be opened: {fault}"


def _group_of(path: str) -> str:
    """The group that may use the port; `dialout` on Debian, `uucp` on Arch."""
    try:
        return Path(path).group()
    except (OSError, KeyError, NotImplementedError):
        return "dialout"
