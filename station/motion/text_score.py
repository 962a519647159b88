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

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.files import write_whole
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone, word
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

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
_NUMBERS = {"lead_ms": float, "openness": float, "duration_ticks": int, "choke_ticks": int, "midi_note": int}
_PLACE = re.compile(r"(\d+):(\d+)(?:\+(\d+)/(\d+))?")


def write_text_score(score: Score, limbs: NDArray[np.int8], path: Path) -> None:
    """Write `score` with its `limbs` (n,) whole to `path`; raises `DeviceError` if the disk refuses."""
    write_whole(path, score_text(score, limbs).encode())


def read_text_score(path: Path) -> Score:
    """The score in a file; raises `BadInput` with the line of the first fault."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as fault:
        raise BadInput(path, "", str(fault)) from fault
    return parse_text_score(text, str(path))


# --- writing ----------------------------------------------------------------------------------------------------------


def score_text(score: Score, limbs: NDArray[np.int8]) -> str:
    """The text of `score` when `limbs` (n,) play it."""
    tempo_map = score.tempo_map
    lines = [HEADER, *([f"title {score.title}"] if score.title else [])]
    lines += [f"meter {_where(tempo_map, m.tick)} {m.beats}/{m.unit}" for m in tempo_map.meters]
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


def parse_text_score(text: str, source: str = "text score") -> Score:
    """The score that `text` says; raises `BadInput` with the line of the first fault."""
    lines = [(i + 1, _words(line)) for i, line in enumerate(text.splitlines())]
    lines = [(number, words) for number, words in lines if words]
    reader = _Reader(source)
    reader.tempo_map = reader.meters(lines)
    reader.tempo_map = reader.tempos(lines)
    notes = [reader.note(number, words) for number, words in lines if words[0] not in _DIRECTIVES]
    ends = [reader.tick(number, words[1:2]) for number, words in lines if words[0] == "end"]
    titles = [" ".join(words[1:]) for _, words in lines if words[0] == "title"]
    title = titles[-1] if titles else ""
    return Score.from_notes(notes, reader.tempo_map, ends[-1] if ends else None, title)


def _words(line: str) -> list[str]:
    """What a line says without its comment; a title is taken as it stands."""
    return line.split() if line.startswith("title ") else line.split("#", maxsplit=1)[0].split()


_DIRECTIVES = {"title", "tempo", "meter", "end"}
_Line = tuple[int, list[str]]


class _Reader:
    """Reads places against the meters that it has seen so far."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.tempo_map = TempoMap()

    def fault(self, number: int, what: str) -> BadInput:
        return BadInput(self.source, f"line {number}", what)

    def meters(self, lines: list[_Line]) -> TempoMap:
        changes: list[MeterChange] = []
        for number, words in lines:
            if words[0] != "meter":
                continue
            self.tempo_map = TempoMap.build([], changes)
            match = re.fullmatch(r"(\d+)/(\d+)", words[2]) if len(words) == 3 else None
            if not match or int(match[1]) == 0 or int(match[2]) not in (1, 2, 4, 8, 16, 32):
                raise self.fault(number, 'expected "meter BAR:BEAT BEATS/UNIT"')
            changes.append(MeterChange(self.tick(number, words[1:2]), int(match[1]), int(match[2])))
        return TempoMap.build([], changes)

    def tempos(self, lines: list[_Line]) -> TempoMap:
        changes = []
        for number, words in lines:
            if words[0] != "tempo":
                continue
            match = re.fullmatch(r"(\d+(?:\.\d+)?)(us)?", words[2]) if len(words) == 3 else None
            if not match or float(match[1]) <= 0:
                raise self.fault(number, 'expected "tempo BAR:BEAT BPM" or microseconds a quarter with "us"')
            tick = self.tick(number, words[1:2])
            exact = TempoChange(tick, int(float(match[1]))) if match[2] else TempoChange.from_bpm(tick, float(match[1]))
            changes.append(exact)
        return TempoMap.build(changes, self.tempo_map.meters)

    def tick(self, number: int, words: list[str]) -> int:
        match = _PLACE.fullmatch(words[0]) if words else None
        if not match or match[4] == "0":
            raise self.fault(number, f"expected a place such as 2:3+1/2, found {words[0] if words else 'nothing'}")
        bar, beat = int(match[1]) - 1, int(match[2]) - 1
        if bar < 0 or beat < 0:
            raise self.fault(number, f"bars and beats count from 1, found {words[0]}")
        start = self.tempo_map.bar_start(bar)
        beat_ticks = self.tempo_map.meter_at(start).beat_ticks
        share = Fraction(int(match[3]), int(match[4])) if match[3] else Fraction(0)
        return start + round((beat + share) * beat_ticks)

    def note(self, number: int, words: list[str]) -> Note:
        if len(words) < 5:
            raise self.fault(number, "expected place, piece, zone, limb and velocity")
        place, piece, zone, limb, velocity, *extras = words
        for given, known, what in ((piece, _PIECES, "piece"), (zone, _ZONES, "zone"), (limb, _LIMBS, "limb")):
            if given not in known:
                raise self.fault(number, f"{given} is no {what}; there are {', '.join(known)}")
        if not velocity.isdigit() or not 1 <= int(velocity) <= 127:
            raise self.fault(number, f"expected a velocity from 1 to 127, found {velocity}")
        tick = self.tick(number, [place])
        note = Note(tick, _PIECES[piece], _ZONES[zone], int(velocity), limb=_LIMBS[limb])
        for extra in extras:
            note = self.with_extra(number, note, extra)
        return note

    def with_extra(self, number: int, note: Note, extra: str) -> Note:
        name, _, value = extra.partition("=")
        if value and name in _NUMBERS:
            try:
                return replace(note, **{name: _NUMBERS[name](value)})
            except ValueError as fault:
                raise self.fault(number, f"{name} expects a number, found {value}") from fault
        if extra in _ARTICULATIONS:
            return replace(note, articulation=_ARTICULATIONS[extra])
        if extra in _DYNAMICS:
            return replace(note, dynamic=_DYNAMICS[extra])
        if extra in _ORNAMENTS:
            return replace(note, ornament=_ORNAMENTS[extra])
        known = ", ".join((*_ARTICULATIONS, *_DYNAMICS, *_ORNAMENTS, *_NUMBERS))
        raise self.fault(number, f"{extra} says nothing; there are {known}")
