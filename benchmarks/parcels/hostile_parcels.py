"""Parcels that mean harm: broken bytes, zip files that lie, tables that say what they should not, members likewise.

Most have sums that fit, so that what lies behind the sums is reached: whoever means harm can compute them.
"""

import hashlib
import io
import json
import random
import re
import struct
import warnings
import zipfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from copy import deepcopy
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.hostile_bytes import lines_again, number, ways_for
from benchmarks.parcels.huge_parcels import (
    capture_of,
    huge_captures,
    huge_lessons,
    huge_reports,
    huge_values,
    of_all_lessons,
    of_all_sessions,
)
from station.core.settings import Settings
from station.devices.capture.capture import CaptureRecord, parse_capture
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.drills.reading.lesson_file import parse_lesson
from station.practice.exchange.assignment_file import AssignedLesson, Assignment, assignment_bytes
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import Note, SessionVerdict, StrokeVerdict, note_bytes
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import AssignmentWord, Return, ReturnedSession, return_bytes
from station.practice.exchange.session_figures import report_figures
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.report.session_pairs import session_pairs_csv
from station.practice.records.report.session_report import practice_document
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec

_SHORT = 'title = "Three"\n\n[grid]\nhihat = "| x x x x |"\nsnare = "| - o - o |"\n'
_LESSONS = ("rock-1", "single-paradiddle")
_MADE = datetime(2026, 11, 23, 14, tzinfo=UTC)
_IDS = ["a" * 32, "b" * 32, "c" * 32]
_HOSTILE_NAMES = (
    *("../../x", "/etc/passwd", "C:\\x", "\\\\host\\share", "lessons/../1.toml", "lessons/1.TOML", "LESSONS/1.toml"),
    *("lessons/0.toml", "lessons/01.toml", "lessons/100.toml", "sessions/99/report.json", "CON", "lessons/con.toml"),
    *("manifest.json", "README.txt", "Manifest.json", "lessons/1.toml/", "lessons/\u202elmot.1", "lessons/１.toml"),
    *(".", "..", "a\0b", "x" * 65_000, "lessons/1.toml ", "sessions/1/session.capture", "__MACOSX/._1.toml"),
)
_HOSTILE_WORDS = (
    *("", " ", "\0", "\x1b[2J\x1b]0;x\x07", "\u202egpj.exe", "\u2028", "\ud800", "\ufeff", "\U000e0041", "a\nb\tc"),
    *(
        "x" * 121,
        "x" * 100_000,
        "../../x",
        "con",
        "CON.toml",
        "rock-1.course",
        "-",
        "--help",
        "~root",
        "%s%n{0}$(x)`x`",
    ),
    *(
        "e\u0301" * 60,
        "\u0301" * 119,
        "ﬁ",
        "İ",
        "ß",
        "１",
        "lessons/1.toml",
        "lessons/2.toml",
        "0" * 32,
        "f" * 32,
        "F" * 32,
    ),
    *("2026-12-01", "0001-01-01", "9999-12-31", "2026-13-01", "2026-W01-1", "20261201", "2026-12-01T00:00:00Z"),
    *("2026-12-01T24:00:00Z", "2026-12-01T23:59:60Z", "2026-12-01T00:00:00+99:00", "beginner", "BEGINNER", "god"),
    *("drum-station/assignment/1", "drum-station/return/1", "drum-station/note/1", "drum-station/assignment/2"),
    *("drum-station/assignment/999999", "drum-station/assessment/1"),
)
_HOSTILE_NUMBERS = (0, -1, 1, 2, 99, 0.5, 1e-300, 1e308, -1e308, 2**31, 2**63, 10**30, 10**400, 1000.0001, -0.0)
_HOSTILE_VALUES: tuple[Any, ...] = (None, True, False, [], {}, [[]], [{}], {"": ""}, [None] * 3, [0] * 2000, [{}] * 200)
_NON_JSON = (
    b"NaN",
    b"Infinity",
    b"1e400",
    b"9" * 5000,
    b"[" * 3000,
    b'{"a":' * 2000,
    b"\xff",
    b"'x'",
    b"0x10",
    b"",
    b"01",
)


_MOST_COPIED = 1_000_000
"""Letters that one change adds to a table: twice as many are longer than any that is read (our choice)."""


@dataclass(frozen=True, slots=True)
class Seed:
    """An honest parcel: its kind, its table without sums, its members."""

    kind: Kind
    table: Mapping[str, Any]
    members: Mapping[str, bytes]


def seeds() -> list[Seed]:
    """Honest parcels of each kind: one with two lessons, and two with a short one, which are read in half the time."""
    note = _taken_apart(Kind.NOTE, _note())
    whole, short = (
        [_taken_apart(Kind.ASSIGNMENT, _assignment(lessons)), _taken_apart(Kind.RETURN, _return(lessons)), note]
        for lessons in ([find_lesson(name) for name in _LESSONS], [_short_lesson()])
    )
    return [*whole, *short, *short]


def _short_lesson() -> Lesson:
    lesson = parse_lesson(_SHORT, "short", "short").lesson
    assert lesson is not None, "it is well written"
    return lesson


def _assignment(given: Sequence[Lesson]) -> bytes:
    goals = LessonGoals(90.0, Level.ELEMENTARY, 4, 12.5, "hands low")
    lessons = [AssignedLesson(one.name, one.title, one.text, goals, "song") for one in given]
    group, due, words = "Tuesday", _MADE.date(), "Slowly.\nThen at tempo."
    return assignment_bytes(Assignment(_IDS[0], 1, "Week 3", "Ms O", _MADE, tuple(lessons), group, due, words))


def _return(given: Sequence[Lesson]) -> bytes:
    sessions = []
    for lesson in given:
        plan = plan_practice(lesson, PlanOptions(loops=1, demonstrations=0))
        with TemporaryDirectory() as folder:
            capture = Path(folder) / "x.capture"
            result = practise_virtually(plan, parse_spec("intermediate,seed=1"), capture).result
            data = capture.read_bytes()
        report = json.dumps(practice_document(result, Settings())).encode()
        figures = report_figures(report, "report", "")
        name, text, pairs = lesson.name, lesson.text, session_pairs_csv(result).encode()
        sessions.append(ReturnedSession(name, _MADE.replace(tzinfo=None), figures, text, data, report, pairs))
    word = AssignmentWord(_IDS[0], 1, "Week 3", "Tuesday")
    return return_bytes(Return(_IDS[1], word, "Zoë", _MADE, tuple(sessions), "Two days."))


def _note() -> bytes:
    strokes = (StrokeVerdict(True, note=3), StrokeVerdict(False, hit=4, words="late"))
    verdict = SessionVerdict(1, "rock-1", "softer", 80.0, True, strokes)
    return note_bytes(Note(_IDS[2], _IDS[1], _IDS[0], "Week 3", "Ms O", "Zoë", _MADE, "Good.", "faster", (verdict,)))


def _taken_apart(kind: Kind, data: bytes) -> Seed:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    table = json.loads(members.pop("manifest.json"))
    return Seed(kind, {key: value for key, value in table.items() if key not in ("members", "checksum")}, members)


# --- putting together -------------------------------------------------------------------------------------------------

Rows = list[tuple[str | zipfile.ZipInfo, bytes]]


def sealed(table: Mapping[str, Any], members: Mapping[str, bytes]) -> bytes:
    """The table with sums that fit, as JSON; what JSON cannot say is left out."""
    rows = [
        {"name": name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()} for name, data in members.items()
    ]
    body = {"members": rows, **table}
    plain = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return json.dumps({**body, "checksum": hashlib.sha256(plain.encode()).hexdigest()}).encode()


def zipped(rows: Rows, packing: int = zipfile.ZIP_DEFLATED) -> bytes:
    """A zip file of these members, whatever they are called."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", packing, compresslevel=1) as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, content in rows:
            archive.writestr(name, content)
    return data.getvalue()


def _whole(table: Mapping[str, Any], members: Mapping[str, bytes]) -> Rows:
    return [("manifest.json", sealed(table, members)), *members.items()]


# --- ways of harm -----------------------------------------------------------------------------------------------------

Harm = Callable[[Seed, random.Random], bytes]


def hostile(of: Sequence[Seed], rng: random.Random) -> tuple[Kind, bytes]:
    """A parcel that means harm, and as what it is opened."""
    seed = rng.choice(of)
    (harm,) = rng.choices([way for way, _ in _HARMS], [weight for _, weight in _HARMS])
    kind = seed.kind if rng.random() < 0.98 else rng.choice(list(Kind))
    return kind, harm(seed, rng)


def broken_bytes(seed: Seed, rng: random.Random) -> bytes:
    """Bits flipped, cut, doubled, or overwritten with what zip files count by."""
    data = bytearray(zipped(_whole(seed.table, seed.members)))
    for _ in range(rng.choice((1, 1, 2, 8, 64))):
        at = rng.randrange(len(data))
        match rng.randrange(5):
            case 0:
                data[at] ^= 1 << rng.randrange(8)
            case 1:
                del data[at : at + rng.choice((1, 4, 100, 10_000))]
            case 2:
                data[at:at] = data[at : at + rng.choice((1, 4, 100, 2000))]
            case 3:
                data[at : at + 4] = struct.pack(
                    "<I", rng.choice((0, 1, 0xFFFF, 0xFFFFFFFF, 0x7FFFFFFF, rng.randrange(2**32)))
                )
            case _:
                data[at:at] = rng.choice((b"PK\x01\x02", b"PK\x03\x04", b"PK\x05\x06", b"PK\x06\x06", b"PK\x06\x07"))
        if not data:
            break
    return bytes(data)


def lying_directory(seed: Seed, rng: random.Random) -> bytes:
    """A field in the table at the zip file's end says something else: sizes, sums, places, packings, flags."""
    data = bytearray(zipped(_whole(seed.table, seed.members)))
    marks = [found.start() for found in re.finditer(rb"PK(?:\x01\x02|\x05\x06|\x03\x04)", data)]
    at = rng.choice(marks) + rng.choice((4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 38, 42))
    wide = rng.choice(("<H", "<I"))
    most = 2**16 if wide == "<H" else 2**32
    struct.pack_into(
        wide, data, min(at, len(data) - 4), rng.choice((0, 1, 8, 9, 12, 14, 99, most - 1, rng.randrange(most)))
    )
    return bytes(data)


def strange_members(seed: Seed, rng: random.Random) -> bytes:
    """Members of other names, twice, missing, linked, packed otherwise, bombs, a zip file in a zip file, very many."""
    members = dict(seed.members)
    name, other = rng.choice(list(members)), rng.choice(_HOSTILE_NAMES)
    rows = _whole(seed.table, members)
    bomb = bytes(rng.choice((1 << 16, 5 << 20)) if rng.random() < 0.2 else 70_000)
    without = {one: data for one, data in members.items() if one != name}
    more = [(f"lessons/{index}.toml", b"") for index in range(rng.choice((12, 12, 12, 12, 300, 1100)))]
    return rng.choice(
        (
            lambda: zipped(_whole(seed.table, {**members, other: b"x"})),
            lambda: zipped([*rows, (other, members[name])]),
            lambda: zipped([*rows, rng.choice(rows)]),
            lambda: zipped(_whole(seed.table, without)),
            lambda: zipped([rows[0], *without.items()]),
            lambda: _linked(seed, name, rng),
            lambda: zipped(rows, rng.choice((zipfile.ZIP_STORED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA))),
            lambda: zipped(_whole(seed.table, {**members, name: bomb})),
            lambda: zipped([*rows[:-1], (rows[-1][0], bomb)]),
            lambda: zipped(_whole(seed.table, {**members, name: zipped(rows)})),
            lambda: zipped([*rows, *more]),
        )
    )()


def _linked(seed: Seed, name: str, rng: random.Random) -> bytes:
    """A member that says to be a link, a pipe, a device or a folder."""
    link = zipfile.ZipInfo(name)
    link.external_attr = rng.choice((0o120777, 0o010666, 0o020666, 0o040777)) << 16
    rows = _whole(seed.table, {**seed.members, name: b"/etc/passwd"})
    return zipped([(link if row == name else row, data) for row, data in rows])


def strange_table(seed: Seed, rng: random.Random) -> bytes:
    """The table says something else somewhere, once or several times, with sums that fit."""
    table = json.loads(json.dumps(seed.table))
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        _spoil(table, rng)
    return zipped(_whole(table, seed.members))


def broken_table(seed: Seed, rng: random.Random) -> bytes:
    """The table's text is broken, or is none of ours."""
    text = sealed(seed.table, seed.members)
    if rng.random() < 0.5:
        for _ in range(rng.choice((1, 2, 5))):
            at = rng.randrange(len(text) + 1)
            text = (
                text[:at]
                + rng.choice((*_NON_JSON, b"}", b"]", b",", b'"', b"\\ud800"))
                + text[at + rng.choice((0, 1, 5)) :]
            )
    else:
        text = rng.choice((number, lines_again))(text, (), rng)
    return zipped([("manifest.json", text[: 2 << 20]), *seed.members.items()])


def strange_content(seed: Seed, rng: random.Random) -> bytes:
    """A member's content is broken as its kind of file is, with sums that fit."""
    if seed.kind is Kind.NOTE:
        return strange_table(seed, rng)
    members = dict(seed.members)
    name = rng.choice([one for one in members if one != "README.txt"])
    members[name] = _content(name, members[name], rng)
    return zipped(_whole(seed.table, members))


def _content(name: str, data: bytes, rng: random.Random) -> bytes:
    if name.endswith(".json") and rng.random() < 0.7:
        report = json.loads(data)
        for _ in range(rng.choice((1, 1, 3))):
            session = report.get("session")
            _spoil(session if rng.random() < 0.5 and isinstance(session, dict) else report, rng)
        return json.dumps(report).encode()
    if name.endswith(".capture") and rng.random() < 0.7:
        return _capture(data, rng)
    for _ in range(rng.choice((1, 1, 2, 4))):
        data = rng.choice(ways_for(data))(data, (), rng)[: rng.choice((40_000, 40_000, 40_000, 300_000))]
    return data


def _capture(data: bytes, rng: random.Random) -> bytes:
    """A capture some of whose records say something else, with checks that fit."""
    records = list(parse_capture(data).records)
    for _ in range(rng.choice((1, 1, 3, 20))):
        at = rng.randrange(len(records))
        records[at] = _record(records[at], rng)
        if rng.random() < 0.1:
            records[at:at] = [records[at]] * rng.choice((1, 10, 1000))
    return capture_of(records)


def _record(record: CaptureRecord, rng: random.Random) -> CaptureRecord:
    if record.payload.startswith(b"{") and record.payload.endswith(b"}") and rng.random() < 0.8:
        with suppress(ValueError):  # it was broken before
            return _said(record, rng)
    match rng.randrange(4):
        case 0:
            return replace(record, kind=rng.choice((*range(13), 255)))
        case 1:
            return replace(record, at_ns=rng.choice((0, -1, 2**61, -(2**61), record.at_ns + 10**12, 1)))
        case 2:
            return replace(record, device=rng.choice((0, 1, 2, 65535)))
        case _:
            return replace(
                record, payload=rng.choice((b"", rng.randbytes(40), record.payload * 50, record.payload[:-1]))
            )


def _said(record: CaptureRecord, rng: random.Random) -> CaptureRecord:
    said = json.loads(record.payload)
    for _ in range(rng.choice((1, 1, 2, 5))):
        _spoil(said, rng)
    return replace(record, payload=json.dumps(said).encode())


def _spoil(value: dict[Any, Any] | list[Any], rng: random.Random) -> None:
    """Change one thing in a table or list, at any depth."""
    keys = list(value) if isinstance(value, dict) else list(range(len(value)))
    if not keys:
        return
    key = rng.choice(keys)
    if isinstance(value[key], dict | list) and value[key] and rng.random() < 0.75:
        _spoil(value[key], rng)
        return
    match rng.randrange(8):
        case 0:
            del value[key]
        case 1 if isinstance(value, dict):
            value[rng.choice(_HOSTILE_WORDS)] = value[key]
        case 2 if isinstance(value, list):
            most = 1 + _MOST_COPIED // len(json.dumps(value[key]))
            value += [deepcopy(value[key]) for _ in range(min(rng.choice((1, 2, 60, 3000)), most))]
        case 3:
            value[key] = deepcopy(rng.choice(_HOSTILE_VALUES))
        case 4:
            value[key] = rng.choice(_HOSTILE_NUMBERS)
        case 5:
            value[key] = {key: value[key]} if isinstance(key, str) else [value[key]]
        case _:
            value[key] = rng.choice(_HOSTILE_WORDS)


def as_much_as_goes_in(seed: Seed, rng: random.Random) -> bytes:
    """A parcel with as much of one thing as any may have: in its table, its lessons, its reports."""
    table, members = dict(seed.table), dict(seed.members)
    if seed.kind is Kind.NOTE or rng.random() < 0.3:
        table[rng.choice([*table, "more"])] = rng.choice(huge_values())
    elif seed.kind is Kind.ASSIGNMENT:
        table["lessons"], members = of_all_lessons(rng.choice(huge_lessons()))
    elif rng.random() < 0.5:
        name = "sessions/1/session.capture"
        members[name] = rng.choice(huge_captures(members[name]))
    else:
        members = of_all_sessions(members, rng.choice(huge_reports(members["sessions/1/report.json"])))
        table["sessions"] = [table["sessions"][0]] * (len(members) // 4)
    return zipped(_whole(table, members))


def false_claims(seed: Seed, rng: random.Random) -> bytes:
    """Every part is well made, but of another: reports that claim more, lessons, captures and pairs exchanged."""
    members = {name: data for name, data in seed.members.items() if name != "README.txt"}
    if seed.kind is Kind.RETURN:
        name = rng.choice([one for one in members if one.endswith("report.json")])
        report = json.loads(members[name])
        report |= {"score": 100.0, "right": report["counts"]["notes"], "level": "studio"}
        report["session"] |= {"passes": rng.choice((1, 99, 100_000)), "beats_a_minute": rng.choice((60, 240, 4000))}
        members[name] = json.dumps(report).encode()
    for name in rng.sample(sorted(members), min(len(members), 2)):
        like = [other for other in members if other.rpartition("/")[2][-5:] == name[-5:]]
        members[name] = members[rng.choice(like)]
    table = {**seed.table, "id": rng.choice(_IDS)}
    return zipped(_whole(table, members))


def no_parcel(seed: Seed, rng: random.Random) -> bytes:
    """Something else altogether."""
    lone = rng.choice(list(seed.members.values()))
    return rng.choice(
        (b"", b"PK", b"PK\x03\x04", b"PK\x05\x06" + bytes(18), rng.randbytes(rng.choice((1, 22, 1000))), lone)
    )


_HARMS: tuple[tuple[Harm, int], ...] = (
    (broken_bytes, 160),
    (lying_directory, 90),
    (strange_members, 150),
    (strange_table, 250),
    (broken_table, 98),
    (strange_content, 190),
    (false_claims, 40),
    (as_much_as_goes_in, 2),
    (no_parcel, 20),
)
"""In thousandths (our choice); what is as large as it may be takes a hundred times as long as another."""
