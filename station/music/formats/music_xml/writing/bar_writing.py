"""A bar of one voice as notes and rests: what stands at each place, in which value, under which tuplet and beam."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from station.core.units import PPQ
from station.music.beat_groups import beat_groups
from station.music.formats.music_xml.writing.note_spelling import (
    CLOSE,
    Span,
    Value,
    rests,
    spans_of,
    values,
)
from station.music.formats.music_xml.writing.stroke_cells import StrokeCell, apart
from station.music.tempo import MeterChange

QUARTER, HALF = 4, 2


@dataclass(slots=True)
class Chord:
    """What is written at one place: cells that are `struck` here, and those that are `held` on from before.

    A rest has neither; `goes_on` are the cells that the next chord holds. `beams` one word a beam, as MusicXML has
    them; `tuplet` where a bracket begins or ends.
    """

    value: Value
    struck: tuple[StrokeCell, ...] = ()
    held: tuple[StrokeCell, ...] = ()
    goes_on: tuple[StrokeCell, ...] = ()
    beams: tuple[str, ...] = ()
    tuplet: tuple[str, ...] = ()

    @property
    def is_rest(self) -> bool:
        """Whether nothing sounds."""
        return not self.struck and not self.held


@dataclass(frozen=True, slots=True)
class SpelledBar:
    """The chords of a voice in a bar; `is_exact`: each stroke is where it is played; `spread` diddles without slash."""

    chords: tuple[Chord, ...]
    is_exact: bool
    spread: tuple[StrokeCell, ...] = ()

    @property
    def is_silent(self) -> bool:
        """Whether it is all rests."""
        return all(chord.is_rest for chord in self.chords)


def spelled_bar(cells: Sequence[StrokeCell], start: int, length: int, meter: MeterChange) -> SpelledBar:
    """The bar [start, start + length) of a voice with `cells`, those included that are held into it."""
    spread: list[StrokeCell] = []
    cells = list(cells)
    while True:
        chords, is_exact = _chords(cells, start, length, meter)
        bad = _ill_written(chords, cells, start, length)
        if not bad:
            break
        spread += bad
        cells = [part for cell in cells for part in (apart(cell) if cell in bad else [cell])]
        cells.sort(key=lambda cell: (cell.start, cell.note.piece))
    return SpelledBar(tuple(chords), is_exact, tuple(spread))


def _ill_written(chords: Sequence[Chord], cells: Sequence[StrokeCell], start: int, length: int) -> list[StrokeCell]:
    """Diddles that one plain value of a quarter or less does not write, so that a slash would say something else."""
    sound = {
        id(cell)
        for chord in chords
        for cell in chord.struck
        if cell.second is not None and not chord.goes_on and not chord.value.dots and chord.value.base >= QUARTER
        and abs(cell.start - start + chord.value.length - ((cell.end or 0) - start)) <= 1
    }  # fmt: skip
    return [cell for cell in cells if cell.second is not None and id(cell) not in sound]


def _chords(cells: Sequence[StrokeCell], start: int, length: int, meter: MeterChange) -> tuple[list[Chord], bool]:
    places = sorted({p - start for cell in cells for p in (cell.start, cell.end) if p is not None})
    found: list[Chord] = []
    is_exact = True
    for group in beat_groups(meter, length):
        inside: list[Chord] = []
        for span in spans_of(Fraction(group[0]), Fraction(group[1]), places):
            is_exact &= span.is_exact
            inside += _bracketed(span, _in_span(span, cells, start))
        _beam(inside)
        found += inside
    return _with_half_rests(found, meter), is_exact


def _in_span(span: Span, cells: Sequence[StrokeCell], start: int) -> list[Chord]:
    """The chords and rests of one span."""
    begins: dict[int, list[StrokeCell]] = {}
    lasting: list[tuple[int, int, StrokeCell]] = []
    for cell in cells:
        place = cell.start - start
        if place >= span.end - CLOSE:
            continue
        first = -1 if place < span.start - CLOSE else min(span.slot(place), span.slots - 1)
        if first >= 0:
            begins.setdefault(first, []).append(cell)
        if cell.end is not None and (last := max(span.slot(cell.end - start), first + 1)) > 0:
            lasting.append((first, last, cell))
    edges = sorted({0, span.slots, *begins, *(last for _, last, _ in lasting if last < span.slots)})
    found: list[Chord] = []
    for first, last in pairwise(edges):
        struck = tuple(begins.get(first, ()))
        held = tuple(cell for begin, end, cell in lasting if begin < first < end)
        found += _between(span, first, last, struck, held, [(end, cell) for _, end, cell in lasting])
    return found


def _between(
    span: Span,
    first: int,
    last: int,
    struck: tuple[StrokeCell, ...],
    held: tuple[StrokeCell, ...],
    ends: Sequence[tuple[int, StrokeCell]],
) -> list[Chord]:
    """What fills the slots between two places."""
    if not struck and not held:
        return [Chord(value) for value in rests(span, first, last)]
    lasting = tuple(cell for cell in (*struck, *held) if cell.lasts)
    parts = values(span, first, last)
    if not lasting:
        head = parts[0]
        filled = first + round(head.length / span.unit)
        return [Chord(head, struck), *(Chord(value) for value in rests(span, filled, last))]
    beyond = tuple(cell for end, cell in ends if end > last and cell in lasting)
    found = []
    for i, value in enumerate(parts):
        goes_on = lasting if i + 1 < len(parts) else beyond
        found.append(Chord(value, struck if not i else (), held if not i else lasting, goes_on))
    return found


# --- brackets, beams, long rests --------------------------------------------------------------------------------------


def _bracketed(span: Span, chords: list[Chord]) -> list[Chord]:
    if span.actual > 1:
        chords[0].tuplet += ("start",)
        chords[-1].tuplet += ("stop",)
    return chords


def _beam(chords: Sequence[Chord]) -> None:
    """Beams over each run of flagged notes."""
    run: list[Chord] = []
    for chord in (*chords, None):
        if chord is not None and not chord.is_rest and chord.value.flags:
            run.append(chord)
            continue
        if len(run) > 1:
            for i, each in enumerate(run):
                each.beams = tuple(_beam_word(run, i, level) for level in range(1, each.value.flags + 1))
        run = []


def _beam_word(run: Sequence[Chord], i: int, level: int) -> str:
    before = i > 0 and run[i - 1].value.flags >= level
    after = i + 1 < len(run) and run[i + 1].value.flags >= level
    if before and after:
        return "continue"
    if before or after:
        return "end" if before else "begin"
    return "backward hook" if i else "forward hook"


def _with_half_rests(chords: list[Chord], meter: MeterChange) -> list[Chord]:
    """Two quarter rests that make a half of a bar in fours are one rest."""
    if meter.unit != QUARTER or meter.beats % 2:
        return chords
    found: list[Chord] = []
    for chord in chords:
        value = chord.value
        if (
            found
            and all(each.is_rest and each.value.base == QUARTER and not each.value.dots for each in (found[-1], chord))
            and value.start % (2 * PPQ) == PPQ
        ):
            before = found.pop().value
            found.append(Chord(Value(before.start, before.length + value.length, HALF, 0, before.span)))
        else:
            found.append(chord)
    return found
