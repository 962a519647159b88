"""How a lesson is to be written: its grids, how often each is played, and the order in which they are.

`form_of` keeps a lesson's sections as they are; `transcription.form_finder` finds shorter ways.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.drills.lesson import Lesson, Section


@dataclass(frozen=True, slots=True)
class FormGrid:
    """A grid that is played `times` times: `bars` bars of the score from `first_bar`, where it is played first.

    `like` is the index of an earlier grid with as many bars, of which it is a variation; its meter is that grid's.
    """

    name: str
    first_bar: int
    bars: int
    times: int = 1
    like: int | None = None


@dataclass(frozen=True, slots=True)
class LessonForm:
    """The grids as they are written, and their indices in the `order` in which they are played."""

    grids: tuple[FormGrid, ...]
    order: tuple[int, ...]

    @property
    def is_as_written(self) -> bool:
        """Whether each grid is played once, one after the other."""
        return self.order == tuple(range(len(self.grids)))


def form_of(lesson: Lesson) -> LessonForm:
    """One grid for each section of the lesson."""
    sections: Sequence[Section] = lesson.sections or (Section("", 0, lesson.score.bar_count - 1),)
    grids = tuple(FormGrid(s.name, s.first_bar, s.last_bar - s.first_bar + 1) for s in sections)
    return LessonForm(grids, tuple(range(len(grids))))
