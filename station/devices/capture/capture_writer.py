"""Writes a capture to disk from a thread of its own, so that a slow disk never delays a hit.

Whatever is recorded is on the disk (written and synchronised) within 100 ms. When the disk refuses, nothing is dropped:
the records wait in memory, writing is tried again every second, and `fault` says what is wrong. A file that exists is
continued after its last sound record, as after a crash.
"""

import os
import stat
import threading
import time
from collections import deque
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from station.core.disk.file_lock import lock
from station.core.errors import DeviceError
from station.devices.capture.capture import MAGIC, CaptureRecord, RecordKind, RecordWriter, parse_capture, start_record

BATCH_S = 0.04
"""How long the first record of a batch waits for company: with a 50 ms write still within the promised 100 ms."""
RETRY_S = 1.0
"""Pause after a refused write (our choice)."""


class CaptureSink(Protocol):
    """Where an engine puts its records."""

    @property
    def fault(self) -> str | None:
        """What hinders writing at present, None if nothing does."""
        ...

    def append(self, record: CaptureRecord) -> None:
        """Keep `record`; never waits."""
        ...

    def close(self, at_ns: int) -> None:
        """Close the capture in order at session time `at_ns`; `fault` says whether something stayed unwritten."""
        ...


class CaptureFile:
    """A capture at `path` that begins at session time `at_ns`, written behind the caller's back.

    Raises `DeviceError` where it cannot begin and `BadInput` where another kind of file is in the way.
    """

    def __init__(self, path: Path, at_ns: int) -> None:
        self.path = path
        self._pending: deque[bytes] = deque()
        self._half_written = b""
        self._wake = threading.Event()
        self._closing = threading.Event()
        self._fault: str | None = None
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o644)
        except OSError as fault:
            raise DeviceError(f"{path}: no capture can be written: {fault.strerror or fault}") from fault
        lock(self._file)  # who deletes files sees that this one is being written
        self._is_on_disk = stat.S_ISREG(os.fstat(self._file).st_mode)
        try:
            self._writer = RecordWriter(self._continue_file())
        except BaseException:
            os.close(self._file)
            raise
        self.append(start_record(at_ns, time.time_ns()))
        self._thread = threading.Thread(target=self._run, name="capture", daemon=True)
        self._thread.start()

    def _continue_file(self) -> int | None:
        """Go behind the last sound record; returns its check, None at the start of a new file."""
        if not self._is_on_disk:  # a pipe or a device has no past
            self._pending.append(MAGIC)
            return None
        try:
            sound = parse_capture(self.path.read_bytes(), self.path)
            os.ftruncate(self._file, sound.good_bytes)
            os.lseek(self._file, sound.good_bytes, os.SEEK_SET)
        except OSError as fault:
            raise DeviceError(f"{self.path}: cannot be continued: {fault.strerror or fault}") from fault
        if not sound.good_bytes:  # empty, or cut short within the first eight bytes
            self._pending.append(MAGIC)
        return sound.check

    @property
    def fault(self) -> str | None:
        """What hinders writing at present, None if nothing does."""
        return self._fault

    def append(self, record: CaptureRecord) -> None:
        """Keep `record`; never waits. Callers take turns, for the checks follow one another."""
        self._pending.append(self._writer.encode(record))
        self._wake.set()

    def close(self, at_ns: int) -> None:
        """Write what is left and the END record; after it `fault` says whether something stayed unwritten."""
        if self._closing.is_set():
            return
        self.append(CaptureRecord(RecordKind.END, 0, at_ns))
        self._closing.set()
        self._wake.set()
        self._thread.join()
        with suppress(OSError):
            os.close(self._file)

    def _run(self) -> None:
        while not self._closing.is_set():
            self._wake.wait()
            self._closing.wait(BATCH_S)
            self._wake.clear()
            while not self._write_pending() and not self._closing.wait(RETRY_S):
                pass
        self._write_pending()

    def _write_pending(self) -> bool:
        """Put everything on the disk; False when it refused, with the rest kept."""
        waiting = [self._half_written]
        while self._pending:
            waiting.append(self._pending.popleft())
        self._half_written = b"".join(waiting)  # at once: one by one each would be copied with all before it
        try:
            while self._half_written:
                written = os.write(self._file, self._half_written)
                self._half_written = self._half_written[written:]
            if self._is_on_disk:  # the system refuses for pipes and devices
                os.fsync(self._file)
        except OSError as fault:
            self._fault = f"{self.path}: the capture waits in memory: {fault.strerror or fault}"
            return False
        self._fault = None
        return True
