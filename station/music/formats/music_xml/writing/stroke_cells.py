"""The strokes of a part as notation has them: one cell for each note head, with its grace strokes and its slash.

Two strokes of a diddle are one cell, where a reader of the slash finds the same two again; a buzz roll and a choked
cymbal last to where they end.
"""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from station.core.pieces import CHOKEABLE, Articulation, Dynamic, Ornament, Piece
from station.music.formats.music_xml.second_strokes import SecondStrokes
from station.music.score import Note

DOUBLES = (Ornament.DIDDLE, Ornament.ROLL)


@dataclass(frozen=True, slots=True, eq=False)
class StrokeCell:
    """One note head: `start` and `end` in ticks as written, `end` None where it lasts as long as the music lets it.

    `second` is the other stroke of a diddle, written as a slash through the stem.
    """

    start: int
    note: Note
    graces: tuple[Note, ...] = ()
    end: int | None = None
    second: Note | None = None

    @property
    def lasts(self) -> bool:
        """Whether its length is heard: a buzz, a choked cymbal, a diddle."""
        return self.end is not None


@dataclass(slots=True)
class _Row:
    note: Note
    graces: list[Note] = field(default_factory=list)


def cells_of(notes: Iterable[Note], end_tick: int) -> list[StrokeCell]:
    """The cells of `notes`, which are as they are written (no swing), diddles in pairs where they can be."""
    rows, graces = [], defaultdict(list)
    for note in notes:
        if note.lead_ms > 0:
            graces[note.tick, note.piece].append(note)
        else:
            rows.append(_Row(note))
    for row in rows:
        if row.note.ornament in (Ornament.FLAM, Ornament.DRAG):
            row.graces = graces.pop((row.note.tick, row.note.piece), [])
    by_piece: dict[Piece, list[_Row]] = defaultdict(list)
    for row in rows:
        by_piece[row.note.piece].append(row)
    found = [cell for piece_rows in by_piece.values() for cell in _cells(piece_rows, end_tick)]
    return sorted(found, key=lambda cell: (cell.start, cell.note.piece))


def second_strokes(cells: Iterable[StrokeCell]) -> SecondStrokes:
    """How loud a reader of `cells`, all of a part, takes the second strokes of diddles to be."""
    return SecondStrokes((c.note.piece, c.note.dynamic, c.note.velocity) for c in cells if c.second is None)


def _cells(rows: Sequence[_Row], end_tick: int) -> list[StrokeCell]:
    found: list[StrokeCell] = []
    i = 0
    while i < len(rows):
        here, after = rows[i], rows[i + 1] if i + 1 < len(rows) else None
        is_pair = after is not None and not here.graces and _is_double(here.note, after.note)
        limit = rows[i + 2].note.tick if i + 2 < len(rows) else end_tick
        if is_pair and after is not None and 2 * after.note.tick - here.note.tick <= limit:
            found.append(
                StrokeCell(here.note.tick, here.note, end=2 * after.note.tick - here.note.tick, second=after.note)
            )
            i += 2
            continue
        until = after.note.tick if after is not None else end_tick
        found.append(StrokeCell(here.note.tick, here.note, tuple(here.graces), _end(here.note, until)))
        i += 1
    return found


def _is_double(first: Note, second: Note) -> bool:
    """Whether a slash through the stem of `first` says `second` too, but for how loud it is."""
    if first.ornament not in DOUBLES or second.ornament is not first.ornament or first.tick == second.tick:
        return False
    if first.articulation is Articulation.BUZZ or first.choke_ticks or second.choke_ticks:
        return False
    as_first = replace(
        second, tick=first.tick, velocity=first.velocity, dynamic=first.dynamic, swing_ticks=first.swing_ticks,
        midi_note=first.midi_note,
    )  # fmt: skip
    return as_first == first and second.dynamic is min(first.dynamic, Dynamic.NORMAL)


def _end(note: Note, until: int) -> int | None:
    lasts = note.duration_ticks if note.articulation is Articulation.BUZZ else _choke(note)
    return min(note.tick + lasts, until) if lasts and until > note.tick else None


def _choke(note: Note) -> int:
    return note.choke_ticks if note.piece in CHOKEABLE else 0


def apart(cell: StrokeCell) -> list[StrokeCell]:
    """The two strokes of a diddle as two notes without a slash."""
    assert cell.second is not None, "a diddle"
    return [StrokeCell(cell.start, cell.note), StrokeCell(cell.second.tick, cell.second)]


def is_roll(cells: Sequence[StrokeCell]) -> dict[int, bool]:
    """Of each diddle in `cells`, by its index, whether it touches another of its piece, and so is read as a roll."""
    by_piece: dict[Piece, list[int]] = defaultdict(list)
    for i, cell in enumerate(cells):
        if cell.second is not None:
            by_piece[cell.note.piece].append(i)
    found = {i: False for places in by_piece.values() for i in places}
    for places in by_piece.values():
        for a, b in pairwise(places):
            if abs((cells[a].end or 0) - cells[b].start) <= 1:
                found[a] = found[b] = True
    return found
