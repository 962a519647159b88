"""The form of a piece as a teacher writes it down: patterns once, how often they are played, and in which order.

A piece is cut where its tempo or meter changes and where the file's own sections begin; without those, where a crash
opens a new part. What lies between is cut into phrases of the length, of 2, 4 or 8 bars, that makes the shortest
page, or into a groove and what comes between it, such as fills. A phrase that is one pattern again and again is written
as the pattern with its `times`; phrases that are the same are one grid that the form names again; one in which few
strokes differ from an earlier grid has that one's letter and a number, and is written as a variation of it where few
lines differ.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from statistics import fmean
from string import ascii_uppercase

from station.drills.grid.grid_reader import MAX_TIMES
from station.drills.grid.grid_writer import LineText
from station.drills.grid.lines_from_score import WrittenStroke, lines_of, strokes_by_bar
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
_ALIKE = 0.7
"""Grids that share so many of their strokes are one idea and its variation: three bars of four, and a fill (our
choice)."""
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
    times = _times(blocks, len(grids), order)
    models = _models([blocks[i] for i in grids], lesson)
    names = _names(bars, [blocks[i] for i in grids], models)
    written = [
        FormGrid(name, blocks[i].first, blocks[i].bars, each, model.index if model and model.is_written else None)
        for i, name, each, model in zip(grids, names, times, models, strict=True)
    ]
    entries = tuple(g for i, g in enumerate(order) for _ in range(blocks[i].times // times[g]))
    if len(written) == 1 and not blocks[0].section and len(entries) == 1:
        written = [replace(written[0], name="")]
    return LessonForm(tuple(written), entries)


# --- where it is cut --------------------------------------------------------------------------------------------------


def _spans(bars: BarContents, sections: Sequence[PartSection]) -> Iterator[tuple[int, int, str]]:
    """First bar, the bar after the last, and the file's name of each run of bars that is looked at by itself."""
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
    found = sorted({0, bars.pick_up})
    for bar in sorted(bars.crashes):
        if bar - found[-1] >= _CRASH_APART:
            found.append(bar)
    return set(found)


# --- phrases ----------------------------------------------------------------------------------------------------------


def _blocks(bars: BarContents, start: int, end: int, section: str) -> list[_Block]:
    """A run of bars as patterns and how often each is played."""
    is_whole = section and end - start <= _LONGEST
    lengths = ((end - start,) if is_whole else ()) + _PHRASES
    cuts = [*(_cut(bars, start, end, n, section) for n in lengths), _runs(bars, start, end, section)]
    return min(cuts, key=lambda found: _cost(bars, found))


def _runs(bars: BarContents, start: int, end: int, section: str) -> list[_Block]:
    """A groove wherever a bar comes again at once, and what is played between."""
    at = [b for b in range(start, end) if b == start or _turns_at(bars, b)]
    return [_folded(bars, a, b, section) for a, b in pairwise([*at, end])]


def _turns_at(bars: BarContents, bar: int) -> bool:
    """Whether a bar begins what is played again and again, or what is not."""
    before, here, after = (bars.contents[b] if b < bars.count else None for b in (bar - 1, bar, bar + 1))
    last = bars.contents[bar - 2] if bar > 1 else None
    return bar not in bars.bound and here != before and (here == after or before == last)


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
    first: dict[object, int] = {}
    written: list[int] = []
    order: list[int] = []
    for i, block in enumerate(blocks):
        pattern = _pattern(bars, block)
        if pattern not in first:
            first[pattern] = len(written)
            written.append(i)
        order.append(first[pattern])
    return written, order


def _times(blocks: Sequence[_Block], count: int, order: Sequence[int]) -> list[int]:
    """How often each grid is played for one entry of the form: as often as all its blocks are, or once."""
    found = [{b.times for b, g in zip(blocks, order, strict=True) if g == i} for i in range(count)]
    return [times.pop() if len(times) == 1 else 1 for times in found]


def _names(bars: BarContents, written: Sequence[_Block], models: Sequence["_Model | None"]) -> list[str]:
    """A name for each grid: the file's, "pick-up", "fill", or a letter; a variation has its model's and a number."""
    letters = _letters()
    wanted: list[str] = []
    for block, model in zip(written, models, strict=True):
        own = block.section or _word(bars, block)
        wanted.append(own or (wanted[model.index] if model else next(letters)))
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
    if block.first + block.bars <= bars.pick_up:
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


@dataclass(frozen=True, slots=True)
class _Model:
    """The grid that another is a variation of, and whether it is written as one."""

    index: int
    is_written: bool


def _models(blocks: Sequence[_Block], lesson: Lesson) -> list[_Model | None]:
    """Of each grid the earlier one that it shares most strokes with, if most are the same."""
    by_bar = strokes_by_bar(lesson.score, lesson.beyond)
    lines = [_marks(lines_of(by_bar, b.first, b.first + b.bars - 1)) for b in blocks]
    strokes = [_strokes(by_bar, block) for block in blocks]
    meters = [str(lesson.score.tempo_map.meter_at(lesson.score.tempo_map.bar_start(b.first))) for b in blocks]
    found: list[_Model | None] = []
    for i, block in enumerate(blocks):
        first = [k for k in range(i) if found[k] is None and (blocks[k].bars, meters[k]) == (block.bars, meters[i])]
        near = [k for k in first if _is_near(lines[k], lines[i])]
        shares = {k: _share(strokes[k], strokes[i]) for k in near or first}
        best = max(shares, key=lambda k: shares[k], default=None)
        is_one = best is not None and (bool(near) or shares[best] >= _ALIKE)
        found.append(_Model(best, bool(near)) if best is not None and is_one else None)
    return found


_Marks = Mapping[str, object]
_Strokes = tuple[frozenset[tuple[int, int]], ...]
"""Piece, and tick in the bar, of each stroke of each bar."""


def _strokes(by_bar: Mapping[int, Sequence[WrittenStroke]], block: _Block) -> _Strokes:
    bars = (by_bar.get(bar, ()) for bar in range(block.first, block.first + block.bars))
    return tuple(frozenset((int(s.note.piece), s.note.tick - s.start) for s in bar) for bar in bars)


def _share(model: _Strokes, own: _Strokes) -> float:
    """How many of the strokes of both are the same, bar by bar (Jaccard 1901), in the mean."""
    return fmean(len(a & b) / len(a | b) if a | b else 1.0 for a, b in zip(model, own, strict=True))


def _marks(lines: Sequence[LineText]) -> _Marks:
    return {line.name: line.marks for line in lines}


def _same(model: _Marks, own: _Marks) -> int:
    """How many lines both have alike."""
    return sum(own.get(name) == marks for name, marks in model.items())


def _is_near(model: _Marks, own: _Marks) -> bool:
    """Whether more is alike than not, and no hand has a line of its own that would take another's place."""
    has_limbs = any("." in name for name in (*model, *own))
    return not has_limbs and 2 * _same(model, own) > len(model.keys() | own.keys())
