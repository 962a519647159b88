"""What a student has taken to practise, and what came back: folders of files.

`<sessions>/<student>/assignments/<title>_<id>/` holds `assignment.drum-assignment` as it came, `taken.json`
(`records.assigned_lessons`), `returns/<id>.json` for each return that was made, `notes/<id>.drum-note`. The lessons lie
among the student's own, in a folder of that name; one that ships in the same words is the shipped one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from datetime import date, datetime
from pathlib import Path

from station.core.disk.file_names import alike, folder_name
from station.core.disk.files import read_regular, write_whole
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.exchange.assignment_file import (
    AssignedLesson,
    Assignment,
    lessons_of,
    parse_assignment,
    read_assignment,
)
from station.practice.exchange.lesson_member import MOST_LESSON_BYTES
from station.practice.exchange.note_file import Note, SessionVerdict, parse_note, read_note
from station.practice.exchange.notes_kept import note_row
from station.practice.exchange.parcel import Kind
from station.practice.exchange.parcel_json import MOST_JSON_BYTES, read_json
from station.practice.exchange.return_file import Return
from station.practice.history.session_files import write_document
from station.practice.history.student_history import StudentHistory
from station.practice.records.assigned_lessons import Taken, all_taken, assignments_folder, write_taken
from station.store.student_names import student_key

_FILE_NAME = f"assignment{Kind.ASSIGNMENT.ending}"
_ID_LETTERS = 8
_TITLE_LETTERS = 40
"""Of the id and the title in a folder's name (our choice: of 9000 ids two begin alike in one case of a hundred)."""
_MOST_COPIES = 1000


@dataclass(frozen=True, slots=True)
class TakenAssignment:
    """An assignment that was taken, in its `folder`, with the notes that came back, the oldest first."""

    folder: Path
    taken: Taken
    assignment: Assignment
    notes: tuple[Note, ...]

    def days_left(self, today: date) -> int | None:
        """Days until it is due, negative when it is late; None where it is due whenever."""
        return None if self.assignment.due is None else (self.assignment.due - today).days

    @property
    def returns(self) -> tuple[str, ...]:
        """The ids of the returns that were made."""
        return tuple(sorted(path.stem for path in self.folder.glob("returns/*.json")))


def stem_of(title: str, identity: str) -> str:
    """The name of what belongs to an assignment, a return or a note: readable, and one of its kind."""
    return f"{folder_name(title)[:_TITLE_LETTERS].strip('-.')}_{identity[:_ID_LETTERS]}"


# --- taking -----------------------------------------------------------------------------------------------------------


def take(path: Path, settings: Settings, now: datetime) -> tuple[TakenAssignment, str]:
    """Take the assignment in the file at `path` at `now` (naive), and what was done, in words.

    Twice is once; a later version takes the place of an earlier one. Raises `BadInput` and `DeviceError`.
    """
    data = read_regular(path, Kind.ASSIGNMENT.value.most_bytes)
    assignment = parse_assignment(data, str(path))
    lessons_of(assignment, str(path))
    before = next((one for one in taken_assignments(settings)[0] if one.assignment.id == assignment.id), None)
    if before is not None:
        if (before.folder / _FILE_NAME).read_bytes() == data:
            return before, "was taken before: nothing changed"
        if before.assignment.revision > assignment.revision:
            told = f"version {before.assignment.revision} was taken before, which is later: nothing changed"
            return before, told
        if before.assignment.revision == assignment.revision:
            raise BadInput(path, "", "another file of the same assignment and version was taken before")
    kept = _keep(assignment, data, settings, now, before)
    return kept, "taken" if before is None else _in_place_of(assignment, before.assignment)


def _in_place_of(later: Assignment, before: Assignment) -> str:
    said = f"version {later.revision} takes the place of the one before"
    if later.teacher == before.teacher:
        return said
    return f"{said}; it is from {later.teacher}, that was from {before.teacher}"


def _keep(
    assignment: Assignment, data: bytes, settings: Settings, now: datetime, before: TakenAssignment | None
) -> TakenAssignment:
    stem = stem_of(assignment.title, assignment.id) if before is None else before.folder.name
    folder = assignments_folder(settings.sessions_dir, settings.student) / stem
    lessons = settings.own_lessons_dir / stem
    put_before = {} if before is None else _texts_here(before)
    called = tuple((one.name, _put(one, lessons, settings, put_before)) for one in assignment.lessons)
    since = now.isoformat(timespec="seconds") if before is None else before.taken.since
    said = () if before is None else before.taken.said
    taken = Taken(assignment.id, assignment.revision, since, called, said, assignment.due)
    write_whole(folder / _FILE_NAME, data)
    write_taken(folder, taken)
    return TakenAssignment(folder, taken, assignment, () if before is None else before.notes)


def _texts_here(one: TakenAssignment) -> dict[str, str]:
    """What the lessons of an assignment said when it was taken, by what they are called here."""
    return {here: lesson.text for name, here in one.taken.lessons if (lesson := one.assignment.lesson(name))}


def _put(lesson: AssignedLesson, folder: Path, settings: Settings, put_before: Mapping[str, str]) -> str:
    """What the lesson is called here: its own name, or that with a number where another has it.

    One that an earlier version put there is another as soon as the student has changed it.
    """
    from station.drills.library import lesson_names, lesson_path  # noqa: PLC0415 - a refusal needs none of it

    others = {
        alike(path.stem)
        for path in settings.own_lessons_dir.rglob("*.toml")
        if path.parent != folder or not _says(path, lesson.text, put_before.get(path.stem))
    }
    shipped = {alike(name): name for name in lesson_names()}
    for number in range(1, _MOST_COPIES):
        name = lesson.name if number == 1 else f"{lesson.name}-{number}"
        if name in shipped.values() and _same_text(lesson_path(name), lesson.text):
            return name
        if alike(name) not in others and alike(name) not in shipped:
            write_whole(folder / f"{name}.toml", lesson.text.encode())
            return name
    raise BadInput(lesson.name, "", "a thousand lessons have this name already")


def _says(path: Path, *texts: str | None) -> bool:
    """Whether a file holds one of the texts, to the letter."""
    try:
        return read_regular(path, MOST_LESSON_BYTES) in [text.encode() for text in texts if text is not None]
    except BadInput:
        return False


def _same_text(path: Path, text: str) -> bool:
    return path.read_text(encoding="utf-8").strip() == text.strip()


# --- what is there ----------------------------------------------------------------------------------------------------


def taken_assignments(settings: Settings) -> tuple[list[TakenAssignment], list[BadInput]]:
    """All that the student has taken, the oldest first, and the faults of what cannot be read any more."""
    found: list[TakenAssignment] = []
    faults: list[BadInput] = []
    for folder, taken in all_taken(settings.sessions_dir, settings.student).items():
        try:
            found.append(TakenAssignment(folder, taken, read_assignment(folder / _FILE_NAME), _notes(folder)))
        except BadInput as fault:
            faults.append(fault)
    return found, faults


def _notes(folder: Path) -> tuple[Note, ...]:
    notes = [read_note(path) for path in sorted(folder.glob(f"notes/*{Kind.NOTE.ending}"))]
    return tuple(sorted(notes, key=lambda note: note.made))


def find_taken(settings: Settings, which: str) -> TakenAssignment:
    """The one whose id or title begins with `which`; raises `BadInput` where none or several do."""
    taken, _ = taken_assignments(settings)
    found = [one for one in taken if _is_meant(one, which.casefold())]
    if len(found) == 1:
        return found[0]
    if found:
        raise BadInput(which, "", f"{len(found)} assignments begin so: say more of the id")
    there = ", ".join(stem_of(one.assignment.title, one.assignment.id) for one in taken[-5:])
    raise BadInput(which, "", f"no such assignment{f'; there are {there}' if there else ': none was taken yet'}")


def _is_meant(one: TakenAssignment, which: str) -> bool:
    names = (one.assignment.id, one.assignment.title.casefold(), one.folder.name.casefold())
    return any(name.startswith(which) for name in names)


# --- what goes and comes back -----------------------------------------------------------------------------------------


def remember_return(one: TakenAssignment, sent: Return) -> None:
    """That this return was made, so that its note is known when it comes; raises `DeviceError`."""
    played = [session_key(each.lesson, each.played) for each in sent.sessions]
    document = {"schema": "drum-station/sent/1", "id": sent.id, "sessions": len(played), "played": played}
    write_document(one.folder / "returns" / f"{sent.id}.json", document)


def verdicts_on(one: TakenAssignment) -> dict[str, SessionVerdict]:
    """What notes say of sessions that were sent, by `session_key`; the latest note has the last word."""
    found: dict[str, SessionVerdict] = {}
    for note in one.notes:
        sent = _sent_sessions(one.folder / "returns" / f"{note.return_id}.json")
        found |= {sent[each.number - 1]: each for each in note.sessions if each.number <= len(sent)}
    return found


def session_key(lesson: str, played: datetime) -> str:
    """What a session of an assignment's lesson is known by: no two of them begin in one second."""
    return f"{played:%Y-%m-%dT%H:%M:%S} {lesson}"


def _sent_sessions(path: Path) -> list[str]:
    """The keys of the sessions of a return, in its order; none where it was made before they were kept."""
    try:
        kept = read_json(read_regular(path, MOST_JSON_BYTES), str(path), "")
    except BadInput:
        return []
    played = kept.get("played", []) if isinstance(kept, dict) else []
    return [str(each) for each in played] if isinstance(played, list) else []


def keep_note(path: Path, settings: Settings) -> tuple[TakenAssignment, Note, bool]:
    """Keep the note in the file at `path`: what it belongs to, the note, and whether it is new.

    Raises `BadInput` where it answers no return of this student's, and `DeviceError`.
    """
    data = read_regular(path, Kind.NOTE.value.most_bytes)
    note = parse_note(data, str(path))
    one = next((each for each in taken_assignments(settings)[0] if each.assignment.id == note.assignment_id), None)
    if one is None:
        raise BadInput(path, "", f"it answers {note.title}, which {settings.student} has not taken")
    if student_key(note.student) != student_key(settings.student):
        raise BadInput(path, "", f"it is a note for {note.student}, not for {settings.student}")
    if note.return_id not in one.returns:
        raise BadInput(path, "", f"it answers a return of {note.title} that {settings.student} has not made")
    _check_sessions(note, _sent_sessions(one.folder / "returns" / f"{note.return_id}.json"), path)
    kept = one.folder / "notes" / f"{note.id}{Kind.NOTE.ending}"
    is_new = not kept.exists()
    if not is_new and read_regular(kept, Kind.NOTE.value.most_bytes) != data:
        raise BadInput(path, "", "another note of the same id came before")
    write_whole(kept, data)
    whose = StudentHistory.of(settings)
    whose.ask(lambda history, student: history.keep_note(student, note_row(note, data)))
    if is_new and all(note.made >= other.made for other in one.notes):
        write_taken(one.folder, replace(one.taken, said=tuple(_said(note, one.taken))))
    return one, note, is_new


def _check_sessions(note: Note, sent: list[str], path: Path) -> None:
    """Raises `BadInput` where a note speaks of a session that is none of those `sent`, where they were kept."""
    for one in note.sessions if sent else ():
        if one.number > len(sent) or sent[one.number - 1].partition(" ")[2] != one.lesson:
            raise BadInput(path, "", f"it speaks of session {one.number}, {one.lesson}, which the return has not")


def _said(note: Note, taken: Taken) -> Iterator[tuple[str, str]]:
    """What a note says of each lesson, as it is called here, in a line."""
    for name, here in taken.lessons:
        of_it = [each.words for each in note.sessions if each.lesson == name]
        words = [*filter(None, of_it), *([f"Next: {note.next}"] if note.next and of_it else [])]
        if words:
            yield here, " ".join(" ".join(map(_closed, words)).split())


def _closed(words: str) -> str:
    """A sentence that ends, so that another may follow; the last of them is closed as well as any."""
    return words if words.rstrip().endswith((".", "!", "?")) else f"{words.rstrip()}."
