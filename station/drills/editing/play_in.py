"""What was played into a grid, as the strokes that a mouse would write: brought to cells, ornaments heard, one a cell.

The bars that are played into are a loop: a stroke just before its first beat falls on that beat, and so does one just
before its end. There are `Quantise.cells` to a beat, in a group as many for each beat that it lasts; those that swing
are looked for where they sound, so that what was played swung falls on its straight cell. Strength says how far of the
way to its cell a stroke goes; a grid has no places between cells, so that the rest of the way is either kept as the
stroke's own timing in ms, or dropped: then any strength is full.

Flams and drags of a drum are heard as an import hears them (`ornament_finder`), where a hand is left for the grace
stroke; of other strokes of a line that fall in one cell the louder stays.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from station.core.pieces import DRUMS, USUAL_FEET, Articulation, Ornament
from station.core.units import PPQ
from station.drills.editing.grid_page import PageGrid
from station.drills.editing.lesson_edits import REST, LineAt, PlayedStroke, PlayIn, SetStroke
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_timing import GridTiming
from station.drills.grid.tab_symbols import LETTER_OF, SYMBOLS, TabSymbol, family_of
from station.drills.transcription.strokes.ornament_finder import found_ornaments
from station.music.score import MAX_LATE_MS, Note, Score
from station.music.swing import Swing
from station.music.tempo import TempoMap

_GRACES = {Ornament.FLAM: 1, Ornament.DRAG: 2}
"""How many grace strokes come before the note."""
_NEAR_MS = 10.0
"""A professional's spread about a beat (HUMANS, Timing): close strokes that lie so near to cells are written ones."""


@dataclass(frozen=True, slots=True)
class CellAt:
    """A cell of the bars that are played into: its bar and tick there as written, where it sounds from their start."""

    bar: int
    tick: int
    played: int


@dataclass(frozen=True, slots=True)
class Placed:
    """A stroke in its cell, and how many ms later than that it was, of what quantising leaves of it."""

    stroke: PlayedStroke
    cell: CellAt
    off_ticks: float


@dataclass(frozen=True, slots=True)
class PlayedIn:
    """What playing in does: strokes to be written, in order, and the timing of those that keep theirs."""

    edits: tuple[SetStroke, ...]
    late_ms: tuple[tuple[SetStroke, int], ...] = ()


def played_in(edit: PlayIn, grid: PageGrid, timing: GridTiming) -> PlayedIn:
    """What `edit` does to its `grid`, whose tempo, swing and dynamics are `timing`; bars that it lacks are left out."""
    cells, length = _cells(edit, grid, timing.swing)
    if not cells:
        return PlayedIn(())
    placed = [_placed(stroke, cells, length) for stroke in edit.strokes]
    kept = [one for line in _by_line(placed) for one in _one_a_cell(line, _other_hands(placed, line), timing, length)]
    kept.sort(key=lambda one: (one.cell.played, one.stroke.line.piece, one.stroke.line.limb))
    written = [SetStroke(p.stroke.line, p.cell.bar, p.cell.tick, p.stroke.letter) for p in kept]
    erased = [] if edit.over else _erased(edit, grid, written)
    late = [(stroke, _late_ms(one, edit, timing)) for stroke, one in zip(written, kept, strict=True)]
    return PlayedIn((*erased, *written), tuple(late) if edit.quantise.keeps_timing else ())


def _late_ms(placed: Placed, edit: PlayIn, timing: GridTiming) -> int:
    left = (1 - edit.quantise.strength) * placed.off_ticks * 60_000 / (timing.tempo_bpm * PPQ)
    return round(min(max(left, -MAX_LATE_MS), MAX_LATE_MS))


# --- cells ------------------------------------------------------------------------------------------------------------


def _cells(edit: PlayIn, grid: PageGrid, swing: Swing) -> tuple[list[CellAt], int]:
    """The cells of all bars that are played into, in order, and how many ticks the bars last."""
    found: list[CellAt] = []
    start = 0
    for bar in range(edit.first, min(edit.last + 1, grid.bar_count)):
        frame = grid.frames[bar]
        found += [CellAt(bar, tick, start + played) for tick, played in _bar_cells(frame, edit.quantise.cells, swing)]
        start += frame.meter.bar_ticks
    return found, start


def _bar_cells(frame: GridFrame, cells: int, swing: Swing) -> Iterable[tuple[int, int]]:
    """Where each cell of a bar is written, and where it sounds."""
    spans = [*frame.spans]
    if (rest := frame.meter.bar_ticks - sum(length for _, length in spans)) > 0:
        spans.append((frame.meter.bar_ticks - rest, rest))  # less than a beat, such as the last eighth of a 7/8
    for start, length in spans:
        parts = max(round(cells * length / frame.beat_ticks), 1)
        for i in range(parts):
            tick = start + (2 * i * length + parts) // (2 * parts)  # to the nearest, as the reader cuts `(…)`
            yield tick, swing.swung(tick, frame.meter) if _swings(length, parts) else tick


def _swings(length: int, parts: int) -> bool:
    """Whether such cells are halves of halves of a whole note, the only ones that swing."""
    cells, rest = divmod(4 * PPQ * parts, length)
    return not rest and cells & (cells - 1) == 0


def _placed(stroke: PlayedStroke, cells: Sequence[CellAt], length: int) -> Placed:
    """The stroke in the cell that is nearest, around the loop."""
    at = stroke.at_ticks % length
    offs = ((at - cell.played + length / 2) % length - length / 2 for cell in cells)
    off, cell = min(zip(offs, cells, strict=True), key=lambda pair: abs(pair[0]))
    return Placed(stroke, cell, off)


# --- one stroke a cell ------------------------------------------------------------------------------------------------


def _by_line(placed: Iterable[Placed]) -> Iterable[list[Placed]]:
    def line(one: Placed) -> tuple[int, int]:
        return one.stroke.line.piece, one.stroke.line.limb

    for _, of_line in groupby(sorted(placed, key=line), key=line):
        yield list(of_line)


def _other_hands(placed: Iterable[Placed], line: Sequence[Placed]) -> frozenset[CellAt]:
    """The cells in which a hand strikes another line: no hand is left there for a grace stroke."""
    own = line[0].stroke.line
    return frozenset(p.cell for p in placed if p.stroke.line != own and p.stroke.line.piece not in USUAL_FEET)


def _one_a_cell(line: Sequence[Placed], busy: frozenset[CellAt], timing: GridTiming, length: int) -> Iterable[Placed]:
    """The strokes of a line, at most one in each cell: ornaments as one letter, of others the louder."""
    by_cell: dict[CellAt, list[Placed]] = {}
    for one in _with_ornaments(line, busy, timing, length):
        by_cell.setdefault(one.cell, []).append(one)
    for together in by_cell.values():
        yield max(together, key=lambda one: (one.stroke.velocity, -abs(one.off_ticks)))


def _with_ornaments(
    line: Sequence[Placed], busy: frozenset[CellAt], timing: GridTiming, length: int
) -> Sequence[Placed]:
    """The strokes of a line in the order played, the main strokes of flams and drags with their letter alone.

    Heard as they were played, a loop later than that, for a score begins at 0 and a grace stroke may come before.
    """
    piece = line[0].stroke.line.piece
    if piece not in DRUMS:
        return line
    played = {round(p.cell.played + p.off_ticks) + length: p for p in sorted(line, key=lambda p: p.stroke.velocity)}
    notes = [Note(tick, piece, velocity=one.stroke.velocity) for tick, one in played.items()]
    found = found_ornaments(Score.from_notes(notes, TempoMap.constant(timing.tempo_bpm)))
    mains = {note.tick: note.ornament for note in found.mains if _is_struck(note)}
    kept: list[Placed] = []
    waiting: list[Placed] = []  # graces, perhaps
    for tick in sorted(played):
        one, ornament = played[tick], mains.get(tick)
        if ornament is None:
            waiting.append(one)
            continue
        graces = waiting[-_GRACES.get(ornament, 0) :] if ornament in _GRACES else []
        letter = _graced_letter(one.stroke, ornament) if graces and one.cell not in busy else None
        if letter and not _is_run([*graces, one], timing):
            kept += [*waiting[: -len(graces)], replace(one, stroke=replace(one.stroke, letter=letter))]
        else:
            kept += [*waiting, one]
        waiting = []
    return [*kept, *waiting]


def _is_run(strokes: Sequence[Placed], timing: GridTiming) -> bool:
    """Whether each of them is meant for a cell of its own, so near to it as it lies."""
    near = _NEAR_MS * timing.tempo_bpm * PPQ / 60_000
    return len({one.cell for one in strokes}) == len(strokes) and all(abs(one.off_ticks) <= near for one in strokes)


def _is_struck(note: Note) -> bool:
    return note.articulation is Articulation.NORMAL


def _graced_letter(stroke: PlayedStroke, ornament: Ornament) -> str | None:
    """The letter of the stroke with its ornament; None where what it is has none, as a rim shot."""
    family = family_of(stroke.line.piece)
    plain = SYMBOLS[family].get(stroke.letter)
    if plain is None or plain.ornament is not Ornament.NONE:
        return None
    graced = TabSymbol(plain.zone, plain.articulation, plain.dynamic, plain.openness, ornament)
    return LETTER_OF[family].get(graced)


# --- what stood there -------------------------------------------------------------------------------------------------


def _erased(edit: PlayIn, grid: PageGrid, written: Iterable[SetStroke]) -> list[SetStroke]:
    """What takes away all letters of the bars that are played into, but those that are written over anyway."""
    over = {(stroke.line, stroke.bar, stroke.tick) for stroke in written}
    return [
        SetStroke(line.at, bar, cell.tick, REST)
        for line in grid.lines
        if isinstance(line.at, LineAt) and line.at.cycle is None
        for bar in range(edit.first, min(edit.last + 1, len(line.bars)))
        for cell in line.bars[bar].cells
        if cell.letter != REST and (line.at, bar, cell.tick) not in over
    ]
