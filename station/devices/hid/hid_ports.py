"""The game drums and foot switches that are plugged in, through hidapi; the only user of it.

On Linux the kernel's own interface (hidraw) is taken where hidapi was built with it: a plain file a device, with
permissions of its own, and the keyboard that a foot switch is goes on typing. A device's report bears the time at which
it was read, for no system tells when it came; a drum kit sends one every 8 ms (RPCS3 RB3MidiDrums.cpp). One that says
what the one before it said is passed over: a kit at rest repeats itself 125 times a second. Reading never waits.

Known devices alone are listed and opened (`hid_reports.HID_DEVICES`).
"""

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.devices.hid.hid_names import HID, hid_port
from station.devices.hid.hid_reports import HID_DEVICES, HidDevice
from station.devices.serial.serial_names import device_of_port
from station.devices.transport import Packet

try:
    import hidraw as hidapi
except ImportError:  # not Linux, or built with libusb or hidraw alone
    import hid as hidapi

LOOK_EVERY_NS = 2 * NS_PER_S
"""So often the system is asked anew where no file tells that a device has come (our choice: on Windows and macOS it
takes milliseconds)."""
_LONGEST_REPORT = 64
"""Of a full-speed device (USB 2.0, § 5.7.3)."""
_ANY_USAGE = 0
"""What hidapi says where it does not know the usage: built with libusb."""
_RULE = 'KERNEL=="hidraw*", ATTRS{{idVendor}}=="{vendor:04x}", ATTRS{{idProduct}}=="{product:04x}", TAG+="uaccess"'

MonotonicNs = Callable[[], int]


def device_nodes() -> frozenset[str] | None:
    """The names that change when a device comes or goes; None where this system has no such names."""
    if sys.platform != "linux":
        return None
    return frozenset(name for name in os.listdir("/dev") if name.startswith("hidraw"))  # noqa: PTH208 - twice as fast


class HidHandle(Protocol):
    """One of hidapi's devices."""

    def open_path(self, path: bytes) -> None: ...  # noqa: D102 - hidapi's own
    def set_nonblocking(self, on: int) -> int: ...  # noqa: D102
    def read(self, longest: int) -> list[int]: ...  # noqa: D102
    def close(self) -> None: ...  # noqa: D102


class HidApi(Protocol):
    """What is used of hidapi's module."""

    def enumerate(self) -> list[dict[str, Any]]: ...  # noqa: D102
    def device(self) -> HidHandle: ...  # noqa: D102


class HidDirectory:
    """The known HID devices of this computer; `nodes` tells when it is time to look for them anew."""

    def __init__(
        self,
        api: HidApi = hidapi,
        now_ns: MonotonicNs = monotonic_ns,
        nodes: Callable[[], frozenset[str] | None] = device_nodes,
    ) -> None:
        self._api = api
        self._now_ns = now_ns
        self._find_nodes = nodes
        self._nodes: frozenset[str] | None = None
        self._look_ns: int | None = None
        self._listed: dict[str, tuple[int, int]] = {}

    def names(self) -> list[str]:
        """The devices that are there now."""
        nodes, now_ns = self._find_nodes(), self._now_ns()
        is_due = self._look_ns is None or now_ns >= self._look_ns
        if nodes != self._nodes or (nodes is None and is_due):
            self._nodes, self._look_ns = nodes, now_ns + LOOK_EVERY_NS
            self._listed = dict(sorted(self._there()))
        return list(self._listed)

    def open(self, port: str) -> "HidPort":
        """Open one of `names()`; raises `DeviceError` that says what to do where it cannot be had."""
        handle, path = self._api.device(), port.rpartition(HID)[2]
        try:
            handle.open_path(path.encode())
            handle.set_nonblocking(1)
        except (OSError, ValueError) as fault:
            why = self.no_access(port) or "it is gone, or another program has it"
            raise DeviceError(f"{port}: {why}") from fault
        return HidPort(device_of_port(port), handle, self._now_ns)

    def no_access(self, port: str) -> str | None:
        """What to do where this user may not use `port`; None where they may, or nobody can tell."""
        path = Path(port.rpartition(HID)[2])
        if not path.is_absolute() or not path.exists() or os.access(path, os.R_OK | os.W_OK):
            return None
        vendor, product = self._listed.get(port, (0, 0))
        rule = _RULE.format(vendor=vendor, product=product)
        return (
            f"permission denied; echo '{rule}' | sudo tee -a /etc/udev/rules.d/70-drum-station.rules, plug it in again"
        )

    def _there(self) -> list[tuple[str, tuple[int, int]]]:
        try:
            found = self._api.enumerate()
        except OSError:  # the system has no HID
            return []
        ids = [(entry, (entry["vendor_id"], entry["product_id"])) for entry in found]
        return [(_port(entry, HID_DEVICES[each]), each) for entry, each in ids if _is_known(entry, each)]


class HidPort:
    """One open HID device."""

    def __init__(self, name: str, handle: HidHandle, now_ns: MonotonicNs) -> None:
        self._name = name
        self._handle: HidHandle | None = handle
        self._now_ns = now_ns
        self._last = b""

    @property
    def name(self) -> str:
        """The device's title."""
        return self._name

    def read(self) -> list[Packet]:
        """The reports since the last call that say something new; raises `DeviceError` where the device has gone."""
        packets: list[Packet] = []
        try:
            while self._handle is not None and (report := bytes(self._handle.read(_LONGEST_REPORT))):
                if report != self._last:
                    packets.append(Packet(report, self._now_ns()))
                self._last = report
        except (OSError, ValueError) as fault:
            if packets:  # the next call finds out the same, and says so
                return packets
            raise DeviceError(f"{self._name}: the HID device has gone: {fault}") from fault
        return packets

    def close(self) -> None:
        """End the connection; a closed port reads as empty."""
        if self._handle is not None:
            with suppress(OSError, ValueError):  # it has gone already
                self._handle.close()
            self._handle = None


def _is_known(entry: dict[str, Any], ids: tuple[int, int]) -> bool:
    """Whether what hidapi lists is a known device, and the one of its faces that sends what we read."""
    usage = HID_DEVICES[ids].usage if ids in HID_DEVICES else None
    said = (entry["usage_page"], entry["usage"])
    if said[0] == _ANY_USAGE:  # the first face is the keyboard
        return ids in HID_DEVICES and (usage is None or entry["interface_number"] <= 0)
    return ids in HID_DEVICES and usage in (None, said)


def _port(entry: dict[str, Any], device: HidDevice) -> str:
    return hid_port(device.title, entry["path"].decode(errors="replace"))
