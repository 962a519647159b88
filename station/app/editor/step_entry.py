"""Writing with the kit, step by step: a stroke writes its letter at the cursor; strokes at once are one step."""

from dataclasses import dataclass

from station.core.events import Hit
from station.core.units import NS_PER_MS
from station.drills.editing.grid_cursor import Cursor
from station.drills.editing.grid_page import PageGrid
from station.drills.editing.lesson_edits import LineAt, SetStroke
from station.drills.editing.played_hits import played_strokes
from station.drills.grid.stroke_settings import Velocities
from station.music.tempo import TempoMap

CHORD_NS = 25 * NS_PER_MS
"""Strokes within so long of a step's first are of that step: hands that strike together lie some 10 to 20 ms apart
(HUMANS, Timing), and nobody writes steps faster than 10 a second (our choice)."""
_ANY_TEMPO = TempoMap.constant(120.0)


@dataclass(frozen=True, slots=True)
class Step:
    """A step that was begun: when, and where it is written."""

    since_ns: int
    at: Cursor

    def holds(self, hit: Hit) -> bool:
        """Whether a stroke belongs to it."""
        return 0 <= hit.at_ns - self.since_ns <= CHORD_NS


def stroke_written(hit: Hit, at: Cursor, grid: PageGrid, velocities: Velocities) -> SetStroke:
    """The edit that writes a stroke of the kit at the place of `at`, in the line of its piece."""
    lines = [line.at for line in grid.lines if isinstance(line.at, LineAt)]
    (stroke,) = played_strokes((hit,), at.grid, lines, _ANY_TEMPO, velocities)
    return SetStroke(stroke.line, at.bar, at.tick, stroke.letter)
