"""The form of a piece as a teacher writes it down: patterns once, how often they are played, and in which order.

A piece is cut where its tempo or meter changes and where the file's own sections begin; without those, where a crash
opens a new part. What lies between is cut into phrases of the length, of 2, 4 or 8 bars, that makes the shortest
page. A phrase that is one pattern again and again is written as the pattern with its `times`; phrases that are the same
are one grid that the form names again; one in which few lines differ from an earlier grid is a variation of that.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import pairwise
from math import gcd
from string import ascii_uppercase

from station.drills.grid.grid_reader import MAX_TIMES
from station.drills.grid.grid_writer import LineText
from station.drills.grid.lines_from_score import lines_of, strokes_by_bar
from station.drills.lesson import Lesson
from station.drills.transcription.bar_contents import BarContents, bar_contents
from station.drills.writing.lesson_form import FormGrid, LessonForm
from station.music.drum_part import PartSection

_PHRASES = (4, 8, 2)
"""Bars of a phrase, the usual one first."""
_LONGEST = 16
"""Bars of a named section that may still be one grid, most of them repeats (our choice)."""
_CRASH_APART = 4
"""A part has at least so many bars: crashes that come more often keep time (our choice)."""
_GRID, _ENTRY = 2.0, 0.3
"""What a grid's head and an entry of the form cost on the page, in bars that are written out (our choice)."""
_WIDE = 4
"""Bars beside each other that a page has room for: four of sixteenths are 90 characters. Further ones cost twice."""
_MOST_TURNS = 4
"""So often the form names a grid again before a grid of its own says how often it is played (our choice)."""
_FILL, _PICK_UP = "fill", "pick-up"
_LONGEST_FILL = 2


@dataclass(frozen=True, slots=True)
class _Block:
    """`times` times a pattern of `bars` bars, from `first`; `section` is the name that the file gives it."""

    first: int
    bars: int
    times: int
    section: str = ""


def found_form(lesson: Lesson, sections: Sequence[PartSection]) -> LessonForm:
    """The shortest form of the music of `lesson`; `sections` are those that its file names."""
    bars = bar_contents(lesson.score, lesson.beyond)
    blocks = [block for span in _spans(bars, sections) for block in _blocks(bars, *span)]
    grids, order = _shared(bars, blocks)
    names = _names(bars, [blocks[i] for i in grids])
    times = _times(blocks, len(grids), order)
    written = [
        FormGrid(name, blocks[i].first, blocks[i].bars, each) for i, name, each in zip(grids, names, times, strict=True)
    ]
    entries = tuple(g for i, g in enumerate(order) for _ in range(blocks[i].times // times[g]))
    if len(written) == 1 and not blocks[0].section and len(entries) == 1:
        written = [replace(written[0], name="")]
    return LessonForm(tuple(_with_models(written, lesson)), entries)


# --- where it is cut --------------------------------------------------------------------------------------------------


def _spans(bars: BarContents, sections: Sequence[PartSection]) -> Iterator[tuple[int, int, str]]:
    """First bar, the bar after the last, and the file's name of each stretch that is looked at by itself."""
    name_of = {s.first_bar: s.name for s in sections if s.first_bar < bars.count}
    ends = {s.last_bar + 1 for s in sections}
    parts = set() if sections else _new_parts(bars)
    starts = sorted({0, *bars.cuts, *((name_of.keys() | ends | parts) - bars.bound)} & set(range(bars.count)))
    inside = {bar: s.name for s in sections for bar in range(s.first_bar, s.last_bar + 1)}
    for start, end in pairwise([*starts, bars.count]):
        yield start, end, _plain(inside.get(start, ""))


def _plain(name: str) -> str:
    """A name that a form can say."""
    return " ".join("".join(c if c.isprintable() and c != "," else " " for c in name).split())


def _new_parts(bars: BarContents) -> set[int]:
    """The bars that a crash opens, where crashes are rare, and the one after a pick-up."""
    found = [0, 1] if bars.has_pick_up else [0]
    for bar in sorted(bars.crashes):
        if bar - found[-1] >= _CRASH_APART:
            found.append(bar)
    return set(found)


# --- phrases ----------------------------------------------------------------------------------------------------------


def _blocks(bars: BarContents, start: int, end: int, section: str) -> list[_Block]:
    """A stretch as patterns and how often each is played."""
    is_whole = section and end - start <= _LONGEST
    lengths = ((end - start,) if is_whole else ()) + _PHRASES
    return min((_cut(bars, start, end, n, section) for n in lengths), key=lambda found: _cost(bars, found))


def _cut(bars: BarContents, start: int, end: int, length: int, section: str) -> list[_Block]:
    """Phrases of `length` bars; the last may be shorter, and one into which something rings on is one with the next."""
    at = [b for b in range(start, end, length) if b not in bars.bound or b == start]
    found: list[_Block] = []
    for a, b in pairwise([*at, end]):
        block = _folded(bars, a, b, section)
        last = found[-1] if found else None
        if last and _pattern(bars, last) == _pattern(bars, block) and last.times + block.times <= MAX_TIMES:
            found[-1] = replace(last, times=last.times + block.times)
        else:
            found.append(block)
    return found


def _folded(bars: BarContents, start: int, end: int, section: str) -> _Block:
    """A phrase as its shortest pattern."""
    count, contents = end - start, bars.contents[start:end]
    for unit in range(1, count):
        if count % unit or count // unit > MAX_TIMES or bars.bound & set(range(start + unit, end, unit)):
            continue
        if contents == contents[:unit] * (count // unit):
            return _Block(start, unit, count // unit, section)
    return _Block(start, count, 1, section)


def _pattern(bars: BarContents, block: _Block) -> tuple[str, tuple[int, ...]]:
    return block.section, bars.contents[block.first : block.first + block.bars]


def _cost(bars: BarContents, blocks: Sequence[_Block]) -> float:
    """How long the page is that these blocks need."""
    patterns = {_pattern(bars, block)[1] for block in blocks}
    written = [1 + sum(a != b for a, b in pairwise(pattern)) for pattern in patterns]
    too_wide = sum(max(0, bars - _WIDE) for bars in written)
    return sum(written) + too_wide + _GRID * len(patterns) + _ENTRY * len(blocks)


# --- the same again ---------------------------------------------------------------------------------------------------


def _shared(bars: BarContents, blocks: Sequence[_Block]) -> tuple[list[int], list[int]]:
    """The blocks that are written, each the first of its kind, and which of them each block is."""
    turns: dict[object, list[int]] = {}
    for block in blocks:
        turns.setdefault(_pattern(bars, block), []).append(block.times)
    first: dict[object, int] = {}
    written: list[int] = []
    order: list[int] = []
    for i, block in enumerate(blocks):
        pattern = _pattern(bars, block)
        is_one = max(turns[pattern]) // reduce(gcd, turns[pattern]) <= _MOST_TURNS
        kind = pattern if is_one else (pattern, block.times)
        if kind not in first:
            first[kind] = len(written)
            written.append(i)
        order.append(first[kind])
    return written, order


def _times(blocks: Sequence[_Block], count: int, order: Sequence[int]) -> list[int]:
    """How often each grid is played for one entry of the form: what all its blocks are multiples of."""
    return [reduce(gcd, (b.times for b, g in zip(blocks, order, strict=True) if g == i)) for i in range(count)]


def _names(bars: BarContents, written: Sequence[_Block]) -> list[str]:
    """A name for each grid: the file's, "pick-up", "fill", or a letter."""
    letters = _letters()
    wanted = [block.section or _word(bars, block) or next(letters) for block in written]
    counts: Counter[str] = Counter()
    taken = set(wanted)
    names: list[str] = []
    for name in wanted:
        counts[name] += 1
        while counts[name] > 1 and f"{name} {counts[name]}" in taken:
            counts[name] += 1
        names.append(name if counts[name] == 1 else f"{name} {counts[name]}")
    return names


def _word(bars: BarContents, block: _Block) -> str:
    if bars.has_pick_up and (block.first, block.bars) == (0, 1):
        return _PICK_UP
    return _FILL if _is_fill(bars, block) else ""


def _is_fill(bars: BarContents, block: _Block) -> bool:
    is_short = block.bars <= _LONGEST_FILL and block.times == 1 and block.first > 0
    return is_short and bool(bars.fills & set(range(block.first, block.first + block.bars)))


def _letters() -> Iterator[str]:
    """A, B and so on to Z, then AA, AB."""
    yield from ascii_uppercase
    for first in _letters():
        yield from (first + second for second in ascii_uppercase)


# --- variations -------------------------------------------------------------------------------------------------------


def _with_models(grids: Sequence[FormGrid], lesson: Lesson) -> list[FormGrid]:
    """The grids, those that share more lines with an earlier one than they have of their own as its variations."""
    by_bar = strokes_by_bar(lesson.score, lesson.beyond)
    lines = [_marks(lines_of(by_bar, g.first_bar, g.first_bar + g.bars - 1)) for g in grids]
    meters = [str(lesson.score.tempo_map.meter_at(lesson.score.tempo_map.bar_start(g.first_bar))) for g in grids]
    found: list[FormGrid] = []
    for i, grid in enumerate(grids):
        alike = [
            k
            for k, model in enumerate(found)
            if model.like is None and (model.bars, meters[k]) == (grid.bars, meters[i]) and _is_near(lines[k], lines[i])
        ]
        found.append(replace(grid, like=max(alike, key=lambda k: _same(lines[k], lines[i])) if alike else None))
    return found


_Marks = Mapping[str, object]


def _marks(lines: Sequence[LineText]) -> _Marks:
    return {line.name: line.marks for line in lines}


def _same(model: _Marks, own: _Marks) -> int:
    """How many lines both have alike."""
    return sum(own.get(name) == marks for name, marks in model.items())


def _is_near(model: _Marks, own: _Marks) -> bool:
    """Whether more is alike than not, and no hand has a line of its own that would take another's place."""
    has_limbs = any("." in name for name in (*model, *own))
    return not has_limbs and 2 * _same(model, own) > len(model.keys() | own.keys())
