"""Teachers' notes as the history keeps them, also those that were taken before there was one.

They lie in `<student>/assignments/<assignment>/notes/<id>.drum-note`, where they stay.
"""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.practice.exchange.note_file import Note, parse_note
from station.practice.exchange.parcel import Kind
from station.store.rows import TeacherNoteRow

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History


def note_row(note: Note, data: bytes) -> TeacherNoteRow:
    """A note that was read from `data`, as the history keeps it."""
    made = note.made.astimezone().replace(tzinfo=None)
    return TeacherNoteRow(note.id, note.assignment_id, note.title, note.teacher, made, note.words, note.next, data)


def take_in_notes(history: "History", ours: Path, student: str) -> None:
    """Have the history know the notes in a student's folder that it does not; twice is once. Raises `DeviceError`.

    One that cannot be read is left out: whoever opens its assignment is told (`student_store.taken_assignments`).
    """
    paths = sorted(ours.glob(f"assignments/*/notes/*{Kind.NOTE.ending}"))
    known = {row.note for row in history.notes(student)} if paths else set()
    for path in paths:
        if path.stem not in known:
            with suppress(BadInput):
                data = read_regular(path, Kind.NOTE.value.most_bytes)
                history.keep_note(student, note_row(parse_note(data, str(path)), data))
