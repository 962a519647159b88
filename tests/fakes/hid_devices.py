"""A fake hidapi: devices that a test plugs in and out, and reports byte by byte as game drums and pedals send them.

`drum_report` and `key_report` are written from the PlasticBand documents and USB HID 1.11, appendix B.1, by the names
that are printed on a PlayStation pad; they know nothing of the station's tables.
"""

from collections import deque
from dataclasses import dataclass, field
from typing import Any

ROCK_BAND, ROCK_BAND_WII_1, ROCK_BAND_WII = (0x12BA, 0x0210), (0x1BAD, 0x0005), (0x1BAD, 0x3110)
MIDI_PRO, GUITAR_HERO = (0x12BA, 0x0218), (0x12BA, 0x0120)
FOOT_SWITCH, MOUSE = (0x0C45, 0x7403), (0x046D, 0xC077)

_BUTTONS = ["square", "cross", "circle", "triangle", "l1", "r1", "-", "-", "select", "start", "l3", "r3", "ps"]
_HAT = {"up": 0, "right": 2, "down": 4, "left": 6}
_AT_REST = bytes.fromhex("00 00 08 7f 7f 7f 7f" + " 00" * 12 + " 00 02" * 4)


def drum_report(pressed: str = "", **pressures: int) -> bytes:
    """27 bytes: the buttons named in `pressed`, a direction of the hat among them; `b12=40` puts 40 into byte 12."""
    report = bytearray(_AT_REST)
    for word in pressed.split():
        if word in _HAT:
            report[2] = _HAT[word]
        else:
            bit = _BUTTONS.index(word)
            report[bit // 8] |= 1 << bit % 8
    for name, value in pressures.items():
        report[int(name.removeprefix("b"))] = value
    return bytes(report)


def key_report(*keys: int, modifiers: int = 0) -> bytes:
    """A foot switch's nine bytes."""
    return bytes((1, modifiers, 0, *keys, *[0] * (6 - len(keys))))


@dataclass
class FakeHandle:
    """One of hidapi's devices: it opens a path, and reads what was sent there."""

    api: "FakeHid"
    path: bytes = b""
    waiting: deque[bytes] = field(default_factory=deque)
    is_open: bool = False
    waits: bool = True

    def open_path(self, path: bytes) -> None:
        if path not in self.api.plugged or path in self.api.denied:
            raise OSError("open failed")
        self.path, self.is_open = path, True
        self.api.handles.append(self)

    def set_nonblocking(self, on: int) -> int:
        self.waits = not on
        return 0

    def read(self, longest: int) -> list[int]:
        if not self.is_open:
            raise ValueError("not open")
        if self.waiting:
            return list(self.waiting.popleft()[:longest])
        if self.path not in self.api.plugged:
            raise OSError("read error")
        assert not self.waits, "hidapi would wait here for ever"
        return []

    def close(self) -> None:
        self.is_open = False


class FakeHid:
    """hidapi's module, as far as it is used."""

    def __init__(self) -> None:
        self.plugged: dict[bytes, list[dict[str, Any]]] = {}
        self.denied: set[bytes] = set()
        self.handles: list[FakeHandle] = []

    def plug(self, path: str, ids: tuple[int, int], usages: tuple[tuple[int, int], ...] = ((1, 5),)) -> None:
        """`usages` of each face: page and number, (0, 0) where the library does not know."""
        base = {"path": path.encode(), "vendor_id": ids[0], "product_id": ids[1], "product_string": "Controller"}
        faces = [
            {"usage_page": page, "usage": usage, "interface_number": number}
            for number, (page, usage) in enumerate(usages)
        ]
        self.plugged[path.encode()] = [base | face for face in faces]

    def unplug(self, path: str) -> None:
        del self.plugged[path.encode()]

    def send(self, path: str, *reports: bytes) -> None:
        for handle in self.handles:
            if handle.is_open and handle.path == path.encode() and handle.path in self.plugged:
                handle.waiting.extend(reports)

    def enumerate(self) -> list[dict[str, Any]]:
        return [face for faces in self.plugged.values() for face in faces]

    def device(self) -> FakeHandle:
        return FakeHandle(self)
