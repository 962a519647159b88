"""The lessons as the window's list shows them, and what a plan was asked for as."""

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from station.app.room_state import LessonCard, SessionRequest
from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.course import Course, lesson_name
from station.drills.lesson import LEVELS, Lesson
from station.drills.library import read_lesson, shipped_lessons
from station.practice.session.plan import Phase, Plan


def request_of(plan: Plan) -> SessionRequest:
    """What would lay out `plan` again."""
    first, last = plan.bars
    demonstrations = sum(segment.phase is Phase.DEMONSTRATION for segment in plan.segments)
    bars = None if plan.bars == plan.lesson.loop else (first + 1, last + 1)
    return SessionRequest(
        plan.lesson.name, plan.tempo_bpm, plan.passes, bars, demonstrations, click=plan.click is not None
    )


def all_lessons(first: Lesson, courses: Iterable[Course]) -> dict[str, Lesson]:
    """Every shipped lesson by name, those that `courses` have beside them and that can be read, and `first`."""
    known = {lesson.name: lesson for lesson in shipped_lessons()}
    for found_by in dict.fromkeys(lesson for course in courses for lesson in course.lessons):
        if lesson_name(found_by) not in known:
            with suppress(BadInput):  # `station lesson check` tells what is wrong with it
                known[lesson_name(found_by)] = read_lesson(Path(found_by))
    return known | {first.name: first}


def card(lesson: Lesson) -> LessonCard:
    """The lesson's line in the list."""
    meter = lesson.score.tempo_map.meters[0]
    return LessonCard(
        name=lesson.name,
        title=lesson.title,
        level=lesson.level,
        level_words=LEVELS[lesson.level],
        about=lesson.about,
        author=lesson.author,
        tempo_bpm=lesson.tempo_bpm,
        bars=lesson.loop[1] - lesson.loop[0] + 1,
        passes=lesson.passes,
        meter=str(meter),
        tags=lesson.tags,
        beat_quarters=lesson.beat_ticks / PPQ,
        levels=lesson.levels,
    )
