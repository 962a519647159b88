"""The byte layout is checked against one record packed by hand from the table in the module's head."""

import math
import struct
import zlib
from collections.abc import Iterable

import pytest

from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_S
from station.devices.capture.capture import (
    MAGIC,
    MOST_A_SECOND,
    MOST_STROKES,
    CaptureRecord,
    RecordKind,
    RecordWriter,
    check_strokes,
    device_of,
    device_record,
    parse_capture,
    start_record,
    stroke_of,
    stroke_record,
)
from station.devices.capture.replay import replay
from tests.fakes.captures import capture_bytes

RECORDS = [
    device_record(1, 10, "Kit «ü»", "roland-td-17"),
    CaptureRecord(RecordKind.BYTES, 1, 20, bytes.fromhex("99 26 64")),
    CaptureRecord(RecordKind.BYTES, 1, 30, b""),
    CaptureRecord(RecordKind.LOST, 1, -40),
    CaptureRecord(RecordKind.END, 0, 50),
]


def encoded(records: list[CaptureRecord]) -> bytes:
    writer = RecordWriter()
    return MAGIC + b"".join(writer.encode(record) for record in records)


def test_a_record_is_laid_out_as_documented() -> None:
    body = b"\x02" + b"\x01\x00" + b"\x03\x00\x00\x00" + struct.pack("<q", 20) + b"\x99\x26\x64"
    check = struct.pack("<I", zlib.crc32(body, zlib.crc32(b"DRUMCAP1")))
    assert encoded([CaptureRecord(RecordKind.BYTES, 1, 20, b"\x99\x26\x64")]) == b"DRUMCAP1" + body + check


def test_what_was_written_is_read() -> None:
    capture = parse_capture(encoded(RECORDS))
    assert list(capture.records) == RECORDS
    assert capture.complete
    assert capture.lost_bytes == 0


def test_a_capture_cut_at_any_byte_reads_up_to_there() -> None:
    data = encoded(RECORDS)
    ends = [len(encoded(RECORDS[:count])) for count in range(len(RECORDS) + 1)]
    for length in range(len(data)):
        capture = parse_capture(data[:length])
        whole = max(0, sum(end <= length for end in ends) - 1)
        assert list(capture.records) == RECORDS[:whole]
        assert capture.lost_bytes == length - (ends[whole] if length >= len(MAGIC) else 0)
        assert not capture.complete


def test_a_capture_with_any_byte_changed_reads_up_to_there() -> None:
    data = encoded(RECORDS)
    for at in range(len(MAGIC), len(data)):
        damaged = data[:at] + bytes((data[at] ^ 0x10,)) + data[at + 1 :]
        capture = parse_capture(damaged)
        assert list(capture.records) == RECORDS[: len(capture.records)]
        assert capture.good_bytes <= at
        assert capture.lost_bytes == len(data) - capture.good_bytes


def test_a_record_that_was_taken_out_or_moved_shows() -> None:
    writer = RecordWriter()
    parts = [writer.encode(record) for record in RECORDS]
    without = MAGIC + b"".join(parts[:1] + parts[2:])
    swapped = MAGIC + b"".join([parts[0], parts[2], parts[1], *parts[3:]])
    assert list(parse_capture(without).records) == RECORDS[:1]
    assert list(parse_capture(swapped).records) == RECORDS[:1]


@pytest.mark.parametrize("at_ns", [2**63 - 1, -(2**63)])
def test_a_time_that_no_clock_says_ends_what_can_be_read(at_ns: int) -> None:
    writer = RecordWriter()
    said = [RECORDS[0], CaptureRecord(RecordKind.BYTES, 1, at_ns, b"\x99\x26\x40"), RECORDS[1]]
    data = MAGIC + b"".join([writer.encode(record) for record in said])
    assert parse_capture(data).records == (RECORDS[0],)


@pytest.mark.parametrize("data", [b"MThd", b"DRUMCUP", b"RUMCAP1", b"\x00" * 100])
def test_another_file_is_refused(data: bytes) -> None:
    with pytest.raises(BadInput, match=r"song\.mid: byte 0: no capture"):
        parse_capture(data, "song.mid")


def test_a_device_has_a_name_and_a_preset() -> None:
    assert device_of(RECORDS[0])[:2] == ("Kit «ü»", "roland-td-17")


@pytest.mark.parametrize("payload", [b"", b"[]", b"{}", b'{"name": 1, "preset": "x"}', b"\xff", b"3", b"[" * 100_000])
def test_a_device_that_cannot_be_read_is_the_files_fault(payload: bytes) -> None:
    with pytest.raises(BadInput, match="device 1"):
        device_of(CaptureRecord(RecordKind.DEVICE, 1, 0, payload))


@pytest.mark.parametrize("openness", [None, 0.0, 0.5])
def test_a_stroke_without_bytes_comes_back_whole(openness: float | None) -> None:
    hit = Hit(77, Piece.HIHAT, Zone.BOW, 90, Articulation.BUZZ, openness, device="keyboard")
    assert stroke_of(stroke_record(2, hit), "keyboard") == hit


NO_VELOCITY = struct.pack("<BBBBf", Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 0, 0.5)
NO_OPENNESS = struct.pack("<BBBBf", Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 90, math.inf)


@pytest.mark.parametrize("payload", [b"", b"\xff" * 8, NO_VELOCITY, NO_OPENNESS])
def test_a_stroke_that_cannot_be_read_is_the_files_fault(payload: bytes) -> None:
    with pytest.raises(BadInput, match="stroke at 5 ns"):
        stroke_of(CaptureRecord(RecordKind.STROKE, 2, 5, payload), "keyboard")


@pytest.mark.parametrize(
    ("at_ns", "fault"),
    [
        ([0, 24 * 3600 * NS_PER_S + 1], "more than a day apart"),
        (range(0, (MOST_STROKES + 1) * NS_PER_S // 100, NS_PER_S // 100), f"more than {MOST_STROKES} strokes"),
        ([5] * (MOST_A_SECOND + 1), "within a second"),
        ([k * NS_PER_S // (MOST_A_SECOND + 1) for k in range(2 * MOST_A_SECOND)], "within a second"),
    ],
    ids=["ages apart", "too many", "at once", "too dense"],
)
def test_strokes_that_no_player_plays_are_refused(at_ns: Iterable[int], fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        check_strokes(at_ns)


def test_the_longest_and_the_fastest_playing_is_taken() -> None:
    check_strokes(range(0, 2 * 3600 * NS_PER_S, NS_PER_S // 20))
    check_strokes([0, 24 * 3600 * NS_PER_S])
    check_strokes([])


def test_what_lies_more_than_a_day_from_its_beginning_is_damage() -> None:
    """But a capture that goes on after the computer was started anew begins again."""
    day_ns = 24 * 3600 * NS_PER_S
    far = [start_record(0, 0), CaptureRecord(RecordKind.BYTES, 1, day_ns + 1, b"\x99\x26\x64")]
    assert len(parse_capture(capture_bytes(far)).records) == 1
    anew = [start_record(9 * day_ns, 0), start_record(5, 0), CaptureRecord(RecordKind.BYTES, 1, 6, b"\x99\x26\x64")]
    assert len(parse_capture(capture_bytes(anew)).records) == 3


def test_a_record_of_megabytes_is_damage() -> None:
    huge = [start_record(0, 0), CaptureRecord(RecordKind.BYTES, 1, 5, bytes(10**6))]
    assert len(parse_capture(capture_bytes(huge)).records) == 1


def test_a_capture_of_more_devices_than_anybody_plugs_in_is_refused() -> None:
    devices = [device_record(k, k, f"kit {k}", "general-midi") for k in range(1_000)]
    with pytest.raises(BadInput, match="more than 64 devices"):
        list(replay(parse_capture(capture_bytes(devices))))
    again = [device_record(1, k, "kit", "general-midi") for k in range(1_000)]  # plugged in a thousand times
    assert list(replay(parse_capture(capture_bytes(again)))) == []
