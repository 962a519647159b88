"""From the cells of the lines to the strokes that a score holds.

A written stroke is one letter; a played one is a row of the score. A flam has one grace stroke before it, a drag two;
a diddle is two strokes that share its cell; a buzz roll is one row that lasts. Diddles that touch each other on a
piece make a roll. `BarClock` says where the music that is written straight is played.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, OTHER_HAND, Articulation, Dynamic, Limb, Ornament, Piece
from station.core.toml.toml_places import KeyPath
from station.drills.grid.grid import Bar
from station.drills.grid.stroke_settings import StrokeSettings
from station.drills.grid.tab_symbols import (
    BEYOND,
    BEYOND_SYMBOLS,
    CHOKE,
    HOLD,
    RESTS,
    SYMBOLS,
    TabSymbol,
    family_of,
    not_a_letter,
)
from station.music.grace_strokes import MAX_VELOCITY, MIN_VELOCITY
from station.music.score import NOTE_DTYPE
from station.music.swing import STRAIGHT, Swing
from station.music.tempo import MeterChange

_USUAL_SETTINGS = StrokeSettings()


@dataclass(frozen=True, slots=True)
class Origin:
    """The letter in the file that wrote a stroke: its line's key path and its index there."""

    path: KeyPath
    char: int


@dataclass(frozen=True, slots=True)
class CellPlace:
    """A moment of the music in ticks: its cell, `straight`, and where it is `played`, swing and all.

    `swing_ticks` is how much later it is played than notation writes it: straight under a mark, whatever the ratio.
    """

    straight: int
    played: int
    swing_ticks: int = 0

    def moved(self, ticks: int) -> "CellPlace":
        """The same moment `ticks` later."""
        return CellPlace(self.straight + ticks, self.played + ticks, self.swing_ticks)


@dataclass(frozen=True, slots=True)
class BarClock:
    """Where moments are played: the bars (the tick of each is its start) and how they swing."""

    bars: Sequence[MeterChange]
    swing: Swing

    def place(self, tick: int, swings: bool) -> CellPlace:
        """The moment written at `tick`."""
        if not swings or self.swing.ratio == STRAIGHT:
            return CellPlace(tick, tick)
        bar = self.bars[bisect_right(self.bars, tick, key=lambda b: b.tick) - 1]
        played = bar.tick + self.swing.swung(tick - bar.tick, bar)
        return CellPlace(tick, played, played - tick)


@dataclass(frozen=True, slots=True)
class WrittenCell:
    """One letter of a line.

    `middle` is where a diddle's second stroke falls; `until` where a buzz roll ends or a cymbal is grabbed; `gain`
    multiplies the velocities of its settings; `late_ms` is its own timing.
    """

    place: CellPlace
    middle: CellPlace
    length_ticks: int
    piece: Piece
    letter: TabSymbol
    limb: Limb
    origin: Origin
    until: CellPlace | None = None
    settings: StrokeSettings = _USUAL_SETTINGS
    gain: float = 1.0
    late_ms: float = 0.0

    @property
    def is_open_roll(self) -> bool:
        """Whether this cell holds two strokes."""
        return self.letter.ornament is Ornament.DIDDLE

    def moved(self, ticks: int) -> "WrittenCell":
        """The same letter `ticks` later."""
        if not ticks:
            return self
        until = None if self.until is None else self.until.moved(ticks)
        return replace(self, place=self.place.moved(ticks), middle=self.middle.moved(ticks), until=until)

    def struck(self, settings: StrokeSettings, gain: float) -> "WrittenCell":
        """The same letter, as loud as `settings` and `gain` say."""
        return WrittenCell(
            *(self.place, self.middle, self.length_ticks, self.piece, self.letter, self.limb, self.origin, self.until),
            settings=settings,
            gain=gain,
            late_ms=self.late_ms,
        )

    def played_by(self, limb: Limb) -> "WrittenCell":
        """The same letter, played by `limb`."""
        return WrittenCell(
            *(self.place, self.middle, self.length_ticks, self.piece, self.letter, limb, self.origin, self.until),
            settings=self.settings,
            gain=self.gain,
            late_ms=self.late_ms,
        )

    def velocity(self, dynamic: Dynamic) -> int:
        """Velocity 1–127 of its stroke, were it `dynamic`."""
        loud = round(self.settings.velocities.of(self.piece, dynamic) * self.gain)
        return min(max(loud, MIN_VELOCITY), MAX_VELOCITY)


# --- a line ----------------------------------------------------------------------------------------------------------


def line_strokes(
    bars: Iterable[tuple[int, Bar]], line: "GridLine", clock: BarClock, report: Callable[[int, str], None]
) -> list[WrittenCell]:
    """The strokes of one line, its bars each with the tick of its start; faults go to `report`."""
    family = family_of(line.piece)
    symbols = {**SYMBOLS[family], BEYOND: BEYOND_SYMBOLS[family]}
    strokes: list[WrittenCell] = []
    open_end: CellPlace | None = None  # where a buzz that may go on has come to
    is_known = True  # what the line struck last; not after a faulty bar
    for start, bar in bars:
        for cell in bar.cells:
            if cell.letter in RESTS:
                open_end = None
                continue
            here = clock.place(start + cell.tick, cell.swings)
            if cell.letter == HOLD:
                end = clock.place(here.straight + cell.length_ticks, cell.swings)
                open_end = _hold(strokes, open_end, end, cell.char, report if is_known else _unheard)
                continue
            open_end = None
            if cell.letter == CHOKE:
                _choke(strokes, line.piece, here, cell.char, report if is_known else _unheard)
            elif cell.letter in symbols:
                letter = symbols[cell.letter]
                if letter.articulation is Articulation.BUZZ:
                    open_end = clock.place(here.straight + cell.length_ticks, cell.swings)
                middle = clock.place(here.straight + cell.length_ticks // 2, cell.swings)
                origin = Origin(line.path, cell.char)
                strokes.append(
                    WrittenCell(here, middle, cell.length_ticks, line.piece, letter, line.limb, origin, open_end)
                )
                is_known = True
            else:
                report(cell.char, not_a_letter(cell.letter, family))
                is_known = False
        if not bar.sound:
            open_end, is_known = None, False
    return strokes


def _unheard(_char: int, _text: str) -> None:
    """Where an earlier fault may be the cause of another, that one is not told."""


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


def parted(strokes: Iterable[WrittenCell]) -> tuple[list[WrittenCell], list[WrittenCell]]:
    """The strokes that are asked of the player, and those beyond them."""
    found: tuple[list[WrittenCell], list[WrittenCell]] = ([], [])
    for stroke in strokes:
        found[stroke.letter.is_beyond].append(stroke)
    return found


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


def expand(strokes: Sequence[WrittenCell]) -> tuple[NDArray[np.void], list[Origin]]:
    """Rows of `NOTE_DTYPE` of all strokes, and beside each row the letter that wrote it."""
    in_rolls = rolls(strokes)
    rows: list[tuple[float, ...]] = []
    origins: list[Origin] = []
    for i, stroke in enumerate(strokes):
        if stroke.is_open_roll:
            made = _two_rows(stroke, Ornament.ROLL if i in in_rolls else Ornament.DIDDLE)
        else:
            made = _rows(stroke)
        rows += made
        origins += [stroke.origin] * len(made)
    return np.array(rows, NOTE_DTYPE), origins


def _two_rows(stroke: WrittenCell, ornament: Ornament) -> list[tuple[float, ...]]:
    """Both strokes of a diddle; an accent is the first one's alone."""
    dynamic = min(stroke.letter.dynamic, Dynamic.NORMAL)
    second = replace(stroke, place=stroke.middle, letter=replace(stroke.letter, dynamic=dynamic))
    return [_row(s, s.velocity(s.letter.dynamic), ornament) for s in (stroke, second)]


def _rows(stroke: WrittenCell) -> list[tuple[float, ...]]:
    """The grace strokes first, then the stroke itself."""
    velocity = stroke.velocity(stroke.letter.dynamic)
    lasts = 0 if stroke.until is None else stroke.until.played - stroke.place.played
    is_buzz = stroke.letter.articulation is Articulation.BUZZ
    main = _row(stroke, velocity, stroke.letter.ornament, {"duration_ticks" if is_buzz else "choke_ticks": lasts})
    return [*_graces(stroke, velocity), main]


def _graces(stroke: WrittenCell, velocity: int) -> list[tuple[float, ...]]:
    graces, ornament = stroke.settings.graces, stroke.letter.ornament
    leads_ms = graces.leads_ms(ornament)
    if not leads_ms:
        return []
    grace = replace(
        stroke,
        limb=OTHER_HAND.get(stroke.limb, Limb.UNKNOWN),
        letter=replace(stroke.letter, dynamic=Dynamic.GHOST),
    )
    return [_row(grace, graces.velocity(velocity), ornament, {"lead_ms": lead}) for lead in leads_ms]


_ALL_ZERO = MappingProxyType(dict.fromkeys(NOTE_DTYPE.names or (), 0))
"""The fields in their order."""


def _row(
    stroke: WrittenCell, velocity: int, ornament: Ornament, more: Mapping[str, float] = MappingProxyType({})
) -> tuple[float, ...]:
    """One row; `more` holds the fields that most strokes leave at 0."""
    letter = stroke.letter
    values: dict[str, float] = {
        **_ALL_ZERO,
        "tick": stroke.place.played,
        "swing_ticks": stroke.place.swing_ticks,
        "openness": np.nan if letter.openness is None else letter.openness,
        "piece": stroke.piece,
        "zone": letter.zone,
        "articulation": letter.articulation,
        "velocity": velocity,
        "dynamic": letter.dynamic,
        "ornament": ornament,
        "limb": stroke.limb,
        "late_ms": stroke.late_ms,
        **more,
    }
    return tuple(values.values())
