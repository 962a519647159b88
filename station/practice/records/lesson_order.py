"""What comes before a lesson and after it: its prerequisites, and the course that the student follows."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress

from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.course import Course
from station.drills.daily.asked import Asked
from station.drills.lesson import Lesson
from station.drills.level_range import ANY_LEVEL, LevelRange
from station.drills.library import courses_in, find_lesson, shipped_courses
from station.drills.mastery.agenda import Ahead
from station.drills.mastery.practice_steps import PracticeItem, item_of
from station.practice.records.lesson_progress import LessonProgress

Progress = Mapping[str, LessonProgress]
"""How far a student is, by the names of lessons."""


def followed_course(settings: Settings) -> Course | None:
    """The course that the user has chosen in the window; None where there is none, or no more."""
    if not settings.course:
        return None
    own, _ = courses_in(settings.courses_dir)
    return next((course for course in (*own, *shipped_courses()) if course.name == settings.course), None)


def is_mastered(name: str, progress: Progress) -> bool:
    """Whether a lesson is held at any level."""
    return name in progress and progress[name].is_mastered


def is_finished(course: Course, name: str, progress: Progress, levels: LevelRange = ANY_LEVEL) -> bool:
    """Whether a lesson of a course counts; `levels` are those at which it may be judged."""
    return course.is_finished(progress[name].held if name in progress else None, levels.strictest)


def first_words(prerequisites: Sequence[str], progress: Progress, title_of: Callable[[str], str]) -> list[str]:
    """A line for each lesson that should come before: its title, and whether it is mastered; nothing is forbidden."""
    said = {True: "mastered", False: "not yet mastered"}
    return [f"First: {title_of(name)} – {said[is_mastered(name, progress)]}" for name in prerequisites]


def shipped_title(name: str) -> str:
    """The title of the lesson of that name, or the name where there is none."""
    with suppress(BadInput):
        return find_lesson(name).title
    return name


def ahead_of(
    lesson: Lesson, course: Course | None, progress: Progress, struggles: bool, asked: Asked | None = None
) -> Ahead:
    """What lies before and after a lesson, for a student who `struggles` with it or does not, and what is `asked`."""
    before = [name for name in lesson.prerequisites if not is_mastered(name, progress)] if struggles else []
    after = [] if course is None else _after(lesson.name, course, progress)
    title = "" if course is None else course.title
    first, then = _first_item(before), _first_item(after)
    return Ahead(first, then, title) if asked is None else Ahead(first, then, title, asked.item, asked.why)


def _after(name: str, course: Course, progress: Progress) -> list[str]:
    """What the lessons are found by that a course has behind one of its own and that are not finished."""
    names = course.lesson_names
    if name not in names:
        return []
    rest = list(zip(names, course.lessons, strict=True))[names.index(name) + 1 :]
    return [found_by for name, found_by in rest if not is_finished(course, name, progress)]


def _first_item(found_by: Sequence[str]) -> PracticeItem | None:
    """The loop of the first of some lessons that can be read."""
    for each in found_by:
        with suppress(BadInput):
            return item_of(find_lesson(each))
    return None
