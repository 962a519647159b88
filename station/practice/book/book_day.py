"""One day of the lesson book as it is kept: `<sessions>/<student>/book/<day>.json`, written whole.

It holds what no session knows: the plan as it was made, which blocks were left out on purpose, and the student's line
about the day. What was practised is read from the sessions' own folders, what a teacher wrote from the assignments'. A
file that cannot be read is set aside under another name, never written over.
"""

from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

from station.core.errors import BadInput
from station.drills.daily.daily_items import DailyItem
from station.drills.mastery.mastery_json import from_json, to_json
from station.practice.history.kept_json import recalled
from station.practice.history.session_files import student_folder, write_document

FOLDER = "book"
SCHEMA = "drum-station/book-day/1"
LONGEST_LINE = 280
"""Letters of a reflection (our choice: one or two sentences)."""
MOST_ITEMS = 60
"""Our choice: a block a minute."""


@dataclass(frozen=True, slots=True)
class BookDay:
    """A day: its plan (`items` for `minutes`), the places of blocks `left_out` on purpose, the line."""

    day: date
    minutes: int = 0
    items: tuple[DailyItem, ...] = ()
    left_out: tuple[int, ...] = ()
    line: str = ""

    def checked(self, source: str) -> "BookDay":
        """The same; raises `BadInput` that names `source` for more than a day has."""
        faults = (
            ("items", len(self.items) > MOST_ITEMS, f"{len(self.items)} blocks, {MOST_ITEMS} at most"),
            (
                "items",
                any(not 0 < one.minutes <= MOST_ITEMS for one in self.items),
                "a block of no or of too many minutes",
            ),
            ("left_out", any(not 0 <= at < len(self.items) for at in self.left_out), "a block that is not there"),
            ("line", len(self.line) > LONGEST_LINE, f"longer than {LONGEST_LINE} letters"),
        )
        for place, is_wrong, fault in faults:
            if is_wrong:
                raise BadInput(source, place, fault)
        return self


def one_line(text: str) -> str:
    """A reflection as it is kept: one line, not too long."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())[:LONGEST_LINE]


@dataclass(frozen=True, slots=True)
class BookFolder:
    """Where a student's days are kept."""

    path: Path

    @classmethod
    def of(cls, sessions: Path, student: str) -> "BookFolder":
        """That of `student`, under the folder of all sessions."""
        return cls(student_folder(sessions, student) / FOLDER)

    def recall(self, day: date) -> tuple[BookDay, str | None]:
        """What is kept of a day, an empty day where nothing is; and a line where the file could not be read.

        Raises `DeviceError` where the file can neither be read nor set aside.
        """
        kept, fault = recalled(self._file(day), _day_from, "this day of the lesson book begins anew")
        return replace(kept, day=day) if kept is not None else BookDay(day), fault

    def keep(self, day: BookDay) -> None:
        """Keep a day from now on; raises `DeviceError`, and then what was kept stays."""
        write_document(self._file(day.day), {"schema": SCHEMA, "day": to_json(day)})

    def days(self) -> list[date]:
        """The days of which something is kept, in order."""
        found = (_date(path.stem) for path in self.path.glob("*.json"))
        return sorted(day for day in found if day is not None)

    def _file(self, day: date) -> Path:
        return self.path / f"{day.isoformat()}.json"


def _date(text: str) -> date | None:
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None


def _day_from(document: object, source: str) -> BookDay:
    if not isinstance(document, dict) or document.get("schema") != SCHEMA:
        raise BadInput(source, "schema", f"is not {SCHEMA}")
    return from_json(BookDay, document.get("day"), source, "day").checked(source)
