"""The capture on a real disk: a full one (/dev/full), one with another file in the way, a process that is killed."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from station.core.errors import BadInput, DeviceError
from station.devices.capture.capture import CaptureRecord, RecordKind, parse_capture, read_capture
from station.devices.capture.capture_writer import CaptureFile

HIT = CaptureRecord(RecordKind.BYTES, 1, 20, bytes.fromhex("99 26 64"))
FULL = Path("/dev/full")

KILLED_WRITER = """
import sys, time
from pathlib import Path
from station.devices.capture.capture import RecordKind, CaptureRecord, read_capture
from station.devices.capture.capture_writer import CaptureFile
capture = CaptureFile(Path(sys.argv[1]), 0)
for index in range(50):
    capture.append(CaptureRecord(RecordKind.BYTES, 1, index, b"hit"))
while len(read_capture(Path(sys.argv[1])).records) < 51:
    time.sleep(0.01)
print("ready", flush=True)
time.sleep(60)
"""


def kinds(path: Path) -> list[int]:
    return [record.kind for record in read_capture(path).records]


def test_a_closed_capture_is_complete(tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "take.cap"
    capture = CaptureFile(path, 10)
    capture.append(HIT)
    capture.close(30)
    assert capture.fault is None
    assert kinds(path) == [RecordKind.START, RecordKind.BYTES, RecordKind.END]
    assert read_capture(path).complete
    assert read_capture(path).records[1] == HIT


def test_closing_twice_is_harmless(tmp_path: Path) -> None:
    capture = CaptureFile(tmp_path / "take.cap", 0)
    capture.close(1)
    capture.close(2)
    assert kinds(tmp_path / "take.cap") == [RecordKind.START, RecordKind.END]


@pytest.mark.parametrize("cut", [0, 1, 5, 9, 30])
def test_a_capture_that_was_cut_short_is_continued_behind_its_last_sound_record(tmp_path: Path, cut: int) -> None:
    path = tmp_path / "take.cap"
    first = CaptureFile(path, 0)
    first.append(HIT)
    first.close(1)
    before = read_capture(path).records
    path.write_bytes(path.read_bytes()[: path.stat().st_size - cut])
    kept = read_capture(path).records
    second = CaptureFile(path, 2)
    second.append(HIT)
    second.close(3)
    capture = read_capture(path)
    assert capture.complete
    assert capture.records[: len(kept)] == kept == before[: len(kept)]
    assert [record.kind for record in capture.records[len(kept) :]] == [
        RecordKind.START,
        RecordKind.BYTES,
        RecordKind.END,
    ]


def test_a_file_that_a_crash_left_with_half_its_first_word_is_begun_anew(tmp_path: Path) -> None:
    path = tmp_path / "take.cap"
    path.write_bytes(b"DRUM")
    CaptureFile(path, 0).close(1)
    assert read_capture(path).complete


def test_another_kind_of_file_is_not_touched(tmp_path: Path) -> None:
    path = tmp_path / "song.mid"
    path.write_bytes(b"MThd and the rest")
    with pytest.raises(BadInput, match=r"song\.mid"):
        CaptureFile(path, 0)
    assert path.read_bytes() == b"MThd and the rest"


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(DeviceError, match="no capture can be written"):
        CaptureFile(tmp_path / "file" / "take.cap", 0)


@pytest.mark.skipif(not FULL.exists(), reason="this system has no /dev/full")
def test_a_full_disk_is_told_and_ends_in_time() -> None:
    capture = CaptureFile(FULL, 0)
    capture.append(HIT)
    capture.close(1)
    assert capture.fault is not None
    assert "No space left" in capture.fault


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill outright")
def test_a_killed_process_leaves_all_but_the_last_moment(tmp_path: Path) -> None:
    path = tmp_path / "take.cap"
    command = [sys.executable, "-c", KILLED_WRITER, str(path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:
        assert writer.stdout is not None
        assert writer.stdout.readline() == "ready\n"
        os.kill(writer.pid, signal.SIGKILL)
    assert [r.at_ns for r in read_capture(path).records if r.kind == RecordKind.BYTES] == list(range(50))


def test_a_missing_capture_is_the_users_fault(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="no such file"):
        read_capture(tmp_path / "none.cap")


def test_a_folder_is_no_capture(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="cannot be read"):
        read_capture(tmp_path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_takes_a_capture_and_is_at_no_fault(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    capture = CaptureFile(pipe, 0)
    capture.append(HIT)
    capture.close(1)
    assert capture.fault is None
    assert [record.kind for record in parse_capture(os.read(reader, 4096)).records] == [
        RecordKind.START,
        HIT.kind,
        RecordKind.END,
    ]
    os.close(reader)


def test_what_waits_for_a_disk_is_joined_at_once(tmp_path: Path) -> None:
    """One by one, 400,000 records would be copied four trillion bytes' worth: that is minutes."""
    capture = CaptureFile(tmp_path / "take.capture", 0)
    record = CaptureRecord(RecordKind.BYTES, 1, 5, b"\x99\x26\x64")
    for _ in range(400_000):
        capture.append(record)
    capture.close(6)
    assert capture.fault is None
    assert (tmp_path / "take.capture").stat().st_size > 400_000 * 22
