"""What a place on the staff means for whoever writes there: a cell of a line of the text.

Places are staff spaces on the page, x and y as in `page_places`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.pieces import Piece
from station.drills.editing.grid_cursor import Cursor, GridStep, Place, cell_ticks
from station.drills.editing.grid_page import GridPage, PageGrid
from station.drills.editing.lesson_edits import LineAt
from station.drills.editing.letter_palette import usual_letter
from station.drills.grid.tab_symbols import BEYOND, BEYOND_SYMBOLS, SYMBOLS, TabSymbol, family_of
from station.render.notation.page.page_places import BarPlace, LinePlace, PageHead, pieces_on
from station.scenes.draft_notation import Notation


@dataclass(frozen=True, slots=True)
class StaffCell:
    """A cell that was pointed at, where it stands on the page, and whether a head is there."""

    cursor: Cursor
    x: float
    y: float
    is_struck: bool

    @property
    def piece(self) -> Piece:
        """What is struck there."""
        assert isinstance(self.cursor.line, LineAt), "a staff has lines of pieces alone"
        return self.cursor.line.piece


@dataclass(frozen=True, slots=True)
class StaffPointer:
    """Finds cells of `page`, the grids of the text, on its `notation`, `step` apart."""

    notation: Notation
    page: GridPage
    step: GridStep

    def cell_at(self, x: float, y: float) -> StaffCell | None:
        """The stroke whose head is there, else the nearest cell of the piece there; None beside the bars."""
        line = self.notation.page.places.line_at(y)
        bar = None if line is None else line.bar_at(x)
        if line is None or bar is None or not line.top <= y <= line.bottom:
            return None
        head = line.head_at(x, y)
        return self._free(line, bar, x, y) if head is None else self._struck(line, head)

    def bar_at(self, x: float, y: float) -> Place | None:
        """The bar that is there."""
        line = self.notation.page.places.line_at(y)
        bar = None if line is None else line.bar_at(x)
        return None if bar is None else self.notation.music.bars[bar.bar]

    def spot(self, place: Place) -> tuple[LinePlace, float] | None:
        """The line of a place and its x; None where the page has no such bar."""
        bars = self.notation.music.bars
        bar = Place(place.grid, place.bar)
        found = self.notation.page.places.bar(bars.index(bar)) if bar in bars else None
        return None if found is None else (found[0], found[1].x_at(place.tick))

    def _struck(self, line: LinePlace, head: PageHead) -> StaffCell | None:
        music = self.notation.music
        at, place = music.lines.get((head.tick, head.piece)), music.bars[head.bar]
        if at is None:
            return None
        tick = head.tick - music.score.tempo_map.bar_start(head.bar)
        return StaffCell(Cursor(place.grid, place.bar, tick, at), head.x, head.y, is_struck=True)

    def _free(self, line: LinePlace, bar: BarPlace, x: float, y: float) -> StaffCell | None:
        place, step = self.notation.music.bars[bar.bar], line.step_at(y)
        if place.grid >= len(self.page.grids) or place.bar >= self.page.grids[place.grid].bar_count:
            return None
        grid = self.page.grids[place.grid]
        at = _line_of(grid, place.grid, step)
        tick = _nearest(cell_ticks(grid, place.bar, at, self.step), bar.tick_at(x))
        cursor = Cursor(place.grid, place.bar, tick, at)
        is_struck = (bar.bar, tick, at.piece) in self._strokes
        return StaffCell(cursor, bar.x_at(tick), line.y_of(step), is_struck)

    @property
    def _strokes(self) -> set[tuple[int, int, Piece]]:
        start = self.notation.music.score.tempo_map.bar_start
        heads = (head for line in self.notation.page.places.lines for head in line.heads)
        return {(head.bar, head.tick - start(head.bar), head.piece) for head in heads}


def _line_of(grid: PageGrid, number: int, step: int) -> LineAt:
    """The grid's line of a piece that stands on `step`; a new one of the usual piece where it has none."""
    lines = [line.at for line in grid.lines if isinstance(line.at, LineAt) and line.at.cycle is None]
    piece = pieces_on(step, [line.piece for line in lines])[0]
    return next((line for line in lines if line.piece is piece), LineAt(number, piece))


def _nearest(ticks: Sequence[int], tick: float) -> int:
    return min(ticks, key=lambda each: abs(each - tick))


def symbol_of(line: LineAt, letter: str) -> TabSymbol:
    """What a letter plays in a line; of one that plays nothing by itself, the line's usual stroke."""
    family = family_of(line.piece)
    if letter == BEYOND:
        return BEYOND_SYMBOLS[family]
    return SYMBOLS[family].get(letter, SYMBOLS[family][usual_letter(line)])
