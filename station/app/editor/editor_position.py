"""Where one is in a lesson that is written, which bars are selected, how fine one writes and with which letter."""

from dataclasses import dataclass, field, replace

from station.drills.editing.grid_cursor import BarRange, Cursor, GridStep, Place, Way, moved, within
from station.drills.editing.grid_page import GridPage


@dataclass(frozen=True, slots=True)
class EditorPosition:
    """The `cursor`; `bars` that are selected, None for none; the `step`; a click's `letter`, empty for the usual."""

    cursor: Cursor = field(default_factory=Cursor)
    bars: BarRange | None = None
    step: GridStep = GridStep.SIXTEENTHS
    letter: str = ""

    @property
    def selected(self) -> BarRange:
        """The bars that are selected, else the one with the cursor."""
        return self.bars or BarRange(self.cursor.grid, self.cursor.bar, self.cursor.bar)

    def at(self, cursor: Cursor) -> "EditorPosition":
        """There; what a click writes was chosen for one line."""
        return replace(self, cursor=cursor, letter=self.letter if cursor.line == self.cursor.line else "")

    def moved(self, page: GridPage, way: Way, selects: bool = False) -> "EditorPosition":
        """A key's way on; where it `selects`, the bars from where the selection began."""
        before, after = self.cursor, self.at(moved(page, self.cursor, way, self.step))
        if not selects or after.cursor.grid != before.grid:
            return after
        start = self.bars if self.bars is not None and self.bars.holds(before.grid, before.bar) else None
        first, last = (before.bar, before.bar) if start is None else (start.first, start.last)
        other = last if before.bar == first else first
        low, high = sorted((other, after.cursor.bar))
        return replace(after, bars=BarRange(before.grid, low, high))

    def onward(self, page: GridPage) -> "EditorPosition":
        """A cell on, after something was written."""
        return replace(self, cursor=moved(page, self.cursor, Way.RIGHT, self.step))

    def at_bar(self, grid: int, bar: int) -> "EditorPosition":
        """At the start of a bar, in the same line."""
        return replace(self, cursor=replace(self.cursor, grid=grid, bar=bar, tick=0))

    def selecting(self, first: Place | None, last: Place | None) -> "EditorPosition":
        """With the bars from one place to another selected, at the first; with none where they share no grid."""
        if first is None or last is None or first.grid != last.grid:
            return replace(self, bars=None)
        low, high = sorted((first.bar, last.bar))
        return replace(self, bars=BarRange(first.grid, low, high)).at_bar(first.grid, low)

    def within(self, page: GridPage) -> "EditorPosition":
        """Where it can be on a page that has changed."""
        bars = self.bars
        if bars is not None:
            count = page.grids[bars.grid].bar_count if bars.grid < len(page.grids) else 0
            kept = BarRange(bars.grid, bars.first, min(bars.last, count - 1))
            bars = kept if kept.first <= kept.last else None
        return replace(self, cursor=within(page, self.cursor), bars=bars)
