"""The levels at which a lesson may be judged, and which of them holds: the one answer for window, terminal and report.

A level belongs to a student and a lesson. It moves the pass mark (`pass_measures.pass_mark`) and the windows that are
shown live, never the score, so that nobody who improves sees it fall.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.scoring.matching.hit_windows import Level

OF_DIFFICULTY: Mapping[int, Level] = MappingProxyType(
    {
        1: Level.BEGINNER,
        2: Level.ELEMENTARY,
        3: Level.INTERMEDIATE,
        4: Level.INTERMEDIATE,
        5: Level.INTERMEDIATE,
    }
)
"""Where a lesson of each difficulty (`lesson.LEVELS`) begins unless it says so itself. Our choice: whoever plays their
first lessons is a beginner; hard music is no reason to ask for more than TEACHING's pass, students grow into that."""


@dataclass(frozen=True, slots=True)
class LevelRange:
    """A lesson's levels: the `suggested` one, where a student begins, and the `strictest`, a teacher's limit."""

    suggested: Level
    strictest: Level = Level.STUDIO

    @property
    def choices(self) -> tuple[Level, ...]:
        """The levels that may be chosen, the widest first."""
        return tuple(Level)[: self.strictest.rank + 1]

    def level(self, asked: Level | None = None, reached: Level | None = None) -> Level:
        """The level that holds: the one `asked` for, else what the student has `reached`, else the suggested one.

        It is never narrower than the strictest.
        """
        return self._limited(asked or reached or self.suggested)

    def after(self, level: Level) -> Level:
        """Where a student goes who holds the lesson at `level`: the next narrower, or no further at the last."""
        return self._limited(tuple(Level)[min(level.rank + 1, Level.STUDIO.rank)])

    def _limited(self, level: Level) -> Level:
        return min(level, self.strictest, key=lambda each: each.rank)


ANY_LEVEL = LevelRange(Level.INTERMEDIATE)
"""Of what says nothing of levels."""
