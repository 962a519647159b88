"""The ports at which motion sensors are, and the words with which a user asks for them.

    STICK = serial:PATH[@BAUD] | PART[@BAUD] | ble:NAME          STICKS = STICK; STICK; …

PART is part of a serial adapter's name, NAME part of a Bluetooth sensor's name or address, empty for the first of
WitMotion's. No sensor is looked for unless it is asked for.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Protocol

from station.core.clock import monotonic_ns
from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_S
from station.devices.device_ports import BETWEEN_DEVICES, DeviceRequest, parse_device
from station.devices.imu.ble_ports import BLE, BleDirectory, BleLibrary, BlePort, Radio, load_bleak
from station.devices.port_watch import ClaimedPorts, PortWatch, choose_port
from station.devices.serial.serial_ports import SerialDirectory
from station.devices.transport import PortDirectory, Transport

SENSOR_BAUD = 115_200
"""What most sensors leave the factory with (x-IMU3, BNO085 in RVC mode, WitMotion's with a case)."""

_CONNECTED_WITHIN_NS = 20 * NS_PER_S
_LOOK_S = 0.02


def parse_stick(text: str) -> DeviceRequest:
    """The request that `text` spells; raises `BadInput` for none, and for a rate that no port has."""
    if not text.strip():
        raise BadInput("stick", "", "expected serial:PATH@BAUD, such as serial:/dev/ttyUSB0@115200, or ble:NAME")
    if text.strip().startswith(BLE):
        return DeviceRequest(text.strip())
    return parse_device(text, SENSOR_BAUD)


def parse_sticks(text: str) -> tuple[DeviceRequest, ...]:
    """All the requests in `text`, in order; none where it is empty. Raises `BadInput` as `parse_stick` does."""
    return tuple(parse_stick(part) for part in text.split(BETWEEN_DEVICES) if part.strip())


@dataclass(frozen=True, slots=True)
class StickWatches:
    """The watches over the sensors that were asked for, and the `fault` for which some cannot be watched."""

    sticks: tuple[PortWatch, ...] = ()
    fault: str | None = None
    radio: Radio | None = None

    def close(self) -> None:
        """Leave every sensor, then the radio."""
        for stick in self.sticks:
            stick.close()
        if self.radio is not None:
            self.radio.close()


def watch_sticks(
    requests: tuple[DeviceRequest, ...],
    claims: ClaimedPorts | None = None,
    now_ns: Callable[[], int] = monotonic_ns,
    library: Callable[[], BleLibrary] = load_bleak,
) -> StickWatches:
    """A watch for each request, each with a port of its own.

    `claims` are those of the kits' watches, where there are some; `library` loads bleak where Bluetooth is asked for.
    """
    radio, fault = None, None
    if any(request.part.startswith(BLE) for request in requests):
        try:
            radio = Radio(library(), now_ns)
        except DeviceError as missing:
            fault = str(missing)
    shared = ClaimedPorts() if claims is None else claims
    watches = []
    for request in requests:
        directory = _directory(request, radio, now_ns)
        if directory is not None:
            watches.append(PortWatch(directory, request.part.removeprefix(BLE), shared))
    return StickWatches(tuple(watches), fault, radio)


class StickPort(Transport, Protocol):
    """An open connection to a sensor, to which settings can be sent."""

    def write(self, data: bytes) -> None:
        """Send `data`; raises `DeviceError` where it cannot be."""
        ...


@contextmanager
def opened_stick(request: DeviceRequest, library: Callable[[], BleLibrary] = load_bleak) -> Iterator[StickPort]:
    """The sensor that is asked for, connected; raises `DeviceError` where it cannot be had."""
    if not request.part.startswith(BLE):
        directory = SerialDirectory(request.baud, request.path, in_chunks=True)
        port = choose_port(directory.names(), request.part)
        if port is None:
            raise DeviceError(no_stick((request,)))
        line = directory.open(port)
        try:
            yield line
        finally:
            line.close()
        return
    radio = Radio(library())
    try:
        yield _connected(BleDirectory(radio, request.part.removeprefix(BLE)), request)
    finally:
        radio.close()


def _connected(directory: BleDirectory, request: DeviceRequest) -> BlePort:
    """The first of the directory's sensors, once it listens."""
    give_up_ns, port = monotonic_ns() + _CONNECTED_WITHIN_NS, None
    while monotonic_ns() < give_up_ns:
        if port is None and (names := directory.names()):
            port = directory.open(names[0])
        if port is not None:
            port.read()  # raises where it cannot be connected
            if port.is_connected:
                return port
        time.sleep(_LOOK_S)
    raise DeviceError(f"no Bluetooth sensor called {request.part!r} answers")


def no_stick(requests: tuple[DeviceRequest, ...]) -> str:
    """What to tell a user none of whose `requests` is there, and which serial ports there are."""
    ports = SerialDirectory().names()
    named = " or ".join(repr(request.part) for request in requests)
    there = f"these serial ports are there: {', '.join(ports)}" if ports else "there is no serial port"
    return f"no motion sensor is at {named}; {there}"


def _directory(request: DeviceRequest, radio: Radio | None, now_ns: Callable[[], int]) -> PortDirectory | None:
    """Where to look for the sensor that is asked for; None where there is no radio to look with."""
    if not request.part.startswith(BLE):
        return SerialDirectory(request.baud, request.path, now_ns, in_chunks=True)
    return None if radio is None else BleDirectory(radio, request.part.removeprefix(BLE))
