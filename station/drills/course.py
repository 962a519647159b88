"""Courses: lessons in the order in which a teacher gives them, as text files that end in `.course.toml`.

The format is described for teachers in docs/lessons.md. A lesson is named as `station lesson list` names it, or by its
file, whose path counts from the course's folder. Faults are reported as those of a lesson: by line and column.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from station.core.schema import Field, Fields, Reader, checked_values, list_of, prose, read, title, whole
from station.core.toml_faults import Faults
from station.core.toml_source import read_source
from station.drills.lesson import LEVELS

ENDING = ".course.toml"
MAX_LESSONS = 200
"""Our choice: three years of a lesson a week and more."""
_EXPECTED = 'lessons = ["rock-1", "rock-2"]'

Where = Callable[[str], str | None]
"""Gives what a lesson that a course names is found by, a shipped name or a file's path; None where there is none."""


@dataclass(frozen=True, slots=True)
class Course:
    """`lessons` in their order, each a shipped lesson's name or a file's path; `level` 1–5; `name` is the file's."""

    name: str
    title: str
    about: str
    author: str
    level: int
    lessons: tuple[str, ...]

    @property
    def lesson_names(self) -> tuple[str, ...]:
        """The lessons' names: that of a file is its stem."""
        return tuple(lesson_name(lesson) for lesson in self.lessons)


def lesson_name(found_by: str) -> str:
    """The name of a lesson that is found by its name or its file."""
    return Path(found_by).stem if found_by.endswith(".toml") else found_by


def is_course(path: Path) -> bool:
    """Whether a file is one by its name."""
    return path.name.endswith(ENDING)


def read_course(path: Path, where: Where) -> Course:
    """The course in the file at `path`; raises `BadInput` with the place of the first fault."""
    return read(read_source(path), course_reader(path.name.removesuffix(ENDING), where))


FIELDS: Fields = {
    "title": Field(title, "", 'title = "First beats"'),
    "about": Field(prose, ""),
    "author": Field(prose, ""),
    "level": Field(whole(1, len(LEVELS)), 1),
    "lessons": Field(list_of(title, f"a list such as {_EXPECTED}"), (), _EXPECTED),
}
"""The schema of the file; whether the lessons are there is asked afterwards."""


def course_reader(name: str, where: Where) -> Reader[Course]:
    """The schema of the file of the course called `name`, whose lessons are found by `where`."""

    def read_table(raw: object) -> Course:
        values, faults = checked_values(raw, FIELDS)
        if not faults and not values["lessons"]:
            faults.add(("lessons",), f"the list is empty; expected {_EXPECTED}")
        lessons = _lessons(values["lessons"], where, faults)
        faults.check()
        return Course(**{**values, "name": name, "lessons": lessons})

    return read_table


def _lessons(written: Sequence[str], where: Where, faults: Faults) -> tuple[str, ...]:
    """What the lessons of a course are found by."""
    if len(written) > MAX_LESSONS:
        faults.add(("lessons",), f"{len(written)} of them; a course has at most {MAX_LESSONS}")
    found: dict[str, str] = {}
    for index, lesson in enumerate(written[:MAX_LESSONS]):
        at = where(lesson)
        name = None if at is None else lesson_name(at)
        if name is None:
            advice = "a file is named from the course's folder" if "/" in lesson else "`station lesson list` shows all"
            fault = f"no such lesson: {lesson}; {advice}"
        elif at != name and where(name) == name:  # progress is remembered by the name alone
            fault = f"{lesson} has the name of a lesson that ships; name the file otherwise"
        elif name in found:
            fault = f"{lesson} is in the course already"
        else:
            found[name] = str(at)
            continue
        faults.add(("lessons", index), fault)
    return tuple(found.values())
