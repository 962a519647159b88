"""The shipped lessons, each read once for all tests of a worker: a lesson is immutable."""

from functools import cache

from station.drills.lesson import Lesson
from station.drills.library import find_lesson, lesson_rows

__all__ = ["shipped_lesson", "shipped_lessons"]

shipped_lesson = cache(find_lesson)
"""`find_lesson`, which keeps what it has read."""


@cache
def _names() -> tuple[str, ...]:
    return tuple(row.name for row in lesson_rows())


def shipped_lessons(first: int = 0, each: int = 1) -> list[Lesson]:
    """`library.shipped_lessons`, or of them the `first` and every `each`-th after it: no other is read."""
    return [shipped_lesson(name) for name in _names()[first::each]]
