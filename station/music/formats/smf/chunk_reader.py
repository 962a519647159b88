"""The chunks of a Standard MIDI File: header, tracks, and whatever else is there; bytes in, `MidiFile` out.

A file is read as it stands or refused with one `BadInput` that names the offset of the wrong byte; `MidiFile.oddities`
reports what was passed over.

Source: MIDI Association, RP-001 "Standard MIDI Files 1.0"; RP-029 for the RIFF wrapper.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.music.formats.smf.contents import CONTROL_DTYPE, NOT_ENDED, TRACK_NOTE_DTYPE, Division, MidiFile, MidiTrack
from station.music.formats.smf.track_events import Columns, TrackEvents, parse_events

MAX_BYTES = 8 << 20
"""Our choice: a million notes, many times the longest piece. What is larger is not music, and the bound keeps the
memory that the worst of files takes below 400 MB."""

_MOST_TRACKS = 1000
"""Our choice: an orchestra's score has fifty, and every empty one still costs a quarter of a millisecond."""
_MOST_CHANGES = 50_000
"""Of tempo and meter (our choice: an hour in which the tempo is drawn as a curve of fourteen points a second)."""
_HEADER_BYTES = 6
_CHUNK_HEAD_BYTES = 8
_RIFF_HEAD_BYTES = 20
_FORMATS = (0, 1, 2)
_SMPTE_US = {24: (24, 1_000_000), 25: (25, 1_000_000), 29: (30, 1_001_000), 30: (30, 1_000_000)}
"""Frames a second as written -> so many frames last so many µs (29 is the 30000/1001 of colour television)."""

_NOTE_OFF, _NOTE_ON, _AFTERTOUCH, _CONTROL = 0x80, 0x90, 0xA0, 0xB0


def parse_midi(data: bytes, source: str) -> MidiFile:
    """The MIDI file whose bytes are `data`; raises `BadInput` with `source` and the byte offset of the fault."""
    if len(data) > MAX_BYTES:
        raise BadInput(source, "", f"is larger than {MAX_BYTES >> 20} MiB, which no MIDI file is")
    start = _RIFF_HEAD_BYTES if data[:4] == b"RIFF" and data[8:16] == b"RMIDdata" else 0
    header = _header(data, start, source)
    found = _tracks(data, header, source)
    if (changes := sum(len(t.tempos) + len(t.meters) for t in found.tracks)) > _MOST_CHANGES:
        raise BadInput(source, "", f"{changes:,} changes of tempo and meter; at most {_MOST_CHANGES:,} are read")
    midi = MidiFile(source, header.format, header.division, tuple(_track(t) for t in found.tracks), found.oddities)
    if any(sequence.lasts_too_long for sequence in midi.sequences):
        raise BadInput(source, "", "lasts longer than a year, which no music does")
    return midi


@dataclass(frozen=True, slots=True)
class _Header:
    format: int
    track_count: int
    division: Division
    end: int


def _kind_label(kind: bytes) -> str:
    """The four letters of a chunk's head; what is no letter as its number."""
    return "".join(chr(c) if 0x20 <= c < 0x7F else f"\\x{c:02x}" for c in kind)


def _header(data: bytes, start: int, source: str) -> _Header:
    if not data:
        raise BadInput(source, "byte 0", "the file is empty")
    if data[start : start + 4] != b"MThd":
        raise BadInput(
            source, f"byte {start}", f"not a MIDI file: {_kind_label(data[start : start + 4])} where MThd should be"
        )
    body = start + _CHUNK_HEAD_BYTES
    length = int.from_bytes(data[start + 4 : body], "big")
    if len(data) < body + _HEADER_BYTES:
        raise BadInput(source, f"byte {len(data)}", "the file ends in the middle of its header")
    if not _HEADER_BYTES <= length <= len(data) - body:
        raise BadInput(source, f"byte {start + 4}", f"a header of {length} bytes; {_HEADER_BYTES} were expected")
    kind, count, division = (int.from_bytes(data[at : at + 2], "big") for at in range(body, body + _HEADER_BYTES, 2))
    if kind not in _FORMATS:
        raise BadInput(source, f"byte {body}", f"MIDI file format {kind}; there are only 0, 1 and 2")
    if count > _MOST_TRACKS:
        raise BadInput(source, f"byte {body + 2}", f"{count} tracks; at most {_MOST_TRACKS} are read")
    return _Header(kind, count, _division(division, body + 4, source), body + length)


def _division(word: int, at: int, source: str) -> Division:
    if not word & 0x8000:
        if not word:
            raise BadInput(source, f"byte {at}", "0 ticks a quarter note")
        return Division(word)
    frames, ticks = 256 - (word >> 8), word & 0xFF
    if frames not in _SMPTE_US or not ticks:
        raise BadInput(
            source, f"byte {at}", f"{frames} frames of {ticks} ticks a second; SMPTE has 24, 25, 29 or 30 frames"
        )
    per_cycle, us = _SMPTE_US[frames]
    return Division(per_cycle * ticks, us)


@dataclass(frozen=True, slots=True)
class _Found:
    tracks: list[TrackEvents]
    oddities: tuple[str, ...]


def _tracks(data: bytes, header: _Header, source: str) -> _Found:
    """Every track chunk; chunks of other kinds are skipped, as RP-001 asks."""
    tracks: list[TrackEvents] = []
    oddities: list[str] = []
    at = header.end
    while len(tracks) < header.track_count:
        if len(data) - at < _CHUNK_HEAD_BYTES:
            raise BadInput(
                source, f"byte {len(data)}", f"the file ends with {len(tracks)} of its {header.track_count} tracks"
            )
        kind, start = data[at : at + 4], at + _CHUNK_HEAD_BYTES
        end = start + int.from_bytes(data[at + 4 : start], "big")
        if end > len(data):
            raise BadInput(
                source, f"byte {at + 4}", f"a chunk of {end - start} bytes, the file has {len(data) - start} left"
            )
        if kind == b"MTrk":
            tracks.append(parse_events(data, start, end, source, tracks[-1].singles if tracks else 0))
            oddities += tracks[-1].oddities
        else:
            oddities.append(f"byte {at}: a chunk of another kind, {_kind_label(kind)}, was skipped")
        at = end
    if at < len(data):
        oddities.append(f"byte {at}: {len(data) - at} bytes follow the last track")
    return _Found(tracks, tuple(oddities))


def _track(events: TrackEvents) -> MidiTrack:
    columns = events.columns
    kind = columns.status & np.uint8(0xF0)
    return MidiTrack(
        notes=_notes(columns, kind),
        controllers=_controls(columns, kind == _CONTROL),
        aftertouch=_controls(columns, kind == _AFTERTOUCH),
        tempos=tuple(events.tempos),
        meters=tuple(events.meters),
        texts=tuple(events.texts),
        sysex=tuple(events.sysex),
        end_tick=events.end_tick,
        message_count=len(columns.tick),
    )


def _notes(columns: Columns, kind: NDArray[np.uint8]) -> NDArray[np.void]:
    """Note ons (velocity above 0), each with its length: to the next note on or off of its channel and number."""
    played = np.flatnonzero((kind == _NOTE_ON) | (kind == _NOTE_OFF))
    tick, number, velocity = columns.tick[played], columns.first[played], columns.second[played]
    channel = columns.status[played] & np.uint8(0x0F)
    length = _lengths(tick, channel.astype(np.uint16) << np.uint16(7) | number)
    sounds = np.flatnonzero((kind[played] == _NOTE_ON) & (velocity > 0))
    rows = np.empty(len(sounds), TRACK_NOTE_DTYPE)
    for name, column in (
        ("tick", tick),
        ("duration_ticks", length),
        ("channel", channel),
        ("number", number),
        ("velocity", velocity),
        ("place", played),
    ):
        rows[name] = column[sounds]
    rows.setflags(write=False)
    return rows


def _lengths(tick: NDArray[np.int64], voice: NDArray[np.uint16]) -> NDArray[np.int64]:
    """From each note event to the next of its voice (channel and number); `NOT_ENDED` where there is none."""
    by_voice = np.argsort(voice, kind="stable")
    to_next = np.diff(tick[by_voice])
    is_last = np.diff(voice[by_voice]) != 0
    to_next[is_last] = NOT_ENDED
    length = np.full(len(tick), NOT_ENDED, np.int64)
    length[by_voice[:-1]] = to_next
    return length


def _controls(columns: Columns, which: NDArray[np.bool_]) -> NDArray[np.void]:
    rows = np.empty(int(which.sum()), CONTROL_DTYPE)
    rows["tick"] = columns.tick[which]
    rows["channel"] = columns.status[which] & 0x0F
    rows["number"] = columns.first[which]
    rows["value"] = columns.second[which]
    rows["place"] = np.flatnonzero(which)
    rows.setflags(write=False)
    return rows
