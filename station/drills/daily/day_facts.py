"""What a daily plan is made from: what is remembered, what there is, what a teacher wants, what the last days were."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from random import Random

from station.core.errors import BadInput
from station.drills.daily.asked import ItemOf
from station.drills.daily.daily_items import Assigned, ItemKind, PastDay
from station.drills.lesson_row import LessonRow
from station.drills.mastery.agenda import Waiting, waiting
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PracticeItem
from station.drills.mastery.rules import DEFAULT_RULES, Rules

MINUTES = 20
"""TEACHING: sessions of 15 to 25 minutes."""
LEAST_MINUTES, MOST_MINUTES = 5, 60
"""Our choice: below, nothing but a review fits; above, nobody stays attentive."""
BREAK_DAYS = 14
"""So long without practice, and the day begins gently (our choice: twice a week's holiday)."""


@dataclass(frozen=True, slots=True)
class DayFacts:
    """All that a plan goes by.

    `states` is what is remembered of every item, `lessons` what there is by name, in the order in which a student
    without a course would take them; `course_lessons` the names of those that the course called `course` has and that
    are not finished, in order. `item_of` gives the loop, or some bars, of a lesson as an item, None where it cannot be
    read. `history` may be in any order, and may lack days.
    """

    today: date
    states: Sequence[ItemState] = ()
    lessons: Mapping[str, LessonRow] = field(default_factory=dict)
    item_of: ItemOf = lambda _name, _bars: None
    course: str = ""
    course_lessons: tuple[str, ...] = ()
    assigned: tuple[Assigned, ...] = ()
    history: Sequence[PastDay] = ()
    minutes: int = MINUTES
    seed: int = 0
    rules: Rules = DEFAULT_RULES

    def checked(self) -> "DayFacts":
        """These facts; raises `BadInput` for minutes that no day has."""
        if not LEAST_MINUTES <= self.minutes <= MOST_MINUTES:
            raise BadInput("--minutes", str(self.minutes), f"expected {LEAST_MINUTES} to {MOST_MINUTES}")
        return replace(self, history=sorted((d for d in self.history if d.day < self.today), key=lambda d: d.day))

    def turns(self, here: PracticeItem | None) -> Waiting:
        """What is remembered, in the agenda's order."""
        return waiting(self.states, self.today, self.rules, here)

    @property
    def chance(self) -> Random:
        """The day's chance: equal on equal days."""
        return Random(f"{self.seed}/{self.today.isoformat()}")

    @property
    def begun(self) -> frozenset[str]:
        """The lessons of which anything is remembered."""
        return frozenset(state.item.name for state in self.states)

    @property
    def days_away(self) -> int:
        """Days since anything was practised; 0 for who never has."""
        last = max((state.today for state in self.states), default=self.today)
        return max((self.today - last).days, 0)

    @property
    def is_back(self) -> bool:
        """Whether the student comes back from a long break."""
        return self.days_away >= BREAK_DAYS

    @property
    def left_over(self) -> frozenset[str]:
        """What the last day that had a plan left undone."""
        return self.history[-1].left_over if self.history else frozenset()

    def recent(self, kind: ItemKind, days: int) -> frozenset[str]:
        """The lessons that blocks of a kind had on the last `days` days that had a plan."""
        planned = [block for day in self.history[-days:] for block in day.planned]
        return frozenset(lesson for of, lesson in planned if of is kind)

    def title(self, name: str) -> str:
        """A lesson's title, or its name where nothing is known of it."""
        return self.lessons[name].title if name in self.lessons else name
