"""Whether two lessons are one: a lesson may be written to another file in another layout."""

from dataclasses import fields

from station.drills.lesson import Lesson
from station.drills.writing.score_difference import score_difference

_APART = ("score", "landing", "beyond", "name", "text")
"""Fields that are compared in their own way, or not: a lesson may be written to another file in another layout."""


def first_difference(a: Lesson, b: Lesson) -> str:
    """The first thing that `b` says or plays otherwise than `a`; empty if they are one lesson."""
    if found := score_difference(a.score, b.score):
        return found
    if a.landing.tobytes() != b.landing.tobytes():
        return "the landing differs"
    if a.beyond.tobytes() != b.beyond.tobytes():
        return "what is beyond the player differs"
    for name in (each.name for each in fields(Lesson) if each.name not in _APART):
        if getattr(a, name) != getattr(b, name):
            return f"{name}: {getattr(a, name)} became {getattr(b, name)}"
    return ""
