"""Reviews over days: what was mastered is asked for again after 1, 3, 7 and 21 days, blind and before any practice.

Gains show only after a night (TEACHING: Simmons 2012); whether gaps grow or stay matters little (Latimier 2021).
"""

from dataclasses import dataclass, replace
from datetime import date, timedelta

from station.drills.mastery.rules import Rules
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class Review:
    """When an item was mastered, how many reviews it has passed since, and when the next is due (None: no more).

    `level` is the narrowest at which it was mastered: reviews are judged at it, so that what was once good enough is.
    """

    mastered_on: date | None = None
    passed: int = 0
    due: date | None = None
    level: Level = Level.INTERMEDIATE

    def is_due(self, today: date) -> bool:
        """Whether the item is to be asked for today."""
        return self.due is not None and self.due <= today

    def mastered(self, today: date, level: Level, rules: Rules) -> "Review":
        """After the item has become stable at `level`; what was mastered before keeps its days."""
        if self.mastered_on is None:
            return replace(self, mastered_on=today, level=level)._scheduled(today, rules)
        return self if level.rank <= self.level.rank else replace(self, level=level)

    def after(self, is_clean: bool, today: date, rules: Rules) -> "Review":
        """After a review: the next one, or, where it failed, none until the item is mastered again."""
        if not is_clean or self.mastered_on is None:
            return Review()
        return replace(self, passed=self.passed + 1)._scheduled(today, rules)

    def _scheduled(self, today: date, rules: Rules) -> "Review":
        """Days count from the mastering; who comes late has the next review tomorrow at the earliest."""
        if self.mastered_on is None or self.passed >= len(rules.review_days):
            return replace(self, due=None)
        due = self.mastered_on + timedelta(days=rules.review_days[self.passed])
        return replace(self, due=max(due, today + timedelta(days=1)))
