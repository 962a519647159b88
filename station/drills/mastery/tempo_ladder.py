"""The tempo's ladder: two clean passes lead a rung up, one bad one holds, two bad ones lead down, a broken one at once.

Tempi are percent of the target. The ladder never leaves [floor, 100].
"""

from dataclasses import dataclass, replace
from enum import StrEnum

from station.drills.mastery.rules import Rules
from station.drills.mastery.verdict import Grade

TOP_PCT = 100.0


class Move(StrEnum):
    """What a pass did to the tempo."""

    UP = "up"
    WAIT = "wait"
    HOLD = "hold"
    DOWN = "down"


@dataclass(frozen=True, slots=True)
class Ladder:
    """Where a student stands: `pct` of the target tempo, with so many `clean` or `bad` passes in a row there."""

    pct: float
    clean: int = 0
    bad: int = 0

    def after(self, grade: Grade, rules: Rules) -> tuple["Ladder", Move]:
        """The ladder after a pass at this rung, and which way it went."""
        is_good = grade in (Grade.CLEAN, Grade.LOOSE)
        if is_good and self.clean + 1 >= rules.clean_to_climb:
            return Ladder(min(self.pct + rules.up_pct, TOP_PCT)), Move.UP
        if is_good:
            return Ladder(self.pct, clean=self.clean + 1), Move.WAIT
        if grade is Grade.BROKEN:
            return self.lower(rules, rules.broken_drops), Move.DOWN
        if self.bad + 1 >= rules.bad_to_drop:
            return self.lower(rules), Move.DOWN
        return Ladder(self.pct, bad=self.bad + 1), Move.HOLD

    def lower(self, rules: Rules, steps: int = 1) -> "Ladder":
        """So many steps down, not below the floor."""
        return Ladder(max(self.pct - steps * rules.down_pct, min(rules.floor_pct, self.pct)))

    def resting(self) -> "Ladder":
        """The same rung, the counting begun anew."""
        return replace(self, clean=0, bad=0)
