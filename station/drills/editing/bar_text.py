"""One bar of a line as text: its letters set, its cells cut finer, one of its beats cut anew.

Ticks count from the bar's start, straight. What stands in a bar keeps its place as it is heard: where a beat becomes a
`(…)`, which never swings, a swung stroke takes the cell at which it was heard.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from station.core.pieces import Articulation, Ornament
from station.drills.grid.grid import MAX_CELLS_A_BEAT, Cell, GridFrame, bar_of
from station.drills.grid.skeletons import (
    REST,
    TUPLET_CELLS,
    GridMark,
    GridSetting,
    filled,
    holds_all,
    plain_bar,
    points_of,
)
from station.drills.grid.tab_symbols import HOLD, RESTS, SYMBOLS, TabFamily

_FINER = (2, 4, 8, 16, 32, 64)
"""How many times finer plain cells are tried: halves of halves, as notes are."""
_TUPLETS = sorted(TUPLET_CELLS)
"""Cells of a `(…)` that is new, the fewest first."""
_FINER_TUPLETS = (2, 3, 4, 5, 6, 7, 8)
"""How many times finer the cells of a `(…)` are tried, the fewest first."""


@dataclass(frozen=True, slots=True)
class BarSetting:
    """What a bar's letters mean: how it is cut and swings, and the family of its line (None: signs)."""

    grid: GridSetting
    family: TabFamily | None

    @property
    def frame(self) -> GridFrame:
        """What its cells divide."""
        return self.grid.frame


def cell_at(word: str, frame: GridFrame, tick: int) -> Cell | None:
    """The cell that begins at `tick`; None where none does."""
    return next((cell for cell in bar_of(word, frame).cells if cell.tick == tick), None)


def with_letter(word: str, tick: int, letter: str, setting: BarSetting) -> str | None:
    """The bar with `letter` at `tick`, cut finer as little as needed; None where no cell can begin there."""
    cell = cell_at(word, setting.frame, tick)
    if cell is None and letter == REST:
        return word
    if cell is None:
        word = finer(word, tick, setting) or ""
        cell = cell_at(word, setting.frame, tick)
    return None if cell is None else f"{word[: cell.char]}{letter}{word[cell.char + 1 :]}"


def finer(word: str, tick: int, setting: BarSetting) -> str | None:
    """The same music with a cell that begins at `tick`: plain cells halved, or its beat in `(…)`; None if neither."""
    marks = marks_of(word, setting)
    points = points_of(marks, setting.frame.meter.bar_ticks)
    for skeleton in finer_skeletons(word, tick, setting.frame):
        fits = cell_at(skeleton, setting.frame, tick) is not None
        if fits and holds_all(skeleton, points, setting.grid):
            return filled(skeleton, marks, setting.grid)
    return None


def rests(frame: GridFrame, like: str = "") -> str:
    """A bar of rests, with as many plain cells on each beat as the bar `like` has."""
    return plain_bar(frame, plain_per_beat(like, frame)) or REST


def plain_per_beat(word: str, frame: GridFrame) -> int:
    """How many plain cells the bar has on each beat of the meter, 1 at least."""
    lengths = [cell.length_ticks for cell in bar_of(word, frame).cells if not _in_tuplet(word, cell.char)]
    return max(1, round(len(lengths) * frame.meter.beat_ticks / sum(lengths))) if lengths else 1


def _in_tuplet(word: str, char: int) -> bool:
    return word.rfind("(", 0, char) > word.rfind(")", 0, char)


# --- letters as marks -------------------------------------------------------------------------------------------------


def marks_of(word: str, setting: BarSetting) -> list[GridMark]:
    """The letters of a bar but for its rests, at the ticks at which they are heard."""
    marks: list[GridMark] = []
    swing, meter = setting.grid.swing, setting.frame.meter
    for cell in bar_of(word, setting.frame).cells:
        at, middle, end = (
            swing.swung(tick, meter) if cell.swings else tick
            for tick in (cell.tick, cell.tick + cell.length_ticks // 2, cell.tick + cell.length_ticks)
        )
        if cell.letter == HOLD and marks and marks[-1].holds and marks[-1].until == at:
            marks[-1] = replace(marks[-1], until=end)
        elif cell.letter not in RESTS:
            marks.append(_mark(cell.letter, at, middle, end, setting.family))
    return marks


def _mark(letter: str, at: int, middle: int, end: int, family: TabFamily | None) -> GridMark:
    symbol = None if family is None else SYMBOLS[family].get(letter)
    if letter == HOLD or (symbol and symbol.articulation is Articulation.BUZZ):
        return GridMark(letter, at, until=end, holds=True)
    return GridMark(letter, at, second=middle if symbol and symbol.ornament is Ornament.DIDDLE else None)


# --- skeletons --------------------------------------------------------------------------------------------------------


def finer_skeletons(word: str, tick: int, frame: GridFrame) -> Iterator[str]:
    """Bars of rests with more cells than this one, those that are nearest to it first."""
    runs = _runs(word, frame)
    here = next((i for i, run in enumerate(runs) if run.is_tuplet and run.start <= tick < run.end), None)
    if here is not None:
        yield from _finer_tuplets(runs, here)
        return
    plain = sum(run.count for run in runs if not run.is_tuplet)
    beats = frame.meter.beats
    if plain < beats and not any(run.is_tuplet for run in runs):
        yield from (REST * (beats * times) for times in (1, *_FINER))
    else:
        yield from (_text([run if run.is_tuplet else run.times(n) for run in runs]) for n in _FINER)
    yield from _with_tuplet(word, tick, frame)


@dataclass(frozen=True, slots=True)
class _Run:
    """Cells that stand together: in one `(…)`, or outside; from tick `start` to `end`."""

    count: int
    is_tuplet: bool
    start: int
    end: int

    def times(self, factor: int) -> "_Run":
        return replace(self, count=self.count * factor)


def _runs(word: str, frame: GridFrame) -> list[_Run]:
    runs: list[_Run] = []
    opened = -1
    for cell in bar_of(word, frame).cells:
        is_tuplet = _in_tuplet(word, cell.char)
        bracket = word.rfind("(", 0, cell.char) if is_tuplet else -1
        if runs and runs[-1].is_tuplet == is_tuplet and bracket == opened:
            runs[-1] = replace(runs[-1], count=runs[-1].count + 1, end=cell.tick + cell.length_ticks)
        else:
            runs.append(_Run(1, is_tuplet, cell.tick, cell.tick + cell.length_ticks))
        opened = bracket
    return runs


def _text(runs: Sequence[_Run]) -> str:
    return "".join(f"({REST * run.count})" if run.is_tuplet else REST * run.count for run in runs)


def _finer_tuplets(runs: Sequence[_Run], here: int) -> Iterator[str]:
    """The bar with more cells in one of its `(…)`."""
    was = runs[here].count
    counts = [was * n for n in _FINER_TUPLETS if was * n <= MAX_CELLS_A_BEAT]
    for count in (*counts, *_TUPLETS):
        yield _text([*runs[:here], replace(runs[here], count=count), *runs[here + 1 :]])


def _with_tuplet(word: str, tick: int, frame: GridFrame) -> Iterator[str]:
    """The bar with the beat that holds `tick` in `(…)`, in more and more cells."""
    span = next((i for i, (start, length) in enumerate(frame.spans) if start <= tick < start + length), None)
    if span is not None:
        yield from (text for cells in _TUPLETS if (text := cut_skeleton(word, span, cells, frame)))


def cut_skeleton(word: str, span: int, cells: int, frame: GridFrame) -> str:
    """The cells of the bar, all rests, with `cells` in `(…)` on the beat `span`; empty where its cells cross that beat.

    A bar with fewer cells than beats has one on each beat.
    """
    start, length = frame.spans[span]
    plain = plain_per_beat(word, frame)
    tuplets = {run.start: run for run in _runs(word, frame) if run.is_tuplet}
    tuplets[start] = _Run(cells, True, start, start + length)
    runs: list[_Run] = []
    done = 0
    while done < frame.meter.bar_ticks:
        runs.append(tuplets.get(done) or _Run(plain, False, done, done + frame.meter.beat_ticks))
        done = runs[-1].end
    return _text(runs) if any(run.start == start and run.is_tuplet for run in runs) else ""


# --- a beat cut anew --------------------------------------------------------------------------------------------------


def with_cut(word: str, span: int, cells: int, setting: BarSetting) -> str | None:
    """The bar with beat `span` in `cells` cells, its letters in the nearest of them; None where that cannot be written.

    Where all beats have as many cells then, they are written without parentheses.
    """
    frame = setting.frame
    start, length = frame.spans[span]
    marks = marks_of(word, setting)
    for skeleton in _cut_skeletons(word, span, cells, frame):
        inside = [cell for cell in bar_of(skeleton, frame).cells if start <= cell.tick < start + length]
        if len(inside) != cells:
            continue
        ends = _played_ends(skeleton, inside, setting)
        others = [mark for mark in marks if not ends[0] <= mark.at < ends[-1]]
        if holds_all(skeleton, [(mark.at, mark.second) for mark in others], setting.grid):
            moved = _nearest([mark for mark in marks if ends[0] <= mark.at < ends[-1]], ends)
            return filled(skeleton, [*others, *moved], setting.grid)
    return None


def _cut_skeletons(word: str, span: int, cells: int, frame: GridFrame) -> Iterator[str]:
    """Ways to write the cut bar: plain where it can be, else with `(…)`."""
    skeleton = cut_skeleton(word, span, cells, frame)
    if not skeleton:
        return
    start, length = frame.spans[span]
    beats = length // frame.meter.beat_ticks
    if beats * plain_per_beat(word, frame) == cells and length % frame.meter.beat_ticks == 0:
        yield _opened(skeleton, start, frame)
    runs = _runs(skeleton, frame)
    if all(run.is_tuplet and run.count * length == cells * (run.end - run.start) for run in runs):
        yield REST * sum(run.count for run in runs)
    yield skeleton


def _opened(skeleton: str, start: int, frame: GridFrame) -> str:
    """The skeleton without the parentheses of the beat at `start`."""
    runs = [replace(run, is_tuplet=run.is_tuplet and run.start != start) for run in _runs(skeleton, frame)]
    return _text(runs)


def _played_ends(skeleton: str, inside: Sequence[Cell], setting: BarSetting) -> list[int]:
    """Where the cells of the beat are heard, and where the last of them ends."""
    swing, meter = setting.grid.swing, setting.frame.meter
    ticks = [cell.tick for cell in inside]
    ends = [*ticks, inside[-1].tick + inside[-1].length_ticks]
    return [swing.swung(tick, meter) if inside[0].swings else tick for tick in ends]


def _nearest(marks: Sequence[GridMark], ends: Sequence[int]) -> list[GridMark]:
    """The letters of a beat in the cells that begin at `ends`; of two that fall together the nearer stays."""
    found: dict[int, tuple[int, GridMark]] = {}
    for mark in marks:
        at = min(ends[:-1], key=lambda tick: abs(tick - mark.at))
        distance = abs(at - mark.at)
        if at not in found or distance < found[at][0]:
            found[at] = (distance, replace(mark, at=at, second=None))
    return [mark for _, mark in found.values()]
