"""Everything that can be done to a lesson while it is written: `LessonEdit`, a closed set of plain values.

Mouse, keyboard, kit and forms all make these, so that the same music comes of all of them. Places in the music are a
grid of the text, a bar of it as written, and a tick from the bar's start as it is written (straight, before any swing).
Bars, grids and cycles count from 0 in the order of the text.
"""

from dataclasses import dataclass
from enum import StrEnum

from station.core.pieces import Limb, Piece
from station.core.toml.toml_places import KeyPath

REST = "-"
"""The letter that erases."""


@dataclass(frozen=True, slots=True)
class LineAt:
    """A line of a grid: of a piece, by `limb` where the line stands in that limb's table, of a `cycle` or of none."""

    grid: int
    piece: Piece
    limb: Limb = Limb.UNKNOWN
    cycle: int | None = None


class TextLine(StrEnum):
    """The lines of a grid that no piece plays."""

    STICKING = "sticking"
    LOUDNESS = "loudness"


@dataclass(frozen=True, slots=True)
class SetStroke:
    """Write `letter` (of `tab_symbols`, `REST` erases) at `tick` of `bar`; the bar is cut finer where it must be.

    A line that is not there is made; one that a variation takes over from its model becomes the variation's own.
    """

    line: LineAt
    bar: int
    tick: int
    letter: str


@dataclass(frozen=True, slots=True)
class SetSign:
    """Write a hand (R, L, B) or a loudness mark ("mf", "<") at `tick` of `bar`; `REST` takes it away."""

    grid: int
    line: TextLine
    bar: int
    tick: int
    sign: str


@dataclass(frozen=True, slots=True)
class CutBeat:
    """Cut a beat (from 0, of the beat that `(…)` fills) of one line, or of all lines, into `cells`.

    With `beat` None all beats of the bar are cut. Strokes that have no cell of the new ones go to the nearest.
    """

    grid: int
    bar: int
    beat: int | None
    cells: int
    line: LineAt | None = None


@dataclass(frozen=True, slots=True)
class AddLine:
    """A line of rests for a piece."""

    line: LineAt


@dataclass(frozen=True, slots=True)
class RemoveLine:
    """Take a line away."""

    line: LineAt | TextLine
    grid: int


@dataclass(frozen=True, slots=True)
class AddBars:
    """`count` bars of rests before bar `at` of a grid, at its end where `at` is its number of bars."""

    grid: int
    at: int
    count: int = 1


@dataclass(frozen=True, slots=True)
class RemoveBars:
    """Take bars `first` to `last` of a grid away."""

    grid: int
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class CopyBars:
    """Bars `first` to `last` of `grid` once more before bar `at` of grid `to`; in the place of as many with `over`.

    They are as they stand; where there is a `text`, as they stand in that, this lesson's as it was or another's.
    """

    grid: int
    first: int
    last: int
    to: int
    at: int
    over: bool = False
    text: str = ""


@dataclass(frozen=True, slots=True)
class AddGrid:
    """A grid called `name` after grid `after`: a variation of grid `like`, or a bar of rests where that is None."""

    name: str
    after: int
    like: int | None = None


@dataclass(frozen=True, slots=True)
class RemoveGrid:
    """Take a grid away, out of the form too; its variations become grids of their own."""

    grid: int


@dataclass(frozen=True, slots=True)
class SetKey:
    """Set the key at `path` of the text, such as ("goals", "level") or ("grid", 1, "times"); None takes it away.

    Grids have their index even where there is only one. `value` is what TOML can say.
    """

    path: KeyPath
    value: object


@dataclass(frozen=True, slots=True)
class Fold:
    """Leave strokes on these pieces alone; what stood on others goes to the nearest of them."""

    pieces: frozenset[Piece]


@dataclass(frozen=True, slots=True)
class PlayedStroke:
    """A stroke as it was played into a grid: `at_ticks` from the start of its first bar, and the letter it makes.

    `at_ticks` may be negative: a stroke just before the first beat.
    """

    line: LineAt
    at_ticks: float
    letter: str
    velocity: int


@dataclass(frozen=True, slots=True)
class Quantise:
    """How times are brought to the grid: `cells` a beat, `strength` 0–1 of the way, the grid's own swing.

    With `keeps_timing` what is left of the way is written as the stroke's own timing; without it is dropped.
    """

    cells: int = 4
    strength: float = 1.0
    keeps_timing: bool = False


@dataclass(frozen=True, slots=True)
class PlayIn:
    """Write what was played over bars `first` to `last` of a grid, `over` what stood there or beside it."""

    grid: int
    first: int
    last: int
    strokes: tuple[PlayedStroke, ...]
    quantise: Quantise = Quantise()
    over: bool = False


@dataclass(frozen=True, slots=True)
class SetText:
    """Another text altogether, as somebody typed it; it may have faults."""

    text: str


LessonEdit = (
    SetStroke
    | SetSign
    | CutBeat
    | AddLine
    | RemoveLine
    | AddBars
    | RemoveBars
    | CopyBars
    | AddGrid
    | RemoveGrid
    | SetKey
    | Fold
    | PlayIn
    | SetText
)
