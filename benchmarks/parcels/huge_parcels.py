"""Parcels that are honest in form and as much of one thing as goes in: they fit every sum and every size of a member.

Each asks a reader for work that grows faster than its bytes, or that is done before anything can be refused.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import product
from string import ascii_lowercase

from station.devices.capture.capture import MAGIC, CaptureRecord, RecordWriter, parse_capture
from station.practice.exchange.lesson_member import MOST_LESSON_BYTES
from station.practice.exchange.parcel_json import MOST_JSON_BYTES

_GRID = 'title = "Three"\n\n[grid]\nhihat = "| x x x x |"\nsnare = "| - o - o |"\n'
_HEAD = 'title = "Three"\n[grid]\n'
_MOST = 40
"""Sessions that a return may have; lessons of an assignment here."""
Members = Mapping[str, bytes]


def capture_of(records: Iterable[CaptureRecord]) -> bytes:
    """The file of these records, with checks that fit."""
    writer = RecordWriter()
    return MAGIC + b"".join(map(writer.encode, records))


@lru_cache(1)
def huge_lessons() -> tuple[bytes, ...]:
    """Texts of lessons, each as long as one may be: comments, cells, rests, keys, words, grids that repeat."""
    words = ["".join(letters) for letters in product(ascii_lowercase, repeat=3)]
    texts = (
        _filled(_GRID, "#\n"),
        _filled(_GRID, "\n"),
        _filled(_GRID, "#"),
        _filled(_HEAD + 'hihat = "| x ', "- ") + '|"\n',
        _filled(_HEAD + 'hihat = "| x ', "xx ") + '|"\n',
        _filled(_HEAD + 'hihat = "', "| q - "),
        _filled(_HEAD + 'times = 100\nhihat = "', "| - |") + '| x |"\n',
        _filled(_HEAD + 'times = 39\nhihat = "| xxxx xxxx xxxx xxxx ', "| - - - - ") + '|"\n',
        _GRID + "".join(f"{word} = 1\n" for word in words[:6000]),
        _GRID + "".join(f'{word} = "| x |"\n' for word in words[:3500]),
        _GRID + "".join(f"{word} = 1\n" * 2 for word in words[:3000]),
        _filled(_GRID + "x = [", "[],") + "]\n",
        _GRID.replace("Three", "x" * 60_000),
        "x" * 60_000 + " = 1\n" + _GRID,
        'title = "T"\n' + '[[grid]]\nhihat = "| x |"\n' * 2000,
        _filled(_GRID + "tags = [", '"a", ') + "]\n",
    )
    return tuple(text.encode() for text in texts)


@lru_cache(1)
def huge_values() -> tuple[object, ...]:
    """Values of a table, each nearly as long as a table may be."""
    keys = {"".join(letters): 1 for letters in product(ascii_lowercase, repeat=4)}
    few = dict(list(keys.items())[:60_000])
    return (
        few,
        [{}] * 300_000,
        [[]] * 300_000,
        "x" * 900_000,
        [few],
        {"x" * 900_000: 1},
        " " * 900_000,
        [1.5] * 180_000,
    )


def huge_reports(report: bytes) -> tuple[bytes, ...]:
    """A report with a key that nobody reads, as long as a report may be: empty tables, lists, numbers, texts."""
    return tuple(_longer(report, each) for each in (b"{},", b"[],", b"1.5,", b'"",', b"1e-9,", b'{"a":0},'))


def huge_captures(capture: bytes) -> tuple[bytes, ...]:
    """A capture with as many records, remarks or begun sessions as a member holds; all checks fit."""
    records = parse_capture(capture).records
    begun = next(one for one in records if b'"said":"pass"' in one.payload)
    said = replace(begun, payload=json.dumps({"said": "x", "words": "x" * 60_000}).encode())
    empty = replace(records[0], payload=b"")
    return tuple(capture_of([*records, *more]) for more in ([empty] * 50_000, [begun] * 250, [said] * 80))


def of_all_lessons(text: bytes) -> tuple[list[dict[str, str]], Members]:
    """Rows of an assignment's table for as many lessons of one text as go in, and their members."""
    files = {f"lessons/{number}.toml": text for number in range(1, _MOST + 1)}
    return [{"name": f"x{number}", "title": "x", "file": file} for number, file in enumerate(files)], files


def of_all_sessions(members: Members, report: bytes) -> Members:
    """The members of the first session in each of as many sessions as go in, with that report."""
    first = {name.removeprefix("sessions/1/"): data for name, data in members.items() if "/1/" in name}
    first["report.json"] = report
    return {f"sessions/{number}/{name}": data for number in range(1, _MOST + 1) for name, data in first.items()}


def _filled(head: str, with_: str) -> str:
    return head + with_ * ((MOST_LESSON_BYTES - len(head) - 8) // len(with_))


def _longer(report: bytes, entry: bytes) -> bytes:
    said = json.dumps(json.loads(report)).encode()[:-1] + b', "more": ['
    return said + (entry * ((MOST_JSON_BYTES - len(said) - 2) // len(entry)))[:-1] + b"]}"
