"""How the lines of a grid stand on the page: bars and beats under each other, and the count above them.

Nothing of what the lines play is changed: blanks mean nothing to the grid, and a row ends and begins with `|`. The
cells are those that the grid's own reader finds, so that the layout knows no second way to read a line.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from station.drills.grid.grid import Cell, GridFrame, bar_of
from station.music.tempo import MeterChange

_REPEAT = re.compile(r"%(\d*)")
_EIGHTH = 8
_KEPT = 4096
"""Bars that are kept as they were laid out: those of a long lesson, which is laid out anew after each edit."""
_COUNTS = {1: "", 2: "&", 3: "ta", 4: "e&a", 6: "ta&ta", 8: "·e·&·a·"}
"""How drummers count the cells after the number of their beat; others are dots."""


@dataclass(frozen=True, slots=True)
class Meters:
    """The meters of a grid's bars, taken in turn, and the beat that `(…)` fills."""

    in_turn: tuple[MeterChange, ...]
    beat_ticks: int

    def frame(self, bar: int) -> GridFrame:
        """What the cells of `bar`, from 0, divide."""
        return GridFrame(self.in_turn[bar % len(self.in_turn)], self.beat_ticks)

    def after(self, bars: int) -> "Meters":
        """The meters from the bar after so many on."""
        turn = bars % len(self.in_turn)
        return Meters(self.in_turn[turn:] + self.in_turn[:turn], self.beat_ticks)


@dataclass(frozen=True, slots=True)
class _Part:
    """What stands between two bar lines, blanks left out: one bar, or a repeat sign for bars `first` to `end - 1`."""

    text: str
    first: int
    end: int

    @property
    def is_written(self) -> bool:
        return not self.text.startswith("%")


def laid_out(lines: Sequence[str], meters: Meters) -> tuple[list[str], str]:
    """The lines with bar under bar and beat under beat, and the count of the finest; empty where there is none.

    Each line is of one row and without fault; they may differ in cells and in number of bars.
    """
    parts = [_parts(line) for line in lines]
    edges = sorted({edge for line in parts for part in line for edge in (part.first, part.end)})
    column_at = {edge: i for i, edge in enumerate(edges)}
    here: list[list[_Part]] = [[] for _ in edges[1:]]
    for part in (part for line in parts for part in line):
        for i in range(column_at[part.first], column_at[part.end]):
            here[i].append(part)
    columns = [_column(each, *span, meters) for each, span in zip(here, pairwise(edges), strict=True)]
    rows = [
        f"| {' | '.join(_cell(p, columns[column_at[p.first] : column_at[p.end]]) for p in line)} |" for line in parts
    ]
    count = "  " + "   ".join(column.count.ljust(column.width) for column in columns)
    return rows, count.rstrip()


def bar_count(line: str) -> int:
    """How many bars a line of one row has, those that it repeats too."""
    return _parts(line)[-1].end


def _parts(line: str) -> list[_Part]:
    texts = ["".join(text.split()) for text in line.split("|")]
    parts: list[_Part] = []
    for i, text in enumerate(texts):
        if not text and i in (0, len(texts) - 1):
            continue
        first = parts[-1].end if parts else 0
        repeat = _REPEAT.fullmatch(text)
        parts.append(_Part(text, first, first + (int(repeat.group(1) or 1) if repeat else 1)))
    return parts


# --- a column: the bars between two edges -----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Column:
    """Bars `first` to `end - 1` of all lines: how wide each beat is, or the whole of it, and the count above it."""

    first: int
    end: int
    starts: tuple[int, ...]
    widths: tuple[int, ...]
    frame: GridFrame
    width: int
    count: str

    def bar(self, text: str) -> str:
        """A written bar, each beat at its place."""
        words = _words(text, self.frame, self.starts)
        return " ".join(word.ljust(width) for word, width in zip(words, self.widths, strict=True)).ljust(self.width)


def _column(here: Sequence[_Part], first: int, end: int, meters: Meters) -> _Column:
    written = [part.text for part in here if part.is_written]
    frame = meters.frame(first)
    signs = max((len(p.text) for p in here if (p.first, p.end) == (first, end) and not p.is_written), default=1)
    if not written:
        return _Column(first, end, (), (), frame, signs, "")
    starts = _beat_starts(frame.meter, min(_shortest(text, frame) for text in written))
    words = [_words(text, frame, starts) for text in written]
    width_of = {start: max(map(len, slot)) for start, *slot in zip(starts, *words, strict=True)}
    starts = tuple(start for start in starts if width_of[start])
    widths = tuple(width_of[start] for start in starts)
    column = _Column(first, end, starts, widths, frame, max(signs, sum(widths) + len(widths) - 1), "")
    finest = column.bar(max(written, key=lambda text: len(_cells(text, frame))))
    return _Column(first, end, starts, widths, frame, len(finest), counted(finest, frame))


def _cell(part: _Part, covered: Sequence[_Column]) -> str:
    """A part of a line, as wide as the columns that it covers."""
    if part.is_written:
        return covered[0].bar(part.text)
    return part.text.ljust(sum(column.width for column in covered) + 3 * (len(covered) - 1))


# --- a bar ------------------------------------------------------------------------------------------------------------


def _cells(text: str, frame: GridFrame) -> tuple[Cell, ...]:
    return bar_of(text, frame).cells


def _shortest(text: str, frame: GridFrame) -> int:
    return min(cell.length_ticks for cell in _cells(text, frame))


def _beat_starts(meter: MeterChange, shortest_ticks: int) -> tuple[int, ...]:
    """Where a blank stands before a bar's beat: at each beat, in meters of eighths and shorter at the groups.

    A 7/8 or 5/8 whose groups nobody has said is one word as long as its cells are the meter's own.
    """
    beats = meter.group_starts if meter.unit >= _EIGHTH else range(meter.beats)
    is_unsaid = meter.unit >= _EIGHTH and len(beats) == meter.beats
    is_one_word = is_unsaid and shortest_ticks >= meter.beat_ticks
    return (0,) if is_one_word else tuple(beat * meter.beat_ticks for beat in beats)


@lru_cache(maxsize=_KEPT)
def _words(text: str, frame: GridFrame, starts: tuple[int, ...]) -> tuple[str, ...]:
    """The bar cut where its beats start; the word of a beat on which no cell starts is empty."""
    slot_of = {tick: slot for slot, tick in enumerate(starts)}
    words = [""] * len(starts)
    slot, after = 0, 0
    for cell in _cells(text, frame):
        before = text[after : cell.char]
        words[slot] += ")" if before.startswith(")") else ""
        slot = slot_of.get(cell.tick, slot)
        opens = before.endswith("(")
        apart = words[slot] and (opens or before.startswith(")"))
        words[slot] += f"{' ' if apart else ''}{'(' if opens else ''}{cell.letter}"
        after = cell.char + 1
    words[slot] += text[after:]
    return tuple(words)


@lru_cache(maxsize=_KEPT)
def counted(text: str, frame: GridFrame) -> str:
    """How a drummer counts the cells of this bar, above them: `1e&a 2e&a …`; blank where no count is usual."""
    unit = frame.meter.beat_ticks
    out = [" "] * len(text)
    for beat, name in enumerate(_numbers(frame.meter)):
        inside = [c for c in _cells(text, frame) if beat * unit <= c.tick < (beat + 1) * unit]
        if not inside or inside[0].tick != beat * unit:
            continue
        fill = inside[-1].tick + inside[-1].length_ticks == (beat + 1) * unit
        syllables = _COUNTS.get(len(inside), "·" * (len(inside) - 1)) if fill else ""
        for cell, letter in zip(inside, name + syllables, strict=False):
            out[cell.char] = letter
    return "".join(out).rstrip()


def _numbers(meter: MeterChange) -> list[str]:
    """The digit of each beat of the bar; in written groups of eighths and shorter it begins again at 1."""
    groups = meter.groups if meter.unit >= _EIGHTH and meter.groups else (meter.beats,)
    return [str((beat + 1) % 10) for group in groups for beat in range(group)]
