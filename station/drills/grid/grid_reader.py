"""Reading one `[grid]` table: its meter, tempo and name, its lines, and the strokes that they write."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

from station.core.pieces import Limb, Piece, word
from station.core.schema import Field, Fields, Reader, anything, checked_values, number, optional, shown, title, whole
from station.core.toml_faults import Faults, wrong
from station.core.toml_places import KeyPath
from station.core.units import PPQ
from station.drills.grid.cell_strokes import GridLine, WrittenCell, line_strokes
from station.drills.grid.grid import Bar, GridFrame, Report, parse_line
from station.drills.grid.sticking_line import STICKING, apply_sticking
from station.drills.grid.tab_symbols import FOOT_OF, LIMB_TABLES, LINE_PIECES
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange

MAX_TIMES = 100
MAX_BEATS = 32
UNITS = (1, 2, 4, 8, 16, 32)
MAX_BARS = 2000
"""Our choice: no lesson is an hour long; a longer one is a slip of the finger."""
MAX_CELLS = 200_000
"""Letters of all lines, repeated bars too, that are read within half a second: five lines of 800 bars of 48 (our
choice)."""


@dataclass(frozen=True, slots=True)
class CellTiming:
    """Tempo in quarter notes a minute, meter (its tick is 0) and beat, as one section hands them to the next."""

    tempo_bpm: float
    meter: MeterChange
    beat_ticks: int


@dataclass(frozen=True, slots=True)
class GridSection:
    """One grid, read: `strokes` stand where the score will have them; `bars` counts repetitions too."""

    name: str
    timing: CellTiming
    start_tick: int
    bars: int
    strokes: tuple[WrittenCell, ...]

    @property
    def end_tick(self) -> int:
        """Where the next section starts."""
        return self.start_tick + self.bars * self.timing.meter.bar_ticks


# --- the schema -------------------------------------------------------------------------------------------------------


def meter(value: object) -> MeterChange:
    """A meter such as "6/8"; its tick is 0."""
    beats, unit = _fraction(value)
    if not 1 <= beats <= MAX_BEATS or unit not in UNITS:
        raise wrong(f"expected a meter of 1 to {MAX_BEATS} beats of 1/1 to 1/32, such as 4/4 or 6/8")
    return MeterChange(0, beats, unit)


def note_length(value: object) -> int:
    """Ticks of a note length such as "1/4" or "3/8"."""
    top, bottom = _fraction(value)
    if not 1 <= top <= 3 or bottom not in UNITS:
        raise wrong('expected a note length such as "1/4", "1/8" or "3/8" (a dotted quarter)')
    return 4 * PPQ * top // bottom


def _fraction(value: object) -> tuple[int, int]:
    """Two whole numbers such as "6/8"."""
    top, slash, bottom = value.partition("/") if isinstance(value, str) else ("", "", "")
    if not (slash and top.strip().isdecimal() and bottom.strip().isdecimal() and len(top + bottom) < 8):
        raise wrong(f'expected two numbers such as "4/4", found {shown(value)}')
    return int(top), int(bottom)


def _cells(value: object) -> str:
    """A line of the grid."""
    if not isinstance(value, str) or not value.strip():
        raise wrong('expected a line of the grid in quotes, such as "o---o---"')
    return value


def _cells_of(piece: Piece, limb: Limb) -> Reader[str]:
    """A line that one limb plays alone."""

    def read(value: object) -> str:
        if piece in _PEDALS and limb.is_hand:
            raise wrong(f"a hand plays no {_PEDALS[piece]}; expected right_foot or left_foot")
        if piece not in _PEDALS and not limb.is_hand:
            raise wrong(f"a foot plays no {word(piece)}; expected right_hand or left_hand")
        return _cells(value)

    return read


_PEDALS = {Piece.KICK: "kick", Piece.HIHAT_PEDAL: "pedal"}
TIMING: Fields = {
    "tempo_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "meter": optional(meter),
    "beat": optional(note_length),
}
"""What a lesson says for all its grids, and each grid for itself and those after it."""
_LINES: Fields = {key: optional(_cells) for key in LINE_PIECES}
_LIMB_LINES: Mapping[str, Fields] = {
    name: {key: optional(_cells_of(piece, limb)) for key, piece in LINE_PIECES.items()}
    for name, limb in LIMB_TABLES.items()
}
_GRID: Fields = {
    "name": Field(title, ""),
    **TIMING,
    "times": Field(whole(1, MAX_TIMES), 1),
    STICKING: optional(_cells),
    **{name: optional(anything) for name in LIMB_TABLES},
    **_LINES,
}


# --- reading ----------------------------------------------------------------------------------------------------------


def timing_of(values: Mapping[str, Any], before: CellTiming, faults: Faults) -> CellTiming:
    """Meter, beat and tempo as a table says them, and as it was `before` where it does not."""
    beat_ticks = before.beat_ticks if values["beat"] is None else values["beat"]
    tempo, beats = before.tempo_bpm, values["tempo_bpm"]
    if beats is not None:
        asked = beats * beat_ticks / PPQ
        if MIN_BPM <= asked <= MAX_BPM:
            tempo = asked
        else:
            faults.add(("tempo_bpm",), f"{asked:g} quarter notes a minute; expected {MIN_BPM:g} to {MAX_BPM:g}")
    return CellTiming(tempo, before.meter if values["meter"] is None else values["meter"], beat_ticks)


def read_grid(raw: object, path: KeyPath, before: "CellTiming | GridSection", faults: Faults) -> GridSection:
    """One grid after `before`: the lesson's own timing, or the section that precedes it."""
    start = before.end_tick if isinstance(before, GridSection) else 0
    values, found = checked_values(raw, _GRID, "line")
    timing = timing_of(values, before.timing if isinstance(before, GridSection) else before, found)
    lines = _lines(values, path, found)
    if not lines and not found:
        found.add((), 'no line to play; expected one such as snare = "----o-------o---"', at_key=True)
    faults.merge(found, *path)
    _no_twins(lines, faults)
    under = values[STICKING]
    sticking = None if under is None else _RawLine(GridLine(Piece.SNARE, Limb.UNKNOWN, (*path, STICKING)), under)
    return _Builder(timing, start, values["times"], lines, sticking, faults).section(values["name"])


@dataclass(frozen=True, slots=True)
class _RawLine:
    line: GridLine
    text: str


def _lines(values: Mapping[str, Any], path: KeyPath, faults: Faults) -> list[_RawLine]:
    """The lines of pieces of the grid at `path`, then those under limb tables."""
    found = [
        _RawLine(GridLine(piece, FOOT_OF.get(piece, Limb.UNKNOWN), (*path, key)), values[key])
        for key, piece in LINE_PIECES.items()
        if values[key] is not None
    ]
    for name, limb in LIMB_TABLES.items():
        if values[name] is None:
            continue
        own, inner = checked_values(values[name], _LIMB_LINES[name], "line")
        faults.merge(inner, name)
        found += [
            _RawLine(GridLine(piece, limb, (*path, name, key)), own[key])
            for key, piece in LINE_PIECES.items()
            if own[key] is not None
        ]
    return found


def _no_twins(lines: list[_RawLine], faults: Faults) -> None:
    seen: dict[tuple[Piece, Limb], GridLine] = {}
    for raw in lines:
        twin = seen.setdefault((raw.line.piece, raw.line.limb), raw.line)
        if twin is not raw.line:
            faults.add(raw.line.path, f"{raw.line.path[-1]} and {twin.path[-1]} are one line", at_key=True)


@dataclass(slots=True)
class _Builder:
    """Puts the lines of one grid together."""

    timing: CellTiming
    start_tick: int
    times: int
    lines: list[_RawLine]
    sticking: _RawLine | None
    faults: Faults

    def section(self, name: str) -> GridSection:
        frame = GridFrame(self.timing.meter, self.timing.beat_ticks)
        parsed = [(raw, parse_line(raw.text, frame, self._report(raw.line))) for raw in self.lines]
        under = parse_line(self.sticking.text, frame, self._report(self.sticking.line)) if self.sticking else []
        count = self._bar_count(parsed, under)
        cells = sum(len(bar.cells) for _, bars in parsed for bar in bars[:count]) * self.times
        if cells > MAX_CELLS:
            raise wrong(f"{cells} cells; a lesson has at most {MAX_CELLS}", *self.lines[0].line.path)
        length = self.timing.meter.bar_ticks
        places = [(self.start_tick + i * length, length) for i in range(count * self.times)]
        before = len(self.faults)
        strokes = list(
            chain.from_iterable(
                line_strokes(bars * self.times, places, raw.line, self._report(raw.line)) for raw, bars in parsed
            )
        )
        unsure = _unsure_bars([bars for _, bars in parsed], count, self.times, all_bars=len(self.faults) > before)
        if self.sticking:
            report = self._report(self.sticking.line)
            strokes = apply_sticking(under * self.times, [s for s, _ in places], strokes, report, unsure)
        return GridSection(name, self.timing, self.start_tick, count * self.times, tuple(strokes))

    def _report(self, line: GridLine) -> Report:
        return lambda char, text: self.faults.add(line.path, text, char)

    def _bar_count(self, parsed: list[tuple[_RawLine, list[Bar]]], under: list[Bar]) -> int:
        """The bars of the longest line; every other line must have as many."""
        everyone = [*parsed, *([(self.sticking, under)] if self.sticking else [])]
        longest = max(everyone, key=lambda p: len(p[1]), default=None)
        if longest is None:
            return 1
        count = len(longest[1])
        if count * self.times > MAX_BARS:
            self.faults.add(longest[0].line.path, f"{count * self.times} bars; a lesson has at most {MAX_BARS}")
            count = 1
        for raw, bars in everyone:
            if len(bars) < count:
                have = f"{len(bars)} bar{'s' * (len(bars) != 1)}, but {longest[0].line.path[-1]} has {count}"
                self.faults.add(raw.line.path, f"{have}; % repeats a bar, - is a bar's rest", len(raw.text))
        return count


def _unsure_bars(lines: list[list[Bar]], count: int, times: int, all_bars: bool) -> frozenset[int]:
    """The bars, repetitions counted, in which some line's strokes are not known."""
    bad = {i for bars in lines for i in range(count) if all_bars or i >= len(bars) or not bars[i].sound}
    return frozenset(i + count * k for i in bad for k in range(times))
