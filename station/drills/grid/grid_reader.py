"""Reading one `[grid]` table: its meter, tempo and name, its lines and cycles, and the strokes that they write."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from station.core.expected import either_of, later, list_like
from station.core.toml.schema import (
    Field,
    Fields,
    anything,
    checked_values,
    number,
    optional,
    said,
    table_like,
    title,
    whole,
)
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.grid.cell_strokes import BarClock, WrittenCell
from station.drills.grid.cycles import CYCLE, Cycle, by_repetition, cycle_strokes, read_cycles
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_lines import LINES, RawLine, cells, lines_of_table, plain_line
from station.drills.grid.grid_timing import TIMING, GridTiming, timing_of
from station.drills.grid.line_group import MAX_BARS, CellCount, ParsedLine, agreed_bars, joined_strokes, parsed
from station.drills.grid.loudness_line import Loudness, read_loudness
from station.drills.grid.sticking_line import STICKING
from station.drills.grid.stroke_timing import STROKE_TIMING, STROKE_TIMINGS
from station.music.loudness_marks import LoudnessMark
from station.music.swing import STRAIGHT
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange

MAX_TIMES = 100
LOUDNESS = "loudness"


@dataclass(frozen=True, slots=True)
class GridSection:
    """One grid, read, from tick 0.

    `meters` has each bar of one repetition, the tick of each its start; `parts` the strokes of each repetition, their
    ticks counted from its own start: repetitions differ where cycles run on over them. `loudness` has the marks of each
    repetition, from its start.
    """

    name: str
    timing: GridTiming
    meters: tuple[MeterChange, ...]
    parts: tuple[tuple[WrittenCell, ...], ...]
    loudness: tuple[LoudnessMark, ...] = ()

    @property
    def times(self) -> int:
        """How often it is played."""
        return len(self.parts)

    @property
    def bar_count(self) -> int:
        """Bars of one repetition."""
        return len(self.meters)

    @property
    def length_ticks(self) -> int:
        """Length of one repetition."""
        return self.meters[-1].tick + self.meters[-1].bar_ticks

    def repetition(self, number: int, start_tick: int = 0) -> list[WrittenCell]:
        """The strokes of one repetition, from 0, that begins at `start_tick`."""
        return [stroke.moved(start_tick) for stroke in self.parts[number]]

    def bars_at(self, start_tick: int) -> list[MeterChange]:
        """The bars of a repetition that begins at `start_tick`."""
        return [replace(bar, tick=bar.tick + start_tick) for bar in self.meters] if start_tick else list(self.meters)

    def at(self, start_tick: int) -> list[WrittenCell]:
        """The strokes of all repetitions, one after the other from `start_tick` on."""
        starts = (start_tick + i * self.length_ticks for i in range(self.times))
        return [stroke for i, start in enumerate(starts) for stroke in self.repetition(i, start)]


GRID: Fields = {
    "name": Field(title, ""),
    "like": optional(anything),  # what the form says is read by its own readers
    "ending": optional(anything),
    "at": optional(anything),
    **TIMING,
    "tempo_to_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "times": Field(whole(1, MAX_TIMES), 1),
    "bars": optional(whole(1, MAX_BARS)),
    LOUDNESS: optional(cells),
    **LINES,
    STROKE_TIMING: optional(said(STROKE_TIMINGS, "line")),
    "cycle": optional(later(either_of(table_like(CYCLE), list_like(table_like(CYCLE))))),
}
"""The keys of a grid."""


def read_grid(
    raw: object, path: KeyPath, before: GridTiming, faults: Faults, count: CellCount | None = None
) -> GridSection:
    """One grid, after what was said `before` it: the lesson's own timing, or that of the grid that precedes it.

    `count` has the cells of all grids of a lesson so far; raises `Wrong` where they are more than anyone practises.
    """
    values, found = checked_values(raw, GRID, "line")
    timing = timing_of(values, before, found, path)
    lines = lines_of_table(values, path, found)
    if not lines and values["cycle"] is None and not found:
        found.miss((), 'has no line to play; expected one such as snare = "----o-------o---"')
    are_all = not found
    faults.merge(found, *path)
    if not timing.is_sure:
        return _unread(values, timing)
    cycles = read_cycles(values["cycle"], (*path, "cycle"), faults)
    count = CellCount() if count is None else count
    return _Builder(values, path, timing, lines, cycles, faults, count, are_all).section()


def _unread(values: Mapping[str, Any], timing: GridTiming) -> GridSection:
    """A grid whose lines cannot be read, for nobody knows in what meter they are: a bar of rest."""
    return GridSection(values["name"], timing, _bars(timing.meters, 1), ((),) * values["times"])


@dataclass(slots=True)
class _Builder:
    """Puts the lines of one grid together."""

    values: Mapping[str, Any]
    path: KeyPath
    timing: GridTiming
    lines: Sequence[RawLine]
    cycles: Sequence[Cycle]
    faults: Faults
    cells: CellCount
    are_all: bool

    def section(self) -> GridSection:
        times: int = self.values["times"]
        before = len(self.faults)
        frames = [GridFrame(meter, self.timing.beat_ticks) for meter in self.timing.meters]
        lines = [parsed(raw, frames, self.faults) for raw in self.lines]
        under, loudness = (self._beside(key, frames) for key in (STICKING, LOUDNESS))
        count = self._bar_count([*lines, *(line for line in (under, loudness) if line)], times)
        self.cells.add(lines, times)
        bars = _bars(self.timing.meters, count)
        length = bars[-1].tick + bars[-1].bar_ticks
        clock = BarClock(bars, self.timing.swing)
        self._must_not_cross(lines, bars)
        own = joined_strokes(lines, under, [bar.tick for bar in bars], clock, self.faults, are_all=self.are_all)
        level = self._loudness(loudness, bars)
        parts = [self._struck([*own, *more], level) for more in self._cycled(bars, length, times)]
        if len(self.faults) == before:
            self._check_said(count)
        return GridSection(self.values["name"], self.timing, bars, tuple(parts), level.marks)

    def _check_said(self, count: int) -> None:
        """Note that the grid says it has more or fewer bars than its lines."""
        said: int | None = self.values["bars"]
        if said is not None and said != count:
            self.faults.add((*self.path, "bars"), f"{said}, but the lines have {count}")

    def _beside(self, key: str, frames: Sequence[GridFrame]) -> ParsedLine | None:
        raw = plain_line(self.values, key, self.path)
        return None if raw is None else parsed(raw, frames, self.faults)

    def _bar_count(self, lines: Sequence[ParsedLine], times: int) -> int:
        """The bars of the grid, as its lines have them, or as it says where all of them are cycles."""
        said: int | None = self.values["bars"]
        if not lines and self.cycles and said is None:
            text = "is missing; expected how many bars the cycles run, such as bars = 4"
            self.faults.miss((*self.path, "bars"), text)
        count = agreed_bars(lines, self.faults) if lines else said or 1
        if count * times > MAX_BARS:
            where = lines[0].raw.line.path if lines else (*self.path, "bars")
            self.faults.add(where, f"{count * times} bars; a lesson has at most {MAX_BARS}")
            return 1
        return count

    def _cycled(self, bars: Sequence[MeterChange], length: int, times: int) -> list[list[WrittenCell]]:
        """The strokes of all cycles, by repetition."""
        everywhere = [replace(bar, tick=bar.tick + i * length) for i in range(times) for bar in bars]
        clock = BarClock(everywhere, self.timing.swing)
        strokes = [
            stroke
            for cycle in self.cycles
            for stroke in cycle_strokes(cycle, self.timing.beat_ticks, clock, length * times, self.faults, self.cells)
        ]
        return by_repetition(strokes, length, times)

    def _loudness(self, line: ParsedLine | None, bars: Sequence[MeterChange]) -> Loudness:
        if line is None or not (line.aligned and all(bar.sound for bar in line.bars)):
            return Loudness()
        starts = [bar.tick for bar in bars]
        return read_loudness(zip(starts, line.bars, strict=False), line.reporter(self.faults))

    def _struck(self, strokes: Sequence[WrittenCell], level: Loudness) -> tuple[WrittenCell, ...]:
        """The strokes as loud as the grid says."""
        settings = self.timing.settings
        return tuple(s.struck(settings, level.gain(s.place.straight)) for s in strokes)

    def _must_not_cross(self, lines: Sequence[ParsedLine], bars: Sequence[MeterChange]) -> None:
        """Note a fault where cells swing in pairs that do not fill the beat that is counted, and so would cross it."""
        swing, beat = self.timing.swing, self.timing.beat_ticks
        if swing.ratio == STRAIGHT or beat % (2 * swing.unit_ticks) == 0:
            return
        in_bars = ((meter, bar) for line in lines for meter, bar in zip(bars, line.bars, strict=False))
        if any(not meter.groups and any(cell.swings for cell in bar.cells) for meter, bar in in_bars):
            text = "the beat is no whole number of pairs to swing; expected a shorter swing_unit"
            self.faults.add(self.timing.swing_path, text)


def _bars(meters: Sequence[MeterChange], count: int) -> tuple[MeterChange, ...]:
    """The bars of one repetition, their meters taken in turn."""
    bars: list[MeterChange] = []
    tick = 0
    for i in range(count):
        bars.append(replace(meters[i % len(meters)], tick=tick))
        tick += bars[-1].bar_ticks
    return tuple(bars)
