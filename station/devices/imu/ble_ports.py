"""Motion sensors over Bluetooth Low Energy: the only user of bleak, which is an optional extra.

bleak waits for the radio, so it lives in a thread of its own; what it brings is queued with the time at which it came.
A port is `NAME ble:ADDRESS`. Opening one returns at once and connects behind the caller's back; one that cannot be
connected, or is lost, is gone at the next reading, and whoever watches it tries again.

The radio looks for sensors only while somebody misses one, for looking takes time from listening.

Services, each with what notifies and what is written to:
* WitMotion, of WITMOTION/WitBluetooth_BWT901BLE5_0;
* Nordic's UART, which home-built sensors use to send lines of text.
"""

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Protocol

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.devices.imu.witmotion import BATTERY_REGISTER
from station.devices.imu.witmotion_setup import ask
from station.devices.transport import Packet

BLE = "ble:"
WITMOTION_NAMES = "WT"
"""How the names of WitMotion's sensors begin: WT901BLE67, WTSDCL …"""
_WIT_NOTIFIES, _WIT_WRITTEN = "0000ffe4-0000-1000-8000-00805f9a34fb", "0000ffe9-0000-1000-8000-00805f9a34fb"
_UART_NOTIFIES, _UART_WRITTEN = "6e400003-b5a3-f393-e0a9-e50e24dcca9e", "6e400002-b5a3-f393-e0a9-e50e24dcca9e"
WRITTEN: Mapping[str, str] = MappingProxyType({_WIT_NOTIFIES: _WIT_WRITTEN, _UART_NOTIFIES: _UART_WRITTEN})
"""The characteristic that is written to, by the one that notifies."""
_MISSED_NS = 2 * NS_PER_S
"""So long after somebody asked which sensors there are, the radio still looks for some (watches ask every 0.4 s)."""
_SILENT_NS = 15 * NS_PER_S
"""A sensor that has not announced itself for so long has gone: they do every second or so (our choice)."""
_TEND_S = 0.2
_ASK_EVERY_S = 60.0
_CONNECT_S = 15.0
_LEAVE_S = 2.0

MISSING = "Bluetooth needs the package bleak: pip install 'drum-station[ble]'"


class BleLibrary(Protocol):
    """What of bleak is used; its classes have these names."""

    @property
    def BleakScanner(self) -> Any:  # noqa: ANN401, N802 - bleak's name, which has no types of its own here
        """Looks for sensors."""

    @property
    def BleakClient(self) -> Any:  # noqa: ANN401, N802
        """A connection."""


class _Handle(Protocol):
    name: str | None
    address: str


class _Advertisement(Protocol):
    local_name: str | None


def load_bleak() -> BleLibrary:
    """The library; raises `DeviceError` that says what to do where it is not installed."""
    try:
        import bleak  # noqa: PLC0415 - optional
    except ImportError:
        raise DeviceError(MISSING) from None
    library: BleLibrary = bleak
    return library


@dataclass(frozen=True, slots=True)
class _Announced:
    """A sensor that announces itself: bleak's `handle` for it, and when it did last."""

    handle: object
    at_ns: int


class Radio:
    """The computer's Bluetooth radio and the thread that waits for it; for all sensors together."""

    def __init__(self, library: BleLibrary, now_ns: Callable[[], int] = monotonic_ns) -> None:
        self.library = library
        self.now_ns = now_ns
        self.fault = ""
        """Why nothing can be received at present, empty where it can."""
        self.clients: list[Any] = []
        """bleak's clients, to be left when the radio is; touched in its thread alone."""
        self._announced: dict[str, _Announced] = {}
        self._missed_ns = 0
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, name="bluetooth", daemon=True)
        self._thread.start()

    def ports(self) -> list[str]:
        """The ports of sensors that announced themselves lately; looks for more in the time that follows."""
        now_ns = self.now_ns()
        self._missed_ns = now_ns + _MISSED_NS
        return sorted(port for port, seen in self._announced.copy().items() if now_ns - seen.at_ns < _SILENT_NS)

    def handle(self, port: str) -> object:
        """Bleak's handle for one of `ports()`; raises `DeviceError` where it has gone."""
        if port not in self._announced:
            raise DeviceError(f"{port}: no such Bluetooth sensor announces itself")
        return self._announced[port].handle

    def submit(self, work: Coroutine[Any, Any, None]) -> None:
        """Have `work` done in the radio's thread."""
        asyncio.run_coroutine_threadsafe(work, self._loop)

    def close(self) -> None:
        """Leave all sensors and end the thread; closing twice is harmless."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._loop.stop)
            self._thread.join(_LEAVE_S)

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.create_task(self._tend())
        self._loop.run_forever()
        tasks = asyncio.all_tasks(self._loop)
        for task in tasks:
            task.cancel()
        leaving = [asyncio.wait_for(client.disconnect(), _LEAVE_S) for client in self.clients]
        self._loop.run_until_complete(asyncio.gather(*tasks, *leaving, return_exceptions=True))
        self._loop.close()

    async def _tend(self) -> None:
        """Look for sensors while one is missed."""
        scanner: Any = None
        try:
            while True:
                is_missed = self.now_ns() < self._missed_ns
                try:
                    if is_missed and scanner is None:
                        scanner = self.library.BleakScanner(self._seen)
                        await scanner.start()
                        self.fault = ""
                    elif not is_missed and scanner is not None:
                        ended, scanner = scanner, None
                        await ended.stop()
                except Exception as fault:  # bleak's backends raise what their systems do
                    scanner, why = None, fault or type(fault).__name__
                    self.fault = f"Bluetooth cannot be used ({why}): is the radio on?"
                await asyncio.sleep(_TEND_S)
        finally:
            if scanner is not None:
                with suppress(Exception):
                    await scanner.stop()

    def _seen(self, handle: _Handle, advertisement: _Advertisement) -> None:
        name = advertisement.local_name or handle.name
        if name:
            self._announced[f"{name} {BLE}{handle.address}"] = _Announced(handle, self.now_ns())


class BleDirectory:
    """The sensors whose name or address has `asked` in it; with nothing asked for, WitMotion's."""

    def __init__(self, radio: Radio, asked: str = "") -> None:
        self._radio = radio
        self._asked = asked
        self._open: BlePort | None = None

    def names(self) -> list[str]:
        """The ports that could be opened now, and the one that is open.

        Where the radio cannot be used, that which was asked for: opening it says why.
        """
        if self._open is not None and self._open.is_open:
            return [self._open.name]
        ports = self._radio.ports()
        if self._radio.fault:
            return [f"{self._asked or 'sensor'} {BLE}"]
        if not self._asked:
            return [port for port in ports if port.startswith(WITMOTION_NAMES)]
        return [port for port in ports if self._asked.lower() in port.lower()]

    def open(self, port: str) -> "BlePort":
        """Begin to connect to one of `names()`; raises `DeviceError` where the radio cannot be used."""
        if self._radio.fault:
            raise DeviceError(self._radio.fault)
        self._open = BlePort(port, self._radio)
        return self._open


class BlePort:
    """The connection to one sensor."""

    def __init__(self, port: str, radio: Radio) -> None:
        self.name = port
        self.is_open = True
        """Whether it is connected, or about to be."""
        self._radio = radio
        self._came: deque[Packet] = deque()
        self._is_closed = False
        self._fault = ""
        self._written = ""
        self._client: Any = None
        radio.submit(self._serve(radio.handle(port)))

    @property
    def is_connected(self) -> bool:
        """Whether the sensor listens."""
        return bool(self._written) and self.is_open

    def read(self) -> list[Packet]:
        """What came since the last call; raises `DeviceError` once the sensor has gone."""
        found = [self._came.popleft() for _ in range(len(self._came))]
        if self._is_closed:  # what a sensor tells until it knows is for nobody
            return []
        if self._fault and not found:
            raise DeviceError(self._fault)
        return found

    def write(self, data: bytes) -> None:
        """Send `data` behind the caller's back; raises `DeviceError` where the sensor is not connected."""
        if not self.is_connected:
            raise DeviceError(self._fault or f"{self.name}: not connected")
        self._radio.submit(self._client.write_gatt_char(self._written, data, response=False))

    def close(self) -> None:
        """End the connection; a closed port reads as empty."""
        if not self._is_closed:
            self._is_closed, self.is_open, self._fault = True, False, ""
            self._radio.submit(self._leave())

    async def _leave(self) -> None:
        if self._client is not None:
            self._radio.clients.remove(self._client)
            await self._client.disconnect()

    async def _serve(self, handle: object) -> None:
        try:
            self._client = self._radio.library.BleakClient(handle, self._gone, timeout=_CONNECT_S)
            self._radio.clients.append(self._client)
            await self._client.connect()
            notifies = next((each for each in WRITTEN if self._client.services.get_characteristic(each)), None)
            if notifies is None:
                self._end("it has no service of a motion sensor that is known here")
                return
            await self._client.start_notify(notifies, self._notified)
            self._written = WRITTEN[notifies]
            while self.is_open:
                if self._written == _WIT_WRITTEN:
                    await self._client.write_gatt_char(self._written, ask(BATTERY_REGISTER), response=False)
                await asyncio.sleep(_ASK_EVERY_S)
        except Exception as fault:  # bleak's backends raise what their systems do
            self._end(str(fault) or type(fault).__name__)

    def _notified(self, _: object, data: bytearray) -> None:
        self._came.append(Packet(bytes(data), self._radio.now_ns()))

    def _gone(self, _: object) -> None:
        self._end("the connection was lost")

    def _end(self, why: str) -> None:
        if self.is_open:
            self._fault = f"{self.name}: {why}"
            self.is_open = False
