"""Skeletons: bars of rests such as `----(---)--------`, the letters that are put on their cells, and whether they fit.

A skeleton is read by the grid's own reader, so whatever is written here is read back alike, swing included. Ticks count
from the bar's start, as played.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from station.drills.grid.grid import GridFrame, bar_of
from station.drills.grid.tab_symbols import HOLD
from station.music.swing import Swing

PLAIN_CELLS = (1, 2, 3, 4, 6, 8)
"""Cells a beat of the meter, in the order in which they are tried."""
TUPLET_CELLS = (3, 6, 5, 7, 2, 4, 9, 10, 12, 8, 14, 11, 13, *range(15, 25), 28, 30, 32, 35, 40, 42, 48, 56, 60, 64)
"""Cells in `(…)`, in the order in which they are tried. The reader takes any number to 64; of the finer ones those are
left out that nobody counts, for they would hold strokes that were meant elsewhere (our choice)."""
_KEPT = 4096
"""Skeletons whose cells are known: all that common music has, and a few megabytes of what no music has."""
REST = "-"


@dataclass(frozen=True, slots=True)
class GridMark:
    """A letter to be set at tick `at` of its bar (as played, swing and all).

    `second` is where a diddle's other stroke falls; `until` where a buzz ends or a cymbal is grabbed, in ticks from the
    same bar's start, perhaps in a later bar; `late_ms` is the stroke's own timing.
    """

    letter: str
    at: int
    second: int | None = None
    until: int | None = None
    holds: bool = False
    late_ms: float = 0.0


@dataclass(frozen=True, slots=True)
class GridSetting:
    """How bars are cut in a section."""

    frame: GridFrame
    swing: Swing


Point = tuple[int, int | None]
"""A tick of the bar at which a cell must start, and the tick that must be that cell's middle (None: any)."""


@dataclass(frozen=True, slots=True)
class _Slot:
    """A cell as played: its start, its middle, its end, and where its character stands in the skeleton."""

    at: int
    middle: int
    end: int
    char: int


@lru_cache(maxsize=_KEPT)
def _slots(skeleton: str, setting: GridSetting) -> tuple[_Slot, ...]:
    meter = setting.frame.meter
    slots: list[_Slot] = []
    for cell in bar_of(skeleton, setting.frame).cells:
        ticks = (cell.tick, cell.tick + cell.length_ticks // 2, cell.tick + cell.length_ticks)
        at, middle, end = (setting.swing.swung(t, meter) if cell.swings else t for t in ticks)
        slots.append(_Slot(at, middle, end, cell.char))
    return tuple(slots)


def points_of(marks: Iterable[GridMark], bar_ticks: int) -> list[Point]:
    """What a skeleton must have to hold these marks."""
    ends = [m.until for m in marks if m.holds and m.until is not None and m.until < bar_ticks]
    return [*((m.at, m.second) for m in marks), *((end, None) for end in ends)]


def holds_all(skeleton: str, points: Iterable[Point], setting: GridSetting) -> bool:
    """Whether the skeleton has the cell that each point asks for."""
    middles = _middles(skeleton, setting)
    return all(at in middles and second in (None, middles[at]) for at, second in points)


@lru_cache(maxsize=_KEPT)
def _middles(skeleton: str, setting: GridSetting) -> Mapping[int, int]:
    """The middle of each cell by its start."""
    return {slot.at: slot.middle for slot in _slots(skeleton, setting)}


def filled(skeleton: str, marks: Sequence[GridMark], setting: GridSetting) -> str:
    """The skeleton with the letters of `marks`, which it holds, and the holds of buzz rolls."""
    out = list(skeleton)
    slots = _slots(skeleton, setting)
    for mark in marks:
        for slot in slots:
            if slot.at == mark.at:
                out[slot.char] = mark.letter
            elif mark.holds and mark.at < slot.at < (mark.until or 0):
                out[slot.char] = HOLD
    return "".join(out)


def plain_bar(frame: GridFrame, cells: int) -> str | None:
    """A bar of `cells` equal cells a beat of the meter; None where they do not divide it."""
    return None if frame.meter.beat_ticks % cells else REST * (frame.meter.beats * cells)
