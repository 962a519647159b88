"""Where everything in the grid's picture is, in pixels from its upper left corner: pure, so that clicks can be tested.

From the left the names of the lines, then the bars, a beat as long as its ticks. From above the bars' numbers, the
count, then a row a line.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from station.drills.editing.grid_cursor import GridStep, Line, cell_ticks, nearest_cell
from station.drills.editing.grid_page import PageGrid


@dataclass(frozen=True, slots=True)
class GridSizes:
    """Pixels: of the names' column, the head with numbers and count, a row, and the least and the most of a cell."""

    names: float
    head: float
    row: float
    least_cell: float
    most_cell: float
    gap: float
    """Between two bars."""


@dataclass(frozen=True, slots=True)
class GridGeometry:
    """The picture of one grid: its `rows` from above, and where its bars begin; `per_tick` pixels a tick."""

    grid: PageGrid
    step: GridStep
    sizes: GridSizes
    rows: tuple[Line, ...]
    lefts: tuple[float, ...]
    per_tick: float

    @classmethod
    def of(cls, grid: PageGrid, step: GridStep, rows: Sequence[Line], width: float, sizes: GridSizes) -> "GridGeometry":
        """All bars in `width` pixels if their cells are not too narrow then; wider, to be scrolled, if they are."""
        lengths = [frame.meter.bar_ticks for frame in grid.frames]
        room = width - sizes.names - len(lengths) * sizes.gap
        finest = min([step.ticks, *(c.length_ticks for line in grid.lines for bar in line.bars for c in bar.cells)])
        fitting = room / max(sum(lengths), 1)
        per_tick = min(max(fitting, sizes.least_cell / finest), sizes.most_cell / step.ticks)
        lefts = accumulate((length * per_tick + sizes.gap for length in lengths), initial=sizes.names)
        return cls(grid, step, sizes, tuple(rows), tuple(lefts), per_tick)

    @property
    def width(self) -> float:
        """Of all of it."""
        return self.lefts[-1]

    @property
    def height(self) -> float:
        """Of all of it."""
        return self.sizes.head + len(self.rows) * self.sizes.row

    def x_of(self, bar: int, tick: float) -> float:
        """Where a tick of a bar is."""
        return self.lefts[bar] + tick * self.per_tick

    def y_of(self, line: Line) -> float | None:
        """The upper edge of a line's row; None where it has none."""
        return self.sizes.head + self.rows.index(line) * self.sizes.row if line in self.rows else None

    def bar_at(self, x: float) -> int:
        """The bar at `x`; the first or the last beside them."""
        return min(max(bisect_right(self.lefts, x) - 1, 0), max(self.grid.bar_count - 1, 0))

    def bars_between(self, left: float, right: float) -> range:
        """The bars of which something lies between `left` and `right`; none where the grid has none."""
        return range(self.bar_at(left), self.bar_at(right) + 1) if self.grid.frames else range(0)

    def line_at(self, y: float) -> Line | None:
        """The line whose row is at `y`; None above and below."""
        index = int((y - self.sizes.head) // self.sizes.row)
        return self.rows[index] if y >= self.sizes.head and index < len(self.rows) else None

    def tick_at(self, x: float, line: Line) -> tuple[int, int] | None:
        """The bar and the tick of the cell of a line at `x`; None beside the bars."""
        if not self.grid.frames or not self.sizes.names <= x < self.width:
            return None
        bar = self.bar_at(x)
        tick = min((x - self.lefts[bar]) / self.per_tick, self.grid.frames[bar].meter.bar_ticks - 1)
        return bar, nearest_cell(cell_ticks(self.grid, bar, line, self.step), tick)

    def cell_width(self, bar: int, tick: int, line: Line) -> float:
        """How wide the cell of a line is that begins there."""
        ticks = (*cell_ticks(self.grid, bar, line, self.step), self.grid.frames[bar].meter.bar_ticks)
        return (ticks[min(ticks.index(tick) + 1, len(ticks) - 1)] - tick) * self.per_tick
