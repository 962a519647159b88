"""The grid: one line of characters a piece, one character a cell of equal length, `|` between bars.

* The cells of a bar share it equally: in 4/4, 8 characters are eighths, 12 are triplets, 16 are sixteenths. The number
  must be a whole multiple of the meter's beats, or divide them (1, 2 or 4 in 4/4), so that a lost character shows.
* Blanks are for the eye and mean nothing.
* `(…)` fills exactly one beat, however many characters it holds: `x-x- (xxx) x-x- x-x-`. It starts on a beat, and is
  never swung.
* `%` repeats the bar before it, `%3` three times more. A `|` at either end is welcome and means nothing.

Ticks count from the start of the bar, straight (no swing yet).
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from station.core.units import PPQ
from station.music.tempo import MeterChange

Report = Callable[[int, str], None]
"""Takes the index of a character in the line and what is wrong there."""

_REPEAT = re.compile(r"%(\d*)$")
_USUAL = (1, 2, 3, 4, 6, 8)
"""Cells a beat that a message proposes."""
MAX_REPEATS = 200
"""Our choice: a longer repetition is a slip of the finger."""


@dataclass(frozen=True, slots=True)
class Cell:
    """One character of a bar; `swings` where a swing moves it, `char` its index in the line's text."""

    tick: int
    length_ticks: int
    letter: str
    char: int
    swings: bool


@dataclass(frozen=True, slots=True)
class Bar:
    """The cells of one bar in order; none where the bar was at fault (`sound` False)."""

    cells: tuple[Cell, ...]
    sound: bool = True


@dataclass(frozen=True, slots=True)
class GridFrame:
    """What the cells of a bar divide: its meter, and the beat that `(…)` fills."""

    meter: MeterChange
    beat_ticks: int


@dataclass(slots=True)
class _Group:
    """Characters between two parentheses (`beat`), or outside any."""

    chars: list[tuple[int, str]]
    beat: bool
    start: int


class _BadBarError(Exception):
    def __init__(self, char: int, text: str) -> None:
        self.char, self.text = char, text


def parse_line(text: str, frame: GridFrame, report: Report) -> list[Bar]:
    """The bars of one line of the grid; faults go to `report`, and a faulty bar keeps its place as an empty one."""
    bars: list[Bar] = []
    for start, end in _bar_spans(text):
        word = text[start:end].strip()
        repeat = _REPEAT.match(word)
        if repeat:
            bars += _repeated(bars, repeat.group(1), _first(text, start), report)
            continue
        try:
            bars.append(_parse_bar(text, start, end, frame))
        except _BadBarError as fault:
            report(fault.char, fault.text)
            bars.append(Bar((), sound=False))
    return bars


def _bar_spans(text: str) -> list[tuple[int, int]]:
    """Start and end of each bar's characters; a bar line at either end of a row of text is only decoration."""
    edges = [-1, *(i for i, c in enumerate(text) if c == "|"), len(text)]
    spans = [(a + 1, b) for a, b in pairwise(edges)]
    spans = [s for s in spans if text[slice(*s)].strip() or "\n" not in text[slice(*s)]]  # | at both ends of a row
    if len(spans) > 1 and not text[slice(*spans[0])].strip():
        spans = spans[1:]
    if len(spans) > 1 and not text[slice(*spans[-1])].strip():
        spans = spans[:-1]
    return spans


def _first(text: str, start: int) -> int:
    """Index of the first character from `start` that is not blank, or `start`."""
    return next((i for i in range(start, len(text)) if not text[i].isspace()), start)


def _repeated(bars: list[Bar], count: str, char: int, report: Report) -> list[Bar]:
    times = min(int(count[:9] or 1), MAX_REPEATS + 1)
    if not bars:
        report(char, "% repeats the bar before it, and there is none; expected a written bar")
        return [Bar((), sound=False)]
    if not 1 <= times <= MAX_REPEATS:
        report(char, f"%{count}: a bar is repeated 1 to {MAX_REPEATS} times")
        return [Bar((), sound=False)]
    return [bars[-1]] * times


def _parse_bar(text: str, start: int, end: int, frame: GridFrame) -> Bar:
    groups = _groups(text, start, end)
    if not groups:
        raise _BadBarError(min(start, max(len(text) - 1, 0)), "an empty bar; a bar's rest is written -")
    plain_ticks = _plain_cell_ticks(text, start, groups, frame)
    cells: list[Cell] = []
    tick = 0
    for group in groups:
        length = _beat_cell_ticks(group, tick, frame.beat_ticks) if group.beat else plain_ticks
        swings = not group.beat and _is_binary(length)
        for char, letter in group.chars:
            cells.append(Cell(tick, length, letter, char, swings))
            tick += length
    return Bar(tuple(cells))


def _groups(text: str, start: int, end: int) -> list[_Group]:
    """The characters of a bar, cut at the parentheses."""
    groups: list[_Group] = []
    inside = False
    for i in range(start, end):
        char = text[i]
        if char.isspace():
            continue
        if char in "()":
            if (char == "(") == inside:
                raise _BadBarError(i, f"{char!r} without its partner in this bar")
            inside = char == "("
            if inside:
                groups.append(_Group([], True, i))
            elif not groups[-1].chars:
                raise _BadBarError(i, "nothing between the parentheses; a beat's rest is (-)")
            continue
        if not groups or groups[-1].beat != inside:
            groups.append(_Group([], inside, i))
        groups[-1].chars.append((i, char))
    if inside:
        raise _BadBarError(groups[-1].start, "'(' without its partner in this bar")
    return groups


def _plain_cell_ticks(text: str, start: int, groups: list[_Group], frame: GridFrame) -> int:
    """Length of the cells outside parentheses; 0 if there are none and none are missing."""
    beats = [g for g in groups if g.beat]
    count = sum(len(g.chars) for g in groups if not g.beat)
    unit = frame.meter.beat_ticks
    free = frame.meter.bar_ticks - len(beats) * frame.beat_ticks
    name = f"{frame.meter.beats}/{frame.meter.unit}"
    if free < 0:
        most = frame.meter.bar_ticks // frame.beat_ticks
        raise _BadBarError(beats[most].start, f"a {name} bar holds {most} (…) of one beat each; this is one too many")
    if not count and not free:
        return 0
    if not count or not free or free % unit:
        left = free / unit
        raise _BadBarError(
            groups[0].start, f"{count} cells for the {left:g} beats of 1/{frame.meter.unit} that (…) leave of {name}"
        )
    if not _fits(count, free // unit, whole_bar=not beats) or free % count:
        place = _odd_one_out(text, groups) if not beats else groups[0].chars[0][0]
        beside = " beside (…)" if beats else ""
        what = f"{count} cells{beside} do not fill a {name} bar"
        raise _BadBarError(place, f"{what}; expected {_expected(free // unit, not beats)}")
    return free // count


def _fits(count: int, beats: int, whole_bar: bool) -> bool:
    return count % beats == 0 or (whole_bar and beats % count == 0)


def _expected(beats: int, whole_bar: bool) -> str:
    fewer = [n for n in range(1, beats) if beats % n == 0] if whole_bar else []
    counts = [str(n) for n in [*fewer, *(beats * k for k in _USUAL)]]
    return ", ".join(counts[:-1]) + " or " + counts[-1]


def _odd_one_out(text: str, groups: list[_Group]) -> int:
    """Where the blank-separated group stands that is not as long as the most common one; else the bar's start."""
    chars = groups[0].chars
    words: list[list[int]] = [[]]
    for (i, _), (after, _) in zip(chars, [*chars[1:], (len(text), "")], strict=True):
        words[-1].append(i)
        if after - i > 1:
            words.append([])
    words = [w for w in words if w]
    lengths = [len(w) for w in words]
    usual = max(lengths, key=lambda n: (lengths.count(n), n))
    return next((w[0] for w in words if len(w) != usual), chars[0][0])


def _beat_cell_ticks(group: _Group, tick: int, beat_ticks: int) -> int:
    if tick % beat_ticks:
        raise _BadBarError(group.start, "(…) fills one beat and must start on a beat")
    if beat_ticks % len(group.chars):
        raise _BadBarError(group.start, f"a beat cannot be cut exactly into {len(group.chars)} cells")
    return beat_ticks // len(group.chars)


def _is_binary(length_ticks: int) -> bool:
    """Whether a whole note is a power of two of such cells: only those swing."""
    cells, rest = divmod(4 * PPQ, length_ticks)
    return not rest and cells & (cells - 1) == 0
