"""The events of one track chunk, as columns of numbers.

A drum file is nearly all notes and controllers, three-byte messages whose status may be left out (running status). In a
stretch of those every event has exactly three bytes below 0x80: the last of its delta time and its two data bytes. So
numpy takes a window of the track apart without a loop, three such bytes an event, and keeps the events before the first
that does not have this shape; whatever lies between stretches is read event by event. Windows grow while they are good
throughout, so that no byte is looked at more than a few times.

Lenient where nothing can be misunderstood (an oddity is noted), strict elsewhere (`BadInput` with the byte's offset in
the file). Running status outlives meta and system exclusive events, as many files expect, though RP-001 ends it there.

Source: MIDI Association, RP-001 "Standard MIDI Files 1.0"; MIDI 1.0 Detailed Specification 4.2, tables I to VI.
"""

import re
from dataclasses import dataclass, field
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.music.formats.smf.contents import SysEx, Text
from station.music.tempo import MeterChange, TempoChange

_STRETCH = re.compile(rb"(?:[\x80-\xff]{0,3}[\x00-\x7f][\x80-\xbf\xe0-\xef]?[\x00-\x7f]{2}){16}", re.DOTALL)
"""The beginning of a stretch that is worth numpy's overhead (measured; the number is not critical)."""
_FIRST_WINDOW, _LAST_WINDOW = 1 << 10, 1 << 18
"""Bytes: from little waste where stretches are short to the cache's size, which also bounds the temporary arrays."""

_MAY_FOLLOW_DELTA = np.array([not (0xC0 <= byte < 0xE0 or byte >= 0xF0) for byte in range(256)])
"""After the delta time comes a status of two data bytes, or under running status the first data byte."""

_MAX_DELTA_BYTES = 4
_LAST_TEXT_KIND = 0x0F
_END_OF_TRACK, _TEMPO, _METER = 0x2F, 0x51, 0x58
_META_BYTES = {_END_OF_TRACK: 0, _TEMPO: 3, _METER: 4}
_MAX_METER_POWER = 12
"""4096th notes: finer beats are not a whole number of ticks."""

_ONE_DATA_BYTE = (0xC0, 0xD0)
_ILLEGAL_BUT_KNOWN = {0xF1: 1, 0xF2: 2, 0xF3: 1, 0xF6: 0, 0xF8: 0, 0xFA: 0, 0xFB: 0, 0xFC: 0, 0xFE: 0}
"""System messages that have no place in a file, with their data bytes: their length is certain, so they are skipped."""

_MOST_LISTED = 20
"""So many of them are listed one by one; of more, their number (our choice)."""


MOST_SINGLE = 400_000
"""Events of a file that are no note, controller or bend, which are read one by one: half a second of work and 100 MB at
the most. Our choice: twenty minutes of channel pressure at its densest, 300 a second."""


@dataclass(frozen=True, slots=True)
class Columns:
    """Channel messages with two data bytes in file order: equally long arrays."""

    tick: NDArray[np.int64]
    status: NDArray[np.uint8]
    first: NDArray[np.uint8]
    second: NDArray[np.uint8]


@dataclass(slots=True)
class TrackEvents:
    """Everything of a track chunk that we keep."""

    columns: Columns
    tempos: list[TempoChange] = field(default_factory=list)
    meters: list[MeterChange] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    sysex: list[SysEx] = field(default_factory=list)
    oddities: list[str] = field(default_factory=list)
    end_tick: int = 0
    singles: int = 0


_Block = tuple[NDArray[np.int64], NDArray[np.uint8], NDArray[np.uint8], NDArray[np.uint8]]
_NOTHING: _Block = (np.empty(0, np.int64), np.empty(0, np.uint8), np.empty(0, np.uint8), np.empty(0, np.uint8))


def parse_events(data: bytes, start: int, stop: int, source: str, singles: int = 0) -> TrackEvents:
    """The events of a track chunk's content `data[start:stop]`; raises `BadInput` for what cannot be read.

    `singles` is how many events the tracks before had that were read one by one; with this track's they are returned.
    """
    return _TrackReader(data, start, stop, source, singles).read()


@dataclass(frozen=True, slots=True)
class _Places:
    """Where in a window each event's bytes are: the last before it, its delta time's last, its two data bytes."""

    before: NDArray[np.int64]
    last: NDArray[np.int64]
    first: NDArray[np.int64]
    second: NDArray[np.int64]


class _TrackReader:
    """Where we are in a track: byte, tick, running status (0 for none), and what was found."""

    def __init__(self, data: bytes, start: int, stop: int, source: str, singles: int) -> None:
        self.data, self.at, self.stop, self.source = data, start, stop, source
        self.singles = singles
        self.tick = 0
        self.running = 0
        self.ended = False
        self.skipped = 0
        self.blocks: list[_Block] = []
        self.single: list[tuple[int, int, int, int]] = []
        self.found = TrackEvents(_joined([]))

    def read(self) -> TrackEvents:
        """Read all events up to the end of track."""
        while self.at < self.stop and not self.ended:
            if _has_two_data_bytes(self.running) and _STRETCH.match(self.data, self.at, self.stop):
                self._read_stretch()
            else:
                self._read_event()
        self._flush()
        self._note_ending()
        self.found.columns = _joined(self.blocks)
        self.found.end_tick, self.found.singles = self.tick, self.singles
        return self.found

    def _note_ending(self) -> None:
        if self.skipped > _MOST_LISTED:
            self.found.oddities.append(f"{self.skipped - _MOST_LISTED} more system messages were skipped")
        if not self.ended:
            self.found.oddities.append(f"byte {self.stop}: the track has no end-of-track event")
        elif self.at < self.stop:
            self.found.oddities.append(f"byte {self.at}: {self.stop - self.at} bytes follow the end of track")

    # --- many at once -------------------------------------------------------------------------------------------------

    def _read_stretch(self) -> None:
        """Read windows of growing size until one holds something else."""
        self._flush()
        window = _FIRST_WINDOW
        while self._read_window(min(window, self.stop - self.at)):
            window = min(2 * window, _LAST_WINDOW)

    def _read_window(self, size: int) -> bool:
        """Read the events at the start of the next `size` bytes that have the shape; whether all of them have it."""
        raw = np.frombuffer(self.data, np.uint8, size, self.at)
        low = np.flatnonzero(raw < 0x80)
        bytes_low = (low[0 : len(low) // 3 * 3 : 3], low[1::3], low[2::3])
        last, first, second = (column[: len(low) // 3] for column in bytes_low)
        before = np.concatenate(([-1], second[:-1]))
        shaped = (last - before <= _MAX_DELTA_BYTES) & (first - last <= 2) & (second - first == 1)
        shaped &= _MAY_FOLLOW_DELTA[raw[last + 1]]
        count = len(shaped) if shaped.all() else int(shaped.argmin())
        if count:
            self._keep(raw, _Places(before[:count], last[:count], first[:count], second[:count]))
        return bool(count) and count == len(shaped)

    def _keep(self, raw: NDArray[np.uint8], places: "_Places") -> None:
        status = self._statuses(raw, places)
        ticks = self.tick + np.cumsum(_deltas(raw, places))
        self.blocks.append((ticks, status, raw[places.first], raw[places.second]))
        self.tick, self.running = int(ticks[-1]), int(status[-1])
        self.at += int(places.second[-1]) + 1

    def _statuses(self, raw: NDArray[np.uint8], places: "_Places") -> NDArray[np.uint8]:
        """The status of each event: its own byte between delta time and data, or the one before it."""
        own = np.where(places.first - places.last == 2, places.last + 1, -1)
        latest = np.maximum.accumulate(own)
        return np.where(latest < 0, np.uint8(self.running), raw[latest])

    def _flush(self) -> None:
        if self.single:
            ticks, *rest = zip(*self.single, strict=True)
            status, first, second = (np.array(column, np.uint8) for column in rest)
            self.blocks.append((np.array(ticks, np.int64), status, first, second))
            self.single.clear()

    # --- one by one ---------------------------------------------------------------------------------------------------

    def _read_event(self) -> None:
        self.singles += 1
        if self.singles > MOST_SINGLE:
            self._refuse(self.at, f"more than {MOST_SINGLE:,} events that are no notes")
        self.tick += self._number("a delta time")
        status = self._byte("an event")
        if status < 0x80:
            if not self.running:
                self._refuse(self.at - 1, f"data byte {status:02X} where a status byte was expected")
            self.at -= 1
            self._read_channel(self.running)
        elif status < 0xF0:
            self.running = status
            self._read_channel(status)
        elif status == 0xFF:
            self._read_meta()
        elif status in (0xF0, 0xF7):
            self._read_sysex(status)
        else:
            self._skip_illegal(status)

    def _read_channel(self, status: int) -> None:
        first = self._data_byte()
        if status & 0xF0 in _ONE_DATA_BYTE:
            return
        self.single.append((self.tick, status, first, self._data_byte()))

    def _read_meta(self) -> None:
        event_at = self.at - 1
        kind = self._byte("a meta event")
        body = self._body("a meta event")
        if kind == _END_OF_TRACK:
            self.ended = True
        elif len(body) < _META_BYTES.get(kind, 0):
            self._refuse(event_at, f"meta event {kind:02X} has {len(body)} bytes, {_META_BYTES[kind]} were expected")
        elif kind == _TEMPO:
            self._read_tempo(event_at, int.from_bytes(body[:3], "big"))
        elif kind == _METER:
            self._read_meter(event_at, body[0], body[1])
        elif 1 <= kind <= _LAST_TEXT_KIND:
            self.found.texts.append(Text.of(self.tick, kind, body))

    def _read_tempo(self, event_at: int, us_per_quarter: int) -> None:
        if not us_per_quarter:
            self._refuse(event_at, "a tempo of 0 µs a quarter note")
        self.found.tempos.append(TempoChange(self.tick, us_per_quarter))

    def _read_meter(self, event_at: int, beats: int, power: int) -> None:
        if not beats or power > _MAX_METER_POWER:
            self._refuse(event_at, f"a meter of {beats} beats of 1/2^{power} note")
        self.found.meters.append(MeterChange(self.tick, beats, 1 << power))

    def _read_sysex(self, status: int) -> None:
        body = self._body("a system exclusive message")
        if status == 0xF0:
            self.found.sysex.append(SysEx(self.tick, body.removesuffix(b"\xf7")))

    def _skip_illegal(self, status: int) -> None:
        at = self.at - 1
        if status not in _ILLEGAL_BUT_KNOWN:
            self._refuse(at, f"undefined status byte {status:02X}")
        for _ in range(_ILLEGAL_BUT_KNOWN[status]):
            self._data_byte()
        self.skipped += 1
        if self.skipped <= _MOST_LISTED:
            self.found.oddities.append(
                f"byte {at}: system message {status:02X}, which has no place in a file, was skipped"
            )

    # --- bytes --------------------------------------------------------------------------------------------------------

    def _byte(self, of_what: str) -> int:
        if self.at >= self.stop:
            self._refuse(self.stop, f"the track ends in the middle of {of_what}")
        self.at += 1
        return self.data[self.at - 1]

    def _data_byte(self) -> int:
        byte = self._byte("a message")
        if byte >= 0x80:
            self._refuse(self.at - 1, f"status byte {byte:02X} where a data byte was expected")
        return byte

    def _number(self, of_what: str) -> int:
        """A variable-length quantity: seven bits a byte, the last below 0x80."""
        value, start = 0, self.at
        for _ in range(_MAX_DELTA_BYTES):
            byte = self._byte(of_what)
            value = value << 7 | byte & 0x7F
            if byte < 0x80:
                return value
        self._refuse(start, f"{of_what} of more than {_MAX_DELTA_BYTES} bytes")

    def _body(self, of_what: str) -> bytes:
        length_at = self.at
        length = self._number(f"the length of {of_what}")
        if length > self.stop - self.at:
            self._refuse(length_at, f"{of_what} of {length} bytes, the track has {self.stop - self.at} left")
        self.at += length
        return self.data[self.at - length : self.at]

    def _refuse(self, at: int, fault: str) -> NoReturn:
        raise BadInput(self.source, f"byte {at}", fault)


def _has_two_data_bytes(status: int) -> bool:
    return 0x80 <= status < 0xC0 or 0xE0 <= status < 0xF0


def _deltas(raw: NDArray[np.uint8], places: _Places) -> NDArray[np.int64]:
    """The delta time of each event: seven bits a byte, from the one after the event before to its last."""
    deltas = raw[places.last].astype(np.int64)
    for place in range(1, _MAX_DELTA_BYTES):
        has = np.flatnonzero(places.last - places.before > place)
        deltas[has] |= (raw[places.last[has] - place] & 0x7F).astype(np.int64) << (7 * place)
    return deltas


def _joined(blocks: list[_Block]) -> Columns:
    whole: list[_Block] = [_NOTHING, *blocks]
    return Columns(
        np.concatenate([tick for tick, _, _, _ in whole]),
        np.concatenate([status for _, status, _, _ in whole]),
        np.concatenate([first for _, _, first, _ in whole]),
        np.concatenate([second for _, _, _, second in whole]),
    )
