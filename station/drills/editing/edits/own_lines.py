"""Lines that an edit needs in a grid itself: those of a variation's model copied, and missing ones made of rests."""

from station.core.toml.toml_edits import table_rows, with_block, with_pair
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_write import toml_key
from station.drills.editing.bar_text import rests
from station.drills.editing.draft import CYCLE, Draft, DraftLine, quoted
from station.drills.editing.lesson_edits import LineAt, TextLine
from station.drills.editing.line_words import bar_total, written_text
from station.drills.grid.lines_from_score import line_height
from station.drills.grid.tab_symbols import LIMB_TABLES, key_of_piece

_TABLE_OF = {limb: key for key, limb in LIMB_TABLES.items()}


def with_own_line(draft: Draft, at: LineAt | TextLine, grid: int) -> tuple[Draft, KeyPath]:
    """The draft with this line in the grid's own table, and where that stands: copied from the model, or all rests.

    A variation's line takes the place of all that its piece has in the model, so these are copied with it. Variations
    with bars of their own rest in a new line of their model.
    """
    draft = with_own_copies(draft, grid, [line for line in draft.lines(grid) if _goes_with(line, at)])
    line = draft.line(at, grid)
    if line is None:
        before = draft
        draft = _with_line(draft, grid, _place_of(draft, at, grid), silence(draft, at, grid))
        for other in before.followers(grid):
            if before.frames(other) != before.frames(grid) and before.line(at, other) is None:
                draft = _with_line(draft, other, _place_of(before, at, other), silence(before, at, other))
        line = draft.line(at, grid)
    assert line is not None, "it was made just now"
    return draft, line.path


def with_own_copies(draft: Draft, grid: int, lines: list[DraftLine]) -> Draft:
    """The draft with those of the grid's lines that it takes over written in its own table."""
    for line in lines:
        if line.is_own:
            continue
        if line.cycle is not None:
            draft = _with_own_cycles(draft, grid)
        elif not (now := draft.line(line.at, grid)) or not now.is_own:
            draft = _with_line(draft, grid, line.path[len(draft.grids[grid].path) :], line.text)
    return draft


def _goes_with(line: DraftLine, at: LineAt | TextLine) -> bool:
    """Whether a line of the model is replaced where a variation has the line `at`."""
    if isinstance(line.at, LineAt) and isinstance(at, LineAt):
        return line.cycle == at.cycle if at.cycle is not None else line.cycle is None and line.at.piece is at.piece
    return line.at is at


def _place_of(draft: Draft, at: LineAt | TextLine, grid: int) -> KeyPath:
    """The path below its grid of a line that is not there."""
    if isinstance(at, TextLine):
        return (at.value,)
    above: KeyPath = ()
    if at.cycle is not None:
        cycles = draft.cycle_tables(grid)
        if not 0 <= at.cycle < len(cycles):
            raise draft.refused(f"there is no cycle {at.cycle + 1}; the grid has {len(cycles)}")
        above = cycles[at.cycle][0]
    limb = (_TABLE_OF[at.limb],) if at.limb in _TABLE_OF else ()
    return (*above, *limb, key_of_piece(at.piece))


def silence(draft: Draft, at: LineAt | TextLine, grid: int) -> str:
    """Bars of rests, their cells as fine as those of the line that stands nearest."""
    cycle = at.cycle if isinstance(at, LineAt) else None
    name = key_of_piece(at.piece) if isinstance(at, LineAt) else at.value
    lines = [line for line in draft.lines(grid) if line.cycle == cycle and line.at is not TextLine.LOUDNESS]
    height = line_height(name)[0]
    near = min(lines, key=lambda line: abs(line.height[1] - height), default=None)
    bars = range(draft.bar_count(grid, cycle))
    likes = [written_text(near.text, bar) if near and bar < bar_total(near.text) else "" for bar in bars]
    texts = [rests(draft.frame(grid, bar, cycle), like) for bar, like in zip(bars, likes, strict=True)]
    return f"| {' | '.join(texts)} |"


# --- in the text ------------------------------------------------------------------------------------------------------


def _with_line(draft: Draft, grid: int, rel: KeyPath, line: str) -> Draft:
    """The draft with a new line at `rel` of a grid, among its others as they stand on the page."""
    *above, key = (*draft.grids[grid].path, *rel)
    limb = above[-1] if above[-1] in LIMB_TABLES else None
    table = tuple(above)
    said = quoted(line, '"')
    if limb is not None and not _is_table(draft, table):
        table, spelt = table[:-1], f"{limb}.{toml_key(str(key))}"
    else:
        spelt = toml_key(str(key))
    if table not in draft.places.keys and table not in draft.places.values:
        raise draft.refused("the lines of this grid stand in no table of their own; write it as [grid]")
    beside = _neighbour(draft, grid, table, ".".join(str(part) for part in rel[-2:] if isinstance(part, str)))
    return draft.now(with_pair(draft.text, table, spelt, said, beside))


def _is_table(draft: Draft, table: KeyPath) -> bool:
    """Whether the text has this limb's table under a header or in braces; dotted keys are rows of the grid's own."""
    places = draft.places
    at = places.keys.get(table)
    return table in places.values or (at is not None and places.text.startswith("[", at))


def _neighbour(draft: Draft, grid: int, table: KeyPath, name: str) -> tuple[KeyPath, bool] | None:
    """The line beside which a new one stands in `table`: after the last that is higher, or before the first."""
    here = [line for line in draft.lines(grid) if line.is_own and _table_of(draft, line) == table]
    height = line_height(name.removeprefix("cycle."))
    at = draft.places.keys
    higher = [line for line in here if line.height[1:] <= height]
    if higher:
        return max(higher, key=lambda line: at[line.path]).path, True
    return (min(here, key=lambda line: at[line.path]).path, False) if here else None


def _table_of(draft: Draft, line: DraftLine) -> KeyPath:
    """The table in whose rows the line stands."""
    above = line.path[:-1]
    return above[:-1] if above[-1] in LIMB_TABLES and not _is_table(draft, above) else above


def _with_own_cycles(draft: Draft, grid: int) -> Draft:
    """The draft with the cycles of a variation's model written in the variation."""
    path = draft.grids[grid].path
    if any(line.is_own for line in draft.lines(grid) if line.cycle is not None):
        return draft
    if not draft.places.text.startswith("[", draft.places.keys.get(path, 0)):
        return draft.with_key((*path, CYCLE), draft.table(grid)[CYCLE])
    blocks = "".join(f"\n[[grid.{CYCLE}]]\n{table_rows(cycle)}" for _, cycle in draft.cycle_tables(grid))
    return draft.now(with_block(draft.text, path, blocks))
