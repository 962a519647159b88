"""What a draft's journal holds: a line for the text it began with, then a line for each change, in the order made.

A line is the length of its record and its CRC-32 (zlib's), both hexadecimal, then the record in JSON. So a record that
was torn as the power went is known for what it is, and all before it stands.
"""

import json
from dataclasses import dataclass
from zlib import crc32

from station.drills.editing.text_change import TextChange

SCHEMA = "drum-station/draft/1"


@dataclass(frozen=True, slots=True)
class DraftRecords:
    """A draft as its journal has it.

    `lesson` is the file that was edited, empty for one that has none yet; `base` the text that the editing began with,
    `text` what stands now, `name` what the last change was called; `changes` how many there are; `good_bytes` how much
    of the journal is whole.
    """

    lesson: str
    base: str
    text: str
    name: str = ""
    changes: int = 0
    good_bytes: int = 0


def start_record(lesson: str, base: str) -> bytes:
    """The line that a journal begins with."""
    return _line({"schema": SCHEMA, "lesson": lesson, "text": base})


def change_record(change: TextChange, name: str) -> bytes:
    """The line of a change called `name`."""
    return _line({"at": change.at, "taken": change.taken, "given": change.given, "name": name})


def read_records(data: bytes) -> DraftRecords | None:
    """The draft of a journal, up to the first line that is torn or fits nothing; None where its start is neither.

    Whatever `data` holds, nothing is raised.
    """
    draft: DraftRecords | None = None
    text, name, changes, good = "", "", 0, 0
    for line in data.splitlines(keepends=True):
        record = _record(line)
        if record is None:
            break
        if draft is None:
            draft = _start(record)
            if draft is None:
                return None
            text = draft.text
        else:
            change = _change(record)
            if change is None or not change.fits(text):
                break
            text, name, changes = change.applied(text), str(record.get("name", "")), changes + 1
        good += len(line)
    return draft and DraftRecords(draft.lesson, draft.base, text, name, changes, good)


def _line(record: dict[str, object]) -> bytes:
    body = json.dumps(record, separators=(",", ":")).encode("ascii")
    return b"%x %08x %s\n" % (len(body), crc32(body), body)


def _record(line: bytes) -> dict[str, object] | None:
    """What a whole line says; None for a torn or a foreign one."""
    parts = line.removesuffix(b"\n").split(b" ", 2)
    if not line.endswith(b"\n") or len(parts) != 3 or parts[:2] != [b"%x" % len(parts[2]), b"%08x" % crc32(parts[2])]:
        return None
    try:
        record = json.loads(parts[2])
    except (ValueError, RecursionError):
        return None
    return record if isinstance(record, dict) else None


def _start(record: dict[str, object]) -> DraftRecords | None:
    lesson, text = record.get("lesson"), record.get("text")
    if record.get("schema") != SCHEMA or not isinstance(lesson, str) or not isinstance(text, str):
        return None
    return DraftRecords(lesson, text, text)


def _change(record: dict[str, object]) -> TextChange | None:
    at, taken, given = (record.get(key) for key in ("at", "taken", "given"))
    if not (type(at) is int and isinstance(taken, str) and isinstance(given, str)):
        return None
    return TextChange(at, taken, given)
