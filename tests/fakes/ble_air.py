"""Bluetooth sensors in the air, behind the seam where bleak sits: they announce themselves, connect, notify bytes.

`FakeAir` stands in for the module bleak: it has its two classes, whose methods do as bleak 3's documentation says
(`BleakScanner(callback)`, `BleakClient(device, disconnected_callback)`, callbacks in the loop's thread).
"""

import asyncio
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

WIT_SERVICE = "0000ffe5-0000-1000-8000-00805f9a34fb"
WIT_NOTIFIES = "0000ffe4-0000-1000-8000-00805f9a34fb"
WIT_WRITTEN = "0000ffe9-0000-1000-8000-00805f9a34fb"


def until(enough: Callable[[], bool], within_s: float = 20.0) -> bool:
    """Wait for another thread, in short steps; False if it takes too long."""
    give_up_s = time.monotonic() + within_s
    while not enough():
        if time.monotonic() > give_up_s:
            return False
        time.sleep(0.0005)
    return True


class FakeSensor:
    """One sensor: what bleak calls a device, its advertisement and its services at once."""

    def __init__(self, name: str, address: str = "DE:AD:BE:EF:00:01", notifies: str = WIT_NOTIFIES) -> None:
        self.name = self.local_name = name
        self.address = address
        self.notifies = notifies
        self.is_on = True
        self.written: list[tuple[str, bytes]] = []
        self.is_subscribed = threading.Event()
        self.client: Any = None
        self.loop: asyncio.AbstractEventLoop | None = None
        self.callback: Callable[[object, bytearray], None] | None = None

    def notify(self, data: bytes) -> None:
        """Send bytes, as one notification."""
        self._in_loop(lambda: self.callback(None, bytearray(data)) if self.callback else None)

    def switch_off(self) -> None:
        """The battery is out: the connection ends and no more is announced."""
        self.is_on = False
        client = self.client
        self._in_loop(lambda: client.gone(client) if client is not None and self.callback is not None else None)

    def _in_loop(self, work: Callable[[], object]) -> None:
        if self.loop is not None:
            with suppress(RuntimeError):  # the loop has ended, and with it the connection
                self.loop.call_soon_threadsafe(work)

    def get_characteristic(self, uuid: str) -> str | None:
        return uuid if uuid in (self.notifies, WIT_WRITTEN) else None


class FakeAir:
    """The sensors that are near, and a radio that may be missing."""

    def __init__(self, *sensors: FakeSensor, fault: str = "") -> None:
        self.sensors = list(sensors)
        self.fault = fault
        self.is_scanning = False
        self.scans = 0

    def BleakScanner(self, callback: Callable[[Any, Any], None]) -> "_Scanner":  # noqa: N802 - bleak's name
        return _Scanner(self, callback)

    def BleakClient(self, device: FakeSensor, gone: Callable[[Any], None], timeout: float) -> "_Client":  # noqa: N802
        return _Client(device, gone)


class _Scanner:
    def __init__(self, air: FakeAir, callback: Callable[[Any, Any], None]) -> None:
        self._air, self._callback = air, callback
        self._task: asyncio.Task[None] | None = None

    async def start(self) -> None:
        if self._air.fault:
            raise RuntimeError(self._air.fault)
        self._air.is_scanning = True
        self._air.scans += 1
        self._task = asyncio.create_task(self._announce())

    async def _announce(self) -> None:
        while True:
            for sensor in self._air.sensors:
                if sensor.is_on:
                    self._callback(sensor, sensor)
            await asyncio.sleep(0.005)

    async def stop(self) -> None:
        self._air.is_scanning = False
        if self._task is not None:
            self._task.cancel()


class _Client:
    def __init__(self, sensor: FakeSensor, gone: Callable[[Any], None]) -> None:
        self.services = self._sensor = sensor
        self.gone = gone

    async def connect(self) -> None:
        if not self._sensor.is_on:
            raise TimeoutError("no answer")
        self._sensor.client, self._sensor.loop = self, asyncio.get_running_loop()

    async def start_notify(self, uuid: str, callback: Callable[[object, bytearray], None]) -> None:
        assert uuid == self._sensor.notifies
        self._sensor.callback = callback
        self._sensor.is_subscribed.set()

    async def write_gatt_char(self, uuid: str, data: bytes, response: bool) -> None:
        assert not response
        self._sensor.written.append((uuid, bytes(data)))

    async def disconnect(self) -> None:
        self._sensor.callback = self._sensor.client = None
        self._sensor.is_subscribed.clear()
