"""What a teacher has given, and what students have sent: files in folders.

`<sessions>/assignments/<title>_<id>.drum-assignment` is what was given;
`<sessions>/returns/<class or title>/<student>/<day>_<id>.drum-return` what came, as it came, and beside it, under the
same name, the teacher's `.drum-note`. No file is called by what a stranger's file says without `folder_name`.
"""

from dataclasses import dataclass, replace
from pathlib import Path

from station.core.disk.file_names import folder_name
from station.core.disk.files import read_regular, write_whole
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.exchange.assignment_file import Assignment, assignment_bytes, read_assignment
from station.practice.exchange.lesson_goals import GoalState, goal_states
from station.practice.exchange.note_file import Note, SessionVerdict, note_bytes, overruled, read_note
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import Return, parse_return, read_return
from station.practice.exchange.student_store import stem_of

GIVEN_FOLDER, RETURNS_FOLDER = "assignments", "returns"


@dataclass(frozen=True, slots=True, eq=False)
class Received:
    """A return in its file at `path`, and the teacher's `note` on it, None before there is one."""

    path: Path
    returned: Return
    note: Note | None

    @property
    def stem(self) -> str:
        """What it is called on the command line."""
        return self.path.name.removesuffix(Kind.RETURN.ending)


# --- assignments ------------------------------------------------------------------------------------------------------


def keep_given(assignment: Assignment, settings: Settings) -> bytes:
    """The file of an assignment, of which a copy is kept; raises `BadInput` and `DeviceError`."""
    data = assignment_bytes(assignment)
    name = f"{stem_of(assignment.title, assignment.id)}{assignment_ending()}"
    write_whole(settings.sessions_dir / GIVEN_FOLDER / name, data)
    return data


def assignment_ending() -> str:
    """How the names of assignments end."""
    return Kind.ASSIGNMENT.ending


def given(settings: Settings) -> list[Assignment]:
    """All that was given and can be read, the oldest first."""
    found: list[Assignment] = []
    for path in (settings.sessions_dir / GIVEN_FOLDER).glob(f"*{Kind.ASSIGNMENT.ending}"):
        try:
            found.append(read_assignment(path))
        except BadInput:
            continue
    return sorted(found, key=lambda one: (one.made, one.revision))


# --- returns ----------------------------------------------------------------------------------------------------------


def receive(path: Path, settings: Settings) -> tuple[Received, bool]:
    """Keep the return in the file at `path`, and whether it is new: twice is once.

    Raises `BadInput` where it is none, or another of its id came before, and `DeviceError`.
    """
    data = read_regular(path, Kind.RETURN.value.most_bytes)
    returned = parse_return(data, str(path))
    top = settings.sessions_dir / RETURNS_FOLDER
    name = f"{returned.made:%Y-%m-%d}_{returned.id[:8]}{Kind.RETURN.ending}"
    kept = top / folder_name(returned.assignment.shelf) / folder_name(returned.student) / name
    if kept.exists():
        if read_regular(kept, Kind.RETURN.value.most_bytes) != data:
            raise BadInput(path, "", f"another return of the same id came before: {kept}")
        return Received(kept, returned, _note_beside(kept)), False
    write_whole(kept, data)
    return Received(kept, returned, None), True


def received(settings: Settings) -> tuple[list[Received], list[BadInput]]:
    """All returns, by class, student and day, and the faults of what cannot be read any more."""
    found: list[Received] = []
    faults: list[BadInput] = []
    for path in sorted((settings.sessions_dir / RETURNS_FOLDER).glob(f"*/*/*{Kind.RETURN.ending}")):
        try:
            found.append(Received(path, read_return(path), _note_beside(path)))
        except BadInput as fault:
            faults.append(fault)
    return found, faults


def find_received(settings: Settings, which: str) -> Received:
    """The return whose file or id begins with `which`; raises `BadInput` where none or several do."""
    all_of_them, _ = received(settings)
    found = [one for one in all_of_them if one.stem.startswith(which) or one.returned.id.startswith(which)]
    if len(found) == 1:
        return found[0]
    if found:
        raise BadInput(which, "", f"{len(found)} returns begin so: say more of the id")
    there = ", ".join(one.stem for one in all_of_them[-5:])
    raise BadInput(which, "", f"no such return{f'; there are {there}' if there else ': none came yet'}")


def goals_of(one: Received, given_before: list[Assignment]) -> dict[str, list[GoalState]]:
    """What was asked of each lesson that came back, and what its sessions reached of it.

    By the students' word, where the teacher's note does not overrule it; nothing where it was given elsewhere.
    """
    asked = assignment_of(one.returned, given_before)
    verdicts = {} if one.note is None else {verdict.number: verdict for verdict in one.note.sessions}
    states: dict[str, list[GoalState]] = {}
    for lesson in () if asked is None else asked.lessons:
        sessions = [
            overruled(each.figures, verdicts.get(number))
            for number, each in enumerate(one.returned.sessions, 1)
            if each.lesson == lesson.name
        ]
        states[lesson.name] = goal_states(lesson.goals, sessions)
    return states


def assignment_of(returned: Return, given_before: list[Assignment]) -> Assignment | None:
    """The assignment that a return answers, in its version or the last one; None where it was given elsewhere."""
    asked = [each for each in given_before if each.id == returned.assignment.id]
    exact = [each for each in asked if each.revision == returned.assignment.revision]
    return next(iter(exact or asked[-1:]), None)


def teacher_of(one: Received, settings: Settings) -> str:
    """Who answers a return, where nobody else is named: who gave the assignment, else whose settings these are."""
    asked = assignment_of(one.returned, given(settings))
    return settings.student if asked is None else asked.teacher


# --- notes ------------------------------------------------------------------------------------------------------------


def keep_note_on(one: Received, note: Note) -> bytes:
    """The file of a note, of which a copy is kept beside the return; a later one takes its place.

    It says what the reports say beside what it overrules. Raises `BadInput` where it speaks of a session that the
    return has not, and `DeviceError`.
    """
    for verdict in note.sessions:
        _check_session(one.returned, verdict.number, verdict.lesson)
    data = note_bytes(replace(note, sessions=tuple(_beside_report(each, one.returned) for each in note.sessions)))
    write_whole(_note_path(one.path), data)
    return data


def _beside_report(verdict: SessionVerdict, returned: Return) -> SessionVerdict:
    reported = None if verdict.score is None else returned.sessions[verdict.number - 1].figures.score
    return replace(verdict, reported=reported)


def _check_session(returned: Return, number: int, lesson: str) -> None:
    if number > len(returned.sessions) or returned.sessions[number - 1].lesson != lesson:
        raise BadInput("note", f"session {number}", f"the return has no such session of {lesson}")


def _note_path(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(Kind.RETURN.ending) + Kind.NOTE.ending)


def _note_beside(path: Path) -> Note | None:
    try:
        return read_note(_note_path(path))
    except BadInput:
        return None
