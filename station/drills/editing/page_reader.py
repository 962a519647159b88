"""The page of a lesson's text: its grids as they can be shown and pointed at, whatever faults they have."""

from functools import lru_cache

from station.core.errors import BadInput
from station.drills.editing.draft import Draft, DraftLine
from station.drills.editing.grid_page import GridPage, PageBar, PageCell, PageGrid, PageLine
from station.drills.editing.lesson_edits import TextLine
from station.drills.editing.line_words import bar_total
from station.drills.grid.grid import Bar, Cell, GridFrame, bar_words, parse_line
from station.drills.grid.grid_reader import MAX_TIMES
from station.drills.grid.line_group import MAX_BARS
from station.drills.grid.loudness_line import letter_runs
from station.drills.grid.skeletons import REST
from station.drills.grid.tab_symbols import RESTS

_KEPT = 512
"""Lines that are kept as they were read: those of the longest lessons, so that an edit reads again what it changed."""


def page_of(text: str) -> GridPage:
    """The grids of a text; none where it is no TOML, no cells in what is at fault."""
    try:
        draft = Draft.of(text)
        return GridPage(tuple(_grid(draft, i) for i in range(len(draft.grids))))
    except BadInput:
        return GridPage()


def _grid(draft: Draft, index: int) -> PageGrid:
    written, timing = draft.grids[index], draft.timings[index]
    if not isinstance(written.raw, dict):
        return PageGrid("", None, 1, (), ())
    lines = sorted(draft.lines(index), key=lambda line: line.height)
    bars = min(draft.bar_count(index), MAX_BARS)
    frames = tuple(draft.frame(index, bar) for bar in range(bars)) if timing.is_sure else ()
    cycles = tuple(draft.frame(index, 0, i) for i in range(len(draft.cycle_tables(index))))
    shown = tuple(_line(line, frames if line.cycle is None else (cycles[line.cycle],)) for line in lines)
    times = written.raw.get("times", 1)
    times = times if type(times) is int and 1 <= times <= MAX_TIMES else 1
    return PageGrid(written.name, written.like, times, frames, shown, timing.swing.ratio, cycles, timing.tempo_bpm)


def _line(line: DraftLine, frames: tuple[GridFrame, ...]) -> PageLine:
    return PageLine(line.at, _bars(line.text, frames, line.at is TextLine.LOUDNESS), line.is_own)


@lru_cache(maxsize=_KEPT)
def _bars(text: str, frames: tuple[GridFrame, ...], is_loudness: bool) -> tuple[PageBar, ...]:
    """The bars of a line; none where nobody knows its meter, or where it has more than any lesson."""
    if not frames or bar_total(text) > MAX_BARS:
        return ()
    repeats = [word.repeats is not None for word in bar_words(text) for _ in range(word.bars)]
    bars = parse_line(text, frames, lambda _char, _words: None)
    cells = _signs if is_loudness else _cells
    return tuple(PageBar(cells(text, bar), repeat) for bar, repeat in zip(bars, repeats, strict=False))


def _cells(text: str, bar: Bar) -> tuple[PageCell, ...]:
    return tuple(
        PageCell(cell.tick, cell.length_ticks, REST if cell.letter in RESTS else cell.letter, _in_tuplet(text, cell))
        for cell in bar.cells
    )


def _signs(text: str, bar: Bar) -> tuple[PageCell, ...]:
    """The cells of a bar of the loudness line: a mark of several letters is one."""
    return tuple(
        PageCell(
            run[0].tick,
            run[-1].tick + run[-1].length_ticks - run[0].tick,
            REST if run[0].letter in RESTS else "".join(cell.letter for cell in run),
            _in_tuplet(text, run[0]),
        )
        for run in letter_runs(bar.cells)
    )


def _in_tuplet(text: str, cell: Cell) -> bool:
    return text.rfind("(", 0, cell.char) > text.rfind(")", 0, cell.char)
