"""From the cells of the lines to the strokes that a score holds.

A written stroke is one letter; a played one is a row of the score. A flam has one grace stroke before it, a drag two;
a diddle is two strokes that share its cell; a buzz roll is one row that lasts. Diddles that touch each other on a
piece make a roll. All ticks are straight until `expand` swings them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, Articulation, Dynamic, Limb, Ornament, Piece
from station.core.toml_places import KeyPath
from station.drills.grid.grid import Bar
from station.drills.grid.swing import Swing
from station.drills.grid.tab_symbols import CHOKE, HOLD, RESTS, SYMBOLS, TabSymbol, family_of, not_a_letter
from station.music.score import NOTE_DTYPE

FLAM_LEAD_MS = 30.0
"""Middle of a flam's 15–40 ms (HUMANS, Timing)."""
DRAG_LEADS_MS = (110.0, 55.0)
"""A drag's strokes follow each other 40–70 ms apart (HUMANS, Timing)."""
GRACE_SHARE = 0.4
"""A grace stroke's velocity as a share of its main stroke's, in the middle of 25–50 % (HUMANS, Timing)."""
GRACE_LEADS_MS: Mapping[Ornament, tuple[float, ...]] = MappingProxyType(
    {Ornament.FLAM: (FLAM_LEAD_MS,), Ornament.DRAG: DRAG_LEADS_MS}
)

OTHER_HAND = MappingProxyType({Limb.RIGHT_HAND: Limb.LEFT_HAND, Limb.LEFT_HAND: Limb.RIGHT_HAND})


@dataclass(frozen=True, slots=True)
class Origin:
    """The letter in the file that wrote a stroke: its line's key path and its index there."""

    path: KeyPath
    char: int


@dataclass(frozen=True, slots=True)
class CellPlace:
    """A moment of the music: ticks into a bar that starts at `bar_start` and lasts `bar_ticks`."""

    bar_start: int
    bar_ticks: int
    tick: int
    swings: bool

    def played(self, swing: Swing) -> int:
        """Tick of the score at which it is played."""
        return self.bar_start + (swing.swung(self.tick, self.bar_ticks) if self.swings else self.tick)

    def later(self, ticks: int) -> "CellPlace":
        """The moment `ticks` straight ticks later in the same bar."""
        return replace(self, tick=self.tick + ticks)

    @property
    def straight(self) -> int:
        """Tick of the score if nothing swung."""
        return self.bar_start + self.tick


@dataclass(frozen=True, slots=True)
class WrittenCell:
    """One letter of a line; `until` is where a buzz roll ends or a cymbal is grabbed."""

    place: CellPlace
    length_ticks: int
    piece: Piece
    letter: TabSymbol
    limb: Limb
    origin: Origin
    until: CellPlace | None = None

    @property
    def is_open_roll(self) -> bool:
        """Whether this cell holds two strokes."""
        return self.letter.ornament is Ornament.DIDDLE


@dataclass(frozen=True, slots=True)
class Velocities:
    """The velocity of each dynamic: (ghost, normal, accent), with others for some pieces.

    The defaults are HUMANS' ranges: ghost 20–45, normal 60–95, accent 105–127.
    """

    usual: tuple[int, int, int] = (32, 80, 116)
    of_piece: Mapping[Piece, tuple[int, int, int]] = field(default_factory=lambda: MappingProxyType({}))

    def of(self, piece: Piece, dynamic: Dynamic) -> int:
        """Velocity 1–127 of a stroke of `piece`."""
        return self.of_piece.get(piece, self.usual)[dynamic]


# --- a line ----------------------------------------------------------------------------------------------------------


def line_strokes(
    bars: Sequence[Bar], bar_places: Sequence[tuple[int, int]], line: "GridLine", report: Callable[[int, str], None]
) -> list[WrittenCell]:
    """The strokes of one line; `bar_places` are each bar's start and length in ticks, faults go to `report`."""
    symbols = SYMBOLS[family_of(line.piece)]
    strokes: list[WrittenCell] = []
    open_end: CellPlace | None = None  # where a buzz that may go on has come to
    for bar, (start, length) in zip(bars, bar_places, strict=False):
        for cell in bar.cells:
            here = CellPlace(start, length, cell.tick, cell.swings)
            end = here.later(cell.length_ticks)
            if cell.letter == HOLD:
                open_end = _hold(strokes, open_end, end, cell.char, report)
                continue
            open_end = None
            if cell.letter == CHOKE:
                _choke(strokes, line.piece, here, cell.char, report)
            elif cell.letter in symbols:
                letter = symbols[cell.letter]
                is_buzz = letter.articulation is Articulation.BUZZ
                open_end = end if is_buzz else None
                strokes.append(
                    WrittenCell(
                        here, cell.length_ticks, line.piece, letter, line.limb, Origin(line.path, cell.char), open_end
                    )
                )
            elif cell.letter not in RESTS:
                report(cell.char, not_a_letter(cell.letter, family_of(line.piece)))
        if not bar.sound:
            open_end = None
    return strokes


@dataclass(frozen=True, slots=True)
class GridLine:
    """What a line is for: its piece, the limb that plays all of it (or UNKNOWN), and its key path in the file."""

    piece: Piece
    limb: Limb
    path: KeyPath


def _hold(
    strokes: list[WrittenCell],
    open_end: CellPlace | None,
    end: CellPlace,
    char: int,
    report: Callable[[int, str], None],
) -> CellPlace | None:
    if open_end is None:
        report(char, f"{HOLD} goes on with a buzz roll, and none stands right before it; expected b")
        return None
    strokes[-1] = replace(strokes[-1], until=end)
    return end


def _choke(
    strokes: list[WrittenCell], piece: Piece, here: CellPlace, char: int, report: Callable[[int, str], None]
) -> None:
    if piece not in CYMBALS:
        report(char, f"{CHOKE} grabs a ringing cymbal; this line has none")
    elif not strokes or strokes[-1].until is not None:
        report(char, f"{CHOKE} grabs the cymbal that this line struck before, and there is no stroke that still rings")
    else:
        strokes[-1] = replace(strokes[-1], until=here)


# --- all lines of a section ------------------------------------------------------------------------------------------


def rolls(strokes: Sequence[WrittenCell]) -> set[int]:
    """Indices of the diddles that touch another of the same piece, and so make a roll."""
    found: set[int] = set()
    by_piece: dict[Piece, list[int]] = {}
    for i, stroke in enumerate(strokes):
        if stroke.is_open_roll:
            by_piece.setdefault(stroke.piece, []).append(i)
    for diddles in by_piece.values():
        diddles.sort(key=lambda i: strokes[i].place.straight)
        for a, b in pairwise(diddles):
            if strokes[a].place.straight + strokes[a].length_ticks == strokes[b].place.straight:
                found |= {a, b}
    return found


def expand(
    strokes: Sequence[WrittenCell], velocities: Velocities, swing: Swing
) -> tuple[NDArray[np.void], list[Origin]]:
    """Rows of `NOTE_DTYPE` of all strokes, and beside each row the letter that wrote it."""
    in_rolls = rolls(strokes)
    rows: list[tuple[float, ...]] = []
    origins: list[Origin] = []
    for i, stroke in enumerate(strokes):
        if stroke.is_open_roll:
            made = _two_rows(stroke, velocities, swing, Ornament.ROLL if i in in_rolls else Ornament.DIDDLE)
        else:
            made = _rows(stroke, velocities, swing)
        rows += made
        origins += [stroke.origin] * len(made)
    return np.array(rows, NOTE_DTYPE), origins


def _two_rows(stroke: WrittenCell, velocities: Velocities, swing: Swing, ornament: Ornament) -> list[tuple[float, ...]]:
    """Both strokes of a diddle; an accent is the first one's alone."""
    second = replace(
        stroke,
        place=stroke.place.later(stroke.length_ticks // 2),
        letter=replace(stroke.letter, dynamic=Dynamic.NORMAL),
    )
    return [
        _row(s, s.place.played(swing), velocities.of(s.piece, s.letter.dynamic), ornament) for s in (stroke, second)
    ]


def _rows(stroke: WrittenCell, velocities: Velocities, swing: Swing) -> list[tuple[float, ...]]:
    """The grace strokes first, then the stroke itself."""
    tick = stroke.place.played(swing)
    velocity = velocities.of(stroke.piece, stroke.letter.dynamic)
    lasts = 0 if stroke.until is None else stroke.until.played(swing) - tick
    is_buzz = stroke.letter.articulation is Articulation.BUZZ
    main = _row(stroke, tick, velocity, stroke.letter.ornament, {"duration_ticks" if is_buzz else "choke_ticks": lasts})
    return [*_graces(stroke, tick, velocity), main]


def _graces(stroke: WrittenCell, tick: int, velocity: int) -> list[tuple[float, ...]]:
    grace = replace(
        stroke,
        limb=OTHER_HAND.get(stroke.limb, Limb.UNKNOWN),
        letter=replace(stroke.letter, dynamic=Dynamic.GHOST),
    )
    soft = max(1, round(velocity * GRACE_SHARE))
    return [
        _row(grace, tick, soft, stroke.letter.ornament, {"lead_ms": lead})
        for lead in GRACE_LEADS_MS.get(stroke.letter.ornament, ())
    ]


def _row(
    stroke: WrittenCell, tick: int, velocity: int, ornament: Ornament, more: Mapping[str, float] = MappingProxyType({})
) -> tuple[float, ...]:
    """One row; `more` holds the fields that most strokes leave at 0."""
    letter = stroke.letter
    values: dict[str, float] = {
        "tick": tick,
        "openness": np.nan if letter.openness is None else letter.openness,
        "piece": stroke.piece,
        "zone": letter.zone,
        "articulation": letter.articulation,
        "velocity": velocity,
        "dynamic": letter.dynamic,
        "ornament": ornament,
        "limb": stroke.limb,
        **more,
    }
    return tuple(values.get(name, 0) for name in NOTE_DTYPE.names or ())
