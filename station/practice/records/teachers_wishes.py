"""What the teachers of a student want of them: the lessons of the assignments that were taken, and until which day.

An assignment without a day waits behind those that have one; one whose day passed long ago asks for nothing any more.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date, timedelta

from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.daily.asked import Asked, ItemOf, asked_in_turn
from station.drills.daily.daily_items import Assigned
from station.drills.lesson import Lesson
from station.drills.library import courses_in, find_lesson, lesson_names, own_lessons
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PracticeItem, item_of
from station.drills.mastery.rules import Rules
from station.practice.records.assigned_lessons import all_taken

FORGOTTEN_DAYS = 14
"""So long after its day an assignment still asks (our choice: two lessons with a teacher who comes every week)."""


@dataclass(frozen=True, slots=True)
class Wishes:
    """What is `assigned`, and what gives a lesson of that name as an item."""

    assigned: tuple[Assigned, ...] = ()
    item_of: ItemOf = lambda _name, _bars: None

    def next(self, states: Sequence[ItemState], today: date, rules: Rules) -> Asked | None:
        """What has its turn first; None where nothing is asked for."""
        return next(iter(asked_in_turn(self.assigned, self.item_of, states, today, rules)), None)


NO_WISHES = Wishes()
"""Nobody wants anything."""


def wishes_of(settings: Settings, today: date) -> Wishes:
    """What is wanted of the student of `settings`."""
    earliest = today - timedelta(days=FORGOTTEN_DAYS)
    assigned = tuple(
        Assigned(name, taken.due)
        for taken in all_taken(settings.sessions_dir, settings.student).values()
        if taken.due is None or taken.due >= earliest
        for _, name in taken.lessons
    )
    return Wishes(assigned, _items_of(settings)) if assigned else NO_WISHES


def _items_of(settings: Settings) -> ItemOf:
    own: dict[str, Lesson] | None = None

    def found(name: str, bars: tuple[int, int] | None) -> PracticeItem | None:
        nonlocal own
        own = own_lessons_of(settings) if own is None else own
        return item_named(name, bars, own)

    return found


def own_lessons_of(settings: Settings) -> dict[str, Lesson]:
    """The student's own lessons by name; what cannot be read is left out."""
    courses, _ = courses_in(settings.courses_dir)
    return own_lessons(courses, settings.own_lessons_dir, lesson_names())


def item_named(name: str, bars: tuple[int, int] | None, own: dict[str, Lesson]) -> PracticeItem | None:
    """The loop, or some bars, of a lesson; None where it cannot be read, or has no such bars."""
    try:
        lesson = own.get(name) or find_lesson(name)
    except BadInput:
        return None
    if bars is not None and not 0 <= bars[0] <= bars[1] < lesson.score.bar_count:
        return None
    return item_of(lesson, bars)
