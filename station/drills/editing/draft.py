"""A lesson's text while it is edited: what it says, where that stands, and the lines of its grids as they are written.

A draft may have faults; only its TOML must be sound. Grids count from 0 even where there is one `[grid]` alone.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from station.core.errors import BadInput
from station.core.pieces import USUAL_FEET, Limb, Piece
from station.core.toml.toml_edits import spliced, with_value
from station.core.toml.toml_faults import Faults, Wrong
from station.core.toml.toml_places import KeyPath, Places
from station.core.toml.toml_source import load
from station.core.toml.toml_write import toml_text
from station.drills.editing.lesson_edits import LineAt, TextLine
from station.drills.editing.line_words import bar_total
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_timing import GridTiming, meter
from station.drills.grid.line_group import MAX_BARS, MAX_CELLS
from station.drills.grid.lines_from_score import line_height
from station.drills.grid.tab_symbols import LIMB_TABLES, LINE_PIECES
from station.drills.reading.form import WrittenGrid, home_of, written_grids
from station.drills.reading.lesson_fields import FIELDS
from station.drills.writing.lesson_text import plain
from station.drills.writing.written_meters import written_timings

CYCLE = "cycle"
_LONGEST = 2 * MAX_CELLS
"""Letters of a text that is edited by place: twice the cells of the longest lesson, for bar lines, blanks and words."""
_KEPT = 8
"""Texts that are kept as they were read: an edit begins with what the last one left and the page has shown."""


@dataclass(frozen=True, slots=True)
class DraftLine:
    """A line of a grid: `path` is where it would stand in the grid itself, `text` what it says there.

    `is_own` is false where a variation takes it over.
    """

    at: LineAt | TextLine
    path: KeyPath
    text: str
    is_own: bool

    @property
    def piece(self) -> Piece | None:
        """The piece that plays it; None of a line of signs."""
        return self.at.piece if isinstance(self.at, LineAt) else None

    @property
    def cycle(self) -> int | None:
        """The cycle that it stands in, if any."""
        return self.at.cycle if isinstance(self.at, LineAt) else None

    @property
    def height(self) -> tuple[int, int, str]:
        """Lines from the top of the page to its foot, those of cycles below all others."""
        names = [key for key in self.path[-2:] if isinstance(key, str) and key not in ("grid", CYCLE)]
        return (-1 if self.cycle is None else self.cycle, *line_height(".".join(names)))


@dataclass(frozen=True, eq=False)
class Draft:
    """A text whose TOML is sound, and what it says."""

    text: str
    raw: Mapping[str, Any]

    @classmethod
    def of(cls, text: str) -> "Draft":
        """The draft of a text; raises `BadInput`, which names no file, where it is no TOML."""
        return _draft(plain(text))

    def refused(self, fault: str, place: str = "") -> BadInput:
        """What is raised for an edit that cannot be done; it names no file."""
        return BadInput("", place, fault)

    @cached_property
    def places(self) -> Places:
        """Where everything stands."""
        return Places.of(self.text)

    @cached_property
    def grids(self) -> tuple[WrittenGrid, ...]:
        """The grids with what they take over; none where they cannot be told apart."""
        try:
            return tuple(written_grids(self.raw["grid"], Faults())) if "grid" in self.raw else ()
        except Wrong:
            return ()

    @cached_property
    def timings(self) -> tuple[GridTiming, ...]:
        """The meters, beat and swing of each grid."""
        return written_timings(self.raw, self.grids)

    def table(self, grid: int) -> Mapping[str, Any]:
        """What a grid says, with what it takes over; raises `BadInput` where there is no such grid."""
        if not 0 <= grid < len(self.grids) or not isinstance(self.grids[grid].raw, dict):
            raise self.refused(f"there is no grid {grid + 1}; the lesson has {len(self.grids)}")
        raw = self.grids[grid].raw
        assert isinstance(raw, dict)
        return raw

    def frame(self, grid: int, bar: int, cycle: int | None = None) -> GridFrame:
        """What the cells of a bar divide."""
        timing = self.timings[grid]
        if cycle is not None:
            return GridFrame(self.cycle_meters(grid)[cycle], timing.beat_ticks)
        return GridFrame(timing.meters[bar % len(timing.meters)], timing.beat_ticks)

    def frames(self, grid: int) -> list[GridFrame]:
        """What the cells of each bar of a grid divide."""
        return [self.frame(grid, bar) for bar in range(self.bar_count(grid))]

    def cycle_tables(self, grid: int) -> list[tuple[KeyPath, Mapping[str, Any]]]:
        """The cycles of a grid, each with its path below the grid."""
        cycles = self.table(grid).get(CYCLE, [])
        if isinstance(cycles, dict):
            return [((CYCLE,), cycles)]
        entries = enumerate(cycles) if isinstance(cycles, list) else ()
        return [((CYCLE, i), each) for i, each in entries if isinstance(each, dict)]

    def cycle_meters(self, grid: int) -> list[Any]:
        """The meter of each cycle; that of the grid's first bar where the text has a wrong one."""
        found = []
        for _, table in self.cycle_tables(grid):
            try:
                found.append(meter(table.get("meter")))
            except Wrong:
                found.append(self.timings[grid].meters[0])
        return found

    def bar_count(self, grid: int, cycle: int | None = None) -> int:
        """The bars that most lines of a grid or cycle have, as the reader counts; those that it says where none are."""
        lines = [line for line in self.lines(grid) if line.cycle == cycle]
        counts = Counter(bar_total(line.text) for line in lines)
        said = self.table(grid).get("bars") if cycle is None else None
        usual = said if type(said) is int and said > 0 else 1
        return max(counts, key=lambda n: (counts[n], n), default=usual)

    def check_length(self) -> None:
        """Raise `BadInput` where a line has more bars than any lesson."""
        for grid in (i for i, each in enumerate(self.grids) if isinstance(each.raw, dict)):
            if (bars := max((bar_total(line.text) for line in self.lines(grid)), default=0)) > MAX_BARS:
                raise self.refused(f"{bars} bars in a line; a lesson has at most {MAX_BARS}")

    def lines(self, grid: int) -> list[DraftLine]:
        """All lines of a grid, those of its cycles last."""
        table = self.table(grid)
        found = [self._line(grid, at, rel, text) for at, rel, text in _lines_of(table, grid, None, ())]
        for number, (rel, cycle) in enumerate(self.cycle_tables(grid)):
            lines = _lines_of(cycle, grid, number, rel)
            found += [self._line(grid, at, path, text) for at, path, text in lines if isinstance(at, LineAt)]
        return found

    def _line(self, grid: int, at: LineAt | TextLine, rel: KeyPath, text: str) -> DraftLine:
        path = (*self.grids[grid].path, *rel)
        return DraftLine(at, path, text, home_of(path, self.grids[grid], self.grids) == path)

    def line(self, at: LineAt | TextLine, grid: int) -> DraftLine | None:
        """The line that `at` means; None where the grid has none."""
        return next((line for line in self.lines(grid) if same_line(line.at, at)), None)

    def followers(self, grid: int) -> list[int]:
        """The grids that are like this one, or like one of those, in the order of the text."""
        found = {grid}
        for i, each in enumerate(self.grids):
            if each.like in found:
                found.add(i)
        return sorted(found - {grid})

    def with_lines(self, texts: Mapping[KeyPath, str]) -> "Draft":
        """The draft with other texts in lines that stand in it."""
        edits = [
            (self.places.values[path], self.places.ends[path], quoted(line, self.text[self.places.values[path]]))
            for path, line in texts.items()
        ]
        return self.now(spliced(self.text, edits))

    def with_key(self, path: KeyPath, value: object) -> "Draft":
        """The draft with the value at a path; raises `BadInput` where that leads through what is no table."""
        try:
            return self.now(with_value(self.text, path, value, tuple(FIELDS)))
        except KeyError:
            place = ".".join(str(key) for key in path)
            raise self.refused("there is no such table or list to write it in", place) from None

    def now(self, text: str) -> "Draft":
        """Another text of the same lesson."""
        return self if text == self.text else Draft.of(text)


@lru_cache(maxsize=_KEPT)
def _draft(text: str) -> Draft:
    if len(text) > _LONGEST:
        raise BadInput("", "", f"{len(text)} letters; a text of more than {_LONGEST} is edited as text alone")
    raw, _, faults = load(text)
    if faults:
        line, column, fault = faults[0]
        raise BadInput("", f"line {line}, column {column}", f"{fault}; mend the text first")
    return Draft(text, raw)


def same_line(one: LineAt | TextLine, other: LineAt | TextLine) -> bool:
    """Whether both mean one line: that of a foot's own piece is the foot's, whether the text says so or not."""
    if isinstance(one, LineAt) and isinstance(other, LineAt):
        return (one.piece, one.cycle, _whose(one)) == (other.piece, other.cycle, _whose(other))
    return one is other


def _whose(line: LineAt) -> Limb:
    return USUAL_FEET.get(line.piece, Limb.UNKNOWN) if line.limb is Limb.UNKNOWN else line.limb


def quoted(line: str, quote: str) -> str:
    """A line as TOML writes it: in the given quotes, in three of them where it has several rows."""
    if any(sign in line for sign in "\"'\\") or not all(sign.isprintable() or sign == "\n" for sign in line):
        return toml_text(line)
    rows = line.strip("\n")
    return f"{quote * 3}\n{rows}\n{quote * 3}" if "\n" in rows else f"{quote}{rows}{quote}"


def _lines_of(
    table: Mapping[str, Any], grid: int, cycle: int | None, rel: KeyPath
) -> Iterator[tuple[LineAt | TextLine, KeyPath, str]]:
    """The lines of a table: of pieces, of limbs, of signs."""
    for key, value in table.items():
        if key in LINE_PIECES and isinstance(value, str):
            yield LineAt(grid, LINE_PIECES[key], Limb.UNKNOWN, cycle), (*rel, key), value
        elif key in LIMB_TABLES and isinstance(value, dict):
            yield from (
                (LineAt(grid, LINE_PIECES[name], LIMB_TABLES[key], cycle), (*rel, key, name), text)
                for name, text in value.items()
                if name in LINE_PIECES and isinstance(text, str)
            )
        elif key in tuple(TextLine) and isinstance(value, str):
            yield TextLine(key), (*rel, key), value


def pieces_of(lines: list[DraftLine]) -> set[Piece]:
    """The pieces that these lines play."""
    return {line.at.piece for line in lines if isinstance(line.at, LineAt)}
