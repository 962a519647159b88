"""Plateaus: where practising on brings nothing today (TEACHING: leave a drill after five runs on a plateau).

A step forward is a faster rung than any before, or more mastery. A run is so many passes (`Rules.passes_a_run`); a pass
that breaks down where nothing slower is left counts as a whole run, for it only teaches mistakes.
"""

from dataclasses import dataclass, replace

from station.drills.mastery.rules import Rules


@dataclass(frozen=True, slots=True)
class Plateau:
    """The best rung and mastery so far, in percent of the target, and the passes since then."""

    best_pct: float
    best_mastery_pct: float = 0.0
    in_a_row: int = 0
    passes: int = 0

    def after(self, pct: float, mastery_pct: float, in_a_row: int, passes: int = 1) -> "Plateau":
        """After so many more passes, which left the ladder, the mastery and the probes of the target in a row there."""
        if pct > self.best_pct or mastery_pct > self.best_mastery_pct or in_a_row > self.in_a_row:
            return Plateau(max(pct, self.best_pct), max(mastery_pct, self.best_mastery_pct), in_a_row)
        return replace(self, passes=self.passes + passes)

    def is_reached(self, rules: Rules) -> bool:
        """Whether it is time to leave."""
        return self.passes >= rules.runs_to_leave * rules.passes_a_run

    def again(self) -> "Plateau":
        """Another day, or a student who plays on all the same."""
        return replace(self, passes=0)
