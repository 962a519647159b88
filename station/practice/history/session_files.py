"""The folder that a session leaves: `<sessions>/<student>/<date>_<lesson>/` with its capture and its report.

What was played is written there while it is played, and there the user finds it; what was practised and how it went the
history answers (`history.session_intake` takes a folder in). Every file is written whole or, like the capture,
append-only.
"""

import json
from datetime import datetime
from pathlib import Path

from station.core.disk.file_names import alike, folder_name, marked, telling_name
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
    """Where all of a student's is kept, under the folder of all sessions; none of the folders that are no student's.

    One that is there is taken, in whatever spelling.
    """
    own = sessions / own_folder_name(student)
    return own if own.is_dir() else next(iter(student_folders(sessions, student)), own)


def student_folders(sessions: Path, student: str) -> list[Path]:
    """All folders of a student that are there, in every spelling, the one of their name's own spelling first."""
    name = own_folder_name(student)
    try:
        there = [path for path in sessions.iterdir() if alike(path.name) == alike(name)]
    except OSError:
        return []
    found = [path for path in there if path.is_dir() and not leads_to_another(path)]
    return sorted(found, key=lambda path: (path.name != name, path.name))


def own_folder_name(student: str) -> str:
    """What a new folder of a student is called: names that differ have folders that differ."""
    name = telling_name(student)
    return marked(name, student) if name.casefold() in OWN_FOLDERS else name


def leads_to_another(folder: Path) -> bool:
    """Whether a student's folder is a link to a folder of another student's, which is never followed."""
    if not folder.is_symlink():
        return False
    there = folder.resolve()
    return there.is_relative_to(folder.parent.resolve()) and alike(there.name) != alike(folder.name)


def session_folder(sessions: Path, student: str, lesson: str, started: datetime) -> Path:
    """Make and return a new folder for a session; raises `DeviceError` where none can be made."""
    stem = session_name(started, lesson)
    parent = student_folder(sessions, student)
    if leads_to_another(parent):
        raise DeviceError(f"{parent}: is a link to another student's folder: take it away, or take another name")
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
