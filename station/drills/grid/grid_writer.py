"""Strokes of a score set into the grid: the way back from `grid` and `cell_strokes`.

For each bar a *skeleton* is chosen, a bar of rests such as `----(---)--------`, the simplest one on whose cells all
strokes of the bar fall; then the letters are put in their places (`skeletons`). All lines of a bar share one skeleton
where one fits all.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from station.core.errors import BadInput
from station.drills.grid.grid import GridFrame
from station.drills.grid.skeletons import (
    PLAIN_CELLS,
    REST,
    TUPLET_CELLS,
    GridMark,
    GridSetting,
    Point,
    filled,
    holds_all,
    plain_bar,
    points_of,
)
from station.drills.grid.tab_symbols import CHOKE, HOLD
from station.music.tempo import MeterChange

_PLAIN_BESIDE_TUPLETS = (1, 2, 4, 8, 16)
_RARE_CELLS = (12, 16, 5, 7, 10, 24, 32)
MOST_SHARED_CELLS = 12
"""Beyond so many cells a beat each line is cut for itself: finer bars are hard to read. Our choice."""
REPEAT = "%"


@dataclass(slots=True)
class LineText:
    """The bars of one line as they are being written."""

    name: str
    marks: dict[int, list[GridMark]]  # by bar
    bars: list[str]

    @property
    def late_ms(self) -> list[float]:
        """The timing of all its strokes, none where all of them are on their cells."""
        late = [mark.late_ms for bar in sorted(self.marks) for mark in sorted(self.marks[bar], key=lambda m: m.at)]
        return late if any(late) else []


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
            line.bars.append(filled(skeleton, marks, setting))


def with_repeats(bars: Sequence[str], new_bar: Sequence[bool]) -> str:
    """The bars between bar lines; one that is not new is written as a repeat of the one before it."""
    cells = [bar if new else REPEAT for bar, new in zip(bars, new_bar, strict=True)]
    return "| " + " | ".join(cells) + " |"


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


# --- skeletons --------------------------------------------------------------------------------------------------------


def _skeleton(marks: Sequence[GridMark], setting: GridSetting, most: int) -> str | None:
    """The simplest skeleton whose cells, at most `most` a beat, hold all marks of a bar."""
    points = points_of(marks, setting.frame.meter.bar_ticks)
    candidates = (
        *(plain_bar(setting.frame, cells) for cells in PLAIN_CELLS),
        _with_tuplets(points, setting, most),
        *(plain_bar(setting.frame, cells) for cells in _RARE_CELLS if cells <= most),
    )
    return next((s for s in candidates if s and holds_all(s, points, setting)), None)


def _with_tuplets(points: Sequence[Point], setting: GridSetting, most: int) -> str | None:
    """Plain cells with `(…)` in those beats that they do not suit; as few of these as can be."""
    frame = setting.frame
    if sum(length for _, length in frame.spans) != frame.meter.bar_ticks:
        return None
    options = [_tupled(points, setting, cells, most) for cells in _PLAIN_BESIDE_TUPLETS]
    found = [s for s in options if s]
    return min(found, key=lambda s: s.count("(")) if found else None


def _tupled(points: Sequence[Point], setting: GridSetting, cells: int, most: int) -> str | None:
    """A bar of `cells` plain cells a beat of the meter, and tuplets where these do not fit; None if neither does."""
    frame = setting.frame
    plain = plain_bar(frame, cells)
    cell_ticks = frame.meter.beat_ticks // cells
    spans = frame.spans
    if plain is None or any(length % cell_ticks for _, length in spans):
        return None
    words: list[str] = []
    for i, (start, length) in enumerate(spans):
        here = [p for p in points if start <= p[0] < start + length]
        word = REST * (length // cell_ticks)
        if not holds_all(plain, here, setting):
            rests = [f"({REST})"] * len(spans)
            tuplets = (f"({REST * n})" for n in TUPLET_CELLS if n <= most)
            alone = (t for t in tuplets if holds_all("".join([*rests[:i], t, *rests[i + 1 :]]), here, setting))
            word = next(alone, "")
        if not word:
            return None
        words.append(word)
    return "".join(words)


def frame_of(meter: MeterChange, beat_ticks: int) -> GridFrame:
    """The frame of a bar of `meter`, its tick left out."""
    return GridFrame(replace(meter, tick=0), beat_ticks)
