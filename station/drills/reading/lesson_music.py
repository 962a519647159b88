"""The music of a lesson's grids: read in the order of the file, and put together as a score in any order.

`lesson_file` plays them as the form says; an editor shows each once, as it is written.
"""

from collections.abc import Sequence

import numpy as np

from station.core.toml.toml_faults import Faults
from station.drills.grid.cell_strokes import Origin, WrittenCell, expand
from station.drills.grid.grid_reader import read_grid
from station.drills.grid.grid_timing import GridTiming
from station.drills.grid.line_group import MAX_CELLS, CellCount
from station.drills.reading.bar_cues import GridShape, read_cues
from station.drills.reading.form import WrittenGrid, home_of, told_at_home, written_grids
from station.drills.reading.played_grids import PlayedGrid, ReadGrid, check_size, meters_of, tempos_of
from station.music.loudness_marks import joined_marks
from station.music.score import Score
from station.music.tempo import TempoMap

MAX_CUES_WRITTEN = 1000
"""Entries of `at` in all grids, those that variations take over too: one for every other bar of the longest lesson (our
choice)."""


def written_of(raw: object, faults: Faults) -> list[WrittenGrid]:
    """The grids as the file has them; raises `Wrong` where there is more to read than anyone practises."""
    if raw == []:
        faults.add(("grid",), "no grid to play; expected a table [grid] with lines in it")
    nothing: list[WrittenGrid] = []
    grids = faults.attempt(lambda value: written_grids(value, faults), raw, nothing)
    if (entries := sum(len(grid.at) for grid in grids if isinstance(grid.at, list))) > MAX_CUES_WRITTEN:
        faults.add(("grid",), f"{entries} entries of at; a lesson has at most {MAX_CUES_WRITTEN}")
        return []
    if (cells := sum(_cell_count(grid.raw) for grid in grids)) > MAX_CELLS:
        faults.add(("grid",), f"{cells} letters; a lesson has at most {MAX_CELLS}")
        return []
    return grids


def _cell_count(raw: object) -> int:
    """The length of all texts in a raw value."""
    if isinstance(raw, str):
        return len(raw)
    parts = raw.values() if isinstance(raw, dict) else raw if isinstance(raw, list) else ()
    return sum(map(_cell_count, parts))


def read_grids(written: Sequence[WrittenGrid], timing: GridTiming, faults: Faults) -> list[ReadGrid]:
    """The grids, each after what was said before it; raises `Wrong` where they are more than anyone practises."""
    grids: list[ReadGrid] = []
    bars = strokes = 0
    cells = CellCount()
    for each in written:
        before = timing if not grids else grids[-1 if each.like is None else each.like].section.timing
        found = Faults()
        section = read_grid(each.raw, each.path, before, found, cells)
        is_sure = section.timing.is_sure and not found
        shape = GridShape(section.meters, section.times, section.timing.beat_ticks, is_sure)
        at_bars = Faults()
        cues = read_cues(each.at, shape, at_bars)
        found.merge(at_bars, *each.path)
        faults.noted += told_at_home(found, each, written, faults)
        grids.append(ReadGrid(each, section, cues))
        bars, strokes = bars + section.bar_count * section.times, strokes + sum(map(len, section.parts))
        check_size(bars, strokes, each)
    return grids


def note_silence(grids: Sequence[ReadGrid], faults: Faults) -> None:
    """Note that a lesson has nothing to play, where nothing else may be the cause."""
    if grids and not any(_asks(grid) for grid in grids) and not faults:
        faults.miss(("grid",), "has nothing to play: every cell is a rest")


def _asks(grid: ReadGrid) -> bool:
    """Whether any stroke of the grid is the player's."""
    return any(not stroke.letter.is_beyond for part in grid.section.parts for stroke in part)


def score_of(
    strokes: tuple[Sequence[WrittenCell], Sequence[WrittenCell]],
    played: Sequence[PlayedGrid],
    written: Sequence[WrittenGrid],
    faults: Faults,
) -> tuple[Score, list[Origin]]:
    """The score of all that is played, and the letter of the file that wrote each of its rows.

    `strokes` are those that are asked, and those beyond the player.
    """
    (rows, origins), (beyond, _) = map(expand, strokes)
    order = np.lexsort((rows["piece"], -rows["lead_ms"], rows["tick"]))
    tempo_map = TempoMap.build(faults.attempt(lambda _: tempos_of(played), None, []), meters_of(played))
    end = played[-1].end_tick if played else tempo_map.bar_start(1)
    by_path = {grid.path: grid for grid in written}
    homes = {
        origin.path: home_of(origin.path, by_path[_grid_path(origin)], written)
        for origin in {(o.path): o for o in origins}.values()
    }
    at_home = [Origin(homes[origin.path], origin.char) for origin in origins]
    loudness = joined_marks((s.start_tick, s.grid.section.loudness) for s in played)
    score = Score.from_array(rows[order], tempo_map, end, loudness=loudness, beyond=beyond)
    return score, [at_home[i] for i in order]


def _grid_path(origin: Origin) -> tuple[str | int, ...]:
    """The path of the grid that a letter stands in: `grid`, and its index where there are several."""
    return origin.path[: 2 if isinstance(origin.path[1], int) else 1]
