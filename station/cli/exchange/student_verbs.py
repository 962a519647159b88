"""The student's side of `station assignment`: take, list, return, note."""

import uuid
from dataclasses import dataclass
from datetime import UTC, date, datetime
from pathlib import Path

from station.app.settings.settings_store import SettingsStore
from station.cli.console import print_json, say, write
from station.cli.input.caught_up import caught_up
from station.cli.options.option_fields import argument, flag, option, required, whole_number
from station.core.counts import counted
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.exchange.assigned_work import LessonWork, due_words, lesson_work
from station.practice.exchange.assignment_file import goals_text
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import MOST_SESSIONS, return_bytes
from station.practice.exchange.student_return import ReturnFacts, return_of
from station.practice.exchange.student_store import (
    TakenAssignment,
    find_taken,
    keep_note,
    remember_return,
    stem_of,
    take,
    taken_assignments,
)

SCHEMA = "drum-station/assignments/1"
_MARKS = {True: "[x]", False: "[ ]", None: "   "}


@dataclass(frozen=True, slots=True, kw_only=True)
class FileOptions:
    """Which file came, and whose it is."""

    file: Path = argument("FILE", "the file that came", Path)
    student: str | None = option("NAME", "whose it is", str, None)


@dataclass(frozen=True, slots=True, kw_only=True)
class ListOptions:
    """Whose assignments are listed, and how."""

    student: str | None = option("NAME", "whose assignments", str, None)
    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReturnOptions:
    """Which assignment goes back, and where the file is written."""

    assignment: str = argument("ID", "the first letters of the assignment's id or title", str)
    out: Path = required("FILE", f"the file to write; it ends in {Kind.RETURN.ending}", Path)
    words: str = option("TEXT", "what you say of it yourself", str, "")
    most: int = option("N", f"how many sessions at most, the newest ({MOST_SESSIONS})", whole_number, MOST_SESSIONS)
    student: str | None = option("NAME", "whose sessions", str, None)
    overwrite: bool = flag("write FILE even if there is one already")


def settings_of(student: str | None) -> Settings:
    """The settings of this user, for `student` where one is named."""
    return caught_up(SettingsStore(said={} if student is None else {"student": student}, source="assignment").now)


def check_out(out: Path, kind: Kind, overwrite: bool) -> None:
    """Raises `BadInput` for a name that such a file has not, or that another file has."""
    if not out.name.lower().endswith(kind.ending):
        raise BadInput(out, "", f"expected a name that ends in {kind.ending}")
    if out.exists() and not overwrite:
        raise BadInput(out, "", "is there already: choose another name, or say --overwrite")


def take_file(options: FileOptions) -> int:
    """Take an assignment, and say what it asks."""
    settings = settings_of(options.student)
    one, done = take(options.file, settings, datetime.now())
    say(f"{one.assignment.title}: {done}")
    write(_text(one, settings, date.today()), end="")
    return 0


def list_taken(options: ListOptions) -> int:
    """List what was taken, with what is done of it."""
    settings, today = settings_of(options.student), date.today()
    taken, faults = taken_assignments(settings)
    for fault in faults:
        say(str(fault))
    if options.json:
        print_json({"schema": SCHEMA, "assignments": [_document(one, settings, today) for one in taken]})
    elif taken:
        write("\n".join(_text(one, settings, today) for one in taken), end="")
    else:
        say("no assignment was taken yet: `station assignment take FILE` takes one")
    return 0


def make_return(options: ReturnOptions) -> int:
    """Write what was practised of an assignment into a file for the teacher."""
    check_out(options.out, Kind.RETURN, options.overwrite)
    settings = settings_of(options.student)
    one = find_taken(settings, options.assignment)
    if options.most < 1:
        raise BadInput("--most", str(options.most), f"expected 1 to {MOST_SESSIONS}")
    sent = return_of(settings, one, ReturnFacts(uuid.uuid4().hex, datetime.now(UTC), options.words, options.most))
    data = return_bytes(sent)
    write_whole(options.out, data)
    remember_return(one, sent)
    left = f", {sent.left_out} left out" if sent.left_out else ""
    sessions = f"{counted(len(sent.sessions), 'session')} of {sent.student}{left}"
    say(f"return   {options.out}: {sessions}, {max(len(data) >> 10, 1)} KiB")
    return 0


def take_note(options: FileOptions) -> int:
    """Keep a note that came back, and show it."""
    one, note, is_new = keep_note(options.file, settings_of(options.student))
    say(f"{one.assignment.title}: {'a note' if is_new else 'a note that came before,'} from {note.teacher}")
    write("\n".join(note.lines))
    return 0


# --- in words ---------------------------------------------------------------------------------------------------------


def _text(one: TakenAssignment, settings: Settings, today: date) -> str:
    """An assignment for people: its lessons, what is asked of them and how much of it is done, the notes on it."""
    asked = one.assignment
    group = f", {asked.group}" if asked.group else ""
    rows = [
        f"{asked.title}  ({due_words(one, today)})",
        f"  from {asked.teacher}{group}; {stem_of(asked.title, asked.id)}",
        *(f"  {row}" for row in asked.words.split("\n") if row),
    ]
    for work in lesson_work(one, settings):
        rows += _lesson_rows(work)
    for note in one.notes:
        rows += [f"  Note of {note.made:%Y-%m-%d} from {note.teacher}:", *(f"    {row}" for row in note.lines)]
    return "\n".join(rows) + "\n"


def _lesson_rows(work: LessonWork) -> list[str]:
    best = "" if work.best is None else f", best score {work.best:.0f}"
    song = f", to the song {work.asked.song}" if work.asked.song else ""
    return [
        f"  {work.here:20} {work.asked.title}{song}: {counted(work.sessions, 'session')}{best}",
        *(f"    {_MARKS[state.reached]} {state.words}" for state in work.goals),
    ]


def _document(one: TakenAssignment, settings: Settings, today: date) -> dict[str, object]:
    asked = one.assignment
    return {
        "id": asked.id,
        "revision": asked.revision,
        "title": asked.title,
        "teacher": asked.teacher,
        "group": asked.group,
        "due": None if asked.due is None else asked.due.isoformat(),
        "days_left": one.days_left(today),
        "taken": one.taken.since,
        "words": asked.words,
        "lessons": [_lesson_document(work) for work in lesson_work(one, settings)],
        "returns": list(one.returns),
        "notes": [{"id": note.id, "teacher": note.teacher, "lines": list(note.lines)} for note in one.notes],
    }


def _lesson_document(work: LessonWork) -> dict[str, object]:
    return {
        "name": work.here,
        "title": work.asked.title,
        "asked": goals_text(work.asked.goals),
        "sessions": work.sessions,
        "goals": [{"text": state.words, "reached": state.reached} for state in work.goals],
    }
