"""`.gp3`, `.gp4` and `.gp5`: from PyGuitarPro's song to a `TabSong`.

Of several drum tracks the one with most strokes is taken. A fret is a percussion number. What each thing means to a
drummer stands in `tab_part`; let ring, dead notes, slides, bends and what else guitars have is nothing to a drum.
"""

# ruff: noqa: ANN401  PyGuitarPro has no types

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from station.core.errors import BadInput
from station.core.pieces import Dynamic
from station.core.units import PPQ
from station.music.formats.guitar_pro.guarded_parser import ParsedTabs, is_drum_track, parse_tabs
from station.music.formats.guitar_pro.tab_song import TabBar, TabBeat, TabNote, TabSong
from station.music.formats.guitar_pro.tab_words import (
    FEEL_OF,
    STRAIGHT_FEEL,
    bpm_to_us,
    checked_meter,
    signs_of,
    within,
)
from station.music.grace_strokes import MAX_VELOCITY, MIN_VELOCITY

_QUARTER = 960
"""PyGuitarPro's units a quarter note."""
_SHORTEST = 256
"""No note is shorter than 1/256."""
_TIE = 2
"""PyGuitarPro's `NoteType.tie`."""
_ENDING_BITS = 8

_FEELS = {0: STRAIGHT_FEEL, 1: FEEL_OF["triplet8th"], 2: FEEL_OF["triplet16th"]}


def read_old_tabs(data: bytes, source: str) -> TabSong:
    """The drums of a Guitar Pro 3, 4 or 5 file; raises `BadInput` with the bar of a fault."""
    parsed = parse_tabs(data, source)
    song = parsed.song
    drums = [track for track in song.tracks if is_drum_track(track)]
    if not drums:
        raise BadInput(source, "", f"no drum track among its {len(song.tracks)} tracks")
    track = max(drums, key=_stroke_count)
    others = [t.name.strip() or "?" for t in drums if t is not track and _stroke_count(t)]
    return TabSong(
        song.title.strip() or Path(source).stem,
        song.artist.strip() or song.music.strip(),
        " ".join(" ".join([song.subtitle, song.instructions, *song.notice]).split()),
        tuple(_Bars(parsed, track, source).bars()),
        tuple(f"another drum track: {name}" for name in others),
    )


def _stroke_count(track: Any) -> int:
    beats = (beat for measure in track.measures for voice in measure.voices for beat in voice.beats)
    return sum(len(beat.notes) for beat in beats)


class _Bars:
    """The bars of one track with what the song says over them."""

    def __init__(self, parsed: ParsedTabs, track: Any, source: str) -> None:
        self.parsed, self.track, self.source = parsed, track, source
        self.tempos: dict[int, list[tuple[int, int]]] = {}
        for bar, place, bpm in parsed.tempos:
            self.tempos.setdefault(bar, []).append((_ticks(place), bpm_to_us(bpm, source, bar)))

    def bars(self) -> Iterator[TabBar]:
        us = bpm_to_us(self.parsed.song.tempo, self.source, 0)
        directions: dict[int, list[str]] = {}
        for name, bar in (*self.parsed.signs, *self.parsed.jumps):
            directions.setdefault(bar, []).append(name)
        for i, measure in enumerate(self.track.measures):
            header = measure.header
            meter = checked_meter(
                header.timeSignature.numerator, header.timeSignature.denominator.value, self.source, i
            )
            tempos = [(0, us), *sorted(self.tempos.get(i, []))]
            us = tempos[-1][1]
            yield TabBar(
                meter,
                tuple(within((b for voice in measure.voices for b in _beats(measure, voice)), meter)),
                tuple((tick, rate) for tick, rate in tempos if tick < meter.bar_ticks),
                signs_of(
                    directions.get(i, ()),
                    repeat_from=header.isRepeatOpen,
                    repeat_times=header.repeatClose + 1 if header.repeatClose > 0 else 0,
                    endings=frozenset(n + 1 for n in range(_ENDING_BITS) if header.repeatAlternative >> n & 1),
                ),
                _FEELS[header.tripletFeel.value],
                header.marker.title.strip() if header.marker is not None else "",
            )


def _beats(measure: Any, voice: Any) -> Iterator[TabBeat]:
    for beat in voice.beats:
        if beat.notes and beat.duration.value <= _SHORTEST:
            yield TabBeat(
                _ticks(Fraction(beat.start - measure.start)),
                max(_ticks(Fraction(beat.duration.time)), 1),
                tuple(_note(note) for note in beat.notes),
                beat.duration.tuplet.enters != beat.duration.tuplet.times,
            )


def _note(note: Any) -> TabNote:
    effect = note.effect
    roll = effect.tremoloPicking.duration.value if effect.tremoloPicking is not None else None
    return TabNote(
        note.value,
        min(max(note.velocity, MIN_VELOCITY), MAX_VELOCITY),
        _dynamic(effect),
        (effect.grace.fret,) if effect.grace is not None else (),
        4 * PPQ // roll if roll else 0,
        note.type.value == _TIE,
    )


def _dynamic(effect: Any) -> Dynamic:
    if effect.accentuatedNote or effect.heavyAccentuatedNote:
        return Dynamic.ACCENT
    return Dynamic.GHOST if effect.ghostNote else Dynamic.NORMAL


def _ticks(units: Fraction) -> int:
    return round(units * PPQ / _QUARTER)
