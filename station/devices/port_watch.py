"""Keeps one kit connected: finds its port by part of its name, notices when it goes, opens it again when it comes back.

A kit that vanishes in mid-bar costs nothing but the strokes of the time it is away: the session goes on, told by
`DeviceLost` and `DeviceFound`. Several kits are watched by as many watches, which share their claims: none opens what
another holds, and two modules of one model have names of their own. Pure but for the directory that it is given; time
is what `poll` is told.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS
from station.devices.hid.hid_names import HID
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, preset_for, stable_name
from station.devices.serial.serial_names import SERIAL, device_of_port
from station.devices.transport import Packet, PortDirectory, Transport

SCAN_EVERY_NS = 400 * NS_PER_MS
"""A kit is noticed and opened within 1 s of being plugged in, with room for the driver to announce it (our choice)."""

_NO_KITS = ("midi through", "through port", "midi_playback", "virmidi")
"""Parts of port names behind which no kit sits; they are opened only when asked for by name."""


@dataclass(frozen=True, slots=True)
class PortPoll:
    """What one poll brought: the device's name (empty while there is none), its packets, whether it went or came.

    `fault` says, once, why a port that is there cannot be opened.
    """

    device: str
    packets: list[Packet]
    lost: bool = False
    found: bool = False
    fault: str = ""


_NOTHING = PortPoll("", [])


@dataclass(slots=True)
class ClaimedPorts:
    """What the watches of one station hold: their ports, and the names by which their kits go."""

    ports: set[str] = field(default_factory=set)
    devices: set[str] = field(default_factory=set)

    def claim(self, port: str, name: str) -> str:
        """Hold `port`; returns the kit's name, numbered where another kit has the same."""
        device, count = name, 1
        while device in self.devices:
            count += 1
            device = f"{name} ({count})"
        self.ports.add(port)
        self.devices.add(device)
        return device

    def leave(self, port: str, device: str) -> None:
        """Hold them no longer."""
        self.ports.discard(port)
        self.devices.discard(device)


def choose_port(ports: Iterable[str], wanted: str) -> str | None:
    """The port to open: the first whose name contains `wanted` in any case of letters, one with a path by all of it.

    With `wanted` empty the first of a module that has a preset, else the first behind which a kit may sit, else the
    first game drums.
    """
    names = list(ports)
    if wanted.startswith((SERIAL, HID)):
        return next((name for name in names if name == wanted or name.endswith(f" {wanted}")), None)
    if wanted:
        return next((name for name in names if wanted.lower() in name.lower()), None)
    midi = [name for name in names if SERIAL not in name and HID not in name]
    likely = [name for name in midi if not any(part in name.lower() for part in _NO_KITS)]
    known = [name for name in likely if preset_for(name) is not GENERAL_MIDI_PRESET]
    drums = [name for name in names if HID in name and preset_for(name).notes]
    return next(iter(known or likely or drums), None)


class PortWatch:
    """The connection to one kit, kept up."""

    def __init__(self, directory: PortDirectory, wanted: str = "", claims: ClaimedPorts | None = None) -> None:
        self.wanted = wanted
        self._directory = directory
        self._claims = ClaimedPorts() if claims is None else claims
        self._transport: Transport | None = None
        self._port = ""
        self._plug = ""  # the port's stable name: what it is called when it comes back
        self._device = ""
        self._fault = ""
        self._reported_fault = ""
        self._next_scan_ns: int | None = None

    @property
    def device(self) -> str:
        """The name of the connected kit, empty while there is none."""
        return self._device if self._transport else ""

    def poll(self, now_ns: int) -> PortPoll:
        """What came since the last poll; now and then looks which ports there are."""
        if self._next_scan_ns is None or now_ns >= self._next_scan_ns:
            self._next_scan_ns = now_ns + SCAN_EVERY_NS
            return self._scan()
        if self._transport is None:
            return _NOTHING
        try:
            return PortPoll(self._device, self._transport.read())
        except DeviceError:
            return self._lose([])

    def hear(self) -> PortPoll:
        """What came since the last poll, and nothing else: no port is looked for, opened or given up."""
        if self._transport is None:
            return _NOTHING
        try:
            return PortPoll(self._device, self._transport.read())
        except DeviceError:  # the next poll finds out the same, and says so
            return _NOTHING

    def close(self) -> None:
        """End the connection."""
        if self._transport is not None:
            self._transport.close()
            self._transport = None
            self._claims.leave(self._port, self._device)

    def _scan(self) -> PortPoll:
        ports = self._directory.names()
        if self._transport is None:
            return self._find(ports)
        try:
            packets = self._transport.read()
        except DeviceError:
            return self._lose([])
        return PortPoll(self._device, packets) if self._port in ports else self._lose(packets)

    def _find(self, ports: list[str]) -> PortPoll:
        port = self._choose([port for port in ports if port not in self._claims.ports])
        if port is None:
            return _NOTHING
        try:
            self._transport = self._directory.open(port)
        except DeviceError as fault:  # taken by another program or gone again; the next scan tries anew
            return self._refused(str(fault))
        self._fault = self._reported_fault = ""
        self._port, self._plug = port, _plug_of(port)
        self._device = self._claims.claim(port, self._transport.name)
        return PortPoll(self._device, [], found=True)

    def _refused(self, fault: str) -> PortPoll:
        """Tell a fault that lasts: a port that has just come may not be ours before the system has said whose it is."""
        lasts, self._fault = fault == self._fault, fault
        if not lasts or fault == self._reported_fault:
            return _NOTHING
        self._reported_fault = fault
        return PortPoll("", [], fault=fault)

    def _choose(self, ports: list[str]) -> str | None:
        """The kit that was lost if it is back, by its stable name, else the one that is wanted."""
        back = next((port for port in ports if self._plug and _plug_of(port) == self._plug), None)
        return back or choose_port(ports, self.wanted)

    def _lose(self, packets: list[Packet]) -> PortPoll:
        self.close()
        return PortPoll(self._device, packets, lost=True)


def _plug_of(port: str) -> str:
    return device_of_port(stable_name(port))
