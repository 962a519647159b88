"""Writing drum tablature: systems of at most four bars, a count above them, and a key of the letters that need one."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import gcd
from types import MappingProxyType

from station.core.pieces import CHOKEABLE, Articulation, Dynamic, Ornament, Piece
from station.music.drum_part import DrumPart
from station.music.formats.ascii_tab.tab_letters import CHOKE, LETTERS, OWN_LABELS, TabStroke
from station.music.formats.ascii_tab.tab_reader import MOST_BYTES, counted_quarters, is_plain, read_tab
from station.music.formats.ascii_tab.tab_text import is_tab
from station.music.formats.ascii_tab.words_of_tabs import swing_in_numbers
from station.music.formats.music_format import Feature, Loss, MusicFormat, WrittenFile
from station.music.score import Note, Score
from station.music.swing import Swing

_WIDEST = 76
"""Characters a line: what a terminal and a mail show (our choice)."""
_MOST_BARS_A_LINE = 4
_FINEST = 96
"""Cells a bar at the most: sixteenths and triplets down to 64ths meet there in 4/4 (our choice)."""
_KEY = {"f": "flam", "d": "drag", "b": "buzz roll", "g": "ghost", "#": "choke", "r": "rim shot", "@": "cross-stick"}
"""Letters that readers ask about."""

_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "in up to 96 cells a bar",
        Feature.PIECES: "",
        Feature.METERS: "",
        Feature.TEMPO: "changes at bar lines",
        Feature.SWING: "of the whole piece",
        Feature.DYNAMICS: "where the piece has a letter for it",
        Feature.CROSS_STICKS: "of the snare",
        Feature.RIM_SHOTS: "of the snare",
        Feature.FOOT_SPLASHES: "",
        Feature.FLAMS: "",
        Feature.DRAGS: "",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.ABOUT: "",
        Feature.SECTIONS: "",
    }
)


@dataclass(frozen=True, slots=True)
class _Lines:
    """One bar: its cells by piece."""

    bar: int
    cells: Mapping[Piece, str]
    count: str
    lost: tuple[Loss, ...] = ()

    @property
    def width(self) -> int:
        """Characters that it takes, its bar line among them."""
        return len(self.count) + 1


def write_tab(part: DrumPart) -> WrittenFile:
    """The part as a text of drum tablature, in UTF-8."""
    lost: dict[Loss, None] = {}
    bars, swing = _swung_bars(part), swing_in_numbers(part.swing)
    if bars is None or not swing:
        bars, swing = [_bar(part.score.as_written, k) for k in range(part.score.bar_count)], ""
        lost |= _swing_lost(part)
    lost |= dict.fromkeys(loss for bar in bars for loss in bar.lost)
    _tell_gaps(part, lost)
    lines = [*_head(part), *([swing] if swing else []), *_key(bars), *_systems(part, bars, lost)]
    return WrittenFile(("\n".join(lines) + "\n").encode(), tuple(lost))


def _swing_lost(part: DrumPart) -> dict[Loss, None]:
    if not part.score.notes["swing_ticks"].any():
        return {}
    ratio = f" of {part.swing.ratio:.3g}:1" if part.swing.stands_in_words else ""
    text = f"swing{ratio} is written straight"
    return {Loss(Feature.TIMES, text): None, Loss(Feature.SWING, text): None}


def _swung_bars(part: DrumPart) -> list[_Lines] | None:
    """The bars under the words for the part's swing; None where one of them would not come back as it sounds.

    A bar with tuplets of its own is written as it sounds, its swing in tuplets too: the reader leaves it alone.
    """
    found, written = list[_Lines](), part.score.as_written
    for k in range(part.score.bar_count):
        bars = (_bar(score, k) for score in (written, part.score))
        bar = next((bar for bar in bars if _comes_back(part, bar)), None)
        if bar is None:
            return None
        found.append(bar)
    return found


def _comes_back(part: DrumPart, lines: _Lines) -> bool:
    """Whether the strokes of a bar, in cells swung by the part's swing, sound when they did."""
    tempo_map = part.score.tempo_map
    start = tempo_map.bar_start(lines.bar)
    bar = replace(tempo_map.meter_at(start), tick=start)
    cell = Fraction(bar.bar_ticks, len(lines.count))
    swing = part.swing if is_plain(cell) else Swing()
    rows = part.score.notes[(part.score.bar == lines.bar) & ~part.score.is_grace]
    for piece, cells in lines.cells.items():
        sounding = {swing.swung(round(i * cell), bar) for i, letter in enumerate(cells) if letter not in {"-", CHOKE}}
        if sounding != set((rows["tick"][rows["piece"] == piece] - start).tolist()):
            return False
    return True


def _tell_gaps(part: DrumPart, lost: dict[Loss, None]) -> None:
    """A section ends where the next begins: bars of no section come to the one before them."""
    ends = [*(section.first_bar for section in part.sections[1:]), part.score.bar_count]
    for section, end in zip(part.sections, ends, strict=False):
        if section.last_bar + 1 != end:
            first = section.last_bar + 2
            bars = f"bar {first} belongs" if first == end else f"bars {first}–{end} belong"
            stands = "it stands" if first == end else "they stand"
            text = f"{bars} to no section; in the file {stands} in {section.name!r}"
            lost[Loss(Feature.SECTIONS, text)] = None


def _head(part: DrumPart) -> Iterator[str]:
    for name, text in (("Title", part.score.title), ("Artist", part.author), ("About", part.about)):
        if line := " ".join(text.split()):
            yield f"{name}: {line}"


def _key(bars: Sequence[_Lines]) -> Iterator[str]:
    used = {letter for bar in bars for cells in bar.cells.values() for letter in cells}
    if said := [f"{letter} {word}" for letter, word in _KEY.items() if letter in used]:
        yield f"({', '.join(said)})"


# --- systems ----------------------------------------------------------------------------------------------------------


def _systems(part: DrumPart, bars: Sequence[_Lines], lost: dict[Loss, None]) -> Iterator[str]:
    words = {bar: list(_words(part, bar, lost)) for bar in range(len(bars))}
    start = 0
    while start < len(bars):
        end = _end_of_system(bars, words, start)
        yield from ("", *words[start])
        together = bars[start:end]
        pieces = [p for p in OWN_LABELS if any(p in bar.cells for bar in together)] or [Piece.SNARE]
        yield f"   {' '.join(bar.count for bar in together)}".rstrip()
        for piece in pieces:
            rests = ("-" * len(bar.count) for bar in together)
            cells = [bar.cells.get(piece, rest) for bar, rest in zip(together, rests, strict=True)]
            yield f"{OWN_LABELS[piece]}|{'|'.join(cells)}|"
        start = end


def _end_of_system(bars: Sequence[_Lines], words: Mapping[int, list[str]], start: int) -> int:
    """The bar after the last one of the line that begins with `start`."""
    end, width = start + 1, 3 + bars[start].width
    while end < len(bars) and end - start < _MOST_BARS_A_LINE and not words[end]:
        width += bars[end].width
        if width > _WIDEST:
            break
        end += 1
    return end


def _words(part: DrumPart, bar: int, lost: dict[Loss, None]) -> Iterator[str]:
    """What stands above a bar: its section, and tempo and meter where they begin."""
    tempo_map = part.score.tempo_map
    start, end = tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)
    for tempo in tempo_map.tempos:
        if tempo.tick == start:
            meter = tempo_map.meter_at(start)
            bpm = tempo.short_bpm(counted_quarters(meter.beats, meter.unit))
            yield f"Tempo: {bpm:.9f}".rstrip("0").rstrip(".")
        elif start < tempo.tick < end:
            lost[Loss(Feature.TEMPO, f"bar {bar + 1}: the tempo changes within the bar")] = None
    for meter in tempo_map.meters:
        if meter.tick == start:
            yield f"Time: {meter.beats}/{meter.unit}"
    for section in part.sections:
        if section.first_bar == bar:
            yield f"[{section.name}]"


# --- a bar ------------------------------------------------------------------------------------------------------------


def _bar(score: Score, bar: int) -> _Lines:
    lost = dict[Loss, None]()
    start, end = score.tempo_map.bar_start(bar), score.tempo_map.bar_start(bar + 1)
    meter = score.tempo_map.meter_at(start)
    first, last = score.notes["tick"].searchsorted([start, end])
    notes = [score[i] for i in range(first, last) if not score.is_grace[i]]
    chokes = [n.tick + n.choke_ticks for n in notes if _is_choked(n)]
    within = [n.tick - start for n in notes] + [t - start for t in chokes if t < end]
    beats = [k * meter.beat_ticks for k in range(meter.beats)]
    count = (end - start) // gcd(end - start, *within, *beats)
    if count > _FINEST:
        lost[Loss(Feature.TIMES, f"bar {bar + 1}: finer than {_FINEST} cells; moved to the nearest")] = None
        count = _finest_for(meter.beats)
    rows: dict[Piece, list[str]] = {}
    for note in notes:
        cells = rows.setdefault(note.piece, ["-"] * count)
        cells[_cell(note.tick - start, end - start, count)] = _letter(note, lost)
    for note in notes:
        at = note.tick + note.choke_ticks
        if _is_choked(note) and at < end and rows[note.piece][_cell(at - start, end - start, count)] == "-":
            rows[note.piece][_cell(at - start, end - start, count)] = CHOKE
    lines = {piece: "".join(cells) for piece, cells in rows.items()}
    return _Lines(bar, lines, _counting(meter.beats, count), tuple(lost))


def _finest_for(beats: int) -> int:
    return _FINEST // beats * beats or beats


def _cell(tick: int, length: int, count: int) -> int:
    return min(round(tick * count / length), count - 1)


def _is_choked(note: Note) -> bool:
    return note.choke_ticks > 0 and note.piece in CHOKEABLE


def _counting(beats: int, cells: int) -> str:
    """1 to the last beat, each over its cell; + half way where there is room."""
    a_beat = cells // beats
    out = [" "] * cells
    for beat in range(beats):
        number = str(beat + 1)
        if len(number) <= a_beat:
            out[beat * a_beat : beat * a_beat + len(number)] = number
        if a_beat % 2 == 0 and a_beat > len(number):
            out[beat * a_beat + a_beat // 2] = "+"
    return "".join(out)


def _letter(note: Note, lost: dict[Loss, None]) -> str:
    """The letter of the note's piece that differs least, the ornament first."""
    letters = LETTERS[note.piece]
    ornament = Ornament.NONE if note.ornament is Ornament.DIDDLE else note.ornament
    is_buzz = note.articulation is Articulation.BUZZ
    wanted = TabStroke(
        note.zone,
        note.articulation,
        note.dynamic,
        note.openness,
        Ornament.ROLL if is_buzz else Ornament.NONE if ornament is Ornament.ROLL else ornament,
    )
    letter = min(letters, key=lambda each: _distance(letters[each], wanted))
    if letters[letter].dynamic is not note.dynamic:
        what = {Dynamic.GHOST: "ghost", Dynamic.ACCENT: "accent"}.get(note.dynamic, "stroke")
        lost[Loss(Feature.DYNAMICS, f"{OWN_LABELS[note.piece]}: no letter for such a {what}")] = None
    return letter


def _distance(struck: TabStroke, wanted: TabStroke) -> tuple[bool, bool, bool, bool, float, int]:
    return (
        struck.piece is not None,
        struck.articulation is not wanted.articulation,
        struck.ornament is not wanted.ornament,
        struck.zone is not wanted.zone,
        abs((struck.openness or 0.0) - (wanted.openness or 0.0)),
        abs(struck.dynamic - wanted.dynamic),
    )


ASCII_TAB = MusicFormat("drum tab", (".tab", ".txt"), read_tab, is_tab, MOST_BYTES, write_tab, _KEEPS)
