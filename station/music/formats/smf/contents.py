"""What a Standard MIDI File holds, as immutable values in the file's own ticks; nothing is interpreted as drums yet.

Conventions: channels count from 0 as on the wire, so `DRUM_CHANNEL` 9 is the "channel 10" of manuals. A file of
format 0 or 1 is one sequence, however many tracks it has; each track of a format 2 file is a sequence of its own, and
they are played one after the other. Times are integer nanoseconds from the start of a sequence.

Source: MIDI Association, RP-001 "Standard MIDI Files 1.0".
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.units import NS_PER_S, NS_PER_US
from station.music.tempo import DEFAULT_US_PER_QUARTER, MeterChange, TempoChange

DRUM_CHANNEL = 9

TRACK_NOTE_DTYPE = np.dtype(
    [
        ("tick", np.int64),
        (
            "duration_ticks",
            np.int64,
        ),  # to its note off, or to the next stroke of its number; NOT_ENDED if neither comes
        ("channel", np.uint8),
        ("number", np.uint8),
        ("velocity", np.uint8),  # 1–127
        ("place", np.int32),  # among the track's messages, which tells what came first on one tick
    ]
)
NOT_ENDED = -1

CONTROL_DTYPE = np.dtype(
    [
        ("tick", np.int64),
        ("channel", np.uint8),
        ("number", np.uint8),  # of the controller, or of the note whose key is pressed (polyphonic aftertouch)
        ("value", np.uint8),
        ("place", np.int32),
    ]
)

MAX_NS = 366 * 24 * 3600 * NS_PER_S
"""A year (our choice: far beyond any music, and every product below stays inside 63 bits)."""

_NO_NAME = re.compile(r"\s*|(base )?midi( drums?)?|drums?|drum ?kit|(midi )?track ?\d*|untitled|unnamed", re.IGNORECASE)
"""What programs call a track that nobody named (the Groove MIDI Dataset's are all "MIDI")."""

_DRUM_NAME = re.compile(r"drum|percus|\bperc\b|\bkit\b|schlagzeug|batterie|bater[ií]a|batteria", re.IGNORECASE)
_TUNED_NAME = re.compile(r"steel ?drum", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Division:
    """What a tick is: 1/`ticks` of a quarter note, or for SMPTE time `ticks` of them are `us` microseconds."""

    ticks: int
    us: int | None = None


@dataclass(frozen=True, slots=True)
class Text:
    """A text event; `kind` is its meta number: 1 text, 2 copyright, 3 name, 4 instrument, 5 lyric, 6 marker, 7 cue."""

    tick: int
    kind: int
    text: str

    @classmethod
    def of(cls, tick: int, kind: int, body: bytes) -> "Text":
        """Of UTF-8 where it is, else of Latin-1, in one line without control characters."""
        try:
            text = body.decode("utf-8")
        except UnicodeDecodeError:
            text = body.decode("latin-1")
        return cls(tick, kind, " ".join("".join(c if c.isprintable() else " " for c in text).split()))


@dataclass(frozen=True, slots=True)
class SysEx:
    """A system exclusive message without its F0 and F7."""

    tick: int
    data: bytes


@dataclass(frozen=True, eq=False)
class MidiTrack:
    """One track: `notes` (n,) of `TRACK_NOTE_DTYPE`, `controllers` and `aftertouch` of `CONTROL_DTYPE`, by file order.

    All arrays are read-only; ticks count from the track's start and never fall. `end_tick` is its end-of-track event's;
    `message_count` the messages among which `place` counts.
    """

    notes: NDArray[np.void]
    controllers: NDArray[np.void]
    aftertouch: NDArray[np.void]
    tempos: tuple[TempoChange, ...] = ()
    meters: tuple[MeterChange, ...] = ()
    texts: tuple[Text, ...] = ()
    sysex: tuple[SysEx, ...] = ()
    end_tick: int = 0
    message_count: int = 0

    @property
    def name(self) -> str:
        """The first name that is written in the track; empty if there is none."""
        return next((t.text for t in self.texts if t.kind == 3), "")

    @property
    def is_named_drums(self) -> bool:
        """Whether the track's name says that it is for drums (steel drums are tuned)."""
        return bool(_DRUM_NAME.search(self.name)) and not _TUNED_NAME.search(self.name)

    @cached_property
    def drum_channels(self) -> frozenset[int]:
        """The channels whose notes are drums: channel 10, or every one of a track that is named so and lacks it."""
        used = frozenset(np.unique(self.notes["channel"]).tolist())
        if DRUM_CHANNEL in used:
            return frozenset({DRUM_CHANNEL})
        return used if self.is_named_drums else frozenset()


@dataclass(frozen=True, eq=False)
class MidiSequence:
    """Tracks that sound together under one tempo map, whose changes are in the file's ticks and begin at tick 0."""

    tracks: tuple[MidiTrack, ...]
    division: Division
    tempos: tuple[TempoChange, ...]
    meters: tuple[MeterChange, ...]

    @classmethod
    def of(cls, tracks: Iterable[MidiTrack], division: Division) -> "MidiSequence":
        """The sequence of `tracks`, their tempo and meter changes merged: the last on a tick counts."""
        together = tuple(tracks)
        tempos = {0: TempoChange(0, DEFAULT_US_PER_QUARTER)} | {t.tick: t for track in together for t in track.tempos}
        meters = {0: MeterChange(0, 4, 4)} | {m.tick: m for track in together for m in track.meters}
        return cls(
            together, division, tuple(tempos[t] for t in sorted(tempos)), tuple(meters[t] for t in sorted(meters))
        )

    @property
    def end_tick(self) -> int:
        """Where the longest track ends."""
        return max((track.end_tick for track in self.tracks), default=0)

    @property
    def _clock(self) -> tuple[TempoChange, ...]:
        """How many µs `division.ticks` ticks last, and from where on; SMPTE time heeds no tempo."""
        return self.tempos if self.division.us is None else (TempoChange(0, self.division.us),)

    @cached_property
    def _rates(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """Start tick, µs for `division.ticks` ticks, and start time in µs times `division.ticks`, of every segment."""
        starts = [0]
        for before, after in zip(self._clock, self._clock[1:], strict=False):
            starts.append(starts[-1] + (after.tick - before.tick) * before.us_per_quarter)
        return (
            np.array([c.tick for c in self._clock], np.int64),
            np.array([c.us_per_quarter for c in self._clock], np.int64),
            np.array(starts, np.int64),
        )

    def ns_at(self, ticks: ArrayLike) -> NDArray[np.int64]:
        """Time of each tick (0 … `end_tick`) in ns, exact but for the last rounding to the nearest."""
        starts, rates, times = self._rates
        t = np.asarray(ticks, np.int64)
        i = np.searchsorted(starts, t, side="right") - 1
        us, part = np.divmod(times[i] + (t - starts[i]) * rates[i], self.division.ticks)
        ns: NDArray[np.int64] = us * NS_PER_US + (2 * part * NS_PER_US + self.division.ticks) // (
            2 * self.division.ticks
        )
        return ns

    @property
    def lasts_too_long(self) -> bool:
        """Whether the sequence ends after `MAX_NS`, so that times would not fit (computed without limit)."""
        ends = [c.tick for c in self._clock[1:]] + [self.end_tick]
        total = sum((end - c.tick) * c.us_per_quarter for c, end in zip(self._clock, ends, strict=True))
        return total * NS_PER_US > MAX_NS * self.division.ticks


@dataclass(frozen=True, eq=False)
class MidiFile:
    """A whole file: `format` 0, 1 or 2, its tracks in order, and `oddities`, a line for all that was passed over.

    Only what cannot be misunderstood is passed over: chunks of other kinds, illegal system messages, a missing end of
    track, bytes after the end. `source` names the file for error messages.
    """

    source: str
    format: int
    division: Division
    tracks: tuple[MidiTrack, ...]
    oddities: tuple[str, ...] = ()

    @cached_property
    def sequences(self) -> tuple[MidiSequence, ...]:
        """What is played one after the other: one sequence, or in format 2 one for every track."""
        groups = [(t,) for t in self.tracks] if self.format == 2 else [self.tracks]
        return tuple(MidiSequence.of(g, self.division) for g in groups)

    @property
    def title(self) -> str:
        """The name of the first track, which RP-001 makes the sequence's; else of the file, without its ending."""
        first = self.tracks[0].name if self.tracks else ""
        return Path(self.source).stem if _NO_NAME.fullmatch(first) else first
