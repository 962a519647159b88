"""Reviews over days: what was mastered is asked for again after 1, 3, 7 and 21 days, blind and before any practice.

Gains show only after a night (TEACHING: Simmons 2012); whether gaps grow or stay matters little (Latimier 2021).
"""

from dataclasses import dataclass
from datetime import date, timedelta

from station.drills.mastery.rules import Rules


@dataclass(frozen=True, slots=True)
class Review:
    """When an item was mastered, how many reviews it has passed since, and when the next is due (None: no more)."""

    mastered_on: date | None = None
    passed: int = 0
    due: date | None = None

    def is_due(self, today: date) -> bool:
        """Whether the item is to be asked for today."""
        return self.due is not None and self.due <= today

    def mastered(self, today: date, rules: Rules) -> "Review":
        """After the item has become stable; what was mastered before stays as it is."""
        return self if self.mastered_on else _scheduled(today, 0, today, rules)

    def after(self, is_clean: bool, today: date, rules: Rules) -> "Review":
        """After a review: the next one, or, where it failed, none until the item is mastered again."""
        if not is_clean or self.mastered_on is None:
            return Review()
        return _scheduled(self.mastered_on, self.passed + 1, today, rules)


def _scheduled(mastered_on: date, passed: int, today: date, rules: Rules) -> Review:
    """Days count from the mastering; who comes late has the next review tomorrow at the earliest."""
    if passed >= len(rules.review_days):
        return Review(mastered_on, passed)
    due = mastered_on + timedelta(days=rules.review_days[passed])
    return Review(mastered_on, passed, max(due, today + timedelta(days=1)))
