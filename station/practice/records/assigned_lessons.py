"""Which lessons a student was given to practise, and by which assignment.

`<sessions>/<student>/assignments/<assignment>/taken.json` says it of each assignment that was taken; what lies beside
it is `practice.exchange.student_store`'s. A file that cannot be read is left out.
"""

from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path

from station.core.errors import BadInput
from station.drills.mastery.mastery_json import from_json, to_json
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import student_folder, write_document

FOLDER = "assignments"
TAKEN_NAME = "taken.json"
SCHEMA = "drum-station/taken/1"


@dataclass(frozen=True, slots=True)
class Taken:
    """An assignment that was taken: its `id` and `revision`, `since` when (by the clock on the wall, ISO 8601).

    `lessons` are pairs: what a lesson is called in the assignment, and what it is called here; `said` what the
    teacher's last note says of a lesson, as it is called here; `due` the day until which it is wanted (None: whenever).
    """

    id: str
    revision: int
    since: str
    lessons: tuple[tuple[str, str], ...]
    said: tuple[tuple[str, str], ...] = ()
    due: date | None = None

    @property
    def when(self) -> datetime:
        """When it was taken, naive."""
        return datetime.fromisoformat(self.since)

    def has(self, lesson: str) -> bool:
        """Whether a lesson of that name, as it is called here, belongs to it."""
        return any(lesson == here for _, here in self.lessons)

    def here(self, name: str) -> str | None:
        """What a lesson of the assignment is called here."""
        return dict(self.lessons).get(name)


def assignments_folder(sessions: Path, student: str) -> Path:
    """Where a student's assignments are kept, under the folder of all sessions."""
    return student_folder(sessions, student) / FOLDER


def all_taken(sessions: Path, student: str) -> dict[Path, Taken]:
    """What `student` has taken, by its folder, the oldest first."""
    paths = assignments_folder(sessions, student).glob(f"*/{TAKEN_NAME}")
    found = {path.parent: taken for path in sorted(paths) if (taken := _read(path)) is not None}
    return dict(sorted(found.items(), key=lambda item: item[1].since))


def assigned_by(sessions: Path, student: str, lesson: str) -> list[Taken]:
    """The assignments that a lesson, as it is called here, belongs to."""
    return [taken for taken in all_taken(sessions, student).values() if taken.has(lesson)]


def write_taken(folder: Path, taken: Taken) -> None:
    """Remember it; raises `DeviceError`."""
    write_document(folder / TAKEN_NAME, {"schema": SCHEMA, "taken": to_json(taken)})


def _read(path: Path) -> Taken | None:
    try:
        document = kept_document(path)
        if not isinstance(document, dict) or document["schema"] != SCHEMA:
            return None
        taken = from_json(Taken, document["taken"], str(path))
        return taken if taken.when.tzinfo is None else None
    except (ValueError, KeyError, TypeError, BadInput):
        return None
