"""The lessons as the window's list shows them, and what a plan was asked for as."""

from collections.abc import Collection, Iterable
from contextlib import suppress
from pathlib import Path

from station.app.room_state import LessonCard, SessionRequest
from station.core.errors import BadInput
from station.drills.course import Course, lesson_name
from station.drills.lesson import LEVELS, Lesson
from station.drills.lesson_row import LessonRow
from station.drills.library import read_lesson
from station.practice.session.plan import Phase, Plan


def request_of(plan: Plan) -> SessionRequest:
    """What would lay out `plan` again."""
    first, last = plan.bars
    demonstrations = sum(segment.phase is Phase.DEMONSTRATION for segment in plan.segments)
    bars = None if plan.bars == plan.lesson.loop else (first + 1, last + 1)
    return SessionRequest(
        plan.lesson.name, plan.tempo_bpm, plan.passes, bars, demonstrations, click=plan.click is not None
    )


def own_lessons(courses: Iterable[Course], shipped: Collection[str]) -> dict[str, Lesson]:
    """The lessons that `courses` bring with them, none of them `shipped`, by name; what cannot be read is left out."""
    own: dict[str, Lesson] = {}
    for found_by in dict.fromkeys(lesson for course in courses for lesson in course.lessons):
        if lesson_name(found_by) not in shipped:
            with suppress(BadInput):  # `station lesson check` tells what is wrong with it
                own[lesson_name(found_by)] = read_lesson(Path(found_by))
    return own


def card(row: LessonRow) -> LessonCard:
    """The lesson's line in the list."""
    return LessonCard(
        name=row.name,
        title=row.title,
        level=row.level,
        level_words=LEVELS[row.level],
        about=row.about,
        author=row.author,
        tempo_bpm=row.tempo_bpm,
        bars=row.loop_bars,
        passes=row.passes,
        meter=row.meter,
        tags=row.tags,
        beat_quarters=row.beat_quarters,
        levels=row.levels,
        kind=row.folder,
        prerequisites=row.prerequisites,
    )
