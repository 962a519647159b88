"""The grids of a text as they can be shown and pointed at: lines, bars, cells, each with its place in the music.

`page_of` is of any text that TOML accepts; where a line or a bar is at fault it has no cells.
"""

from dataclasses import dataclass

from station.core.pieces import Limb, Piece
from station.drills.editing.lesson_edits import LineAt, TextLine
from station.drills.grid.grid import GridFrame


@dataclass(frozen=True, slots=True)
class PageCell:
    """A cell: `tick` from the bar's start as written, how long it is, its `letter` ("-" for a rest, a sign's words).

    `in_tuplet` where it stands in `(…)`.
    """

    tick: int
    length_ticks: int
    letter: str
    in_tuplet: bool = False


@dataclass(frozen=True, slots=True)
class PageBar:
    """A bar of a line: its cells, none where it is at fault; `repeats` where it is written `%`."""

    cells: tuple[PageCell, ...]
    repeats: bool = False


@dataclass(frozen=True, slots=True)
class PageLine:
    """A line: of a piece, or of signs; `is_own` false where a variation takes it over from its model."""

    at: LineAt | TextLine
    bars: tuple[PageBar, ...]
    is_own: bool = True

    @property
    def piece(self) -> Piece | None:
        """Of a line that is played."""
        return self.at.piece if isinstance(self.at, LineAt) else None

    @property
    def limb(self) -> Limb:
        """Whose line it is, where the text says so."""
        return self.at.limb if isinstance(self.at, LineAt) else Limb.UNKNOWN


@dataclass(frozen=True, slots=True)
class PageGrid:
    """A grid of the text: `like` is the index of its model; `frames` have each bar's meter and beat.

    `tempo_bpm` is that at its beginning, in quarter notes a minute.
    `cycles` have those of the bars of each cycle, whose lines stand last in `lines`.
    """

    name: str
    like: int | None
    times: int
    frames: tuple[GridFrame, ...]
    lines: tuple[PageLine, ...]
    swing_ratio: float = 1.0
    cycles: tuple[GridFrame, ...] = ()
    tempo_bpm: float = 80.0

    @property
    def bar_count(self) -> int:
        """How many bars are written."""
        return len(self.frames)


@dataclass(frozen=True, slots=True)
class GridPage:
    """All grids of a text, in its order; none where the text is no TOML."""

    grids: tuple[PageGrid, ...] = ()
