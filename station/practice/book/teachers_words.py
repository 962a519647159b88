"""What teachers want of a student and have written to them, from the assignments that the student has taken."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date

from station.core.settings import Settings
from station.drills.daily.daily_items import Assigned
from station.practice.exchange.student_store import TakenAssignment, taken_assignments
from station.practice.records.teachers_wishes import wishes_of


@dataclass(frozen=True, slots=True)
class TeacherNote:
    """What a teacher wrote on a `day`, in a line each."""

    day: date
    author: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TeachersWords:
    """Everything of it, for one student."""

    assigned: tuple[Assigned, ...] = ()
    notes: tuple[TeacherNote, ...] = ()

    def on(self, day: date) -> tuple[TeacherNote, ...]:
        """What was written on a day."""
        return tuple(note for note in self.notes if note.day == day)


def teachers_words(settings: Settings, today: date, notify: Callable[[str], None]) -> TeachersWords:
    """What the student of `settings` has from their teachers; `notify` hears what cannot be read."""
    taken, faults = taken_assignments(settings)
    for fault in faults:
        notify(str(fault))
    return TeachersWords(wishes_of(settings, today).assigned, _notes(taken))


def _notes(taken: Sequence[TakenAssignment]) -> tuple[TeacherNote, ...]:
    notes = [note for one in taken for note in one.notes]
    return tuple(TeacherNote(note.made.astimezone().date(), note.teacher, note.lines) for note in notes)
