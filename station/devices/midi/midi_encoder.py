"""Strokes as MIDI bytes: General MIDI's drum channel, with what drum modules add to it.

Pure; the inverse of `midi_decoder` for a General MIDI kit. A hi-hat stroke of known openness is preceded by controller
4 as V-Drums send it (127 shut … 0 open); a choke is polyphonic aftertouch on the cymbal's note, 127 as the hand grabs
and 0 as it lets go. Every note is ended `GATE_NS` later: samplers that hold notes would otherwise hang.
"""

from station.core.note_map import general_midi_note
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS

DRUM_CHANNEL = 9
"""Channel 10, counted from 0 as in the status byte (General MIDI level 1)."""
GATE_NS = 50 * NS_PER_MS
"""How long a note is held (our choice: longer than any trigger's mask, shorter than a stroke of a fast roll)."""
NOTE_OFF, NOTE_ON, POLY_AFTERTOUCH, CONTROL_CHANGE = 0x80, 0x90, 0xA0, 0xB0
FOOT_CONTROLLER, ALL_NOTES_OFF = 4, 123
_MOST = 127


def note_on(
    piece: Piece, zone: Zone, articulation: Articulation, velocity: int, openness: float | None = None
) -> list[bytes]:
    """The messages of a stroke, in order; `velocity` 1–127."""
    assert 1 <= velocity <= _MOST, "a stroke has a MIDI velocity"
    note = general_midi_note(piece, zone, articulation, openness)
    stroke = bytes((NOTE_ON | DRUM_CHANNEL, note, velocity))
    return [pedal(openness), stroke] if piece is Piece.HIHAT and openness is not None else [stroke]


def note_off(piece: Piece, zone: Zone, articulation: Articulation, openness: float | None = None) -> bytes:
    """What ends the stroke's note."""
    return bytes((NOTE_OFF | DRUM_CHANNEL, general_midi_note(piece, zone, articulation, openness), 0))


def pedal(openness: float) -> bytes:
    """The hi-hat's pedal at `openness` 0 shut … 1 open."""
    return bytes((CONTROL_CHANGE | DRUM_CHANNEL, FOOT_CONTROLLER, round(_MOST * (1.0 - min(1.0, max(0.0, openness))))))


def choke(piece: Piece, zone: Zone) -> list[bytes]:
    """The hand that grabs the cymbal and lets go."""
    note = general_midi_note(piece, zone, Articulation.NORMAL)
    return [bytes((POLY_AFTERTOUCH | DRUM_CHANNEL, note, pressure)) for pressure in (_MOST, 0)]


def all_off() -> bytes:
    """Every note ends."""
    return bytes((CONTROL_CHANGE | DRUM_CHANNEL, ALL_NOTES_OFF, 0))
