"""A score as text whose limbs a person can edit and read back (the idea of SMED's `mid2scr`, thesis § 4.1.3).

A line a stroke: where (bar:beat+fraction of the beat, all from 1), piece, zone, limb, velocity, then what else there is
to say as words and `key=value`. Tempo and meter changes have lines of their own, `#` begins a comment. What is written
reads back the same to the tick; a limb of `-` is free.

    tempo 1:1 120
    meter 1:1 4/4
    1:1       hihat  bow   right_hand  80
    1:2+1/2   snare  head  left_hand   96  accent
    end 3:1
"""

import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.disk.utf8 import utf8_text
from station.core.errors import BadInput
from station.core.pieces import HAND_PIECES, Articulation, Dynamic, Limb, Ornament, Piece, Zone, word
from station.music.drum_part import DrumPart
from station.music.formats.music_format import MusicFormat
from station.music.score import MAX_LATE_MS, Note, Score
from station.music.tempo import METER_UNITS, MeterChange, TempoChange, TempoMap

MOST_BYTES = 8 << 20
"""No text score is longer (our choice: hours of music)."""

HEADER = "# drum station text score 1"

_PIECES = {word(p): p for p in Piece}
_ZONES = {word(z): z for z in Zone}
_LIMBS = {"-": Limb.UNKNOWN} | {word(m): m for m in Limb if m is not Limb.UNKNOWN}
_LETTERS = {Limb.UNKNOWN: "-"} | {m: word(m) for m in Limb if m is not Limb.UNKNOWN}
_SPLASH = "foot_splash"  # "splash" is a piece
_ARTICULATIONS: dict[str, Articulation] = {_SPLASH: Articulation.SPLASH} | {
    word(a): a for a in Articulation if a not in (Articulation.NORMAL, Articulation.SPLASH)
}
_DYNAMICS = {word(d): d for d in Dynamic if d is not Dynamic.NORMAL}
_ORNAMENTS = {word(o): o for o in Ornament if o is not Ornament.NONE}
_LONGEST = 10**15
"""Ticks that no score reaches and 64 bits hold (our choice)."""
_NUMBERS: dict[str, tuple[type[int] | type[float], float, float]] = {
    "lead_ms": (float, 0.0, 1000.0),
    "late_ms": (float, -MAX_LATE_MS, MAX_LATE_MS),
    "openness": (float, 0.0, 1.0),
    "duration_ticks": (int, 0, _LONGEST),
    "choke_ticks": (int, 0, _LONGEST),
    "midi_note": (int, 0, 127),
}
"""What a number is, its least and its greatest value; a grace stroke a second early is none any more (our choice)."""
_PLAYERS = {True: (Limb.RIGHT_HAND, Limb.LEFT_HAND), False: (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)}
_SLOWEST_US = 10**9
"""Microseconds a quarter note, far slower than MIDI files can say (our choice)."""
_PLACE = re.compile(r"([0-9]{1,6}):([0-9]{1,3})(?:\+([0-9]{1,9})/([0-9]{1,9}))?")


def write_text_score(score: Score, limbs: NDArray[np.int8], path: Path) -> None:
    """Write `score` with its `limbs` (n,) whole to `path`; raises `DeviceError` if the disk refuses."""
    write_whole(path, score_text(score, limbs).encode())


# --- writing ----------------------------------------------------------------------------------------------------------


def score_text(score: Score, limbs: NDArray[np.int8]) -> str:
    """The text of `score` when `limbs` (n,) play it."""
    tempo_map = score.tempo_map
    lines = [HEADER, *([f"title {score.title}"] if score.title else [])]
    for k, m in enumerate(tempo_map.meters):  # counted by the meters before: a change in mid-bar begins a bar there
        lines.append(f"meter {_where(TempoMap.build([], tempo_map.meters[:k]), m.tick)} {m.beats}/{m.unit}")
    lines += [f"tempo {_where(tempo_map, t.tick)} {t.us_per_quarter}us" for t in tempo_map.tempos]
    for note, limb in zip(score, limbs.tolist(), strict=True):
        place, limb_word = _where(tempo_map, note.tick), _LETTERS[Limb(limb)]
        line = f"{place:<10} {word(note.piece):<12} {word(note.zone):<5} {limb_word:<10} {note.velocity:>3}"
        lines.append("  ".join((line, *_extras(note))))
    return "\n".join([*lines, f"end {_where(tempo_map, score.end_tick)}"]) + "\n"


def _where(tempo_map: TempoMap, tick: int) -> str:
    place = tempo_map.position_at(tick)
    share = Fraction(place.tick, tempo_map.meter_at(tick).beat_ticks)
    return f"{place.bar + 1}:{place.beat + 1}" + (f"+{share}" if share else "")


def _extras(note: Note) -> Iterator[str]:
    if note.articulation is Articulation.SPLASH:
        yield _SPLASH
    elif note.articulation is not Articulation.NORMAL:
        yield word(note.articulation)
    if note.dynamic is not Dynamic.NORMAL:
        yield word(note.dynamic)
    if note.ornament is not Ornament.NONE:
        yield word(note.ornament)
    natural = Note(0, note.piece)
    for name in _NUMBERS:
        value = getattr(note, name)
        if value != getattr(natural, name):
            yield f"{name}={value!r}"


# --- reading ----------------------------------------------------------------------------------------------------------


class _Word(NamedTuple):
    """A word of the file and where it begins, line and column from 1."""

    text: str
    line: int
    column: int


_Line = list[_Word]
_DIRECTIVES = ("title", "tempo", "meter", "end")
_A_LINE = re.compile(rf"^[ \t]*(?:(?:{'|'.join(_DIRECTIVES)})[ \t]|[0-9]{{1,6}}:[0-9])", re.MULTILINE)


def parse_text_score(text: str, source: str = "text score") -> Score:
    """The score that `text` says; raises `BadInput` with line and column of the first fault."""
    rows = text.splitlines()
    lines = [words for words in (_words(row, i + 1) for i, row in enumerate(rows)) if words]
    reader = _Reader(source)
    reader.tempo_map = reader.meters(lines)
    reader.tempo_map = reader.tempos(lines)
    notes = [reader.note(words) for words in lines if words[0].text not in _DIRECTIVES]
    ends = [reader.end(words) for words in lines if words[0].text == "end"]
    titles = [rows[words[0].line - 1].split(maxsplit=1)[1].strip() for words in lines if _is_title(words)]
    return Score.from_notes(notes, reader.tempo_map, ends[-1] if ends else None, titles[-1] if titles else "")


def _is_title(words: _Line) -> bool:
    return words[0].text == "title" and len(words) > 1


def _words(row: str, line: int) -> _Line:
    """What a row says without its comment; a title is taken as it stands."""
    words = [_Word(m[0], line, m.start() + 1) for m in re.finditer(r"\S+", row)]
    if words and words[0].text == "title":
        return words
    said = row.split("#", maxsplit=1)[0]
    return [_Word(m[0], line, m.start() + 1) for m in re.finditer(r"\S+", said)]


class _Reader:
    """Reads places against the meters that it has seen so far."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.tempo_map = TempoMap()

    def fault(self, word: _Word, expected: str) -> BadInput:
        return BadInput(self.source, f"line {word.line}, column {word.column}", f"{expected}, found {word.text!r}")

    def meters(self, lines: list[_Line]) -> TempoMap:
        changes: list[MeterChange] = []
        for words in lines:
            if words[0].text != "meter":
                continue
            place, value = self.directive(words, "meter BAR:BEAT BEATS/UNIT")
            self.tempo_map = TempoMap.build([], changes)
            match = re.fullmatch(r"([0-9]{1,3})/([0-9]{1,3})", value.text)
            if not match or int(match[1]) == 0 or int(match[2]) not in METER_UNITS:
                raise self.fault(value, "expected a meter such as 4/4 or 6/8")
            changes.append(MeterChange(self.tick(place), int(match[1]), int(match[2])))
        return TempoMap.build([], changes)

    def tempos(self, lines: list[_Line]) -> TempoMap:
        changes = []
        for words in lines:
            if words[0].text != "tempo":
                continue
            place, value = self.directive(words, "tempo BAR:BEAT BPM")
            match = re.fullmatch(r"([0-9]+(?:\.[0-9]+)?)(us)?", value.text)
            number = float(match[1]) if match else 0.0
            us = number if match and match[2] else 60e6 / max(number, 1e-9)
            if not 1 <= us <= _SLOWEST_US:
                raise self.fault(value, 'expected quarter notes a minute, or microseconds of one with "us"')
            changes.append(TempoChange(self.tick(place), round(us)))
        return TempoMap.build(changes, self.tempo_map.meters)

    def directive(self, words: _Line, expected: str) -> tuple[_Word, _Word]:
        if len(words) != 3:
            raise self.fault(words[0], f'expected "{expected}"')
        return words[1], words[2]

    def end(self, words: _Line) -> int:
        if len(words) != 2:
            raise self.fault(words[0], 'expected "end BAR:BEAT"')
        return self.tick(words[1])

    def tick(self, word: _Word) -> int:
        """The tick of a place, which must be in its bar."""
        match = _PLACE.fullmatch(word.text)
        if not match or (match[4] and int(match[3]) >= int(match[4])):
            raise self.fault(word, "expected a place such as 2:3+1/2: bar, beat and a part of the beat below 1")
        bar, beat = int(match[1]) - 1, int(match[2]) - 1
        if bar < 0:
            raise self.fault(word, "expected bars that count from 1")
        start = self.tempo_map.bar_start(bar)
        meter = self.tempo_map.meter_at(start)
        if not 0 <= beat < meter.beats:
            raise self.fault(word, f"expected a beat from 1 to {meter.beats}")
        share = Fraction(int(match[3]), int(match[4])) if match[4] else Fraction(0)
        return start + round((beat + share) * meter.beat_ticks)

    def note(self, words: _Line) -> Note:
        if len(words) < 5:
            raise self.fault(words[0], f"expected place, piece, zone, limb and velocity or {', '.join(_DIRECTIVES)}")
        place, piece, zone, limb, velocity, *extras = words
        for given, known, what in ((piece, _PIECES, "piece"), (zone, _ZONES, "zone"), (limb, _LIMBS, "limb")):
            if given.text not in known:
                raise self.fault(given, f"expected a {what}: {', '.join(known)}")
        if not re.fullmatch(r"[0-9]{1,3}", velocity.text) or not 1 <= int(velocity.text) <= 127:
            raise self.fault(velocity, "expected a velocity from 1 to 127")
        if _LIMBS[limb.text] not in (Limb.UNKNOWN, *_PLAYERS[_PIECES[piece.text] in HAND_PIECES]):
            players = ", ".join(word(m) for m in _PLAYERS[_PIECES[piece.text] in HAND_PIECES])
            raise self.fault(limb, f"expected one that can play the {piece.text}: {players} or -")
        tick = self.tick(place)
        note = Note(tick, _PIECES[piece.text], _ZONES[zone.text], int(velocity.text), limb=_LIMBS[limb.text])
        for extra in extras:
            note = self.with_extra(note, extra)
        return note

    def with_extra(self, note: Note, extra: _Word) -> Note:
        name, _, value = extra.text.partition("=")
        if value and name in _NUMBERS:
            number = {name: self.number(extra, name, value)}
            return replace(note, **number)  # type: ignore[arg-type] # each name is a field of its kind of number
        if extra.text in _ARTICULATIONS:
            return replace(note, articulation=_ARTICULATIONS[extra.text])
        if extra.text in _DYNAMICS:
            return replace(note, dynamic=_DYNAMICS[extra.text])
        if extra.text in _ORNAMENTS:
            return replace(note, ornament=_ORNAMENTS[extra.text])
        known = ", ".join((*_ARTICULATIONS, *_DYNAMICS, *_ORNAMENTS, *(f"{n}=NUMBER" for n in _NUMBERS)))
        raise self.fault(extra, f"expected one of {known}")

    def number(self, extra: _Word, name: str, value: str) -> float:
        kind, least, most = _NUMBERS[name]
        try:
            number = kind(value)
        except ValueError:
            number = most + 1
        if not least <= number <= most:  # also refuses NaN
            raise self.fault(extra, f"expected {name} from {least:g} to {most:g}")
        return number


def is_text_score(data: bytes) -> bool:
    """Whether a text has a line that begins as those of a score do, or the first line of one."""
    text = data.decode("utf-8", "replace")
    return text.startswith(HEADER) or bool(_A_LINE.search(text))


def _read_part(data: bytes, source: str) -> DrumPart:
    return DrumPart(parse_text_score(utf8_text(data, source, "a text score"), source))


TEXT_ENDING = ".txt"
TEXT_SCORE = MusicFormat("text score", (TEXT_ENDING,), _read_part, is_text_score, MOST_BYTES)
