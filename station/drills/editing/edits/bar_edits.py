"""Bars: added, taken away, written once more. All lines of a grid go with them, and what counts bars by number.

Variations that take over a line of the grid follow it; a variation whose own bars change has all its lines itself
from then on. Cycles run on over the bars as before.
"""

from collections.abc import Callable, Sequence

from station.core.toml.toml_places import KeyPath
from station.drills.editing.bar_text import rests
from station.drills.editing.draft import Draft, DraftLine
from station.drills.editing.edits.bar_numbers import BarMap, bars_after_adding, bars_after_removing, with_moved_numbers
from station.drills.editing.edits.cell_edits import check_place
from station.drills.editing.edits.own_lines import with_own_copies, with_own_line
from station.drills.editing.lesson_edits import AddBars, CopyBars, LineAt, RemoveBars, TextLine
from station.drills.editing.line_words import (
    bar_total,
    with_all_bars,
    with_bars,
    without_bars,
    written_text,
)
from station.drills.grid.grid import bar_of
from station.drills.grid.line_group import MAX_BARS


def add_bars(draft: Draft, edit: AddBars) -> Draft:
    """The draft with bars of rests before bar `at`."""
    bars = draft.bar_count(edit.grid)
    if not 0 <= edit.at <= bars or not 1 <= edit.count <= MAX_BARS - bars:
        raise draft.refused(
            f"{edit.count} bars before bar {edit.at + 1}; the grid has {bars}, a lesson {MAX_BARS} at most"
        )
    turn = len(draft.timings[edit.grid].meters)
    if edit.at < bars and edit.count % turn:
        raise draft.refused(f"its meters come in turn; expected {turn} bars or a multiple, or bars at its end")
    moved = bars_after_adding(bars, edit.at, edit.count)

    def longer(draft: Draft, grid: int, line: DraftLine) -> str:
        bars = range(edit.at, edit.at + edit.count)
        near = min(edit.at, bar_total(line.text) - 1)
        like = written_text(line.text, near)
        return with_bars(
            line.text, edit.at, [rests(draft.frame(grid, bar), _if_sound(draft, grid, near, like)) for bar in bars]
        )

    return _with_bars_changed(draft, edit.grid, longer, moved, bars + edit.count)


def remove_bars(draft: Draft, edit: RemoveBars) -> Draft:
    """The draft without bars `first` to `last`."""
    bars = draft.bar_count(edit.grid)
    if not 0 <= edit.first <= edit.last < bars:
        raise draft.refused(f"bars {edit.first + 1} to {edit.last + 1}; the grid has {bars}")
    gone = edit.last - edit.first + 1
    if gone == bars:
        raise draft.refused("these are all bars of the grid; take the grid away instead")
    turn = len(draft.timings[edit.grid].meters)
    if edit.last + 1 < bars and gone % turn:
        raise draft.refused(f"its meters come in turn; expected {turn} bars or a multiple, or bars at its end")
    moved = bars_after_removing(bars, edit.first, edit.last)

    def shorter(_draft: Draft, _grid: int, line: DraftLine) -> str:
        return without_bars(line.text, edit.first, edit.last)

    return _with_bars_changed(draft, edit.grid, shorter, moved, bars - gone)


def copy_bars(draft: Draft, edit: CopyBars) -> Draft:
    """The draft with some bars of a grid, of this draft or another text, written in the same grid or another."""
    source = source_of(draft, edit)
    for bar in (edit.first, edit.last):
        check_place(source, edit.grid, bar, 0)
    draft.table(edit.to)
    if any(bar_total(line.text) <= edit.last for line in _played(source, edit.grid)):
        raise draft.refused("a line of the grid has too few bars; mend it in the text first")
    count = edit.last - edit.first + 1
    if count < 1:
        raise draft.refused(f"bar {edit.last + 1} comes before bar {edit.first + 1}")
    if edit.over:
        check_place(draft, edit.to, edit.at + count - 1, 0)
    for i in range(count):
        here, there = source.frame(edit.grid, edit.first + i), draft.frame(edit.to, edit.at + i)
        if here != there:
            raise draft.refused(f"bar {edit.first + i + 1} is of {here.meter}, its new place of {there.meter}")
    copied = [(line.at, _bars_at(line, range(edit.first, edit.last + 1))) for line in _played(source, edit.grid)]
    if not edit.over:
        draft = add_bars(draft, AddBars(edit.to, edit.at, count))
    return _overwritten(draft, edit.to, edit.at, [(_at(at, edit.to), texts) for at, texts in copied], count)


def source_of(draft: Draft, edit: CopyBars) -> Draft:
    """Where the bars come from."""
    return Draft.of(edit.text) if edit.text else draft


def _overwritten(
    draft: Draft, grid: int, at: int, copied: Sequence[tuple[LineAt | TextLine, list[str]]], count: int
) -> Draft:
    """The draft with these texts of bars from bar `at` on; lines that are not among them rest there."""
    for line_at, texts in copied:
        if draft.line(line_at, grid) or any(any(sign not in "-. ()" for sign in text) for text in texts):
            draft = with_own_line(draft, line_at, grid)[0]
    texts_of = dict(copied)
    changed: dict[KeyPath, str] = {}
    lines = _played(draft, grid)
    silent = [line for line in lines if line.at not in texts_of]
    draft = with_own_copies(draft, grid, silent)
    for line in _played(draft, grid):
        silence = [rests(draft.frame(grid, at + i)) for i in range(count)]
        new = texts_of.get(line.at, silence)
        bars = [written_text(line.text, bar) for bar in range(bar_total(line.text))]
        if len(bars) < at + count:
            raise draft.refused("a line of the grid has too few bars; mend it in the text first")
        changed[line.path] = with_all_bars(line.text, [*bars[:at], *new, *bars[at + count :]])
    return draft.with_lines(changed)


def _bars_at(line: DraftLine, bars: Sequence[int]) -> list[str]:
    return [written_text(line.text, bar) for bar in bars]


def _at(at: LineAt | TextLine, grid: int) -> LineAt | TextLine:
    return LineAt(grid, at.piece, at.limb) if isinstance(at, LineAt) else at


def _played(draft: Draft, grid: int) -> list[DraftLine]:
    """The lines of a grid but for those of its cycles."""
    return [line for line in draft.lines(grid) if line.cycle is None]


def _if_sound(draft: Draft, grid: int, bar: int, text: str) -> str:
    return text if bar_of(text, draft.frame(grid, bar)).sound else ""


def _with_bars_changed(
    draft: Draft, grid: int, change: Callable[[Draft, int, DraftLine], str], moved: BarMap, count: int
) -> Draft:
    """The draft with all lines of a grid changed, and of the variations that take over one of them."""
    before = draft
    bars = len(moved)
    draft = with_own_copies(draft, grid, _played(draft, grid))
    followers = [i for i in before.followers(grid) if _follows(before, i)]
    texts: dict[KeyPath, str] = {}
    for each in (grid, *followers):
        own = [line for line in _played(draft, each) if line.is_own]
        if any(bar_total(line.text) != bars for line in own):
            raise draft.refused("a line of the grid has more or fewer bars than the others; mend it in the text first")
        texts |= {line.path: change(draft, each, line) for line in own}
    draft = draft.with_lines(texts)
    for each in (grid, *followers):
        if "bars" in draft.table(each) and (each == grid or ("bars",) in draft.grids[each].own):
            draft = draft.with_key((*draft.grids[each].path, "bars"), count)
    for each in (i for i in before.followers(grid) if i not in followers):
        if ("bars",) not in before.grids[each].own and "bars" in before.table(each):
            draft = draft.with_key((*draft.grids[each].path, "bars"), before.table(each)["bars"])
    return with_moved_numbers(before, draft, dict.fromkeys((grid, *followers), moved))


def _follows(draft: Draft, grid: int) -> bool:
    """Whether a variation has its number of bars from its model."""
    lines = _played(draft, grid)
    return any(not line.is_own for line in lines) or not lines
