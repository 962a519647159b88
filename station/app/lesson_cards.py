"""The lessons as the window's list shows them, and what a plan was asked for as."""

from station.app.room_state import LessonCard, SessionRequest
from station.drills.lesson import LEVELS
from station.drills.lesson_row import LessonRow
from station.practice.session.plan import Phase, Plan


def request_of(plan: Plan) -> SessionRequest:
    """What would lay out `plan` again."""
    first, last = plan.bars
    demonstrations = sum(segment.phase is Phase.DEMONSTRATION for segment in plan.segments)
    bars = None if plan.bars == plan.lesson.loop else (first + 1, last + 1)
    return SessionRequest(
        plan.lesson.name,
        plan.tempo_bpm,
        plan.passes,
        bars,
        demonstrations,
        click=plan.click is not None,
        gap=None if plan.click is None else plan.click.gap,
        rise=plan.rise,
    )


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
        is_song=row.is_song,
    )
