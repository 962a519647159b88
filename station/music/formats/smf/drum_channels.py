"""Which notes of a MIDI file are drums, and which kit map it was written for.

What counts as drums is `MidiTrack.drum_channels`: channel 10, or a track that is named so. Where a file has neither,
one lone channel whose every number is a drum's is taken, for many programs export a drum clip on channel 1.
"""

import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.note_map import GENERAL_MIDI, V_DRUMS, KitMap, guess_map
from station.music.formats.smf.contents import (
    CONTROL_DTYPE,
    DRUM_CHANNEL,
    TRACK_NOTE_DTYPE,
    MidiFile,
    MidiSequence,
    MidiTrack,
)

PEDAL_CONTROLLER = 4
SNARE_POSITION_CONTROLLER = 16
_KIT_CONTROLLERS = (PEDAL_CONTROLLER, 16, 17, 18)
"""A pedal or stick positions: these come from a module, not from an editor."""

_DRUM_SET_NUMBERS = frozenset(GENERAL_MIDI) | frozenset(V_DRUMS)
_BACKBONE = frozenset({35, 36, 37, 38, 40})
"""Kick and snare: a lone channel without either is not taken for drums."""

KIT_MAP_NAMES = {"General MIDI": GENERAL_MIDI, "V-Drums": V_DRUMS}
"""Instrument names (meta event 4) by which a file declares its map; ours always do."""
_INSTRUMENT_KIND = 4
_GENERAL_MIDI_RESET = re.compile(
    rb"\x7e[\x00-\x7f]\x09[\x01\x03]|\x41.\x42\x12\x40\x00\x7f|\x43.\x4c\x00\x00\x7e", re.DOTALL
)
"""GM and GM2 system on (RP-003, RP-024), Roland GS reset, Yamaha XG on: all place drums as General MIDI does."""


def guess_kit_map(midi: MidiFile, *beside: MidiFile) -> KitMap:
    """The map that `midi` was most likely written for: General MIDI or V-Drums.

    A declaration in the file decides; then numbers that only V-Drums send; then controllers that only a module sends.
    `beside` are files of the same kit, such as the performance that a score was quantised from: where `midi` says
    nothing itself, they speak for it.
    """
    declared = _declared_map(midi)
    if declared is not None:
        return declared
    files = [midi] + [other for other in beside if _declared_map(other) is not GENERAL_MIDI]
    return next((V_DRUMS for file in files if _is_of_a_module(file)), GENERAL_MIDI)


def _declared_map(midi: MidiFile) -> KitMap | None:
    for track in midi.tracks:
        for text in track.texts:
            if text.kind == _INSTRUMENT_KIND and text.text in KIT_MAP_NAMES:
                return KIT_MAP_NAMES[text.text]
        if any(_GENERAL_MIDI_RESET.match(message.data) for message in track.sysex):
            return GENERAL_MIDI
    return None


def _is_of_a_module(midi: MidiFile) -> bool:
    drums = [Drums(sequence, _lone_channel(midi)) for sequence in midi.sequences]
    numbers = {number for d in drums for number in np.unique(d.notes["number"]).tolist()}
    moved = any(np.isin(d.controllers["number"], _KIT_CONTROLLERS).any() for d in drums)
    return _declared_map(midi) is V_DRUMS or guess_map(numbers) is V_DRUMS or (bool(numbers) and moved)


def _lone_channel(midi: MidiFile) -> int | None:
    """The one channel of a file without drum tracks, if all that it plays are a drum set's numbers."""
    if any(track.drum_channels for track in midi.tracks):
        return None
    channels = {channel for track in midi.tracks for channel in np.unique(track.notes["channel"]).tolist()}
    numbers = {number for track in midi.tracks for number in np.unique(track.notes["number"]).tolist()}
    is_drum_set = numbers <= _DRUM_SET_NUMBERS and bool(numbers & _BACKBONE)
    return channels.pop() if len(channels) == 1 and is_drum_set else None


@dataclass(frozen=True, eq=False)
class Drums:
    """The drum notes of a sequence in order of time, with the controllers and key pressures of their channels.

    On one tick the earlier track comes first, and in a track the earlier message: `place` counts through all tracks.
    `lone_channel` is the channel that plays drums in all tracks, None where each track says; `is_declared` whether
    the file declares its map, and with it that controllers use their whole range. `notes` (n,) of `TRACK_NOTE_DTYPE`,
    `controllers` and `aftertouch` of `CONTROL_DTYPE`.
    """

    sequence: MidiSequence
    lone_channel: int | None
    is_declared: bool = False

    @cached_property
    def notes(self) -> NDArray[np.void]:
        """The drum notes."""
        return self._gathered("notes", TRACK_NOTE_DTYPE)

    @cached_property
    def controllers(self) -> NDArray[np.void]:
        """The controllers of the drums' channels."""
        return self._gathered("controllers", CONTROL_DTYPE)

    @cached_property
    def aftertouch(self) -> NDArray[np.void]:
        """The key pressures on the drums' channels."""
        return self._gathered("aftertouch", CONTROL_DTYPE)

    def _gathered(self, column: str, dtype: np.dtype[np.void]) -> NDArray[np.void]:
        parts, first_place = [np.empty(0, dtype)], 0
        for track in self.sequence.tracks:
            rows: NDArray[np.void] = getattr(track, column)
            rows = rows[np.isin(rows["channel"], self._channels(track))]
            rows["place"] += first_place
            first_place += track.message_count
            parts.append(rows)
        together = np.concatenate(parts)
        return together[np.argsort(together["tick"], kind="stable")]

    def _channels(self, track: MidiTrack) -> list[int]:
        """Channel 10 always: a format 1 file may keep its controllers in another track than its notes."""
        return sorted({DRUM_CHANNEL} | track.drum_channels) if self.lone_channel is None else [self.lone_channel]


def drums_of(midi: MidiFile) -> list[Drums]:
    """The drums of each sequence; raises `BadInput` for a file that has notes and none of them drums."""
    lone, is_declared = _lone_channel(midi), _declared_map(midi) is not None
    drums = [Drums(sequence, lone, is_declared) for sequence in midi.sequences]
    count = sum(len(track.notes) for track in midi.tracks)
    if count and not any(len(d.notes) for d in drums):
        raise BadInput(midi.source, "", f"no drums among its {count} notes: none on channel 10, no track named drums")
    return drums
