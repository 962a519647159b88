"""The shipped lessons, each read once for all tests of a worker: a lesson is immutable."""

from functools import cache

from station.drills.library import find_lesson

__all__ = ["shipped_lesson"]

shipped_lesson = cache(find_lesson)
"""`find_lesson`, which keeps what it has read."""
