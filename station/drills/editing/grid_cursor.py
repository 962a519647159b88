"""Where one is in a lesson that is written: the cursor, the cells that it steps through, the bars that are selected.

Ticks count from the start of their bar, as in `lesson_edits`. A cell is a place that can be written at: what the line
has itself in a `(…)`, else every `GridStep` of the bar and what stands between them.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from itertools import pairwise

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.grid_page import GridPage, PageBar, PageCell, PageGrid, PageLine
from station.drills.editing.lesson_edits import REST, LineAt, SetSign, SetStroke, TextLine

Line = LineAt | TextLine


class GridStep(Enum):
    """How fine one writes: cells a quarter note, and what drummers call them."""

    QUARTERS = (1, "1/4")
    EIGHTHS = (2, "1/8")
    TRIPLETS = (3, "1/8 triplets")
    SIXTEENTHS = (4, "1/16")
    QUINTUPLETS = (5, "quintuplets")
    SEXTUPLETS = (6, "1/16 triplets")
    SEPTUPLETS = (7, "septuplets")
    THIRTY_SECONDS = (8, "1/32")

    def __init__(self, cells: int, words: str) -> None:
        self.cells = cells
        self.words = words

    @property
    def ticks(self) -> int:
        """How long a cell is; all of them divide `PPQ`."""
        return PPQ // self.cells


class Way(Enum):
    """Where a key takes the cursor."""

    LEFT = "a cell back"
    RIGHT = "a cell on"
    UP = "a line up"
    DOWN = "a line down"
    BEAT_BACK = "a beat back"
    BEAT_ON = "a beat on"
    BAR_BACK = "a bar back"
    BAR_ON = "a bar on"
    HOME = "to the start of the grid"
    END = "to its last bar"


@dataclass(frozen=True, slots=True)
class Place:
    """A place in the text's music: a grid, its bar, a tick of that."""

    grid: int = 0
    bar: int = 0
    tick: int = 0


@dataclass(frozen=True, slots=True)
class Cursor:
    """A place and the line that is written in there."""

    grid: int = 0
    bar: int = 0
    tick: int = 0
    line: Line = field(default_factory=lambda: LineAt(0, Piece.SNARE))

    @property
    def place(self) -> Place:
        """Where it is, whatever the line."""
        return Place(self.grid, self.bar, self.tick)


@dataclass(frozen=True, slots=True)
class BarRange:
    """Bars `first` to `last` of a grid."""

    grid: int
    first: int
    last: int

    def holds(self, grid: int, bar: int) -> bool:
        """Whether a bar is among them."""
        return grid == self.grid and self.first <= bar <= self.last


def usual_step(page: GridPage) -> GridStep:
    """The coarsest step, eighths or finer, that all strokes of the first grid stand on; what stands in `(…)` aside."""
    bars = [bar for grid in page.grids[:1] for line in grid.lines for bar in line.bars]
    ticks = {cell.tick for bar in bars for cell in bar.cells if cell.letter != REST and not cell.in_tuplet}
    fitting = [step for step in GridStep if step.cells > 1 and all(tick % step.ticks == 0 for tick in ticks)]
    return fitting[0] if fitting else GridStep.SIXTEENTHS


def line_of(grid: PageGrid, line: Line) -> PageLine | None:
    """The line of a grid that stands there."""
    return next((each for each in grid.lines if each.at == line), None)


def cell_ticks(grid: PageGrid, bar: int, line: Line, step: GridStep) -> tuple[int, ...]:
    """Every tick of a bar that can be written at in a line, in order."""
    here = shown_bar(grid, bar, line)
    tuplets = [(cell.tick, cell.tick + cell.length_ticks) for cell in here.cells if cell.in_tuplet]
    length = grid.frames[bar].meter.bar_ticks
    starts = [*(_pass_starts(grid, bar, line) or [0]), length]
    plain = [tick for low, high in pairwise(starts) for tick in range(low, high, step.ticks) if tick >= 0]
    ticks = {tick for tick in plain if not any(low <= tick < high for low, high in tuplets)}
    ticks |= {cell.tick for cell in here.cells if cell.in_tuplet or cell.letter != REST}
    return tuple(sorted(ticks))


def shown_bar(grid: PageGrid, bar: int, line: Line) -> PageBar:
    """What a line has in a bar of its grid: of a cycle's line what the cycle plays there, as it runs on over the bars.

    It `repeats` where the cycle has been played before; no cells where the line has none or is at fault.
    """
    written = line_of(grid, line)
    if written is None or not any(each.cells for each in written.bars):
        return PageBar(())
    if _cycle_ticks(grid, line) == 0:
        return written.bars[bar] if bar < len(written.bars) else PageBar(())
    length, cells = grid.frames[bar].meter.bar_ticks, list[PageCell]()
    for start in _pass_starts(grid, bar, line):
        for number, each in enumerate(written.bars):
            at = start + number * grid.cycles[_cycle(line)].meter.bar_ticks
            cells += [replace(c, tick=at + c.tick) for c in each.cells if 0 <= at + c.tick < length]
    first = cells[0].tick if cells else length
    rest = [PageCell(0, first, REST)] if first else []  # what began in the bar before
    return PageBar((*rest, *cells), repeats=_bar_start(grid, bar) >= _cycle_ticks(grid, line))


def written_at(grid: PageGrid, cell: Cursor) -> Cursor:
    """The place in the text of what stands in a cell: of a cycle's line, in the cycle's own bars."""
    total = _cycle_ticks(grid, cell.line)
    if not total:
        return cell
    tick = (_bar_start(grid, cell.bar) + cell.tick) % total
    bar, tick = divmod(tick, grid.cycles[_cycle(cell.line)].meter.bar_ticks)
    return replace(cell, bar=bar, tick=tick)


def _cycle(line: Line) -> int:
    return line.cycle if isinstance(line, LineAt) and line.cycle is not None else -1


def _cycle_ticks(grid: PageGrid, line: Line) -> int:
    """How long the cycle of a line is; 0 for a line of none."""
    if not 0 <= _cycle(line) < len(grid.cycles):
        return 0
    written = line_of(grid, line)
    bars = 1 if written is None else max(len(written.bars), 1)
    return bars * grid.cycles[_cycle(line)].meter.bar_ticks


def _bar_start(grid: PageGrid, bar: int) -> int:
    return sum(frame.meter.bar_ticks for frame in grid.frames[:bar])


def _pass_starts(grid: PageGrid, bar: int, line: Line) -> list[int]:
    """Where in a bar the passes of a line's cycle begin, the first perhaps before it; none of a line that has none."""
    total, start = _cycle_ticks(grid, line), _bar_start(grid, bar)
    return list(range(-(start % total), grid.frames[bar].meter.bar_ticks, total)) if total else []


def nearest_cell(ticks: Sequence[int], tick: float) -> int:
    """The cell that `tick` stands in: the last one that begins there or before."""
    return ticks[max(bisect_right(ticks, tick) - 1, 0)]


def within(page: GridPage, cursor: Cursor) -> Cursor:
    """The same cursor where it can be on `page`: in a grid, a bar and a line that are there."""
    if not page.grids:
        return cursor
    number = min(max(cursor.grid, 0), len(page.grids) - 1)
    grid = page.grids[number]
    bar = min(max(cursor.bar, 0), max(grid.bar_count - 1, 0))
    tick = min(cursor.tick, grid.frames[bar].meter.bar_ticks - 1) if grid.frames else 0
    line = _own_line(cursor.line, number)
    if line_of(grid, line) is None and grid.lines and not _is_of_piece(line):
        line = grid.lines[0].at
    return Cursor(number, bar, max(tick, 0), line)


def _is_of_piece(line: Line) -> bool:
    return isinstance(line, LineAt)  # it may be made by what is written next


def _own_line(line: Line, grid: int) -> Line:
    return replace(line, grid=grid) if isinstance(line, LineAt) else line


def moved(page: GridPage, cursor: Cursor, way: Way, step: GridStep) -> Cursor:
    """The cursor one `way` further; at an end of its grid it stays, or goes into the grid beside it."""
    cursor = within(page, cursor)
    if not page.grids or not page.grids[cursor.grid].frames:
        return cursor
    grid = page.grids[cursor.grid]
    if way in _LINES:
        return _by_line(grid, cursor, _LINES[way])
    if way in _CELLS:
        return _by_cell(page, cursor, _CELLS[way], step)
    if way in _BEATS:
        return _by_beat(page, cursor, _BEATS[way])
    if way in _BARS:
        return _by_bar(page, cursor, _BARS[way])
    return replace(cursor, bar=0 if way is Way.HOME else grid.bar_count - 1, tick=0)


_LINES = {Way.UP: -1, Way.DOWN: 1}
_CELLS = {Way.LEFT: -1, Way.RIGHT: 1}
_BEATS = {Way.BEAT_BACK: -1, Way.BEAT_ON: 1}
_BARS = {Way.BAR_BACK: -1, Way.BAR_ON: 1}


def _by_line(grid: PageGrid, cursor: Cursor, by: int) -> Cursor:
    lines = [line.at for line in grid.lines]
    if cursor.line not in lines:
        return replace(cursor, line=lines[0]) if lines else cursor
    return replace(cursor, line=lines[min(max(lines.index(cursor.line) + by, 0), len(lines) - 1)])


def _by_cell(page: GridPage, cursor: Cursor, by: int, step: GridStep) -> Cursor:
    ticks = cell_ticks(page.grids[cursor.grid], cursor.bar, cursor.line, step)
    index = bisect_left(ticks, cursor.tick) - 1 if by < 0 else bisect_right(ticks, cursor.tick)
    if 0 <= index < len(ticks):
        return replace(cursor, tick=ticks[index])
    beside = _by_bar(page, cursor, by)
    if by > 0 or (beside.grid, beside.bar) == (cursor.grid, cursor.bar):
        return beside
    return replace(beside, tick=cell_ticks(page.grids[beside.grid], beside.bar, beside.line, step)[-1])


def _by_beat(page: GridPage, cursor: Cursor, by: int) -> Cursor:
    starts = [start for start, _ in page.grids[cursor.grid].frames[cursor.bar].spans]
    index = bisect_left(starts, cursor.tick) - 1 if by < 0 else bisect_right(starts, cursor.tick)
    if 0 <= index < len(starts):
        return replace(cursor, tick=starts[index])
    beside = _by_bar(page, cursor, by)
    if by > 0 or (beside.grid, beside.bar) == (cursor.grid, cursor.bar):
        return beside
    return replace(beside, tick=page.grids[beside.grid].frames[beside.bar].spans[-1][0])


def _by_bar(page: GridPage, cursor: Cursor, by: int) -> Cursor:
    """A bar on or back; at the end of all it stays where it is, back from within the first bar it goes to its start."""
    grid, bar = cursor.grid, cursor.bar + by
    if bar >= page.grids[grid].bar_count and grid + 1 < len(page.grids):
        return within(page, replace(cursor, grid=grid + 1, bar=0, tick=0))
    if bar < 0 and grid > 0 and page.grids[grid - 1].frames:
        return within(page, replace(cursor, grid=grid - 1, bar=page.grids[grid - 1].bar_count - 1, tick=0))
    if 0 <= bar < page.grids[grid].bar_count:
        return replace(cursor, bar=bar, tick=0)
    return replace(cursor, tick=0) if bar < 0 else cursor


def letter_at(grid: PageGrid, cell: Cursor) -> str:
    """What stands in a cell, a rest where nothing does."""
    if cell.bar >= grid.bar_count:
        return REST
    cells = shown_bar(grid, cell.bar, cell.line).cells
    return next((each.letter for each in cells if each.tick == cell.tick), REST)


def writing(page: GridPage, at: Cursor, letter: str) -> SetStroke | SetSign:
    """The edit that writes at a cursor of `page`."""
    at = written_at(page.grids[at.grid], at) if at.grid < len(page.grids) else at
    if isinstance(at.line, LineAt):
        return SetStroke(at.line, at.bar, at.tick, letter)
    return SetSign(at.grid, at.line, at.bar, at.tick, letter)
