"""Strokes of a score set into the grid: the way back from `grid` and `cell_strokes`.

For each bar a *skeleton* is chosen, a bar of rests such as `----(---)--------`, the simplest one on whose cells all
strokes of the bar fall. The skeleton is read by the reader itself, so whatever is written here is read back alike,
swing included; then the letters are put in their places. All lines of a bar share one skeleton where one fits all.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from station.core.errors import BadInput
from station.drills.grid.grid import Bar, GridFrame, parse_line
from station.drills.grid.tab_symbols import CHOKE, HOLD
from station.music.swing import Swing
from station.music.tempo import MeterChange

PLAIN_CELLS = (1, 2, 3, 4, 6, 8)
"""Cells a beat of the meter, in the order in which they are tried."""
_PLAIN_BESIDE_TUPLETS = (1, 2, 4, 8, 16)
TUPLET_CELLS = (3, 6, 5, 7, 2, 4, 9, 10, 12, 8, 14, 11, 13, *range(15, 25), 28, 30, 32, 35, 40, 42, 48, 56, 60, 64)
"""Cells in `(…)`, in the order in which they are tried. The reader takes any number to 64; of the finer ones those are
left out that nobody counts, for they would hold strokes that were meant elsewhere (our choice)."""
_RARE_CELLS = (12, 16, 5, 7, 10, 24, 32)
MOST_SHARED_CELLS = 12
"""Beyond so many cells a beat each line is cut for itself: finer bars are hard to read. Our choice."""
_KEPT = 4096
"""Skeletons whose cells are known: all that common music has, and a few megabytes of what no music has."""
REST = "-"
REPEAT = "%"


@dataclass(frozen=True, slots=True)
class GridMark:
    """A letter to be set at tick `at` of its bar (as played, swing and all).

    `second` is where a diddle's other stroke falls; `until` where a buzz ends or a cymbal is grabbed, in ticks from the
    same bar's start, perhaps in a later bar.
    """

    letter: str
    at: int
    second: int | None = None
    until: int | None = None
    holds: bool = False


@dataclass(frozen=True, slots=True)
class GridSetting:
    """How bars are cut in a section."""

    frame: GridFrame
    swing: Swing


@dataclass(slots=True)
class LineText:
    """The bars of one line as they are being written."""

    name: str
    marks: dict[int, list[GridMark]]  # by bar
    bars: list[str]


def write_lines(lines: list[LineText], bar_count: int, setting: GridSetting, first_bar: int = 0) -> None:
    """Fill `bars` of every line; `line_layout` sets the blanks. `first_bar` of the music is the lines' first.

    Raises `BadInput` where a bar's strokes lie on no cell of any skeleton.
    """
    lasting = [[(bar, m) for bar, marks in line.marks.items() for m in marks if m.until is not None] for line in lines]
    for bar in range(bar_count):
        needed = [_needs(line, rings, bar, setting) for line, rings in zip(lines, lasting, strict=True)]
        common = _skeleton([mark for marks in needed for mark in marks], setting, MOST_SHARED_CELLS)
        for line, marks in zip(lines, needed, strict=True):
            skeleton = common or _skeleton(marks, setting, max(TUPLET_CELLS))
            if not skeleton:
                place = f"bar {first_bar + bar + 1}"
                raise BadInput(line.name, place, "strokes lie between the cells that the grid can write")
            line.bars.append(_filled(skeleton, marks, setting))


def with_repeats(bars: Sequence[str], new_bar: Sequence[bool]) -> str:
    """The bars between bar lines; one that is not new is written as a repeat of the one before it."""
    cells = [bar if new else REPEAT for bar, new in zip(bars, new_bar, strict=True)]
    return "| " + " | ".join(cells) + " |"


_Point = tuple[int, int | None]
"""A tick of the bar at which a cell must start, and the tick that must be that cell's middle (None: any)."""

# --- marks ------------------------------------------------------------------------------------------------------------


def _needs(line: LineText, lasting: Iterable[tuple[int, GridMark]], bar: int, setting: GridSetting) -> list[GridMark]:
    """The marks of this bar, with buzz rolls that come from earlier bars and chokes that fall into it.

    `lasting` are the marks of the line that end later than they begin, each with its bar.
    """
    length = setting.frame.meter.bar_ticks
    found = list(line.marks.get(bar, []))
    for other, mark in lasting:
        end = (mark.until or 0) - (bar - other) * length
        if mark.holds and other < bar and end > 0:
            found.append(GridMark(HOLD, 0, until=end, holds=True))
        if not mark.holds and 0 <= end < length:
            found.append(GridMark(CHOKE, end))
    return found


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
    for cell in _cells(skeleton, setting.frame).cells:
        ticks = (cell.tick, cell.tick + cell.length_ticks // 2, cell.tick + cell.length_ticks)
        at, middle, end = (setting.swing.swung(t, meter) if cell.swings else t for t in ticks)
        slots.append(_Slot(at, middle, end, cell.char))
    return tuple(slots)


@lru_cache(maxsize=_KEPT)
def _cells(skeleton: str, frame: GridFrame) -> Bar:
    faults: list[str] = []
    (bar,) = parse_line(skeleton, [frame], lambda _, text: faults.append(text))
    return bar


def _points(marks: Iterable[GridMark], bar_ticks: int) -> list[_Point]:
    """What a skeleton must have to hold these marks."""
    ends = [m.until for m in marks if m.holds and m.until is not None and m.until < bar_ticks]
    return [*((m.at, m.second) for m in marks), *((end, None) for end in ends)]


def _holds_all(skeleton: str, points: Iterable[_Point], setting: GridSetting) -> bool:
    """Whether the skeleton has the cell that each point asks for."""
    middles = _middles(skeleton, setting)
    return all(at in middles and second in (None, middles[at]) for at, second in points)


@lru_cache(maxsize=_KEPT)
def _middles(skeleton: str, setting: GridSetting) -> Mapping[int, int]:
    """The middle of each cell by its start."""
    return {slot.at: slot.middle for slot in _slots(skeleton, setting)}


def _filled(skeleton: str, marks: Sequence[GridMark], setting: GridSetting) -> str:
    out = list(skeleton)
    slots = _slots(skeleton, setting)
    for mark in marks:
        for slot in slots:
            if slot.at == mark.at:
                out[slot.char] = mark.letter
            elif mark.holds and mark.at < slot.at < (mark.until or 0):
                out[slot.char] = HOLD
    return "".join(out)


# --- skeletons --------------------------------------------------------------------------------------------------------


def _skeleton(marks: Sequence[GridMark], setting: GridSetting, most: int) -> str | None:
    """The simplest skeleton whose cells, at most `most` a beat, hold all marks of a bar."""
    points = _points(marks, setting.frame.meter.bar_ticks)
    candidates = (
        *(_plain(setting.frame, cells) for cells in PLAIN_CELLS),
        _with_tuplets(points, setting, most),
        *(_plain(setting.frame, cells) for cells in _RARE_CELLS if cells <= most),
    )
    return next((s for s in candidates if s and _holds_all(s, points, setting)), None)


def _plain(frame: GridFrame, cells: int) -> str | None:
    """A bar of `cells` equal cells a beat of the meter; None where they do not divide it."""
    return None if frame.meter.beat_ticks % cells else REST * (frame.meter.beats * cells)


def _with_tuplets(points: Sequence[_Point], setting: GridSetting, most: int) -> str | None:
    """Plain cells with `(…)` in those beats that they do not suit; as few of these as can be."""
    frame = setting.frame
    if sum(length for _, length in frame.spans) != frame.meter.bar_ticks:
        return None
    options = [_tupled(points, setting, cells, most) for cells in _PLAIN_BESIDE_TUPLETS]
    found = [s for s in options if s]
    return min(found, key=lambda s: s.count("(")) if found else None


def _tupled(points: Sequence[_Point], setting: GridSetting, cells: int, most: int) -> str | None:
    """A bar of `cells` plain cells a beat of the meter, and tuplets where these do not fit; None if neither does."""
    frame = setting.frame
    plain = _plain(frame, cells)
    cell_ticks = frame.meter.beat_ticks // cells
    spans = frame.spans
    if plain is None or any(length % cell_ticks for _, length in spans):
        return None
    words: list[str] = []
    for i, (start, length) in enumerate(spans):
        here = [p for p in points if start <= p[0] < start + length]
        word = REST * (length // cell_ticks)
        if not _holds_all(plain, here, setting):
            rests = [f"({REST})"] * len(spans)
            tuplets = (f"({REST * n})" for n in TUPLET_CELLS if n <= most)
            alone = (t for t in tuplets if _holds_all("".join([*rests[:i], t, *rests[i + 1 :]]), here, setting))
            word = next(alone, "")
        if not word:
            return None
        words.append(word)
    return "".join(words)


def frame_of(meter: MeterChange, beat_ticks: int) -> GridFrame:
    """The frame of a bar of `meter`, its tick left out."""
    return GridFrame(replace(meter, tick=0), beat_ticks)
