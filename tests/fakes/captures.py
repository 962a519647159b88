"""Captures written down shortly."""

from collections.abc import Iterable

from station.devices.capture import MAGIC, Record, RecordWriter


def capture_bytes(records: Iterable[Record]) -> bytes:
    """A capture file that holds `records`."""
    writer = RecordWriter()
    return MAGIC + b"".join(writer.encode(record) for record in records)
