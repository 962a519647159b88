"""The lessons as the window's list shows them, and what a plan was asked for as."""

from station.app.model import LessonCard, Start
from station.core.units import PPQ
from station.drills.lesson import LEVELS, Lesson
from station.drills.library import shipped_lessons
from station.practice.plan import Phase, Plan


def wish_of(plan: Plan) -> Start:
    """What would lay out `plan` again."""
    first, last = plan.bars
    demonstrations = sum(segment.phase is Phase.DEMONSTRATION for segment in plan.segments)
    bars = None if plan.bars == plan.lesson.loop else (first + 1, last + 1)
    return Start(plan.lesson.name, plan.tempo_bpm, plan.passes, bars, demonstrations, click=plan.click is not None)


def all_lessons(first: Lesson) -> dict[str, Lesson]:
    """Every shipped lesson by name, and `first`."""
    return {lesson.name: lesson for lesson in shipped_lessons()} | {first.name: first}


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
        meter=f"{meter.beats}/{meter.unit}",
        tags=lesson.tags,
        beat_quarters=lesson.beat_ticks / PPQ,
    )
