"""Parcels for tests: honest ones by the station's own writers, and others by `zipfile` and `json` alone."""

import hashlib
import io
import json
import warnings
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, date, datetime
from pathlib import Path
from typing import Any

from station.drills.library import lesson_path
from station.practice.exchange.assignment_file import AssignedLesson, Assignment
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import Note, SessionVerdict, StrokeVerdict
from station.practice.exchange.return_file import AssignmentWord, Return, ReturnedSession
from station.practice.exchange.session_figures import report_figures
from station.scoring.matching.hit_windows import Level

MADE = datetime(2026, 11, 23, 14, 0, 5, tzinfo=UTC)
TEXT = 'title = "Three"\n\n[grid]\nsnare = "| o - o - |"\n'
ASSIGNMENT_ID, RETURN_ID, NOTE_ID = "a" * 32, "b" * 32, "c" * 32
ASSIGNMENT = Assignment(
    ASSIGNMENT_ID,
    1,
    "Week 3",
    "Ms Okafor",
    MADE,
    (
        AssignedLesson("three", "Three", TEXT, LessonGoals(90.0, Level.ELEMENTARY, 4, 12.5, "hands low")),
        AssignedLesson("four", "Four", TEXT.replace("Three", "Four"), song="Blue Monday"),
    ),
    "Tuesday group",
    date(2026, 12, 1),
    "Slowly first.\nThen at tempo.",
)
NOTE = Note(
    NOTE_ID,
    RETURN_ID,
    ASSIGNMENT_ID,
    "Week 3",
    "Ms Okafor",
    "Zoë",
    MADE,
    "Well done.",
    "the same at 100",
    (SessionVerdict(1, "three", "softer", 80.0, True, (StrokeVerdict(True, note=3), StrokeVerdict(False, hit=4))),),
)


def unzipped(data: bytes) -> dict[str, bytes]:
    """Every member of a zip file."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def zipped(members: Mapping[str, bytes] | list[tuple[str | zipfile.ZipInfo, bytes]]) -> bytes:
    """A zip file of these members, in their order."""
    data = io.BytesIO()
    rows = list(members.items()) if isinstance(members, Mapping) else members
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of names that are there twice
        for name, content in rows:
            archive.writestr(name, content)
    return data.getvalue()


def table_of(data: bytes) -> dict[str, Any]:
    """The table of a parcel."""
    table: dict[str, Any] = json.loads(unzipped(data)["manifest.json"])
    return table


def sealed(table: Mapping[str, Any], members: Mapping[str, bytes]) -> bytes:
    """A parcel whose table says what it likes, with sums that fit: as somebody who means harm writes it."""
    rows = [
        {"name": name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()} for name, data in members.items()
    ]
    body = {"members": rows, **{key: value for key, value in table.items() if key != "checksum"}}
    plain = json.dumps(body, sort_keys=True, separators=(",", ":"))
    manifest = {**body, "checksum": hashlib.sha256(plain.encode()).hexdigest()}
    return zipped({"manifest.json": json.dumps(manifest).encode(), **members})


def changed(data: bytes, files: Mapping[str, bytes] | None = None, **table: object) -> bytes:
    """A parcel with other keys in its table and other members in `files`, and sums that fit."""
    old = unzipped(data)
    said = {key: value for key, value in json.loads(old.pop("manifest.json")).items() if key != "members"}
    return sealed({**said, **table}, {**old, **(files or {})})


def a_return(folder: Path) -> Return:
    """A return with the session in `folder`, of the shipped lesson rock-1, said to have taken ten seconds."""
    report = (folder / "report.json").read_bytes()
    session = ReturnedSession(
        "rock-1",
        datetime(2026, 11, 23, 18, 0, 5),
        replace(report_figures(report, "report", ""), seconds=10.0),
        lesson_path("rock-1").read_text(encoding="utf-8"),
        (folder / "session.capture").read_bytes(),
        report,
        (folder / "pairs.csv").read_bytes(),
    )
    return Return(RETURN_ID, AssignmentWord(ASSIGNMENT_ID, 1, "Week 3", "Tuesday group"), "Zoë", MADE, (session,))
