"""A performance as the MIDI bytes that a drum module would send, each message with its time.

Every stroke is a note-on on channel 10 and a note-off a moment later; before a hi-hat stroke comes its pedal position
as controller 4, and a grabbed cymbal is polyphonic aftertouch 127, then 0 (`devices.mapping.presets` has the sources).
A module can only say what its table has a number for, so `as_sent` first folds a performance onto the table: what
`MidiDecoder` reads from the bytes is exactly that, but for the limb, of which MIDI knows nothing.
"""

import numpy as np

from station.core.errors import BadInput
from station.core.events import Hit
from station.core.note_map import NoteMeaning, general_midi_note, strike_of
from station.core.pieces import Piece, Zone, word
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import DeviceMap, PedalRange
from station.music.performance import Performance

TimedBytes = tuple[int, bytes]

NOTE_OFF_AFTER_NS = 40 * NS_PER_MS
CHOKE_HELD_NS = 100 * NS_PER_MS
"""How long a module keeps a note on, and a hand a cymbal; our choice."""

_NOTE_OFF, _NOTE_ON, _AFTERTOUCH, _CONTROL = 0x89, 0x99, 0xA9, 0xB9
_HELD, _LET_GO = 127, 0
_RELEASE_VELOCITY = 64
_NO_KNOWN_PIECE = range(60, 128)
"""Numbers from here on are bongos and their like: the first that a table lacks stands for a pad without a name."""


def as_sent(performance: Performance, preset: DeviceMap) -> Performance:
    """The performance as this module reports it: with its note numbers, and as much of zone and openness as it tells.

    Raises `BadInput` for a piece that the module does not have.
    """
    hits = performance.hits.copy()
    kinds = hits[["piece", "zone", "articulation", "openness", "midi_note"]].copy()
    kinds["openness"] = np.nan_to_num(kinds["openness"], nan=-1.0)  # NaNs would each be a kind of its own
    _, first, kind_of_hit = np.unique(kinds, return_index=True, return_inverse=True)
    for kind, row in enumerate(first.tolist()):
        alike = kind_of_hit == kind
        hit = performance[row]
        note = note_number(hit, preset)
        strike = strike_of(note, preset.notes)
        openness = _reported_openness(hit, strike, preset.pedal)
        hits["midi_note"][alike], hits["zone"][alike], hits["articulation"][alike] = (
            note,
            strike.zone,
            strike.articulation,
        )
        hits["openness"][alike] = np.nan if openness is None else openness
    return Performance.from_array(hits, performance.chokes)


def note_number(hit: Hit, preset: DeviceMap) -> int:
    """The module's number that says most of what `hit` was; raises `BadInput` where its piece has none."""
    if hit.piece is Piece.PERCUSSION:
        written_so = strike_of(hit.midi_note, preset.notes).piece is Piece.PERCUSSION and hit.midi_note
        return hit.midi_note if written_so else next(n for n in _NO_KNOWN_PIECE if n not in preset.notes)
    numbers = [n for n, strike in preset.notes.items() if strike.piece is hit.piece]
    if not numbers:
        raise BadInput(preset.title, word(hit.piece), "this kit has no such piece")
    plain = general_midi_note(hit.piece, hit.zone, hit.articulation, hit.openness)

    def strangeness(note: int) -> tuple[bool, bool, float, bool, int]:
        strike = preset.notes[note]
        apart = abs((strike.openness or 0.0) - (hit.openness or 0.0))
        return strike.articulation != hit.articulation, strike.zone != hit.zone, apart, note != plain, note

    return min(numbers, key=strangeness)


def midi_stream(sent: Performance, preset: DeviceMap) -> list[TimedBytes]:
    """Every message with its time in ns, in order of time; `sent` comes from `as_sent` with the same preset."""
    messages: list[TimedBytes] = []
    note_on_ns: dict[int, int] = {}
    columns = (sent.hits[name].tolist() for name in ("at_ns", "midi_note", "velocity", "piece", "openness"))
    rows = list(zip(*columns, strict=True))
    for at_ns, note, velocity, piece, openness in reversed(rows):  # so that a note-off knows the stroke that follows it
        until_next = note_on_ns.get(note, at_ns + 2 * NOTE_OFF_AFTER_NS) - at_ns
        off_ns = at_ns + min(NOTE_OFF_AFTER_NS, until_next // 2)
        note_on_ns[note] = at_ns
        messages.append((off_ns, bytes((_NOTE_OFF, note, _RELEASE_VELOCITY))))
        messages.append((at_ns, bytes((_NOTE_ON, note, velocity))))
        if piece == Piece.HIHAT and preset.pedal is not None:
            value = preset.pedal.value(openness)  # `as_sent` leaves none untold
            messages.append((at_ns, bytes((_CONTROL, preset.pedal.controller, value))))
    messages.reverse()
    for choke in sent.chokes:
        note = note_number(Hit(0, Piece(choke["piece"]), Zone.EDGE, 1), preset)
        at_ns = int(choke["at_ns"])
        messages.append((at_ns, bytes((_AFTERTOUCH, note, _HELD))))
        messages.append((at_ns + CHOKE_HELD_NS, bytes((_AFTERTOUCH, note, _LET_GO))))
    return sorted(messages, key=lambda message: message[0])


def _reported_openness(hit: Hit, strike: NoteMeaning, pedal: PedalRange | None) -> float | None:
    """The openness that the module tells with this stroke."""
    if hit.piece is not Piece.HIHAT or pedal is None:
        return strike.openness
    return pedal.openness(pedal.value(hit.openness or 0.0))
