"""What stands between two bar lines of a tab, where that is no bar: a beat, or a bar with a dash for its line."""

from collections.abc import Sequence
from dataclasses import replace

from station.music.formats.ascii_tab.tab_letters import RESTS
from station.music.formats.ascii_tab.tab_lines import TabBar
from station.music.formats.ascii_tab.tab_text import TabRow, TabSystem

_CELLS_OF_A_BEAT = frozenset({3, 4, 6})
"""Sixteenths, triplets and sextuplets; whole bars have eight cells or more (usual in tabs, our choice)."""
_BARS_AND_ONE = frozenset({17, 33})
"""Cells of a bar of sixteenths or thirty-seconds with a dash before the first or behind the last, as some type it."""
_ONE_BEFORE_BARS = _BARS_AND_ONE | {9, 13, 25, 49}
"""Cells of bars of eighths and triplets too: music of nine or thirteen cells strikes something at the first."""
_USUAL_BEATS = 4


def in_whole_bars(system: TabSystem, stated: tuple[int, int] | None) -> tuple[TabSystem, tuple[str, ...]]:
    """The system with whole bars between its bar lines, and what was done to it, in words.

    Groups of 3, 4 or 6 cells are beats, unless the line of counting has two numbers within one: `stated` or usual are
    so many of them a bar.
    """
    if (beats := _beats_a_bar(system, stated)) > 1:
        said = f"line {system.rows[0].line}: what its bar lines part is read as beats, {beats} a bar"
        return replace(system, rows=[_joined(row, beats) for row in system.rows]), (said,)
    return replace(system, rows=_trimmed(system.rows)), ()


def _beats_a_bar(system: TabSystem, stated: tuple[int, int] | None) -> int:
    """How many of the system's groups make a bar; 1 where they are bars."""
    lengths = {len(bar.cells) for row in system.rows for bar in row.bars}
    count = max(len(row.bars) for row in system.rows)
    beats = stated[0] if stated else _USUAL_BEATS
    is_short = bool(lengths) and lengths <= _CELLS_OF_A_BEAT and not (stated and stated[1] != 4)
    return beats if is_short and count % beats == 0 and not _counts_within(system.count, max(lengths)) else 1


def _counts_within(count: str, cells: int) -> bool:
    """Whether a line of counting reaches 2 before so many cells are over."""
    one, two = count.find("1"), count.find("2")
    return 0 <= one < two < one + cells


def _joined(row: TabRow, beats: int) -> TabRow:
    return replace(row, bars=tuple(_one(row.bars[i : i + beats]) for i in range(0, len(row.bars), beats)))


def _one(beats: Sequence[TabBar]) -> TabBar:
    columns = tuple(column for beat in beats for column in beat.columns)
    return TabBar("".join(beat.cells for beat in beats), columns, beats[0].opens, beats[-1].closes)


def _trimmed(rows: list[TabRow]) -> list[TabRow]:
    """Without the dash that stands for the bar line in every bar of every line, before or behind it."""
    bars = [bar for row in rows for bar in row.bars]
    lengths = {len(bar.cells) for bar in bars}
    if bars and lengths <= _ONE_BEFORE_BARS and all(bar.cells[0] in RESTS for bar in bars):
        return [replace(row, bars=tuple(bar.part(1) for bar in row.bars)) for row in rows]
    if bars and lengths <= _BARS_AND_ONE and all(bar.cells[-1] in RESTS for bar in bars):
        return [replace(row, bars=tuple(bar.part(0, -1) for bar in row.bars)) for row in rows]
    return rows
