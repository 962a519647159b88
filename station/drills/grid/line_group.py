"""Lines that run together in one meter: parsed, counted, and turned into strokes with their hands."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from station.core.toml.toml_faults import Faults, wrong
from station.drills.grid.cell_strokes import BarClock, WrittenCell, line_strokes, parted
from station.drills.grid.grid import Bar, GridFrame, Report, parse_line
from station.drills.grid.grid_lines import RawLine
from station.drills.grid.sticking_line import apply_sticking
from station.drills.grid.stroke_timing import timed

MAX_BARS = 2000
"""Our choice: no lesson is an hour long; a longer one is a slip of the finger."""
MAX_CELLS = 200_000
"""Letters of all lines, repeated bars too, that are read within half a second: five lines of 800 bars of 48 (our
choice)."""


@dataclass(slots=True)
class ParsedLine:
    """The bars of one line, and the characters of it that were at fault.

    A line that is not `aligned` has more or fewer bars than the others: nobody knows which of theirs its bars go with.
    """

    raw: RawLine
    bars: list[Bar]
    bad_chars: set[int] = field(default_factory=set)
    aligned: bool = True

    def reporter(self, faults: Faults) -> Report:
        """Where the faults of this line go; each is told once, however often the line is played."""

        def report(char: int, text: str) -> None:
            if char not in self.bad_chars:
                self.bad_chars.add(char)
                faults.add(self.raw.line.path, text, char)

        return report

    def is_unsure(self, bar: int) -> bool:
        """Whether what it plays in `bar`, from 0, is not known."""
        if not self.aligned or not self.bars[bar].sound:
            return True
        return any(cell.char in self.bad_chars for cell in self.bars[bar].cells)


def parsed(raw: RawLine, frames: Sequence[GridFrame], faults: Faults) -> ParsedLine:
    """The bars of a line."""
    line = ParsedLine(raw, [])
    line.bars = parse_line(raw.text, frames, line.reporter(faults))
    return line


def agreed_bars(lines: Sequence[ParsedLine], faults: Faults) -> int:
    """The bars of most of the lines, of the longer ones where they are as many; a fault for each other line.

    A line with bars at fault is counted only where all are so; where it has but those too many, that is told already.
    """
    sound = [line for line in lines if all(bar.sound for bar in line.bars)]
    counts = Counter(len(line.bars) for line in sound or lines)
    count = max(counts, key=lambda n: (counts[n], n), default=1)
    model = next((line.raw.line for line in lines if len(line.bars) == count), None)
    for line in lines:
        have = len(line.bars)
        if have != count and model:
            text = f"{have} bar{'s' * (have != 1)}, but {model.path[-1]} has {count}"
            remedy = "% repeats a bar, - is a bar's rest" if have < count else "is a bar line too many?"
            if sum(bar.sound for bar in line.bars) != count:
                faults.add(line.raw.line.path, f"{text}; {remedy}", len(line.raw.text))
            line.aligned = False
    return count


@dataclass(slots=True)
class CellCount:
    """How many cells a lesson has so far: reading stops at more than anyone practises."""

    cells: int = 0

    def add(self, lines: Sequence[ParsedLine], times: int) -> None:
        """Count lines that are played `times` times; raises `Wrong` where the lesson has more cells than it may."""
        self.cells += sum(len(bar.cells) for line in lines for bar in line.bars) * times
        if self.cells > MAX_CELLS:
            raise wrong(f"{self.cells} cells; a lesson has at most {MAX_CELLS}", *lines[0].raw.line.path)


def joined_strokes(
    lines: Sequence[ParsedLine],
    under: ParsedLine | None,
    starts: Sequence[int],
    clock: BarClock,
    faults: Faults,
    *,
    are_all: bool = True,
) -> list[WrittenCell]:
    """The strokes of lines whose bars begin at `starts`, with the hands that the sticking line `under` them says.

    `are_all` tells whether all lines of the table could be read; if not, a stroke may be missing anywhere.
    """
    strokes: list[WrittenCell] = []
    for line in lines:
        own = line_strokes(zip(starts, line.bars, strict=False), line.raw.line, clock, line.reporter(faults))
        if line.raw.timing and line.aligned and not any(map(line.is_unsure, range(len(line.bars)))):
            own = timed(own, line.raw.timing, str(line.raw.line.path[-1]), faults)
        strokes += own if line.aligned else []
    if under is None or not under.aligned:
        return strokes
    bars = range(len(starts))
    unsure = frozenset(bar for bar in bars if not are_all or any(line.is_unsure(bar) for line in lines))
    asked, beyond = parted(strokes)
    below = zip(starts, under.bars, strict=False)
    return [*beyond, *apply_sticking(below, clock, asked, under.reporter(faults), unsure)]
