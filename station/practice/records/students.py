"""Who practises here: the students whom the history knows, and which names stay apart."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import date

from station.core.settings import Settings
from station.practice.history.session_files import VIRTUAL_STUDENT
from station.practice.history.student_history import StudentHistory
from station.store.student_names import student_key


@dataclass(frozen=True, slots=True)
class KnownStudent:
    """A student by name, and the day on which they played last; None where nothing is kept yet."""

    name: str
    last: date | None = None

    def words(self, today: date) -> str:
        """When that was."""
        if self.last is None:
            return "nothing played yet"
        ago = (today - self.last).days
        return {0: "played today", 1: "played yesterday"}.get(ago) or f"played on {self.last.day} {self.last:%B %Y}"


def known_students(settings: Settings, named: Iterable[str]) -> tuple[KnownStudent, ...]:
    """Those who are `named`, in this order, then whoever else the history knows, who played last first."""
    rows = StudentHistory.of(settings).ask(lambda history, _: history.students()) or []
    found: dict[str, KnownStudent] = {}
    for name in named:
        found.setdefault(student_key(name), KnownStudent(name))
    for row in rows:
        key, last = student_key(row.name), None if row.last is None else row.last.date()
        if key in found:
            found[key] = replace(found[key], last=last)
        elif row.name != VIRTUAL_STUDENT:
            found[key] = KnownStudent(row.name, last)
    return tuple(found.values())


def shares_folder(name: str, other: str) -> bool:
    """Whether two names are of one student, as they have one folder."""
    return student_key(name) == student_key(other)


def sharing(name: str, others: Sequence[str]) -> str | None:
    """Which of the `others` is the student whom `name` would be, in another spelling; None where nobody is."""
    return next((each for each in others if each != name and shares_folder(name, each)), None)
