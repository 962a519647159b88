"""Courses: lessons in the order in which a teacher gives them, as text files that end in `.course.toml`.

The format is described for teachers in docs/lessons.md. A lesson is named as `station lesson list` names it, or by its
file, whose path counts from the course's folder. Faults are told as those of a lesson: by line and column.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from station.drills.faults import Fault, Faults, raise_first
from station.drills.lesson import LEVELS
from station.drills.lesson_file import lesson_text
from station.drills.table import Table, text, texts, title, whole
from station.drills.toml_syntax import load

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
    course, faults = parse_course(lesson_text(path), path, where)
    raise_first(faults, path)
    assert course
    return course


def parse_course(words: str, path: Path, where: Where) -> tuple[Course | None, list[Fault]]:
    """The course that the `words` of the file at `path` say, or None and every fault that prevented it."""
    raw, syntax, words = load(words)
    faults = Faults()
    course = _course(Table(raw, (), faults), path, where) if raw or not syntax else None
    found = faults.found(syntax, words, str(path))
    return (None if found else course), found


def _course(top: Table, path: Path, where: Where) -> Course:
    course = Course(
        name=path.name.removesuffix(ENDING),
        title=top.require("title", title, "?", 'title = "First beats"'),
        about=top.take("about", text, ""),
        author=top.take("author", text, ""),
        level=top.take("level", whole(1, len(LEVELS)), 1),
        lessons=_lessons(top, where),
    )
    top.close()
    return course


def _lessons(top: Table, where: Where) -> tuple[str, ...]:
    none: tuple[str, ...] = ()
    written = top.require("lessons", texts, none, _EXPECTED)
    if top.has("lessons") and not written and top.raw["lessons"] == []:
        top.fault("lessons", f"lessons: the list is empty; expected {_EXPECTED}")
    if len(written) > MAX_LESSONS:
        top.fault("lessons", f"lessons: {len(written)} of them; a course has at most {MAX_LESSONS}")
    found: dict[str, str] = {}
    for index, lesson in enumerate(written[:MAX_LESSONS]):
        at = where(lesson)
        name = None if at is None else lesson_name(at)
        if name is None:
            advice = "a file is named from the course's folder" if "/" in lesson else "`station lesson list` shows all"
            top.faults.add((*top.path, "lessons", index), f"no such lesson: {lesson}; {advice}")
        elif at != name and where(name) == name:  # progress is remembered by the name alone
            top.faults.add(
                (*top.path, "lessons", index), f"{lesson} has the name of a lesson that ships; name the file otherwise"
            )
        elif name in found:
            top.faults.add((*top.path, "lessons", index), f"{lesson} is in the course already")
        else:
            found[name] = str(at)
    return tuple(found.values())
