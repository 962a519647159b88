"""Tracks of channel messages to the bytes of a Standard MIDI File, through mido, and to the disk whole or not at all.

Ticks are the file's own and absolute here; mido gets delta times.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO

import mido
import numpy as np
from numpy.typing import NDArray

from station.music.tempo import MeterChange, TempoChange

MESSAGE_DTYPE = np.dtype(
    [
        ("tick", np.int64),
        ("rank", np.uint8),  # the order on one tick
        ("status", np.uint8),
        ("first", np.uint8),
        ("second", np.uint8),
    ]
)
Messages = NDArray[np.void]

_MAX_DELTA = (1 << 28) - 1
"""Four bytes of seven bits (RP-001)."""


@dataclass(frozen=True, slots=True)
class OutTrack:
    """What a track holds besides its end: names, tempo and meter, and channel messages of `MESSAGE_DTYPE`.

    `markers` are (tick, text).
    """

    name: str
    messages: Messages
    instrument: str = ""
    tempos: Sequence[TempoChange] = ()
    meters: Sequence[MeterChange] = ()
    markers: Sequence[tuple[int, str]] = ()


def tracks_bytes(tracks: Sequence[OutTrack], division: int, end_tick: int) -> bytes:
    """A file of one track in format 0, of several in format 1; each ends at `end_tick` or with its last message.

    `division` is in ticks a quarter note.
    """
    file = mido.MidiFile(type=min(len(tracks) - 1, 1), ticks_per_beat=division, charset="utf-8")
    for track in tracks:
        timed = sorted([*_metas(track), *_channel_messages(track)], key=_time)
        end = mido.MetaMessage("end_of_track", time=max([end_tick, *map(_time, timed)]))
        file.tracks.append(mido.MidiTrack(_with_deltas([*timed, end])))
    buffer = BytesIO()
    file.save(file=buffer)
    return buffer.getvalue()


def _time(message: mido.Message) -> int:
    return int(message.time)


def _metas(track: OutTrack) -> Iterator[mido.MetaMessage]:
    """Names, tempo, meter and markers, each with its absolute tick as time."""
    for kind, name in (("track_name", track.name), ("instrument_name", track.instrument)):
        line = " ".join(name.split()).encode("utf-8", "replace").decode("utf-8")
        if line:
            yield mido.MetaMessage(kind, name=line, time=0)
    for tempo in track.tempos:
        yield mido.MetaMessage("set_tempo", tempo=tempo.us_per_quarter, time=tempo.tick)
    for meter in track.meters:
        yield mido.MetaMessage("time_signature", numerator=meter.beats, denominator=meter.unit, time=meter.tick)
    for tick, text in track.markers:
        yield mido.MetaMessage("marker", text=text.encode("utf-8", "replace").decode("utf-8"), time=tick)


def _channel_messages(track: OutTrack) -> Iterator[mido.Message]:
    """Channel messages in order, each with its absolute tick as time."""
    rows = track.messages[np.lexsort((track.messages["rank"], track.messages["tick"]))]
    for tick, _, status, first, second in rows.tolist():
        yield mido.Message.from_bytes([status, first, second], time=tick)


def _with_deltas(timed: Sequence[mido.Message]) -> Iterator[mido.Message]:
    """The same with delta times; a gap that four bytes cannot hold is bridged by empty texts."""
    now = 0
    for message in timed:
        while message.time - now > _MAX_DELTA:
            yield mido.MetaMessage("text", text="", time=_MAX_DELTA)
            now += _MAX_DELTA
        gap, now = message.time - now, message.time
        yield message.copy(time=gap)
