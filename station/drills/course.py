"""Courses: lessons in the order in which a teacher gives them, as text files that end in `.course.toml`.

A course is a list of lessons, or of parts with a title and lessons of their own.

The format is described for teachers in docs/lessons.md. A lesson is named as `station lesson list` names it, or by its
file, whose path counts from the course's folder. Faults are reported as those of a lesson: by line and column.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    checked_values,
    choice,
    list_of,
    optional,
    prose,
    read,
    said,
    title,
    whole,
)
from station.core.toml.toml_faults import Faults, Noted
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_source import read_source
from station.drills.lesson import LEVELS
from station.drills.songs.song_file import SONG_ENDING
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

ENDING = ".course.toml"
MAX_LESSONS = 200
"""Our choice: three years of a lesson a week and more."""
_EXPECTED = 'lessons = ["rock-1", "rock-2"]'

Where = Callable[[str], str | None]
"""Gives what a lesson that a course names is found by, a shipped name or a file's path; None where there is none."""


@dataclass(frozen=True, slots=True)
class CoursePart:
    """Some of a course's lessons under a `title` of their own; empty where the course has no parts."""

    title: str
    lessons: tuple[str, ...]

    @property
    def lesson_names(self) -> tuple[str, ...]:
        """The lessons' names."""
        return tuple(map(lesson_name, self.lessons))


@dataclass(frozen=True, slots=True)
class Course:
    """The lessons of its `parts` in their order, each a shipped lesson's name or a file's path.

    `level` 1–5; `name` is the file's. `prerequisites` name the courses that come before. A lesson is finished when it
    is held at the level `mastery`, at any where that is None.
    """

    name: str
    title: str
    about: str
    author: str
    level: int
    parts: tuple[CoursePart, ...]
    prerequisites: tuple[str, ...] = ()
    mastery: Level | None = None

    @property
    def lessons(self) -> tuple[str, ...]:
        """What the lessons of all parts are found by."""
        return tuple(lesson for part in self.parts for lesson in part.lessons)

    @property
    def lesson_names(self) -> tuple[str, ...]:
        """The lessons' names: that of a file is its stem."""
        return tuple(map(lesson_name, self.lessons))

    def is_finished(self, held: Level | None, strictest: Level = Level.STUDIO) -> bool:
        """Whether a lesson counts that is `held` at a level, None at none; it is judged no more strictly than that."""
        if held is None or self.mastery is None:
            return held is not None
        return held.rank >= min(self.mastery.rank, strictest.rank)


def lesson_name(found_by: str) -> str:
    """The name of a lesson that is found by its name or its file."""
    return Path(found_by).stem if found_by.endswith((".toml", SONG_ENDING)) else found_by


def is_course(path: Path) -> bool:
    """Whether a file is one by its name."""
    return path.name.endswith(ENDING)


def read_course(path: Path, where: Where) -> Course:
    """The course in the file at `path`; raises `BadInput` with the place of the first fault."""
    return read(read_source(path), course_reader(path.name.removesuffix(ENDING), where))


_LESSONS: Field[tuple[str, ...]] = Field(list_of(title, f"a list such as {_EXPECTED}"), ())
_PART: Fields = {
    "title": Field(title, "", 'title = "The backbeat"'),
    "lessons": replace(_LESSONS, must=_EXPECTED),
}
FIELDS: Fields = {
    "title": Field(title, "", 'title = "First beats"'),
    "about": Field(prose, ""),
    "author": Field(prose, ""),
    "level": Field(whole(1, len(LEVELS)), 1),
    "prerequisites": Field(list_of(title, 'a list of courses, such as ["first-beats"]'), ()),
    "mastery": optional(choice(OUR_LEVELS, "level")),
    "lessons": _LESSONS,
    "part": Field(list_of(said(_PART), "tables [[part]] with a title and lessons"), ()),
}
"""The schema of the file; whether lessons and courses are there is asked afterwards."""


def course_reader(name: str, where: Where) -> Reader[Course]:
    """The schema of the file of the course called `name`, whose lessons are found by `where`."""

    def read_table(raw: object) -> Course:
        values, faults = checked_values(raw, FIELDS)
        written, in_parts = values.pop("lessons"), values.pop("part")
        if written and in_parts:
            faults.add(("lessons",), "here are parts, too; expected either lessons or [[part]]", at_key=True)
        if not faults and not written and not in_parts:
            faults.noted.append(_no_lessons(raw))
        found = _Found(where, faults)
        parts = [CoursePart("", found.lessons(written, ("lessons",)))] if written else []
        for index, part in enumerate(in_parts):
            parts.append(CoursePart(part["title"], found.lessons(part["lessons"], ("part", index, "lessons"))))
        faults.check()
        return Course(**values, name=name, parts=tuple(parts))

    return read_table


def _no_lessons(raw: object) -> Noted:
    if isinstance(raw, dict) and "lessons" in raw:
        return Noted(f"the list is empty; expected {_EXPECTED}", ("lessons",))
    return Noted(f"is missing; expected {_EXPECTED}", ("lessons",), at_key=True, is_missing=True)


@dataclass(slots=True)
class _Found:
    """The lessons of a course so far by their names, each as it is found; `faults` hears what is wrong with others."""

    where: Where
    faults: Faults
    by_name: dict[str, str] = field(default_factory=dict)

    def lessons(self, written: Sequence[str], path: KeyPath) -> tuple[str, ...]:
        """What these lessons, which stand at `path`, are found by."""
        if len(self.by_name) + len(written) > MAX_LESSONS:
            count = len(self.by_name) + len(written)
            self.faults.add(path, f"{count} of them; a course has at most {MAX_LESSONS}")
        if not written:
            self.faults.add(path, f"the list is empty; expected {_EXPECTED}")
        before = len(self.by_name)
        for index, lesson in enumerate(written[:MAX_LESSONS]):
            self._find(lesson, (*path, index))
        return tuple(self.by_name.values())[before:]

    def _find(self, lesson: str, path: KeyPath) -> None:
        at = self.where(lesson)
        name = None if at is None else lesson_name(at)
        if name is None:
            advice = "a file is named from the course's folder" if "/" in lesson else "`station lesson list` shows all"
            self.faults.add(path, f"no such lesson: {lesson}; {advice}")
        elif at != name and self.where(name) == name:  # progress is remembered by the name alone
            self.faults.add(path, f"{lesson} has the name of a lesson that ships; name the file otherwise")
        elif name in self.by_name:
            self.faults.add(path, f"{lesson} is in the course already")
        else:
            self.by_name[name] = str(at)
