"""Reading drum tablature.

The cells of a bar share its length evenly, each line for itself. The meter is the one that the text states, else what
its count says, else the one that so many cells usually are: sixteenths, and twelve of them triplets of 4/4 where the
snare has the second and the fourth of four beats.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import islice

from station.core.disk.utf8 import utf8_text
from station.core.errors import BadInput
from station.core.pieces import CHOKEABLE, HALF_OPEN, Articulation, Dynamic, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.ascii_tab.hat_of_the_foot import with_hat_of_the_foot
from station.music.formats.ascii_tab.tab_beats import in_whole_bars
from station.music.formats.ascii_tab.tab_letters import CHOKE, LETTERS, RESTS, TabStroke
from station.music.formats.ascii_tab.tab_lines import TabBar
from station.music.formats.ascii_tab.tab_text import TabRow, TabSystem, TabText, tab_text
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.stroke_velocities import usual_velocity
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

MOST_BYTES = 1 << 20
"""Our choice: the longest tabs have some ten thousand characters."""
_MOST_BARS = 2000
_MOST_CELLS = 384
"""A bar; our choice."""
_USUAL_BPM = 120.0
_IN_EIGHTHS_AND_OTHERS = {4: (4, 4), 6: (6, 8), 8: (4, 4), 9: (9, 8), 24: (4, 4), 32: (4, 4), 48: (4, 4), 64: (4, 4)}
"""Cells a bar that are no sixteenths: quarters, eighths, sextuplets, thirty-seconds (usual in tabs, our choice)."""


@dataclass(frozen=True, slots=True)
class _Stroke:
    """One letter: where in its bar, as a share of it, what, and how long its cell is."""

    at: Fraction
    cell: Fraction
    piece: Piece
    struck: TabStroke
    choke: Fraction | None = None


@dataclass(slots=True)
class _Bar:
    """One bar as the text has it."""

    meter: tuple[int, int]
    strokes: list[_Stroke] = field(default_factory=list)
    tempo_bpm: float | None = None
    section: str = ""
    opens: bool = False
    closes: int = 0
    """How often what ends here is played in all; 0 where nothing ends."""


def read_tab(data: bytes, source: str) -> DrumPart:
    """The part that a text of tablature says; raises `BadInput` with line and column."""
    found = tab_text(utf8_text(data, source, "drum tablature"), source)
    if not found.systems:
        raise BadInput(source, "", "no line of tablature in it, such as HH|x-x-x-x-|")
    reader = _Reader(source, found.loose_x)
    reader.lost.update((f"line {number}: {words!r} is not carried out", None) for number, words in found.unheeded)
    bars = list(islice(reader.bars(found), _MOST_BARS + 1))
    played = list(islice(_written_out(bars), _MOST_BARS + 1))
    if len(played) > _MOST_BARS:
        raise BadInput(source, "", f"more than {_MOST_BARS} bars with all repeats")
    if not any(bar.tempo_bpm for bar in bars):
        reader.lost[f"no tempo in it: {_USUAL_BPM:g} beats a minute"] = None
    words = found.words
    score = _score(played, words.get("title", ""), found.swing)
    sections = tuple(_sections(played))
    author, about = words.get("author", ""), words.get("about", "")
    return DrumPart(score, author, about, None, found.swing, sections, lost=tuple(reader.lost))


# --- bars -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Reader:
    """What holds for a whole text."""

    source: str
    loose_x: bool
    lost: dict[str, None] = field(default_factory=dict)

    def bars(self, text: TabText) -> Iterator[_Bar]:
        """The bars as the text has them."""
        stated: tuple[int, int] | None = None
        for typed in text.systems:
            stated = typed.meter or stated
            system, said = in_whole_bars(typed, stated)
            system, heard = with_hat_of_the_foot(system)
            self.lost.update(dict.fromkeys((*said, *heard)))
            count = max(len(row.bars) for row in system.rows)
            beats = stated[0] if stated else _counted(system.count)
            bars = [self.bar(system, k, stated, beats) for k in range(min(count, _MOST_BARS + 1))]
            if bars:
                bars[0].tempo_bpm, bars[0].section = system.tempo_bpm, system.section
                _mark_repeats(bars, system)
            yield from bars

    def bar(self, system: TabSystem, k: int, stated: tuple[int, int] | None, beats: int) -> _Bar:
        """Bar `k` of a system; its usual number of cells is that of most lines, shared evenly by `beats`."""
        rows = [(row, row.bars[k]) for row in system.rows if k < len(row.bars)]
        lengths = [len(bar.cells) for _, bar in rows]
        usual = _shared(max(set(lengths), key=lambda n: (lengths.count(n), n)), beats)
        if usual > _MOST_CELLS:
            raise BadInput(self.source, f"line {rows[0][0].line}", f"a bar of {usual} cells")
        strokes = [stroke for row, bar in rows for stroke in self.strokes(row, bar, usual)]
        return _Bar(stated or _meter(system.count, usual, strokes), strokes)

    def strokes(self, row: TabRow, bar: TabBar, usual: int) -> list[_Stroke]:
        """The strokes of one line in one bar; a line whose number of cells does not fit is filled or cut."""
        cells = bar.cells
        if usual % len(cells) and len(cells) % usual:
            self.lost[f"line {row.line}: a bar of {len(cells)} cells beside {usual}: filled or cut at its end"] = None
            cells = cells.ljust(usual, "-")[:usual]
        cell, found, letters = Fraction(1, len(cells)), list[_Stroke](), LETTERS[row.meaning.piece]
        for i, letter in enumerate(cells):
            if letter in RESTS:
                continue
            if letter == CHOKE and row.meaning.piece in CHOKEABLE:
                _choke(found, i * cell, cell, row)
            elif letter in letters:
                struck = self.struck(letter, row)
                found.append(_Stroke(i * cell, cell, struck.piece or row.meaning.piece, struck))
            else:
                place = f"line {row.line}, column {bar.columns[i]}"
                raise BadInput(self.source, place, f"{letter!r} is no stroke; expected one of {' '.join(letters)} -")
        return found

    def struck(self, letter: str, row: TabRow) -> TabStroke:
        """What a letter of a line strikes, as its label and the text's key have it."""
        struck = _as_labelled(LETTERS[row.meaning.piece][letter], row)
        if self.loose_x and letter == "X" and row.meaning.piece is Piece.HIHAT:
            return replace(struck, dynamic=Dynamic.NORMAL, openness=HALF_OPEN)
        return struck


def _shared(cells: int, beats: int) -> int:
    """`cells`, or one more or less where only so `beats` share them evenly: a cell too few or too many is a slip."""
    fitting = [n for n in (cells, cells + 1, cells - 1) if beats > 1 and n >= beats and n % beats == 0]
    return fitting[0] if fitting and cells % 2 else cells


def _mark_repeats(bars: list[_Bar], system: TabSystem) -> None:
    """Signs in the lines; a number of times without a sign repeats the whole system."""
    for k, bar in enumerate(bars):
        here = [row.bars[k] for row in system.rows if k < len(row.bars)]
        bar.opens = any(b.opens for b in here)
        bar.closes = max(system.times, 2) if any(b.closes for b in here) else 0
    if system.times > 1 and not any(bar.closes for bar in bars):
        bars[0].opens, bars[-1].closes = True, system.times


def _meter(count: str, cells: int, strokes: Sequence[_Stroke]) -> tuple[int, int]:
    """The meter of a bar of which the text does not state it."""
    if beats := _counted(count):
        return (beats, 8) if beats in (6, 9, 12) and cells in (beats, 2 * beats) else (beats, 4)
    if cells == 12:
        snares = {s.at for s in strokes if s.piece is Piece.SNARE and s.struck.dynamic is not Dynamic.GHOST}
        return (4, 4) if snares and snares <= {Fraction(1, 4), Fraction(3, 4)} else (3, 4)
    if cells in _IN_EIGHTHS_AND_OTHERS:
        return _IN_EIGHTHS_AND_OTHERS[cells]
    unit = 4 if cells % 4 == 0 else 8 if cells % 2 == 0 else 16
    return max(cells * unit // 16, 1), unit


def _counted(count: str) -> int:
    """How far a line of counting counts in its first bar; 0 where there is none."""
    reached = 0
    for word in "".join(c if c.isdigit() else " " for c in count).split():
        if word != str(reached + 1):
            break
        reached += 1
    return reached


# --- strokes ----------------------------------------------------------------------------------------------------------


def _as_labelled(struck: TabStroke, row: TabRow) -> TabStroke:
    """The stroke as the line's label says it is struck."""
    meaning = row.meaning
    if meaning.articulation is Articulation.CROSS_STICK:
        struck = replace(struck, articulation=meaning.articulation, zone=LETTERS[Piece.SNARE]["@"].zone)
    if meaning.openness is not None:
        struck = replace(struck, openness=meaning.openness)
    return struck if meaning.zone is None else replace(struck, zone=meaning.zone)


def _choke(found: list[_Stroke], at: Fraction, cell: Fraction, row: TabRow) -> None:
    """Grab what this line struck before in the bar and still rings, else a stroke that is grabbed at once."""
    if found and found[-1].choke is None:
        found[-1] = replace(found[-1], choke=at - found[-1].at)
    else:
        struck = _as_labelled(LETTERS[row.meaning.piece]["x"], row)
        found.append(_Stroke(at, cell, row.meaning.piece, struck, cell))


def counted_quarters(beats: int, unit: int) -> float:
    """How many quarter notes the beat has that a tempo above a tab counts: a dotted one in 6/8, 9/8 and 12/8.

    A tab says no groups.
    """
    ticks: int = MeterChange(0, beats, unit).usual_beat_ticks
    return ticks / PPQ


# --- the whole --------------------------------------------------------------------------------------------------------


def _written_out(bars: Sequence[_Bar]) -> Iterator[_Bar]:
    """The bars as they are played."""
    start = 0
    for k, bar in enumerate(bars):
        if bar.opens:
            start = k
        yield bar
        if bar.closes:
            for _ in range(bar.closes - 1):
                yield from (replace(again, section="") for again in bars[start : k + 1])
            start = k + 1


def _score(bars: Sequence[_Bar], title: str, swing: Swing) -> Score:
    tick, notes, meters = 0, list[Note](), list[MeterChange]()
    first = next((bar.tempo_bpm * counted_quarters(*bar.meter) for bar in bars if bar.tempo_bpm), _USUAL_BPM)
    tempos = [TempoChange.from_bpm(0, first)]
    for bar in bars:
        meters.append(MeterChange(tick, *bar.meter))
        if bar.tempo_bpm:
            tempos.append(TempoChange.from_bpm(tick, bar.tempo_bpm * counted_quarters(*bar.meter)))
        notes += [row for s in bar.strokes for row in with_graces(_note(s, meters[-1], swing))]
        tick += meters[-1].bar_ticks
    return Score.from_notes(notes, TempoMap.build(tempos, meters), tick, title)


def _note(stroke: _Stroke, bar: MeterChange, swing: Swing) -> Note:
    """The stroke of a bar; `swing` moves it unless its line has triplets or other tuplets there."""
    struck, written = stroke.struck, round(stroke.at * bar.bar_ticks)
    swing = swing if is_plain(stroke.cell * bar.bar_ticks) else Swing()
    played = swing.swung(written, bar)

    def lasting(share: Fraction) -> int:
        return swing.swung(min(written + round(share * bar.bar_ticks), bar.bar_ticks), bar) - played

    is_buzz = struck.articulation is Articulation.BUZZ
    return Note(
        bar.tick + played,
        stroke.piece,
        struck.zone,
        usual_velocity(struck.dynamic),
        struck.articulation,
        struck.dynamic,
        openness=struck.openness,
        ornament=struck.ornament,
        duration_ticks=lasting(stroke.cell) if is_buzz else 0,
        choke_ticks=lasting(stroke.choke) if stroke.choke else 0,
        swing_ticks=played - written,
    )


def is_plain(cell_ticks: Fraction) -> bool:
    """Whether swing moves cells of this length: all but those of tuplets, a whole note halved again and again."""
    parts = Fraction(4 * PPQ) / cell_ticks
    return parts.denominator == 1 and parts.numerator & (parts.numerator - 1) == 0


def _sections(bars: Sequence[_Bar]) -> Iterator[PartSection]:
    starts = [k for k, bar in enumerate(bars) if bar.section]
    ends = [*starts[1:], len(bars)]
    for k, end in zip(starts, ends, strict=False):
        yield PartSection(bars[k].section, k, end - 1)
