"""The capture: every byte of every device with its time, in one append-only file that checks itself.

    capture = "DRUMCAP1" record*
    record  = kind u8, device u16, size u32, at_ns i64, payload (size bytes), check u32      little-endian

`check` is the CRC-32 of everything before it in the record, begun with the check of the record before (for the first,
with the CRC-32 of the first eight bytes), so that a record that was damaged, dropped or moved shows. A reader stops at
the first fault and has everything before it. Kinds that it does not know it passes over. Times are session time.

| kind | device | at_ns | payload |
|---|---|---|---|
| START | 0 | when writing began | unix time in ns, i64 |
| DEVICE | its number from now on | when it was first heard | JSON: `name`, `preset`; `kit`, its own file, if any |
| BYTES | number | when they came | the bytes as they came |
| LOST, FOUND | number | when | none |
| STROKE | number | when it was played | a hit that had no bytes (computer keyboard, air): `_STROKE`, `_LIMB` |
| ZERO | 0 | when cue time 0 was heard | none |
| END | 0 | when the capture was closed | none |
| SETTLED | number | until when its hits had been told | none; only before bytes from earlier, that came late |
| OUTPUT | 0 | when the sound went there | the name of what sounds from now on, UTF-8; empty: nothing does |
| ANNOTATION | 0 | when it came | what whoever records wants kept, UTF-8; sessions:
`station.practice.session.event_log` |
"""

import json
import math
import struct
import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import IntEnum
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import NS_PER_S

MOST_BYTES = 256 << 20
"""No capture is longer (our choice: more than a day of playing)."""

LONGEST_NS = 24 * 3600 * NS_PER_S
"""Nothing lies farther from the first record of its part than a day (our choice): more is damage."""
MOST_STROKES = 200_000
"""Of one performance (our choice: two hours of ten strokes a second, and as many of the feet)."""
MOST_A_SECOND = 500
"""Ten times what two hands and two feet do (our choice)."""
_CLOCKLESS_YEAR = 1970
"""A computer that does not know the time begins to count here, as a virtual student does."""
_MOST_PAYLOAD = {0: 1 << 18, 10: 1 << 24}
"""Bytes of a record by its kind, of kind 0 for all that are not named: so many take a kit over a minute on its cable
(31,250 baud); what a session says of itself holds its whole score (our choice)."""
MAGIC = b"DRUMCAP1"
_HEAD = struct.Struct("<BHIq")
_CHECK = struct.Struct("<I")
_HARDEST = 127
FURTHEST_NS = 2**62
"""No clock says so much (146 years): two times lie within 64 bits of each other."""
_UNIX = struct.Struct("<q")
_STROKE = struct.Struct("<BBBBf")  # piece, zone, articulation, velocity, openness (NaN: cannot tell)
_LIMB = struct.Struct("<b")  # after it, where the limb is known


class RecordKind(IntEnum):
    """What a record holds; a number, once given, is never given again."""

    START = 0
    DEVICE = 1
    BYTES = 2
    LOST = 3
    FOUND = 4
    STROKE = 5
    ZERO = 6
    END = 7
    SETTLED = 8
    OUTPUT = 9
    ANNOTATION = 10


@dataclass(frozen=True, slots=True)
class CaptureRecord:
    """One entry of a capture; `kind` is a plain number, for a later version may write kinds that we do not know."""

    kind: int
    device: int
    at_ns: int
    payload: bytes = b""


class RecordWriter:
    """Turns records into the bytes that follow those already written; keeps the running check."""

    def __init__(self, check: int | None = None) -> None:
        self._check = zlib.crc32(MAGIC) if check is None else check

    def encode(self, record: CaptureRecord) -> bytes:
        """The bytes of one record."""
        body = _HEAD.pack(record.kind, record.device, len(record.payload), record.at_ns) + record.payload
        self._check = zlib.crc32(body, self._check)
        return body + _CHECK.pack(self._check)


@dataclass(frozen=True, slots=True)
class Capture:
    """What could be read: `records` in the order of writing.

    `good_bytes` is the length of the sound part, `lost_bytes` what follows it and cannot be read, `check` the running
    check at its end.
    """

    records: tuple[CaptureRecord, ...]
    good_bytes: int
    lost_bytes: int
    check: int

    @property
    def complete(self) -> bool:
        """Whether the capture was closed in order and all of it can be read."""
        return not self.lost_bytes and bool(self.records) and self.records[-1].kind == RecordKind.END


def read_capture(path: Path) -> Capture:
    """Everything sound in the capture at `path`.

    Raises `BadInput` where there is none, or it cannot be read.
    """
    return parse_capture(read_regular(path, MOST_BYTES), path)


def parse_capture(data: bytes, source: str | Path = "capture") -> Capture:
    """The capture in `data`, up to the first fault; raises `BadInput` where it does not even begin as one.

    What was cut within its first eight bytes, even before the first, is a capture with nothing in it.
    """
    if not data.startswith(MAGIC):
        if MAGIC.startswith(data):
            return Capture((), 0, len(data), zlib.crc32(MAGIC))
        raise BadInput(source, "byte 0", "no capture of a drum kit: it does not begin with DRUMCAP1")
    records: list[CaptureRecord] = []
    check = zlib.crc32(MAGIC)
    at, began_ns = len(MAGIC), None
    while at + _HEAD.size + _CHECK.size <= len(data):
        kind, device, size, at_ns = _HEAD.unpack_from(data, at)
        body_end = at + _HEAD.size + size
        if body_end + _CHECK.size > len(data) or size > _MOST_PAYLOAD.get(kind, _MOST_PAYLOAD[0]):
            break
        if began_ns is None or kind == RecordKind.START:
            began_ns = at_ns
        expected = zlib.crc32(data[at:body_end], check)
        is_far = abs(at_ns) > FURTHEST_NS or abs(at_ns - began_ns) > LONGEST_NS
        if _CHECK.unpack_from(data, body_end)[0] != expected or is_far:
            break
        records.append(CaptureRecord(kind, device, at_ns, data[at + _HEAD.size : body_end]))
        check, at = expected, body_end + _CHECK.size
    return Capture(tuple(records), at, len(data) - at, check)


def check_strokes(at_ns: Iterable[int], source: str | Path = "capture") -> None:
    """Raise `BadInput` where strokes are none of one player's: a day apart, very many, or very many at once."""
    times = list(islice(at_ns, MOST_STROKES + 1))
    if len(times) > MOST_STROKES:
        raise BadInput(source, "", f"more than {MOST_STROKES} strokes")
    if times and max(times) - min(times) > LONGEST_NS:
        raise BadInput(source, "", "its strokes lie more than a day apart")
    times.sort()
    if any(late - early < NS_PER_S for early, late in zip(times, times[MOST_A_SECOND:], strict=False)):
        raise BadInput(source, "", f"more than {MOST_A_SECOND} strokes within a second")


# --- payloads --------------------------------------------------------------------------------------------------------


def start_record(at_ns: int, unix_ns: int) -> CaptureRecord:
    """Writing began at session time `at_ns`, which was `unix_ns` by the wall clock."""
    return CaptureRecord(RecordKind.START, 0, at_ns, _UNIX.pack(unix_ns))


def written_at(capture: Capture) -> datetime | None:
    """When writing began by the wall clock, in the time of the place; None where the capture does not say."""
    start = next((record for record in capture.records if record.kind == RecordKind.START), None)
    if start is None or len(start.payload) != _UNIX.size:
        return None
    (unix_ns,) = _UNIX.unpack(start.payload)
    try:
        found = datetime.fromtimestamp(unix_ns / NS_PER_S).astimezone()
    except (OverflowError, OSError, ValueError):  # a year that no calendar has
        return None
    return found if found.year > _CLOCKLESS_YEAR else None


class DeviceWord(NamedTuple):
    """What a DEVICE record says: the device's name, its preset's, and the text of a kit of the user's own, if any."""

    name: str
    preset: str
    kit: str | None = None


def device_record(number: int, at_ns: int, name: str, preset: str, kit: str | None = None) -> CaptureRecord:
    """From now on `number` stands for the device `name`, understood by `preset` or by the text of an own `kit`."""
    said = {"name": name, "preset": preset} | ({} if kit is None else {"kit": kit})
    return CaptureRecord(RecordKind.DEVICE, number, at_ns, json.dumps(said, ensure_ascii=False).encode())


def device_of(record: CaptureRecord) -> DeviceWord:
    """What a DEVICE record says; raises `BadInput` where its payload is not ours."""
    try:
        fields = json.loads(record.payload)
        name, preset, kit = fields["name"], fields["preset"], fields.get("kit")
        if not (isinstance(name, str) and isinstance(preset, str) and isinstance(kit, str | None)):
            raise TypeError
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        raise BadInput("capture", f"device {record.device}", "its name and preset cannot be read") from None
    return DeviceWord(name, preset, kit)


def stroke_record(number: int, hit: Hit) -> CaptureRecord:
    """A hit that came without bytes."""
    openness = math.nan if hit.openness is None else hit.openness
    payload = _STROKE.pack(hit.piece, hit.zone, hit.articulation, hit.velocity, openness)
    if hit.limb is not Limb.UNKNOWN:
        payload += _LIMB.pack(hit.limb)
    return CaptureRecord(RecordKind.STROKE, number, hit.at_ns, payload)


def stroke_of(record: CaptureRecord, device: str) -> Hit:
    """The hit of a STROKE record; raises `BadInput` where its payload is not ours."""
    try:
        piece, zone, articulation, velocity, openness = _STROKE.unpack(record.payload[: _STROKE.size])
        limb = record.payload[_STROKE.size :]
        if not (1 <= velocity <= _HARDEST and (math.isnan(openness) or 0.0 <= openness <= 1.0)):
            raise ValueError
        return Hit(
            at_ns=record.at_ns,
            piece=Piece(piece),
            zone=Zone(zone),
            velocity=velocity,
            articulation=Articulation(articulation),
            openness=None if math.isnan(openness) else openness,
            limb=Limb(*_LIMB.unpack(limb)) if limb else Limb.UNKNOWN,
            device=device,
        )
    except (struct.error, ValueError):
        raise BadInput("capture", f"stroke at {record.at_ns} ns", "it cannot be read") from None
