"""Captures written down shortly, and awaited."""

import time
from collections.abc import Iterable
from pathlib import Path

from station.devices.capture.capture import MAGIC, CaptureRecord, RecordKind, RecordWriter, read_capture


def capture_bytes(records: Iterable[CaptureRecord]) -> bytes:
    """A capture file that holds `records`."""
    writer = RecordWriter()
    return MAGIC + b"".join(writer.encode(record) for record in records)


def on_disk(path: Path, kind: RecordKind) -> None:
    """Wait until the capture that is written at `path` has a record of `kind`; the test's own timeout bounds it."""
    while all(record.kind != kind for record in read_capture(path).records):
        time.sleep(0.01)
