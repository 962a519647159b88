"""The click falls silent for some bars: what is stable is kept without it, longer and longer.

Four bars on and one off, two and two, one and three (TEACHING). Two clean passes at a level lead to the next, one that
is not clean leads back. Whether the student was early or late when the click returned is the report's business.
"""

from dataclasses import dataclass

from station.drills.mastery.rules import Rules


@dataclass(frozen=True, slots=True)
class SilentBars:
    """`level` into `Rules.gaps` from 1, 0 for a click throughout; `clean` passes in a row at it."""

    level: int = 0
    clean: int = 0

    def bars(self, rules: Rules) -> tuple[int, int] | None:
        """Bars with a click and bars without, in turn; None for a click throughout."""
        return None if self.level == 0 else rules.gaps[min(self.level, len(rules.gaps)) - 1]

    def after(self, is_clean: bool, rules: Rules) -> "SilentBars":
        """After a pass over the whole of a stable item."""
        if not is_clean:
            return SilentBars(max(self.level - 1, 0))
        if self.clean + 1 >= rules.clean_to_gap and self.level < len(rules.gaps):
            return SilentBars(self.level + 1)
        return SilentBars(self.level, self.clean + 1)
