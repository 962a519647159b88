"""The grid: one line of characters a piece, one character a cell of equal length, `|` between bars.

* The cells of a bar share it equally: in 4/4, 8 characters are eighths, 12 are triplets, 16 are sixteenths. The number
  must be a whole multiple of the meter's beats, or divide them (1, 2 or 4 in 4/4), so that a lost character shows.
* Blanks are for the eye and mean nothing.
* `(…)` fills exactly one beat, in a meter with groups the group in which it starts, with 1 to 64 characters:
  `x-x- (xxx) x-x- x-x-`. It starts on a beat, or a group, and is never swung.
* `%` repeats the bar before it, `%3` three times more. A `|` at either end is welcome and means nothing.

Ticks count from the start of the bar, straight (no swing yet), and round to the nearest: nine cells do not divide a
quarter note exactly.
"""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, pairwise

from station.core.units import PPQ
from station.music.tempo import MeterChange

Report = Callable[[int, str], None]
"""Takes the index of a character in the line and what is wrong there."""

_REPEAT = re.compile(r"%(\d*)$")
_USUAL = (1, 2, 3, 4, 6, 8)
"""Cells a beat that a message proposes."""
MAX_REPEATS = 200
"""Our choice: a longer repetition is a slip of the finger."""
MAX_CELLS_A_BEAT = 64
"""256th notes in a quarter: more than anybody writes or plays (our choice)."""


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
    """What the cells of a bar divide: its meter, and the beat that `(…)` fills where the meter has no groups."""

    meter: MeterChange
    beat_ticks: int

    @property
    def spans(self) -> tuple[tuple[int, int], ...]:
        """Start and length in ticks of everything that `(…)` can fill, in order: the groups, or the whole beats."""
        unit, groups = self.meter.beat_ticks, self.meter.groups
        if groups:
            starts = accumulate(groups[:-1], initial=0)
            return tuple((start * unit, beats * unit) for start, beats in zip(starts, groups, strict=True))
        beats = self.meter.bar_ticks // self.beat_ticks
        return tuple((i * self.beat_ticks, self.beat_ticks) for i in range(beats))


@dataclass(slots=True)
class _Run:
    """Characters between two parentheses (`is_tuplet`), or outside any."""

    chars: list[tuple[int, str]]
    is_tuplet: bool
    start: int


class _BadBarError(Exception):
    def __init__(self, char: int, text: str) -> None:
        self.char, self.text = char, text


def parse_line(text: str, frames: Sequence[GridFrame], report: Report) -> list[Bar]:
    """The bars of one line of the grid, their `frames` taken in turn.

    Faults go to `report`, and a faulty bar keeps its place as an empty one.
    """
    bars, faults = _line(text, tuple(frames)) if len(text) <= _LONGEST_KEPT else _read(text, frames)
    for char, words in faults:
        report(char, words)
    return list(bars)


_KEPT_LINES, _KEPT_BARS = 64, 4096
"""Lines and bars that are kept as they were read: those of a long lesson, which is read anew after each edit."""
_LONGEST_KEPT = 4000
"""Letters of a line that is kept: all lines that are kept take some 50 MB at most (our choice)."""

_Read = tuple[tuple[Bar, ...], tuple[tuple[int, str], ...]]
"""The bars of a line, and its faults as `Report` takes them."""


@lru_cache(maxsize=_KEPT_LINES)
def _line(text: str, frames: tuple[GridFrame, ...]) -> _Read:
    return _read(text, frames)


def _read(text: str, frames: Sequence[GridFrame]) -> _Read:
    bars: list[Bar] = []
    faults: list[tuple[int, str]] = []
    for word in bar_words(text):
        if word.repeats is not None:
            bars += _repeated(bars, word, frames, lambda char, words: faults.append((char, words)))
            continue
        try:
            bars.append(_bar(text, word.start, word.end, frames[len(bars) % len(frames)]))
        except _BadBarError as fault:
            faults.append((fault.char, fault.text))
            bars.append(Bar((), sound=False))
    return tuple(bars), tuple(faults)


def _bar(text: str, start: int, end: int, frame: GridFrame) -> Bar:
    """The bar that stands there, as it was read before where that was; raises `_BadBarError`."""
    cells = _cells_alone(text[start:end], frame)
    if cells is None:
        return _parse_bar(text, start, end, frame)
    return Bar(tuple(Cell(c.tick, c.length_ticks, c.letter, c.char + start, c.swings) for c in cells))


@lru_cache(maxsize=_KEPT_BARS)
def _cells_alone(word: str, frame: GridFrame) -> tuple[Cell, ...] | None:
    """The cells of a bar, their `char` counted in `word`; None where it is at fault."""
    try:
        return _parse_bar(word, 0, len(word), frame).cells
    except _BadBarError:
        return None


@dataclass(frozen=True, slots=True)
class BarWord:
    """What stands between two bar lines, from `start` to `end` with blanks; its `text` has none and begins at `first`.

    `repeats` is the number of bars that a `%` stands for, None where a bar is written.
    """

    start: int
    end: int
    first: int
    text: str
    repeats: int | None = None

    @property
    def bars(self) -> int:
        """How many bars it is in the line; a `%` that repeats too often is told as a fault, and is one."""
        return self.repeats if self.repeats is not None and 1 <= self.repeats <= MAX_REPEATS else 1


@lru_cache(maxsize=256)
def bar_words(text: str) -> tuple[BarWord, ...]:
    """The bars of a line as they are written, in order."""
    return tuple(_bar_word(text, *span) for span in _bar_spans(text))


def _bar_word(text: str, start: int, end: int) -> BarWord:
    word = text[start:end].strip()
    first = end - len(text[start:end].lstrip()) if word else start
    repeat = _REPEAT.match(word)
    return BarWord(start, end, first, word, int(repeat.group(1)[:9] or 1) if repeat else None)


@lru_cache(maxsize=_KEPT_BARS)
def bar_of(word: str, frame: GridFrame) -> Bar:
    """A bar that stands alone, and whether it is sound; `char` of its cells counts in `word`."""
    ((bar,), _) = _read(word, (frame,))
    return bar


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


def _repeated(bars: list[Bar], word: BarWord, frames: Sequence[GridFrame], report: Report) -> list[Bar]:
    times, char = min(word.repeats or 0, MAX_REPEATS + 1), word.first
    if not bars:
        report(char, "% repeats the bar before it, and there is none; expected a written bar")
        return [Bar((), sound=False)]
    if not 1 <= times <= MAX_REPEATS:
        report(char, f"{word.text}: a bar is repeated 1 to {MAX_REPEATS} times")
        return [Bar((), sound=False)]
    meters = [frames[i % len(frames)].meter for i in range(len(bars) - 1, len(bars) + times)]
    other = next((meter for meter in meters if meter != meters[0]), None)
    if other and bars[-1].sound:
        report(char, f"% repeats a bar of {meters[0]}, and this one is of {other}; expected it written out")
        return [Bar((), sound=False)] * times
    return [bars[-1]] * times


def _parse_bar(text: str, start: int, end: int, frame: GridFrame) -> Bar:
    runs = _runs(text, start, end)
    if not runs:
        raise _BadBarError(min(start, max(len(text) - 1, 0)), "an empty bar; a bar's rest is written -")
    free = _free_ticks(text, runs, frame)
    count = sum(len(r.chars) for r in runs if not r.is_tuplet)
    swings = bool(count) and _is_binary(count, free)
    lengths = dict(frame.spans)
    cells: list[Cell] = []
    tick = 0
    for run in runs:
        parts = len(run.chars) if run.is_tuplet else count
        whole = lengths[tick] if run.is_tuplet else free
        edges = [tick + _part(whole, i, parts) for i in range(len(run.chars) + 1)]
        cells += [
            Cell(a, b - a, letter, char, swings and not run.is_tuplet)
            for (a, b), (char, letter) in zip(pairwise(edges), run.chars, strict=True)
        ]
        tick = edges[-1]
    return Bar(tuple(cells))


def _part(whole: int, i: int, parts: int) -> int:
    """`i` of `parts` equal parts of `whole`, to the nearest tick."""
    return (2 * i * whole + parts) // (2 * parts)


def _runs(text: str, start: int, end: int) -> list[_Run]:
    """The characters of a bar, cut at the parentheses."""
    runs: list[_Run] = []
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
                runs.append(_Run([], True, i))
            elif not runs[-1].chars:
                raise _BadBarError(i, "nothing between the parentheses; a beat's rest is (-)")
            continue
        if not runs or runs[-1].is_tuplet != inside:
            runs.append(_Run([], inside, i))
        runs[-1].chars.append((i, char))
    if inside:
        raise _BadBarError(runs[-1].start, "'(' without its partner in this bar")
    return runs


def _free_ticks(text: str, runs: list[_Run], frame: GridFrame) -> int:
    """Ticks that the cells outside parentheses share; 0 if there are none and none are missing."""
    for run in runs:
        if run.is_tuplet and len(run.chars) > MAX_CELLS_A_BEAT:
            raise _BadBarError(run.start, f"{len(run.chars)} cells in one (…); expected 1 to {MAX_CELLS_A_BEAT}")
    tuplets = [r for r in runs if r.is_tuplet]
    what = "group" if frame.meter.groups else "beat"
    if len(tuplets) > len(frame.spans):
        most = len(frame.spans)
        raise _BadBarError(
            tuplets[most].start, f"a {frame.meter} bar holds {most} (…) of one {what} each; this is one too many"
        )
    if frame.meter.groups and tuplets:
        return _grouped_free(runs, frame)
    free = _even_free(text, runs, frame)
    count = sum(len(r.chars) for r in runs if not r.is_tuplet)
    for last, run in enumerate(runs):
        if run.is_tuplet and _end_of(runs[: last + 1], free, count, frame) is None:
            raise _BadBarError(run.start, "(…) fills one beat and must start on a beat")
    return free


def _even_free(text: str, runs: list[_Run], frame: GridFrame) -> int:
    """The same where all `(…)` are one beat long, or there are none."""
    tuplets = sum(r.is_tuplet for r in runs)
    count = sum(len(r.chars) for r in runs if not r.is_tuplet)
    unit = frame.meter.beat_ticks
    free = frame.meter.bar_ticks - tuplets * frame.beat_ticks
    if not count and not free:
        return 0
    if not count or not free or free % unit:
        left = f"the {free / unit:g} beats of 1/{frame.meter.unit} that (…) leave of {frame.meter}"
        raise _BadBarError(runs[0].start, f"{count} cells for {left}")
    if not _fits(count, free // unit, whole_bar=not tuplets):
        place = _odd_one_out(text, runs, frame.meter.groups) if not tuplets else runs[0].chars[0][0]
        beside = " beside (…)" if tuplets else ""
        expected = _expected(free // unit, not tuplets)
        raise _BadBarError(place, f"{count} cells{beside} do not fill a {frame.meter} bar; expected {expected}")
    return free


def _grouped_free(runs: list[_Run], frame: GridFrame) -> int:
    """The same where `(…)` fill groups: so much that each of them starts a group and the bar is full."""
    count = sum(len(r.chars) for r in runs if not r.is_tuplet)
    unit = frame.meter.beat_ticks
    for beats in range(frame.meter.beats):
        fits = _fits(count, beats, whole_bar=False) if beats else not count
        if fits and _end_of(runs, beats * unit, count, frame) == frame.meter.bar_ticks:
            return beats * unit
    raise _BadBarError(
        runs[0].start,
        f"{count} cells beside (…) do not fill a {frame.meter} bar; each (…) starts a group and fills it, and beside"
        " them stand as many cells on every beat",
    )


def _end_of(runs: list[_Run], free: int, count: int, frame: GridFrame) -> int | None:
    """Where these runs end if `count` plain cells share `free` ticks; None where a `(…)` starts on no beat or group."""
    lengths = dict(frame.spans)
    tick = 0
    for run in runs:
        if not run.is_tuplet:
            tick += _part(free, len(run.chars), count)
        elif tick in lengths:
            tick += lengths[tick]
        else:
            return None
    return tick


def _fits(count: int, beats: int, whole_bar: bool) -> bool:
    if count > MAX_CELLS_A_BEAT * beats:
        return False
    return count % beats == 0 or (whole_bar and beats % count == 0)


def _expected(beats: int, whole_bar: bool) -> str:
    fewer = [n for n in range(1, beats) if beats % n == 0] if whole_bar else []
    counts = [str(n) for n in [*fewer, *(beats * k for k in _USUAL)]]
    return ", ".join(counts[:-1]) + " or " + counts[-1]


def _odd_one_out(text: str, runs: list[_Run], groups: tuple[int, ...]) -> int:
    """Where the word between blanks stands that has not as many cells a beat as most have; else the bar's start."""
    chars = runs[0].chars
    words: list[list[int]] = [[]]
    for (i, _), (after, _) in zip(chars, [*chars[1:], (len(text), "")], strict=True):
        words[-1].append(i)
        if after - i > 1:
            words.append([])
    words = [w for w in words if w]
    beats = groups if len(groups) == len(words) else (1,) * len(words)
    shares = [len(w) / n for w, n in zip(words, beats, strict=True)]
    often = Counter(shares)
    usual = max(often, key=lambda n: (often[n], n))
    return next((w[0] for w, n in zip(words, shares, strict=True) if n != usual), chars[0][0])


def _is_binary(count: int, ticks: int) -> bool:
    """Whether a whole note is a power of two of such cells, `count` in `ticks`: only those swing."""
    cells, rest = divmod(4 * PPQ * count, ticks)
    return not rest and cells & (cells - 1) == 0
