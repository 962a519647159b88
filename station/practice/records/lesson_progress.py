"""How far a student is with each lesson, from what is remembered of its mastery."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date

from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.rules import Rules
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class LessonProgress:
    """One lesson: tempi in percent of its target, `day_pct` practised last, `shown_pct` the fastest shown blind.

    `held` says the narrowest level at which the target was shown often enough in a row, and every review since, None
    where it was not; `review` when it is asked for again (None: not, or no more).
    """

    day_pct: float
    shown_pct: float
    held: Level | None
    review: date | None = None

    @classmethod
    def of(cls, state: ItemState) -> "LessonProgress":
        """What a state says."""
        held = state.level if state.is_stable(Rules()) else None
        if state.review.mastered_on is not None:
            held = state.review.level
        return cls(state.pct, state.mastery_pct, held, state.review.due)

    @property
    def is_mastered(self) -> bool:
        """Whether it is held at any level."""
        return self.held is not None

    def is_due(self, today: date) -> bool:
        """Whether it is to be asked for today."""
        return self.review is not None and self.review <= today

    def words(self, today: date) -> str:
        """It in a line."""
        if self.is_due(today):
            return f"Mastered at {self.held}; today is the day to show that it stuck"
        if self.is_mastered:
            again = "" if self.review is None else f"; to be shown again on {self.review.day} {self.review:%B}"
            return f"Mastered at {self.held}{again}"
        if self.shown_pct:
            return f"{self.shown_pct:.0f} % of the target tempo shown blind; {self.day_pct:.0f} % practised last"
        return f"Begun: {self.day_pct:.0f} % of the target tempo practised last"


def progress_of(states: Iterable[ItemState]) -> dict[str, LessonProgress]:
    """The progress that is remembered, by the names of lessons; of those practised in parts, that of the most bars."""
    longest: dict[str, ItemState] = {}
    for state in states:
        known = longest.get(state.item.name)
        if known is None or _weight(state) > _weight(known):
            longest[state.item.name] = state
    return {name: LessonProgress.of(state) for name, state in longest.items()}


def _weight(state: ItemState) -> tuple[int, date]:
    return len(state.item.bar_notes), state.today
