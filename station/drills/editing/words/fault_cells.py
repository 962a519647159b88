"""Which cell of a lesson's grids a fault is about, by the line and column where it was found."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from station.core.errors import BadInput
from station.core.toml.toml_faults import Fault
from station.drills.editing.draft import Draft, DraftLine
from station.drills.editing.grid_cursor import Cursor
from station.drills.grid.grid import parse_line


@dataclass(frozen=True, slots=True)
class FaultCell:
    """A cell at fault, and what is wrong there."""

    at: Cursor
    text: str


def fault_cells(text: str, faults: Sequence[Fault]) -> tuple[FaultCell, ...]:
    """The cells that `faults` of a text are about; none for one elsewhere or in a bar that cannot be read.

    A bar that `%` repeats has its fault where it is written.
    """
    if not faults:
        return ()
    try:
        draft = Draft.of(text)
        lines = [(grid, line) for grid in range(len(draft.grids)) for line in draft.lines(grid) if line.is_own]
    except BadInput:
        return ()
    cells = ((_cell(draft, lines, fault), fault.text) for fault in faults)
    return tuple(FaultCell(at, words) for at, words in cells if at is not None)


def _cell(draft: Draft, lines: Sequence[tuple[int, DraftLine]], fault: Fault) -> Cursor | None:
    places = draft.places
    if not 1 <= fault.line <= len(places.line_starts):
        return None
    offset = places.line_starts[fault.line - 1] + fault.column - 1
    for grid, line in lines:
        chars = places.chars.get(line.path)
        if chars and chars[0] <= offset <= chars[-1]:
            return _in_line(draft, grid, line, bisect_right(chars, offset) - 1)
    return None


def _in_line(draft: Draft, grid: int, line: DraftLine, char: int) -> Cursor | None:
    """The cell whose letter is character `char` of a line."""
    frames = [draft.frame(grid, 0, line.cycle)] if line.cycle is not None else draft.frames(grid)
    bars = parse_line(line.text, frames, lambda _char, _words: None) if frames else []
    cells = ((bar, cell) for bar, each in enumerate(bars) for cell in each.cells)
    return next((Cursor(grid, bar, cell.tick, line.at) for bar, cell in cells if cell.char == char), None)
