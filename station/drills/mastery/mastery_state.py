"""All that the policy knows of one student and one item: an immutable value, one after each pass."""

from dataclasses import dataclass, field, replace
from datetime import date

from station.drills.mastery.equipment_faults import Equipment
from station.drills.mastery.feedback_fading import Fading
from station.drills.mastery.plateau import Plateau
from station.drills.mastery.practice_steps import PracticeItem, PracticeStep
from station.drills.mastery.probes import Probes
from station.drills.mastery.reviews import Review
from station.drills.mastery.rules import Rules
from station.drills.mastery.silent_bars import SilentBars
from station.drills.mastery.tempo_ladder import Ladder
from station.drills.mastery.weak_bars import BarTally
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class Chunk:
    """A weak bar that is practised alone, on a ladder of its own, until it is clean at `goal_pct`; `passes` so far."""

    bar: int
    ladder: Ladder
    goal_pct: float
    passes: int = 0


@dataclass(frozen=True, slots=True)
class Before:
    """How it was during the last pass: what a veto goes back to."""

    ladder: Ladder
    chunk: Chunk | None


@dataclass(frozen=True, slots=True)
class ItemState:
    """What is known. `step` is the pass that was asked for last; `fixed_pct` the tempo a student has pinned.

    `varied` counts the variations played, `today` is the session's day, `level` the one by which it was judged.
    """

    item: PracticeItem
    step: PracticeStep
    today: date
    ladder: Ladder
    probes: Probes
    plateau: Plateau
    fading: Fading = field(default_factory=Fading)
    tally: tuple[BarTally, ...] = ()
    chunk: Chunk | None = None
    equipment: Equipment = field(default_factory=Equipment)
    review: Review = field(default_factory=Review)
    gaps: SilentBars = field(default_factory=SilentBars)
    fixed_pct: float | None = None
    varied: int = 0
    before: Before | None = None
    level: Level = Level.INTERMEDIATE

    @property
    def mastery_pct(self) -> float:
        """The fastest tempo last shown blind, percent of the target; 0 where none was."""
        return self.probes.mastery_pct

    @property
    def pct(self) -> float:
        """The tempo of the day."""
        return self.ladder.pct if self.fixed_pct is None else self.fixed_pct

    def is_stable(self, rules: Rules) -> bool:
        """Whether the target tempo was shown blind often enough in a row."""
        return self.probes.is_stable(rules)

    def is_settled(self, rules: Rules) -> bool:
        """Whether it is stable, or was at a wider level and goes on at a narrower one."""
        has_grown = self.review.mastered_on is not None and self.review.level.rank < self.level.rank
        return has_grown or self.is_stable(rules)

    def at_level(self, level: Level) -> "ItemState":
        """It judged at `level` from now on: what was shown at another does not make it stable there."""
        if level is self.level:
            return self
        return replace(self, level=level, probes=replace(self.probes, in_a_row=0))
