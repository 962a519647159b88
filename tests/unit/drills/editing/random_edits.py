"""Edits that somebody might make who clicks about in a page at random."""

from collections.abc import Callable
from random import Random

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.drills.editing.grid_page import GridPage, PageGrid
from station.drills.editing.lesson_edits import (
    REST,
    AddBars,
    AddGrid,
    AddLine,
    CopyBars,
    CutBeat,
    LessonEdit,
    LineAt,
    RemoveBars,
    RemoveGrid,
    RemoveLine,
    SetSign,
    SetStroke,
    TextLine,
)
from station.drills.grid.tab_symbols import SYMBOLS, family_of

PIECES = (Piece.SNARE, Piece.KICK, Piece.HIHAT, Piece.CRASH_1, Piece.TOM_1, Piece.RIDE, Piece.HIHAT_PEDAL)
LIMBS = (Limb.UNKNOWN, Limb.UNKNOWN, Limb.UNKNOWN, Limb.RIGHT_HAND)


def random_edit(random: Random, page: GridPage) -> LessonEdit:
    """An edit by place of any kind; strokes are the most usual."""
    index = random.randrange(len(page.grids))
    (make,) = random.choices([make for make, _ in MAKERS], [often for _, often in MAKERS])
    return make(random, page, index)


def random_line(random: Random, grid: PageGrid, index: int) -> LineAt:
    there = [line.at for line in grid.lines if isinstance(line.at, LineAt)]
    if there and random.random() < 0.7:
        return random.choice(there)
    return LineAt(index, random.choice(PIECES), random.choice(LIMBS))


def random_stroke(random: Random, page: GridPage, index: int) -> SetStroke:
    grid = page.grids[index]
    at = random_line(random, grid, index)
    frames = grid.frames if at.cycle is None else [grid.cycles[at.cycle]]
    bar = random.randrange(len(frames))
    cells = random.choice((1, 2, 4, 4, 8, 3, 6, 12))
    ticks = range(0, frames[bar].meter.bar_ticks, PPQ // cells)
    letters = (REST, REST, *SYMBOLS[family_of(at.piece)], "~", "#", "*")
    return SetStroke(at, bar, random.choice(ticks), random.choice(letters))


def _bar(random: Random, grid: PageGrid) -> int:
    return random.randrange(grid.bar_count)


def _tick(random: Random, grid: PageGrid, bar: int) -> int:
    return random.randrange(16) * grid.frames[bar].meter.bar_ticks // 16


def _hand(random: Random, page: GridPage, index: int) -> LessonEdit:
    grid, sign = page.grids[index], random.choice("RLB-")
    bar = _bar(random, grid)
    return SetSign(index, TextLine.STICKING, bar, _tick(random, grid, bar), sign)


def _mark(random: Random, page: GridPage, index: int) -> LessonEdit:
    grid, sign = page.grids[index], random.choice(("p", "mf", "ff", "<", ">", "-"))
    bar = _bar(random, grid)
    return SetSign(index, TextLine.LOUDNESS, bar, _tick(random, grid, bar), sign)


def _cut(random: Random, page: GridPage, index: int) -> LessonEdit:
    grid = page.grids[index]
    line = random.choice((None, random_line(random, grid, index)))
    bar = 0 if line and line.cycle is not None else _bar(random, grid)
    return CutBeat(index, bar, random.randrange(4), random.choice((1, 2, 3, 4, 5, 6, 8)), line)


def _add_line(random: Random, page: GridPage, index: int) -> LessonEdit:
    return AddLine(random_line(random, page.grids[index], index))


def _remove_line(random: Random, page: GridPage, index: int) -> LessonEdit:
    return RemoveLine(random.choice(page.grids[index].lines).at, index)


def _add_bars(random: Random, page: GridPage, index: int) -> LessonEdit:
    return AddBars(index, random.randint(0, page.grids[index].bar_count), random.choice((1, 1, 2)))


def _remove_bars(random: Random, page: GridPage, index: int) -> LessonEdit:
    first = _bar(random, page.grids[index])
    return RemoveBars(index, first, min(first + random.randrange(2), page.grids[index].bar_count - 1))


def _copy_bars(random: Random, page: GridPage, index: int) -> LessonEdit:
    first = _bar(random, page.grids[index])
    last = min(first + random.randrange(2), page.grids[index].bar_count - 1)
    to = random.randrange(len(page.grids))
    return CopyBars(index, first, last, to, _bar(random, page.grids[to]), random.random() < 0.5)


def _add_grid(random: Random, _page: GridPage, index: int) -> LessonEdit:
    return AddGrid(f"N{random.randrange(10**6)}", index, random.choice((None, index)))


def _remove_grid(_random: Random, _page: GridPage, index: int) -> LessonEdit:
    return RemoveGrid(index)


Maker = Callable[[Random, GridPage, int], LessonEdit]
MAKERS: tuple[tuple[Maker, int], ...] = (
    (random_stroke, 20),
    (_hand, 4),
    (_mark, 3),
    (_cut, 3),
    (_add_line, 1),
    (_remove_line, 1),
    (_add_bars, 2),
    (_remove_bars, 2),
    (_copy_bars, 2),
    (_add_grid, 1),
    (_remove_grid, 1),
)
"""What makes each kind of edit, and how often it is made."""
