"""Assignments: what a teacher gives to practise, as one file that ends in `.drum-assignment`.

Its table (`parcel`) holds `id`, `revision` (from 1; a later one takes the place of an earlier one), `title`, `teacher`,
`group` (a class, may be empty), `made`, `due` (a day or null), `words`, and `lessons`, each with `name`, `title`,
`file` (its member), `song` (the song it is played to, by reference alone: no sound travels) and `goals`.
"""

from dataclasses import asdict, dataclass
from datetime import date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from station.core.disk.file_names import alike
from station.core.errors import BadInput
from station.core.toml.schema import Field, Fields, Reader, list_of, needed, record, shown, text, whole
from station.core.toml.toml_faults import wrong
from station.practice.exchange.lesson_goals import GOAL_FIELDS, LessonGoals
from station.practice.exchange.lesson_member import lesson_text, lesson_title, parsed
from station.practice.exchange.parcel import Kind, Parcel, packed, parse_parcel, read_parcel
from station.practice.exchange.plain_words import (
    due_day,
    identity,
    line,
    line_or_none,
    moment,
    moment_text,
    or_none,
    words,
)

if TYPE_CHECKING:
    from station.drills.lesson import Lesson

MOST_LESSONS = 50
"""Our choice: nobody practises more until the next lesson."""
MOST_REVISIONS = 1_000_000
NO_GOALS = LessonGoals()


@dataclass(frozen=True, slots=True)
class AssignedLesson:
    """A lesson of an assignment: its name as a file's, title, text, what is asked, the song that it refers to."""

    name: str
    title: str
    text: str
    goals: LessonGoals = NO_GOALS
    song: str = ""


@dataclass(frozen=True, slots=True)
class Assignment:
    """What a teacher gives; `made` is aware, `due` the last day (None: whenever), `group` a class or empty."""

    id: str
    revision: int
    title: str
    teacher: str
    made: datetime
    lessons: tuple[AssignedLesson, ...]
    group: str = ""
    due: date | None = None
    words: str = ""

    def lesson(self, name: str) -> AssignedLesson | None:
        """The lesson of that name; None where there is none."""
        return next((one for one in self.lessons if one.name == name), None)

    @property
    def shelf(self) -> str:
        """Under what a teacher keeps its returns: the class, or the title."""
        return self.group or self.title


# --- writing ----------------------------------------------------------------------------------------------------------


def assignment_bytes(assignment: Assignment) -> bytes:
    """The file; raises `BadInput` where it could not be read again: too long, or with words that are not plain."""
    members = {_member(number): one.text.encode() for number, one in enumerate(assignment.lessons, 1)}
    data = packed(Kind.ASSIGNMENT, _table(assignment), readme_text(assignment), members)
    lessons_of(parse_assignment(data, "assignment"), "assignment")
    return data


def _member(number: int) -> str:
    return f"lessons/{number}.toml"


def _table(assignment: Assignment) -> dict[str, object]:
    return {
        "id": assignment.id,
        "revision": assignment.revision,
        "title": assignment.title,
        "teacher": assignment.teacher,
        "group": assignment.group,
        "made": moment_text(assignment.made),
        "due": None if assignment.due is None else assignment.due.isoformat(),
        "words": assignment.words,
        "lessons": [
            {
                "name": one.name,
                "title": one.title,
                "file": _member(number),
                "song": one.song,
                "goals": {key: value for key, value in asdict(one.goals).items() if value not in (None, "")},
            }
            for number, one in enumerate(assignment.lessons, 1)
        ],
    }


def goals_text(goals: LessonGoals) -> str:
    """What is asked, in a line; empty where nothing is."""
    asked = (
        goals.tempo_bpm is not None and f"{goals.tempo_bpm:g} bpm",
        goals.level is not None and f"judged as {goals.level}",
        goals.passes is not None and f"{goals.passes} passes",
        goals.minutes is not None and f"{goals.minutes:g} minutes",
        goals.words.replace("\n", " "),
    )
    return ", ".join(part for part in asked if part)


def readme_text(assignment: Assignment) -> str:
    """The assignment for people who open the file without a station."""
    due = "" if assignment.due is None else f"Due {assignment.due:%A}, {assignment.due.day} {assignment.due:%B %Y}\n"
    group = f", {assignment.group}" if assignment.group else ""
    rows = [f"* {one.title} ({one.name}){_asked(one)}" for one in assignment.lessons]
    said = f"\n{assignment.words}\n" if assignment.words else ""
    return f"{assignment.title}\n{assignment.teacher}{group}\n{due}{said}\n" + "\n".join(rows) + "\n"


def _asked(lesson: AssignedLesson) -> str:
    song = f", to the song {lesson.song}, which does not travel with this file" if lesson.song else ""
    goals = goals_text(lesson.goals)
    return f"{f': {goals}' if goals else ''}{song}"


# --- reading ----------------------------------------------------------------------------------------------------------


def read_assignment(path: Path) -> Assignment:
    """The assignment in the file at `path`; raises `BadInput`. What its lessons mean `lessons_of` says."""
    return _assignment(read_parcel(path, Kind.ASSIGNMENT))


def parse_assignment(data: bytes, source: str) -> Assignment:
    """The assignment in `data`; raises `BadInput` of `source`."""
    return _assignment(parse_parcel(data, source, Kind.ASSIGNMENT))


def lessons_of(assignment: Assignment, source: str) -> "tuple[Lesson, ...]":
    """Its lessons as the station reads them; raises `BadInput` of `source` for one that is none."""
    return tuple(parsed(((one.name, one.text) for one in assignment.lessons), source))


def _assignment(parcel: Parcel) -> Assignment:
    assignment = parcel.meaning(_reader(parcel))
    names = [alike(one.name) for one in assignment.lessons]
    if not 1 <= len(names) <= MOST_LESSONS:
        raise parcel.fault("lessons", f"expected 1 to {MOST_LESSONS}, found {len(names)}")
    if len(set(names)) < len(names):
        raise parcel.fault("lessons", "two lessons have one name, or names that a file system takes for one")
    return assignment


def _reader(parcel: Parcel) -> Reader[Assignment]:
    return record(Assignment, {**_FIELDS, "lessons": needed(list_of(_lesson_reader(parcel), "a list of lessons"))})


def _lesson_reader(parcel: Parcel) -> Reader[AssignedLesson]:
    def member(value: object) -> str:
        try:
            return lesson_text(parcel, text(value))
        except BadInput as fault:
            raise wrong(f"{shown(value)} {fault.fault}") from None

    return record(AssignedLesson, {**_LESSON, "file": Field(member, "", "", "text")})


_LESSON: Fields = {
    "name": needed(lesson_title),
    "title": needed(line),
    "song": Field(line_or_none, ""),
    "goals": Field(record(LessonGoals, GOAL_FIELDS), NO_GOALS),
}
_FIELDS: Fields = {
    "id": needed(identity),
    "revision": needed(whole(1, MOST_REVISIONS)),
    "title": needed(line),
    "teacher": needed(line),
    "group": Field(line_or_none, ""),
    "made": needed(moment),
    "due": Field(or_none(due_day), None),
    "words": Field(words, ""),
}
