"""All ports at which a kit may be (MIDI, game drums, serial) in one list, and the word with which a user asks for one.

    KIT = PART | PART@BAUD | serial:PATH | serial:PATH@BAUD          KITS = KIT; KIT; …

PART is part of a port's name in any case of letters, empty for the first MIDI kit found or, without one, the first game
drums. A serial port is never opened unless it is asked for: there may be a motion sensor, a modem or a robot behind it.
A foot switch is no kit: it is heard where it is asked for, beside a kit.
"""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from station.core.clock import monotonic_ns
from station.core.counts import is_count
from station.core.errors import BadInput, DeviceError
from station.devices.hid.hid_names import HID
from station.devices.hid.hid_ports import HidDirectory
from station.devices.mapping.presets import stable_name
from station.devices.midi.midi_clients import SoundServer
from station.devices.midi.midi_ports import MidiDirectory
from station.devices.port_watch import ClaimedPorts, PortWatch, choose_port
from station.devices.serial.serial_names import SERIAL, device_of_port
from station.devices.serial.serial_ports import FASTEST_BAUD, MIDI_BAUD, SLOWEST_BAUD, SerialDirectory
from station.devices.transport import PortDirectory, Transport

BETWEEN_DEVICES = ";"
"""Stands between several kits in the settings: no driver puts one into a port's name."""

_BAUD = re.compile(r"(.*)@(\d+)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class DeviceRequest:
    """A kit that a user asks for: `part` of its port's name, and the `baud` at which to open it if it is serial."""

    part: str
    baud: int = MIDI_BAUD

    @property
    def path(self) -> str:
        """The path of a serial port, empty where none is asked for by its path."""
        return self.part.removeprefix(SERIAL) if self.part.startswith(SERIAL) else ""


def parse_device(text: str, baud: int = MIDI_BAUD) -> DeviceRequest:
    """The request that `text` spells; at `baud` where it says none. Raises `BadInput` for a rate that no port has."""
    request = text.strip()
    rated = _BAUD.fullmatch(request)
    if rated is None:
        if request.startswith(SERIAL) and "@" in request:
            raise BadInput(f"kit {request}", "", "expected serial:PATH@BAUD, such as serial:/dev/ttyUSB0@115200")
        return DeviceRequest(request, baud)
    baud = int(rated[2]) if is_count(rated[2]) else 0
    if not SLOWEST_BAUD <= baud <= FASTEST_BAUD:
        raise BadInput(f"kit {request}", "", f"{rated[2]} baud: expected {SLOWEST_BAUD} to {FASTEST_BAUD}")
    return DeviceRequest(rated[1], baud)


def parse_devices(text: str) -> tuple[DeviceRequest, ...]:
    """All the requests in `text`; one for any kit counts only alone. Raises `BadInput` as `parse_device` does."""
    return tuple(parse_device(part) for part in text.split(BETWEEN_DEVICES) if part.strip()) or (DeviceRequest(""),)


class DevicePorts:
    """MIDI ports, HID devices and serial ports in one list.

    `midi` is None where no MIDI driver works, `serial` where serial ports are not to be opened.
    """

    def __init__(self, midi: PortDirectory | None, serial: SerialDirectory | None, hid: PortDirectory) -> None:
        self._midi = midi
        self._serial = serial
        self._hid = hid

    def names(self) -> list[str]:
        """The ports that are there now, MIDI before HID before serial."""
        kinds = (self._midi, self._hid, self._serial)
        return [name for kind in kinds if kind is not None for name in kind.names()]

    def open(self, port: str) -> Transport:
        """Open one of `names()`; raises `DeviceError` where it cannot be had."""
        if HID in port:
            return self._hid.open(port)
        if SERIAL in port and self._serial is not None:
            return self._serial.open(port)
        if self._midi is None:
            raise DeviceError(f"{port}: no MIDI driver works")
        return self._midi.open(port)


def ports_for(request: DeviceRequest, midi: PortDirectory | None, hid: PortDirectory | None = None) -> PortDirectory:
    """Where to look for the kit that is asked for: not on serial ports unless it has a name.

    `hid` are the HID devices, None for those of this computer.
    """
    serial = SerialDirectory(request.baud, request.path) if request.part else None
    if serial is not None and request.path:
        return serial
    return DevicePorts(midi, serial, HidDirectory() if hid is None else hid)


@dataclass(frozen=True, slots=True)
class Watches:
    """The watches over the kits that were asked for, and the `fault` of a MIDI driver that one of them would need.

    `midi` are the MIDI ports among which they look, None where there are none.
    """

    kits: tuple[PortWatch, ...]
    fault: str | None = None
    midi: MidiDirectory | None = None

    def close(self) -> None:
        """Leave every kit, then the driver: JACK's server waits for a client that ends without a word."""
        for kit in self.kits:
            kit.close()
        if self.midi is not None:
            self.midi.close()


def watch_devices(
    requests: tuple[DeviceRequest, ...],
    driver: str = "auto",
    now_ns: Callable[[], int] = monotonic_ns,
    sound: SoundServer | None = None,
    claims: ClaimedPorts | None = None,
) -> Watches:
    """A watch for each request, each with a port of its own; without a MIDI driver other ports are heard all the same.

    Raises `BadInput` for a driver that there is not. `claims` are shared with other watches of the station; the other
    parameters stand as in `MidiDirectory`.
    """
    midi, fault = None, None
    if any(not request.path for request in requests):
        try:
            midi = MidiDirectory(driver, now_ns, sound)
        except DeviceError as error:
            fault = str(error)
    shared = ClaimedPorts() if claims is None else claims
    heard = [request for request in requests if midi is not None or request.path or _is_elsewhere(request)]
    kits = tuple(PortWatch(ports_for(request, midi), request.part, shared) for request in heard)
    return Watches(kits, fault, midi)


def devices_there(requests: tuple[DeviceRequest, ...]) -> list[str]:
    """The names of the kits that would be opened now, as far as the lists of ports tell."""
    with midi_now() as (midi, _):
        chosen = [choose_port(ports_for(request, midi).names(), request.part) for request in requests]
    return [device_of_port(stable_name(port)) for port in chosen if port is not None]


def no_device(requests: tuple[DeviceRequest, ...]) -> str:
    """What to tell a user none of whose `requests` is there: what was looked for, and which ports there are."""
    with midi_now() as (midi, fault):
        ports = DevicePorts(midi, SerialDirectory(), HidDirectory()).names()
    named = " or ".join(repr(request.part) for request in requests if request.part)
    if not named and fault is not None:
        return f"no kit can be heard: {fault}"
    there = f"these are there: {', '.join(ports)}" if ports else "there is no MIDI port, serial port or game kit"
    needs_midi = any(not request.path for request in requests)
    driverless = " (no MIDI driver works: station doctor says why)" if fault is not None and needs_midi else ""
    return f"{f'no port is called {named}' if named else 'no MIDI kit is plugged in'}; {there}{driverless}"


@contextmanager
def midi_now() -> Iterator[tuple[MidiDirectory | None, str | None]]:
    """The MIDI ports for a look at them, or why there are none; JACK's server waits for clients that never leave."""
    try:
        midi = MidiDirectory()
    except DeviceError as fault:
        yield None, str(fault)
        return
    try:
        yield midi, None
    finally:
        midi.close()


def _is_elsewhere(request: DeviceRequest) -> bool:
    """Whether what is asked for is there, and no MIDI port."""
    return choose_port(ports_for(request, None).names(), request.part) is not None
