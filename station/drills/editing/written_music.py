"""A lesson's music as its text has it: each grid once, in the order of the text, with the cell of every stroke.

What stands behind a page of notation that can be edited. Bars at fault have what of them can be read.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from station.core.pieces import Limb, Piece
from station.core.toml.schema import checked_values
from station.core.toml.toml_faults import Faults, Wrong
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_source import text_source
from station.drills.editing.grid_cursor import Place
from station.drills.editing.lesson_edits import LineAt
from station.drills.grid.cell_strokes import WrittenCell, parted
from station.drills.grid.grid_timing import timing_of
from station.drills.grid.tab_symbols import LIMB_TABLES
from station.drills.reading.lesson_fields import DEFAULT_TIMING, FIELDS
from station.drills.reading.lesson_music import read_grids, score_of, written_of
from station.drills.reading.played_grids import PlayedGrid, ReadGrid
from station.music.score import Score


@dataclass(frozen=True, slots=True)
class GridSigns:
    """What stands at the bar lines of grid number `grid`: its name, how often it is played, which passes it ends.

    Its bars are `first_bar` to `last_bar` of the score; `passes` count from 1, empty where it is no ending.
    """

    name: str
    first_bar: int
    last_bar: int
    times: int
    passes: tuple[int, ...] = ()
    has_endings: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class WrittenMusic:
    """The `score` of all grids, each once, with the place in the text of each of its `bars`.

    `lines` have the line of each stroke by its tick, as written (straight), and its piece.
    """

    score: Score
    bars: tuple[Place, ...]
    grids: tuple[GridSigns, ...]
    lines: Mapping[tuple[int, Piece], LineAt]
    beat_ticks: int


def written_music(text: str) -> WrittenMusic | None:
    """The music of a text; None where it is no TOML or where no grid of it can be read."""
    source = text_source(text, "")
    if source.syntax:
        return None
    try:
        return _music(source.raw)
    except Wrong:
        return None


def _music(raw: object) -> WrittenMusic | None:
    values, _ = checked_values(raw, FIELDS)
    timing = timing_of(values, DEFAULT_TIMING, Faults())
    faults = Faults()
    written = [] if values["grid"] is None else written_of(values["grid"], faults)
    grids = read_grids(written, timing, faults)
    if not grids:
        return None
    once = _each_once(grids)
    cells = list(chain.from_iterable(each.strokes for each in once))
    score, _ = score_of(parted(cells), once, written, faults)
    bars = tuple(Place(each.entry, bar) for each in once for bar in range(each.grid.section.bar_count))
    return WrittenMusic(
        score,
        bars,
        tuple(_signs(each) for each in once),
        {(cell.place.straight, cell.piece): _line_at(cell, once) for cell in cells},
        timing.beat_ticks,
    )


def _each_once(grids: Sequence[ReadGrid]) -> list[PlayedGrid]:
    """Each grid's first repetition, one after the other."""
    found: list[PlayedGrid] = []
    tick = bars = 0
    for index, grid in enumerate(grids):
        found.append(PlayedGrid(grid, 0, index, index, tick, bars, grid.written.name))
        tick, bars = found[-1].end_tick, bars + grid.section.bar_count
    return found


def _signs(each: PlayedGrid) -> GridSigns:
    grid = each.grid.written
    passes = tuple(number + 1 for number in sorted(grid.repetitions))
    return GridSigns(
        grid.name, each.first_bar, each.last_bar, each.grid.section.times, passes, has_endings=bool(grid.endings)
    )


def _line_at(cell: WrittenCell, once: Sequence[PlayedGrid]) -> LineAt:
    """The line that wrote a cell."""
    number = next(each.entry for each in reversed(once) if each.start_tick <= cell.place.straight)
    path = cell.origin.path
    return LineAt(number, cell.piece, _limb_of(path), _cycle_of(path))


def _limb_of(path: KeyPath) -> Limb:
    return next((LIMB_TABLES[key] for key in path if isinstance(key, str) and key in LIMB_TABLES), Limb.UNKNOWN)


def _cycle_of(path: KeyPath) -> int | None:
    """The number of the cycle that a line stands in; 0 where it is the only one."""
    if "cycle" not in path:
        return None
    after = path[path.index("cycle") + 1]
    return after if isinstance(after, int) else 0
