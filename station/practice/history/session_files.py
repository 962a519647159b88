"""The folder that a session leaves: `<sessions>/<student>/<date>_<lesson>/` with its capture and its report.

What was played is written there while it is played, and there the user finds it; what was practised and how it went the
history answers (`history.session_intake` takes a folder in). Every file is written whole or, like the capture,
append-only.
"""

import json
from datetime import datetime
from pathlib import Path

from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import DeviceError

CAPTURE_NAME = "session.capture"
DOCUMENT_NAME = "report.json"
TEXT_NAME = "report.txt"
TAKE_NAME = "take.json"
PAIRS_NAME = "pairs.csv"
EXAM_NAME = "exam.json"
LEARNT_NAME = "learnt.json"
BATTLE_CAPTURE_NAME = "battle.capture"
BATTLE_NAME = "battle.json"
PICTURE_NAME = "report.png"
DRUMMER_NAME = "drummer.png"

OWN_FOLDERS = frozenset({"assignments", "courses", "lessons", "returns", "styles"})
"""What lies beside the students' folders: given and returned parcels, what the user has written."""
VIRTUAL_STUDENT = "virtual student"
"""Whose a session is that a virtual student plays who was given no name: nobody's who practises here."""

_STARTED = "%Y-%m-%dT%H-%M-%S"


def student_folder(sessions: Path, student: str) -> Path:
    """Where all of a student's is kept, under the folder of all sessions; none of the folders that are no student's."""
    name = folder_name(student)
    return sessions / (f"{name}_" if name.casefold() in OWN_FOLDERS else name)


def session_folder(sessions: Path, student: str, lesson: str, started: datetime) -> Path:
    """Make and return a new folder for a session; raises `DeviceError` where none can be made."""
    stem = session_name(started, lesson)
    parent = student_folder(sessions, student)
    for attempt in range(1, 1000):
        path = parent / (stem if attempt == 1 else f"{stem}_{attempt}")
        try:
            path.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as fault:
            raise DeviceError(f"{path}: no folder can be made: {fault.strerror or fault}") from fault
        return path
    raise DeviceError(f"{parent / stem}: a thousand sessions in one second")


def session_name(started: datetime, lesson: str) -> str:
    """What a session is called, and its folder where the user has named none."""
    return f"{started.strftime(_STARTED)}_{folder_name(lesson)}"


def started_in(name: str) -> datetime | None:
    """When a session of that name was begun; None where it says nothing of it."""
    day, clock = name[: len("2026-12-01")], name[len("2026-12-01T") : len("2026-12-01T18-30-00")]
    try:
        return datetime.fromisoformat(f"{day}T{clock.replace('-', ':')}") if clock[5:6] == "-" else None
    except ValueError:
        return None


def write_document(path: Path, document: object) -> None:
    """Write a JSON document whole; raises `DeviceError`."""
    write_whole(
        path,
        (json.dumps(document, ensure_ascii=False, allow_nan=False, indent=2) + "\n").encode(
            "utf-8", "backslashreplace"
        ),
    )
