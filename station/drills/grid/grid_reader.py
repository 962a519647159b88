"""Reading one `[grid]` table: its meter, tempo and name, its lines, and the strokes that they write."""

from dataclasses import dataclass
from itertools import chain

from station.core.did_you_mean import nearest
from station.core.pieces import Limb, Piece, word
from station.core.toml_places import KeyPath
from station.core.units import PPQ
from station.drills.faults import Faults
from station.drills.grid.cell_strokes import GridLine, WrittenCell, line_strokes
from station.drills.grid.grid import Bar, GridFrame, Report, parse_line
from station.drills.grid.sticking_line import STICKING, apply_sticking
from station.drills.grid.tab_symbols import FOOT_OF, LIMB_TABLES, LINE_PIECES
from station.drills.table import Table, fraction, number, title, whole
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange

MAX_TIMES = 100
MAX_BEATS = 32
UNITS = (1, 2, 4, 8, 16, 32)
MAX_BARS = 2000
"""Our choice: no lesson is an hour long; a longer one is a slip of the finger."""

_GRID_KEYS = ("name", "tempo_bpm", "meter", "beat", "times", STICKING, *LIMB_TABLES)


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


def meter(value: object) -> MeterChange:
    """A meter such as "6/8"; its tick is 0."""
    beats, unit = fraction(value)
    if not 1 <= beats <= MAX_BEATS or unit not in UNITS:
        raise ValueError(f"expected a meter of 1 to {MAX_BEATS} beats of 1/1 to 1/32, such as 4/4 or 6/8")
    return MeterChange(0, beats, unit)


def note_length(value: object) -> int:
    """Ticks of a note length such as "1/4" or "3/8"."""
    top, bottom = fraction(value)
    if not 1 <= top <= 3 or bottom not in UNITS:
        raise ValueError('expected a note length such as "1/4", "1/8" or "3/8" (a dotted quarter)')
    return 4 * PPQ * top // bottom


def read_timing(table: Table, before: CellTiming) -> CellTiming:
    """Meter, beat and tempo as this table says them, and as it was `before` where it does not."""
    new_meter = table.take("meter", meter, before.meter)
    beat_ticks = table.take("beat", note_length, before.beat_ticks)
    tempo = before.tempo_bpm
    if table.has("tempo_bpm"):
        beats = table.take("tempo_bpm", number(MIN_BPM, MAX_BPM), tempo * PPQ / beat_ticks)
        asked = beats * beat_ticks / PPQ
        if MIN_BPM <= asked <= MAX_BPM:
            tempo = asked
        else:
            table.fault("tempo_bpm", f"{asked:g} quarter notes a minute; expected {MIN_BPM:g} to {MAX_BPM:g}")
    return CellTiming(tempo, new_meter, beat_ticks)


def read_grid(raw: object, path: KeyPath, before: "CellTiming | GridSection", faults: Faults) -> GridSection:
    """One grid after `before`: the lesson's own timing, or the section that precedes it."""
    table = Table(raw, path, faults)
    start = before.end_tick if isinstance(before, GridSection) else 0
    timing = read_timing(table, before.timing if isinstance(before, GridSection) else before)
    name = table.take("name", title, "")
    times = table.take("times", whole(1, MAX_TIMES), 1)
    lines, sticking = _lines(table)
    table.allow(k for k in LINE_PIECES if k in table.raw)
    _close(table)
    if table.is_table and not lines:
        faults.add(path, 'no line to play; expected one such as snare = "----o-------o---"', at_key=True)
    return _Builder(timing, start, times, lines, sticking, faults).section(name)


@dataclass(frozen=True, slots=True)
class _RawLine:
    line: GridLine
    text: str


def _lines(table: Table) -> tuple[list[_RawLine], _RawLine | None]:
    """The lines of pieces, those under limb tables too, and the sticking line."""
    found = [
        raw_line
        for key, piece in LINE_PIECES.items()
        if (raw_line := _raw_line(table, key, GridLine(piece, FOOT_OF.get(piece, Limb.UNKNOWN), (*table.path, key))))
    ]
    for name, limb in LIMB_TABLES.items():
        if table.has(name):
            inner = Table(table.raw[name], (*table.path, name), table.faults)
            for key, piece in LINE_PIECES.items():
                raw_line = _raw_line(inner, key, GridLine(piece, limb, (*inner.path, key)))
                if raw_line:
                    _check_limb(inner, key, raw_line.line)
                    found.append(raw_line)
            inner.allow(k for k in LINE_PIECES if k in inner.raw)
            _close(inner)
    _no_twins(found, table.faults)
    return found, _raw_line(table, STICKING, GridLine(Piece.SNARE, Limb.UNKNOWN, (*table.path, STICKING)))


def _raw_line(table: Table, key: str, line: GridLine) -> _RawLine | None:
    if not table.has(key):
        return None
    value = table.raw[key]
    if isinstance(value, str) and value.strip():
        return _RawLine(line, value)
    table.fault(key, f'{key}: expected a line of the grid in quotes, such as "o---o---"')
    return None


def _check_limb(table: Table, key: str, line: GridLine) -> None:
    if line.piece is Piece.HIHAT_PEDAL and line.limb.is_hand:
        table.fault(key, "a hand plays no pedal; expected right_foot or left_foot")
    elif line.piece is not Piece.KICK and line.piece is not Piece.HIHAT_PEDAL and not line.limb.is_hand:
        table.fault(key, f"a foot plays no {word(line.piece)}; expected right_hand or left_hand")
    elif line.piece is Piece.KICK and line.limb.is_hand:
        table.fault(key, "a hand plays no kick; expected right_foot or left_foot")


def _no_twins(lines: list[_RawLine], faults: Faults) -> None:
    seen: dict[tuple[Piece, Limb], GridLine] = {}
    for raw in lines:
        twin = seen.setdefault((raw.line.piece, raw.line.limb), raw.line)
        if twin is not raw.line:
            faults.add(raw.line.path, f"{raw.line.path[-1]} and {twin.path[-1]} are one line", at_key=True)


def _close(table: Table) -> None:
    """Note unknown keys; the nearest may be a piece."""
    known = [*LINE_PIECES, *(_GRID_KEYS if table.path[-1] not in LIMB_TABLES else ())]
    for key in table.raw:
        if key not in known:
            hint = nearest(key, known) or f"; the lines are {', '.join(LINE_PIECES)}"
            table.faults.add((*table.path, key), f"no such line: {key}{hint}", at_key=True)


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
