"""The bytes of MIDI files: what reads, with values counted by hand, and what is refused, with the wrong byte."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.music.formats.smf.chunk_reader import MAX_BYTES
from station.music.formats.smf.standard_midi import MidiFile, parse_midi, read_midi
from station.music.tempo import MeterChange, TempoChange
from tests.fakes.smf_bytes import END, chunk, event, file, header, meta, meter, number, tempo, track

NAME = "test.mid"


def notes_of(data: bytes, index: int = 0) -> list[tuple[int, ...]]:
    """(tick, duration, channel, number, velocity) of a track."""
    notes = parse_midi(data, NAME).tracks[index].notes
    return [tuple(row)[:5] for row in notes.tolist()]


def test_notes_last_until_they_are_let_go() -> None:
    data = file(event(10, 0x99, 38, 100), event(24, 0x89, 38, 64), event(5, 0x90, 60, 1), event(200, 0x90, 60, 0))
    assert notes_of(data) == [(10, 24, 9, 38, 100), (39, 200, 0, 60, 1)]


def test_a_note_ends_where_its_number_is_struck_again() -> None:
    data = file(event(0, 0x99, 38, 1), event(7, 0x99, 38, 2), event(3, 0x99, 36, 3), event(6, 0x89, 38, 0))
    assert notes_of(data) == [(0, 7, 9, 38, 1), (7, 9, 9, 38, 2), (10, -1, 9, 36, 3)]


def test_channels_and_numbers_do_not_end_each_other() -> None:
    data = file(event(0, 0x99, 38, 1), event(1, 0x98, 38, 2), event(1, 0x89, 37, 0), event(1, 0x88, 38, 0))
    assert notes_of(data) == [(0, -1, 9, 38, 1), (1, 2, 8, 38, 2)]


def test_running_status_goes_on_through_meta_and_sysex() -> None:
    data = file(
        event(0, 0x99, 38, 1),
        event(1, 38, 2),
        meta(1, 0x01, b"text"),
        event(1, 38, 3),
        event(1, 0xF0, 2, 0x41, 0xF7),
        event(1, 38, 4),
    )
    assert [(tick, velocity) for tick, _, _, _, velocity in notes_of(data)] == [(0, 1), (1, 2), (3, 3), (5, 4)]


def test_running_status_of_messages_with_one_data_byte() -> None:
    data = file(event(0, 0xC9, 1), event(3, 2), event(4, 0xD9, 9), event(5, 8), event(6, 0x99, 38, 70))
    assert notes_of(data) == [(18, -1, 9, 38, 70)]


def long_stretch(count: int, status_every: int) -> bytes:
    """Notes with deltas of one to four bytes, with and without status bytes."""
    deltas = [0, 1, 127, 128, 16_383, 16_384, 2_097_151, 2_097_152]
    return b"".join(
        event(deltas[i % 8], *([0x99] if i % status_every == 0 else []), 35 + i % 5, 1 + i % 127) for i in range(count)
    )


@pytest.mark.parametrize("status_every", [1, 2, 7, 1000])
@pytest.mark.parametrize("count", [1, 5, 40, 1000])
def test_long_stretches_read_like_short_ones(count: int, status_every: int) -> None:
    deltas = [0, 1, 127, 128, 16_383, 16_384, 2_097_151, 2_097_152]
    ticks = np.cumsum([deltas[i % 8] for i in range(count)]).tolist()
    notes = notes_of(file(long_stretch(count, status_every)))
    assert [(n[0], n[3], n[4]) for n in notes] == [(t, 35 + i % 5, 1 + i % 127) for i, t in enumerate(ticks)]


def test_stretches_longer_than_a_block_lose_nothing() -> None:
    count = 120_000  # about 600 kB, more than two blocks
    notes = parse_midi(file(long_stretch(count, 3), division=32_767), NAME).tracks[0].notes
    assert notes["velocity"].tolist() == [1 + i % 127 for i in range(count)]


def test_a_stretch_takes_over_the_running_status_before_it() -> None:
    """Thirty notes without a status byte of their own, after the one that sets it."""
    data = file(event(0, 0x99, 38, 1), *[event(1, 38, 2) for _ in range(30)])
    assert [n[2] for n in notes_of(data)] == [9] * 31


def test_all_kinds_of_two_byte_messages_share_a_stretch() -> None:
    one = (event(0, 0x99, 46, 90) + event(1, 0xB9, 4, 70) + event(1, 0xA9, 49, 127) + event(1, 0xE9, 0, 64)) + event(
        1, 0x89, 46, 0
    )
    read = parse_midi(file(*[one] * 20), NAME).tracks[0]
    assert read.notes["tick"].tolist() == [4 * i for i in range(20)]
    assert read.notes["duration_ticks"].tolist() == [4] * 20
    assert read.controllers.tolist() == [(4 * i + 1, 9, 4, 70, 5 * i + 1) for i in range(20)]
    assert read.aftertouch.tolist() == [(4 * i + 2, 9, 49, 127, 5 * i + 2) for i in range(20)]


def test_tempo_meter_texts_and_sysex() -> None:
    data = file(
        meta(0, 0x03, "Übung".encode()),
        meter(0, 7, 3),
        tempo(0, 400_000),
        meta(10, 0x06, "Fünf\r\n".encode("latin-1")),
        event(5, 0xF0, 4, 0x7E, 0x7F, 0x09, 0xF7),
        tempo(5, 300_000),
        meta(1, 0x21, b"\x00"),
        meta(1, 0x7F, b"maker's own"),
    )
    read = parse_midi(data, NAME).tracks[0]
    assert read.name == "Übung"
    assert [(t.tick, t.kind, t.text) for t in read.texts] == [(0, 3, "Übung"), (10, 6, "Fünf")]
    assert read.meters == (MeterChange(0, 7, 8),)
    assert read.tempos == (TempoChange(0, 400_000), TempoChange(20, 300_000))
    assert [(s.tick, s.data) for s in read.sysex] == [(15, b"\x7e\x7f\x09")]
    assert read.end_tick == 22


def test_an_escaped_message_is_no_sysex() -> None:
    assert parse_midi(file(event(0, 0xF7, 2, 0xF3, 1)), NAME).tracks[0].sysex == ()


def test_a_longer_header_is_read_as_far_as_it_is_known() -> None:
    data = chunk(b"MThd", bytes([0, 0, 0, 1, 0, 96, 1, 2, 3])) + track(event(0, 0x99, 38, 1))
    assert len(notes_of(data)) == 1


def test_a_riff_wrapper_is_opened() -> None:
    inner = file(event(0, 0x99, 38, 1))
    data = b"RIFF" + (len(inner) + 12).to_bytes(4, "little") + b"RMIDdata" + len(inner).to_bytes(4, "little") + inner
    assert len(notes_of(data)) == 1


def test_a_file_without_tracks_is_empty_and_no_fault() -> None:
    assert parse_midi(header(tracks=0), NAME).tracks == ()


@pytest.mark.parametrize(
    ("data", "oddity"),
    [
        (header() + track(event(0, 0x99, 38, 1), end=b""), "byte 26: the track has no end-of-track event"),
        (header() + track(end=END + b"\x00\x99"), "byte 26: 2 bytes follow the end of track"),
        (file() + b"junk", "byte 26: 4 bytes follow the last track"),
        (header() + chunk(b"XFIH", b"abc") + track(), "byte 14: a chunk of another kind, XFIH, was skipped"),
        (file(event(0, 0xF8)), "byte 23: system message F8, which has no place in a file, was skipped"),
        (file(event(0, 0xF2, 1, 2)), "byte 23: system message F2, which has no place in a file, was skipped"),
    ],
)
def test_what_is_odd_is_passed_over_and_told(data: bytes, oddity: str) -> None:
    assert parse_midi(data, NAME).oddities == (oddity,)


def test_many_oddities_are_summed_up() -> None:
    oddities = parse_midi(file(*[event(0, 0xF8)] * 50), NAME).oddities
    assert len(oddities) == 21
    assert oddities[-1] == "30 more system messages were skipped"


# --- time -------------------------------------------------------------------------------------------------------------


def ns_at(data: bytes, *ticks: int) -> list[int]:
    return [int(ns) for ns in parse_midi(data, NAME).sequences[0].ns_at(ticks)]


def test_unsaid_is_120_bpm_in_four() -> None:
    sequence = parse_midi(file(event(960, 0x99, 38, 1)), NAME).sequences[0]
    assert sequence.ns_at([0, 96, 960]).tolist() == [0, 500_000_000, 5_000_000_000]
    assert sequence.meters == (MeterChange(0, 4, 4),)


def test_times_are_exact_for_any_division() -> None:
    """7 ticks of 1/999 of 500000 µs are 3503503.5035… ns."""
    assert ns_at(file(event(7, 0x99, 38, 1), division=999), 1, 2, 7) == [500_501, 1_001_001, 3_503_504]


def test_tempo_changes_of_every_track_hold_for_all() -> None:
    """96 ticks at 120 bpm (0.5 s), 96 at 60 (1 s), the rest at 240."""
    data = header(1, 2) + track(tempo(96, 1_000_000)) + track(tempo(192, 250_000), event(192, 0x99, 38, 1))
    assert ns_at(data, 96, 192, 384) == [500_000_000, 1_500_000_000, 2_000_000_000]


@pytest.mark.parametrize(
    ("code", "ticks_a_frame", "second"),
    [(0xE8, 4, 96), (0xE7, 40, 1000), (0xE2, 80, 2400)],
)
def test_smpte_time_heeds_no_tempo(code: int, ticks_a_frame: int, second: int) -> None:
    data = file(tempo(0, 123_456), event(second, 0x99, 38, 1), division=code << 8 | ticks_a_frame)
    assert ns_at(data, 0, second) == [0, 1_000_000_000]


def test_smpte_29_is_thirty_frames_in_1001_milliseconds() -> None:
    data = file(event(3000, 0x99, 38, 1), division=0xE3 << 8 | 100)
    assert ns_at(data, 3000, 1) == [1_001_000_000, 333_667]


def test_tracks_of_format_2_keep_their_own_time() -> None:
    data = header(2, 2) + track(tempo(0, 1_000_000), event(96, 0x99, 36, 1)) + track(event(96, 0x99, 38, 1))
    sequences = parse_midi(data, NAME).sequences
    assert [int(s.ns_at(96)) for s in sequences] == [1_000_000_000, 500_000_000]


# --- refusals ---------------------------------------------------------------------------------------------------------

REFUSALS = {
    "nothing": (b"", "byte 0: the file is empty"),
    "text": (b"<html>", "byte 0: not a MIDI file: <htm where MThd should be"),
    "half a header": (header()[:10], "byte 10: the file ends in the middle of its header"),
    "short header": (chunk(b"MThd", b"\0\0\0\1") + track(), "byte 4: a header of 4 bytes; 6 were expected"),
    "endless header": (b"MThd\xff\xff\xff\xff" + bytes(6), "byte 4: a header of 4294967295 bytes; 6 were expected"),
    "format 3": (header(form=3), "byte 8: MIDI file format 3; there are only 0, 1 and 2"),
    "no division": (header(division=0), "byte 12: 0 ticks a quarter note"),
    "odd frames": (
        header(division=0xF060),
        "byte 12: 16 frames of 96 ticks a second; SMPTE has 24, 25, 29 or 30 frames",
    ),
    "empty frames": (
        header(division=0xE800),
        "byte 12: 24 frames of 0 ticks a second; SMPTE has 24, 25, 29 or 30 frames",
    ),
    "missing track": (header(1, 2) + track(), "byte 26: the file ends with 1 of its 2 tracks"),
    "half a track": (file(event(0, 0x99, 38, 1))[:-3], "byte 18: a chunk of 8 bytes, the file has 5 left"),
    "no status": (file(event(0, 38, 1)), "byte 23: data byte 26 where a status byte was expected"),
    "status as data": (file(event(0, 0x99, 38, 0x99)), "byte 25: status byte 99 where a data byte was expected"),
    "half a message": (
        header() + track(event(0, 0x99, 38), end=b""),
        "byte 25: the track ends in the middle of a message",
    ),
    "only a delta": (header() + track(b"\x05", end=b""), "byte 23: the track ends in the middle of an event"),
    "long delta": (file(b"\x81\x80\x80\x80\x00"), "byte 22: a delta time of more than 4 bytes"),
    "long meta": (
        file(b"\x00\xff\x01\x7f"),
        "byte 25: a meta event of 127 bytes, the track has 4 left",
    ),
    "long sysex": (
        file(b"\x00\xf0\x7f"),
        "byte 24: a system exclusive message of 127 bytes, the track has 4 left",
    ),
    "undefined": (file(event(0, 0xF4)), "byte 23: undefined status byte F4"),
    "short tempo": (file(meta(0, 0x51, b"\1\2")), "byte 23: meta event 51 has 2 bytes, 3 were expected"),
    "no tempo": (file(tempo(0, 0)), "byte 23: a tempo of 0 µs a quarter note"),
    "no beats": (file(meter(0, 0, 2)), "byte 23: a meter of 0 beats of 1/2^2 note"),
    "fine beats": (file(meter(0, 4, 13)), "byte 23: a meter of 4 beats of 1/2^13 note"),
    "too long": (
        file(tempo(0, (1 << 24) - 1), *[event((1 << 28) - 1, 0x99, 38, 1)] * 2, division=1),
        "lasts longer than a year, which no music does",
    ),
}


@pytest.mark.parametrize(("data", "fault"), REFUSALS.values(), ids=REFUSALS.keys())
def test_a_fault_is_named_with_its_byte(data: bytes, fault: str) -> None:
    with pytest.raises(BadInput) as raised:
        parse_midi(data, NAME)
    assert str(raised.value) == f"{NAME}: {fault}"


def test_a_fault_in_a_long_stretch_is_found_at_its_byte() -> None:
    good = event(0, 0x99, 38, 1) * 100
    with pytest.raises(BadInput, match="byte 424: status byte 99 where a data byte was expected"):
        parse_midi(file(good + event(0, 0x99, 0x99, 1)), NAME)


def test_a_huge_file_is_refused_before_it_is_understood() -> None:
    with pytest.raises(BadInput, match="larger than 8 MiB"):
        parse_midi(bytes(MAX_BYTES + 1), NAME)


@pytest.mark.parametrize(
    ("make", "fault"),
    [(lambda path: None, "no such file"), (lambda path: path.mkdir(), "cannot be read: Is a directory")],
)
def test_a_file_that_cannot_be_opened_says_why(tmp_path: Path, make: Callable[[Path], None], fault: str) -> None:
    path = tmp_path / "kit.mid"
    make(path)
    with pytest.raises(BadInput) as raised:
        read_midi(path)
    assert str(raised.value) == f"{path}: {fault}"


def test_a_file_is_read_from_disk(tmp_path: Path) -> None:
    path = tmp_path / "kit.mid"
    path.write_bytes(file(event(0, 0x99, 38, 1), number(0) + b"\xff\x01\x00"))
    midi: MidiFile = read_midi(path)
    assert (midi.source, midi.title, len(midi.tracks[0].notes)) == (str(path), "kit", 1)
