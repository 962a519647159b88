"""Cycles: lines of another meter that begin with the grid and run on over its bars and repetitions (poly-meter)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from station.core.pieces import Ornament
from station.core.toml.schema import Fields, checked_values, needed
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.grid.cell_strokes import BarClock, CellPlace, WrittenCell
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_lines import LINES, RawLine, lines_of_table, plain_line
from station.drills.grid.grid_timing import meter
from station.drills.grid.line_group import CellCount, agreed_bars, joined_strokes, parsed
from station.drills.grid.sticking_line import STICKING
from station.music.tempo import MeterChange

CYCLE: Fields = {"meter": needed(meter, 'the meter of the cycle, such as meter = "5/8"'), **LINES}


@dataclass(frozen=True, slots=True)
class Cycle:
    """The lines of one `[[grid.cycle]]`; one round of them has bars of `meter`."""

    meter: MeterChange
    lines: Sequence[RawLine]
    sticking: RawLine | None
    are_all: bool = True


def read_cycles(raw: object, path: KeyPath, faults: Faults) -> list[Cycle]:
    """The cycles of a grid; `path` is that of the key `cycle` in the file, faults are noted in full."""
    if raw is None:
        return []
    if not isinstance(raw, list):
        return _read_cycle(raw, path, faults)
    return [cycle for i, each in enumerate(raw) for cycle in _read_cycle(each, (*path, i), faults)]


def _read_cycle(raw: object, path: KeyPath, faults: Faults) -> list[Cycle]:
    """One cycle, or none where it cannot be read."""
    values, found = checked_values(raw, CYCLE, "line")
    lines = lines_of_table(values, path, found)
    if not lines and not found:
        found.miss((), 'has no line to play; expected one such as cowbell = "x--x-"')
    are_all = not found
    faults.merge(found, *path)
    if not lines or values["meter"] is None:
        return []
    return [Cycle(values["meter"], lines, plain_line(values, STICKING, path), are_all)]


def cycle_strokes(
    cycle: Cycle, beat_ticks: int, clock: BarClock, end_tick: int, faults: Faults, count: CellCount
) -> list[WrittenCell]:
    """The strokes of a cycle from tick 0, round after round, cut off at `end_tick`; it swings as the grid does."""
    frames = [GridFrame(cycle.meter, beat_ticks)]
    lines = [parsed(raw, frames, faults) for raw in cycle.lines]
    under = None if cycle.sticking is None else parsed(cycle.sticking, frames, faults)
    beside = [under] if under else []
    bars = agreed_bars([*lines, *beside], faults)
    length = cycle.meter.bar_ticks
    rounds = -(-end_tick // (bars * length))
    count.add([*lines, *beside], rounds)
    strokes: list[WrittenCell] = []
    for number in range(rounds):
        starts = [(number * bars + bar) * length for bar in range(bars)]
        strokes += joined_strokes(lines, under, starts, clock, faults, are_all=cycle.are_all)
    return [_cut(stroke, end_tick) for stroke in strokes if stroke.place.straight < end_tick]


def _cut(stroke: WrittenCell, end_tick: int) -> WrittenCell:
    """The stroke without what would come after `end_tick`."""
    until = stroke.until
    if until is not None and until.straight > end_tick:
        stroke = replace(stroke, until=CellPlace(end_tick, end_tick))
    if stroke.is_open_roll and stroke.middle.straight >= end_tick:
        stroke = replace(stroke, letter=replace(stroke.letter, ornament=Ornament.NONE))
    return stroke


def by_repetition(strokes: Sequence[WrittenCell], length_ticks: int, times: int) -> list[list[WrittenCell]]:
    """The strokes of each repetition of `length_ticks`, their ticks counted from its start."""
    found: list[list[WrittenCell]] = [[] for _ in range(times)]
    for stroke in strokes:
        number = stroke.place.straight // length_ticks
        found[number].append(stroke.moved(-number * length_ticks))
    return found
