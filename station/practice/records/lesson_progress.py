"""How far a student is with each lesson, from what is remembered of its mastery."""

from dataclasses import dataclass
from datetime import date
from pathlib import Path

from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.rules import Rules
from station.practice.records.memory import remembered


@dataclass(frozen=True, slots=True)
class LessonProgress:
    """One lesson: tempi in percent of its target, `day_pct` practised last, `shown_pct` the fastest shown blind.

    `is_mastered` says whether the target was shown often enough in a row, and every review since; `review` when it is
    asked for again (None: not, or no more).
    """

    day_pct: float
    shown_pct: float
    is_mastered: bool
    review: date | None = None

    @classmethod
    def of(cls, state: ItemState) -> "LessonProgress":
        """What a state says."""
        mastered = state.review.mastered_on is not None or state.is_stable(Rules())
        return cls(state.pct, state.mastery_pct, mastered, state.review.due)

    def is_due(self, today: date) -> bool:
        """Whether it is to be asked for today."""
        return self.review is not None and self.review <= today

    def words(self, today: date) -> str:
        """It in a line."""
        if self.is_due(today):
            return "Mastered; today is the day to show that it stuck"
        if self.is_mastered:
            return (
                "Mastered"
                if self.review is None
                else f"Mastered; to be shown again on {self.review.day} {self.review:%B}"
            )
        if self.shown_pct:
            return f"{self.shown_pct:.0f} % of the target tempo shown blind; {self.day_pct:.0f} % practised last"
        return f"Begun: {self.day_pct:.0f} % of the target tempo practised last"


def progress_of(sessions: Path, student: str) -> dict[str, LessonProgress]:
    """The progress of `student` by the names of lessons; of those practised in parts, that of the most bars."""
    longest: dict[str, ItemState] = {}
    for state in remembered(sessions, student):
        known = longest.get(state.item.name)
        if known is None or _weight(state) > _weight(known):
            longest[state.item.name] = state
    return {name: LessonProgress.of(state) for name, state in longest.items()}


def _weight(state: ItemState) -> tuple[int, date]:
    return len(state.item.bar_notes), state.today
