"""PyGuitarPro's parsers for `.gp3`, `.gp4` and `.gp5` with bounds around them.

The library trusts the counts that a file states, searches a bar's beats from the end for every new one and compares
whole beats where a note is tied: a megabyte of hostile bytes takes it many minutes. Here counts are bounded, searches
are look-ups, and of all tracks but those of drums only tempo changes stay in memory. It also raises on some legal files
(a brush of speed 0); what only guitars have is not interpreted.

This module imports PyGuitarPro (LGPL-3.0, unchanged, from the registry): import it where such a file is read.
"""

# ruff: noqa: ANN401  PyGuitarPro has no types

import io
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from guitarpro.io import getVersionAndGPFile
from guitarpro.iobase import GPFileBase
from guitarpro.models import Beat, BeatStroke, Song

from station.core.errors import BadInput
from station.music.formats.guitar_pro.tab_song import MOST_TAB_BEATS, MOST_TAB_NOTES
from station.music.formats.playing_order import MOST_BARS

_MOST_TRACKS = 256
"""Guitar Pro 5 has up to 127."""
_MOST_TRACK_BARS = 40_000
"""Bars of all tracks together, 0.1 ms each to read (our choice: 400 bars of 100 tracks)."""
_DRUM_CHANNEL = 9
_ENCODING = "cp1252"


@dataclass
class ParsedTabs:
    """PyGuitarPro's song, and what its model has no room for.

    `signs` and `jumps` are (name, bar from 0) of GP5's directions; `tempos` are (bar, place in the bar in 1/960 of a
    quarter note, bpm) of all tracks, in order.
    """

    song: Song
    signs: list[tuple[str, int]] = field(default_factory=list)
    jumps: list[tuple[str, int]] = field(default_factory=list)
    tempos: list[tuple[int, Fraction, int]] = field(default_factory=list)


def is_drum_track(track: Any) -> bool:
    """Whether a track of the library's is for drums: by its flag or its channel (10 of any port)."""
    return bool(track.isPercussionTrack) or track.channel.channel % 16 == _DRUM_CHANNEL


def parse_tabs(data: bytes, source: str) -> ParsedTabs:
    """The song in `data`; raises `BadInput` with the bar and the byte where reading ended."""
    stream = io.BytesIO(data)
    try:
        version = GPFileBase(stream, _ENCODING).readVersion()
        version_tuple, base = getVersionAndGPFile(version)
    except Exception as fault:
        raise BadInput(source, "byte 0", "no Guitar Pro 3, 4 or 5 file that this reader knows") from fault
    parser = _guarded(base)(stream, _ENCODING, version, version_tuple)
    try:
        song = parser.readSong()
    except Exception as fault:  # whatever a library raises of strange bytes
        bound = next((e for e in (fault, fault.__cause__) if isinstance(e, BadInput)), None)
        text = bound.fault if bound else f"not as Guitar Pro writes it: {fault or type(fault).__name__}"
        raise BadInput(source, parser.place, text) from fault
    return ParsedTabs(song, parser.signs, parser.jumps, parser.tempos)


def _check(count: int, most: int, what: str) -> None:
    if not 0 <= count <= most:
        raise BadInput("", "", f"{count} {what}; expected at most {most}")


def _tempos_of(measure: Any, voice: Any) -> Iterator[tuple[int, Fraction, int]]:
    for beat in voice.beats:
        change = beat.effect.mixTableChange
        if change is not None and change.tempo is not None:
            yield measure.number - 1, Fraction(beat.start - measure.start), change.tempo.value


def _guarded(base: Any) -> Any:
    """The library's class for one version, with bounds."""

    class Guarded(base):  # type: ignore[misc]  # the class depends on the file's version
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)
            self.signs: list[tuple[str, int]] = []
            self.jumps: list[tuple[str, int]] = []
            self.tempos: list[tuple[int, Fraction, int]] = []
            self._bar = 0
            self._beat_count = self._note_count = 0
            self._last_values: dict[tuple[int, int | None, int], int] = {}

        @property
        def place(self) -> str:
            byte = f"byte {self.data.tell()}"
            return f"bar {self._bar}, {byte}" if self._bar else byte

        def readMeasureHeaders(self, song: Any, count: int, *directions: Any) -> None:  # noqa: N802
            _check(count, MOST_BARS, "bars")
            if not directions:
                super().readMeasureHeaders(song, count)
                return
            signs, jumps = directions[0]
            super().readMeasureHeaders(song, count, ({}, {}))
            self.signs = [(sign.name, bar - 1) for sign, bar in signs.items() if 0 < bar <= count]
            self.jumps = [(sign.name, bar - 1) for sign, bar in jumps.items() if 0 < bar <= count]

        def readTracks(self, song: Any, count: int, channels: Any) -> None:  # noqa: N802
            _check(count, _MOST_TRACKS, "tracks")
            _check(count * len(song.measureHeaders), _MOST_TRACK_BARS, "bars of all tracks together")
            super().readTracks(song, count, channels)

        def readMeasure(self, measure: Any) -> None:  # noqa: N802
            self._bar = measure.number
            super().readMeasure(measure)
            for voice in measure.voices:
                self.tempos += _tempos_of(measure, voice)
                if not is_drum_track(measure.track):
                    voice.beats.clear()

        def readVoice(self, start: Any, voice: Any) -> None:  # noqa: N802
            count = self.readI32()
            self._beat_count += max(count, 0)
            _check(count, MOST_TAB_BEATS, "beats in a bar")
            _check(self._beat_count, MOST_TAB_BEATS, "beats")
            for number in range(1, count + 1):
                self._currentBeatNumber: int | None = number
                start += self.readBeat(start, voice)
            self._currentBeatNumber = None

        def getBeat(self, voice: Any, start: Any) -> Any:  # noqa: N802
            """Beats come in order: one that begins here can only be the last."""
            if not voice.beats or voice.beats[-1].start != start:
                voice.beats.append(Beat(voice, start=start))
            return voice.beats[-1]

        def readNote(self, note: Any, string: Any, track: Any) -> Any:  # noqa: N802
            self._note_count += 1
            _check(self._note_count, MOST_TAB_NOTES, "notes")
            super().readNote(note, string, track)
            self._last_values[track.number, self._currentVoiceNumber, note.string] = note.value
            return note

        def getTiedNoteValue(self, note: Any) -> int:  # noqa: N802
            track = note.beat.voice.measure.track
            return self._last_values.get((track.number, self._currentVoiceNumber, note.string), -1)

        def readBeatStroke(self) -> Any:  # noqa: N802
            self.readI8()
            self.readI8()
            return BeatStroke()

    return Guarded
