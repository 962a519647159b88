"""`station lesson list`: the lessons by kind, or those of a course, and how far the student is with them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

from station.cli.console import print_json, write
from station.cli.options.option_fields import Command, flag, option
from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput

if TYPE_CHECKING:
    from station.drills.course import Course
    from station.drills.lesson_row import LessonRow
    from station.practice.records.lesson_progress import LessonProgress

SCHEMA = "drum-station/lessons/1"
_NEW = "–"
"""Stands where a lesson was never practised."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LessonsOptions:
    """Which lessons are listed, and how."""

    kind: str | None = option("KIND", "only the lessons of this kind, such as grooves", str, None, rivals="which")
    course: str | None = option("NAME", "only the lessons of this course, in its order", str, None, rivals="which")
    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True)
class _Catalog:
    """What there is: the lessons by name in the list's order, the courses, and the student's progress."""

    rows: dict[str, LessonRow]
    courses: Sequence[Course]
    progress: dict[str, LessonProgress]

    def held(self, name: str) -> str:
        """How far the student is with a lesson, in a word."""
        progress = self.progress.get(name)
        if progress is None:
            return _NEW
        return f"✓ {progress.held}" if progress.held else f"{progress.shown_pct:.0f} %"

    def named(self, names: Iterable[str]) -> list[LessonRow]:
        """The rows of those lessons that can be read."""
        return [self.rows[name] for name in names if name in self.rows]

    def finished(self, course: Course) -> int:
        """How many lessons of a course are."""
        from station.practice.records.lesson_order import is_finished

        rows = self.named(course.lesson_names)
        return sum(is_finished(course, row.name, self.progress, row.levels) for row in rows)


def _catalog() -> _Catalog:
    from station.app.settings.settings_store import SettingsStore
    from station.drills.lesson_row import row_of
    from station.drills.library import courses_in, lesson_rows, own_lessons, shipped_courses
    from station.practice.history.student_history import StudentHistory
    from station.practice.records.student_progress import student_progress

    settings = SettingsStore().now
    own, _ = courses_in(settings.courses_dir)
    rows = {row.name: row for row in lesson_rows()}
    rows |= {name: row_of(lesson) for name, lesson in own_lessons(own, settings.own_lessons_dir, rows).items()}
    return _Catalog(rows, (*own, *shipped_courses()), student_progress(StudentHistory.of(settings)))


def run(options: LessonsOptions) -> int:
    """List them."""
    catalog = _catalog()
    course = None if options.course is None else _named_course(options.course, catalog.courses)
    rows = _of_kind(options.kind, catalog) if course is None else catalog.named(course.lesson_names)
    if options.json:
        every = catalog.courses if options.kind is None else ()
        _print_json(catalog, rows, every if course is None else [course])
    elif course is not None:
        _write_course(catalog, course)
    else:
        _write_kinds(catalog, rows, with_courses=options.kind is None)
    return 0


def _of_kind(kind: str | None, catalog: _Catalog) -> list[LessonRow]:
    """The lessons of a kind, all of them where it is None."""
    kinds = list(dict.fromkeys(row.folder for row in catalog.rows.values() if row.folder))
    if kind is not None and kind not in kinds:
        raise BadInput("--kind", kind, f"no such kind of lessons{did_you_mean(kind, kinds)}")
    return [row for row in catalog.rows.values() if kind in (None, row.folder)]


def _named_course(name: str, courses: Sequence[Course]) -> Course:
    for course in courses:
        if course.name == name:
            return course
    raise BadInput("--course", name, f"no such course{did_you_mean(name, [each.name for each in courses])}")


# --- text -------------------------------------------------------------------------------------------------------------


def _write_kinds(catalog: _Catalog, rows: Sequence[LessonRow], with_courses: bool) -> None:
    for index, (folder, some) in enumerate(groupby(rows, key=lambda row: row.folder or "your own")):
        kind = list(some)
        write(f"{chr(10) if index else ''}{folder} ({len(kind)})")
        _write_rows(catalog, kind, rows)
    if with_courses:
        _write_courses(catalog)


def _write_rows(catalog: _Catalog, some: Iterable[LessonRow], aligned: Sequence[LessonRow], first: int = 0) -> None:
    """A line for each of `some`, in the columns of all that are `aligned`; with numbers from `first` on, if any."""
    from station.drills.lesson import LEVELS

    name, meter, held = (
        max(map(len, words))
        for words in (
            [row.name for row in aligned],
            [row.meter for row in aligned],
            [catalog.held(row.name) for row in aligned],
        )
    )
    for number, row in enumerate(some, first):
        bars = f"{row.bars:3} bar{' ' if row.bars == 1 else 's'}"
        facts = f"{row.meter:{meter}}  {row.beats_a_minute:5g} bpm  {bars}  {LEVELS[row.level]:12}"
        count = f"{number:3} " if first else ""
        write(f"  {count}{row.name:{name}}  {facts}  {catalog.held(row.name):{held}}  {row.title}")


def _write_courses(catalog: _Catalog) -> None:
    from station.drills.lesson import LEVELS

    write(f"\ncourses ({len(catalog.courses)}); `station lesson list --course NAME` has the lessons of one")
    width = max((len(course.name) for course in catalog.courses), default=0)
    for course in catalog.courses:
        done = f"{catalog.finished(course):3} of {len(course.lessons):3} finished"
        after = f"; after {', '.join(course.prerequisites)}" if course.prerequisites else ""
        write(f"  {course.name:{width}}  {LEVELS[course.level]:12}  {done}  {course.title}{after}")


def _write_course(catalog: _Catalog, course: Course) -> None:
    """Its lessons in their order, part by part."""
    rows = catalog.named(course.lesson_names)
    asked = f"; a lesson is finished when you hold it at {course.mastery}" if course.mastery else ""
    write(f"{course.title}: {catalog.finished(course)} of {len(course.lessons)} finished{asked}")
    if course.prerequisites:
        write(f"First: {', '.join(course.prerequisites)}")
    first = 1
    for part in course.parts:
        if part.title:
            write(f"\n{part.title}")
        _write_rows(catalog, catalog.named(part.lesson_names), rows, first)
        first += len(part.lessons)


# --- JSON -------------------------------------------------------------------------------------------------------------


def _print_json(catalog: _Catalog, rows: Iterable[LessonRow], courses: Iterable[Course]) -> None:
    print_json(
        {
            "schema": SCHEMA,
            "lessons": [_lesson(catalog, row) for row in rows],
            "courses": [_course(catalog, course) for course in courses],
        }
    )


def _lesson(catalog: _Catalog, row: LessonRow) -> dict[str, object]:
    progress = catalog.progress.get(row.name)
    return {
        "name": row.name,
        "title": row.title,
        "kind": row.folder,
        "level": row.level,
        "difficulty": row.difficulty,
        "beats_a_minute": row.beats_a_minute,
        "meter": row.meter,
        "bars": row.bars,
        "prerequisites": list(row.prerequisites),
        "held": None if progress is None else progress.held,
    }


def _course(catalog: _Catalog, course: Course) -> dict[str, object]:
    return {
        "name": course.name,
        "title": course.title,
        "level": course.level,
        "lessons": list(course.lessons),
        "parts": [{"title": part.title, "lessons": list(part.lessons)} for part in course.parts],
        "prerequisites": list(course.prerequisites),
        "mastery": course.mastery,
        "finished": catalog.finished(course),
    }


COMMAND = Command(LessonsOptions, run)
