"""Maps between MIDI note numbers and what is struck.

`GENERAL_MIDI` is the General MIDI level 1 percussion map (MIDI Association, RP-003, table 3).
`V_DRUMS` is what Roland's V-Drums send (TD-11, TD-17 and TD-27 owner's manuals; the Groove MIDI Dataset's table), which
reuses some General MIDI numbers for rims and edges.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.pieces import HALF_OPEN, Articulation, Piece, Zone


@dataclass(frozen=True, slots=True)
class NoteMeaning:
    """What one MIDI note number means; `openness` 0 closed … 1 open, None where the number does not say."""

    piece: Piece
    zone: Zone = Zone.HEAD
    articulation: Articulation = Articulation.NORMAL
    openness: float | None = None


KitMap = Mapping[int, NoteMeaning]

_CLOSED = 0.0
_OPEN = 1.0

GENERAL_MIDI: KitMap = MappingProxyType(
    {
        35: NoteMeaning(Piece.KICK),
        36: NoteMeaning(Piece.KICK),
        37: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        38: NoteMeaning(Piece.SNARE),
        39: NoteMeaning(Piece.CLAP),
        40: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        41: NoteMeaning(Piece.FLOOR_TOM_2),
        42: NoteMeaning(Piece.HIHAT, Zone.BOW, openness=_CLOSED),
        43: NoteMeaning(Piece.FLOOR_TOM_1),
        44: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, _CLOSED),
        45: NoteMeaning(Piece.TOM_4),
        46: NoteMeaning(Piece.HIHAT, Zone.BOW, openness=_OPEN),
        47: NoteMeaning(Piece.TOM_3),
        48: NoteMeaning(Piece.TOM_2),
        49: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        50: NoteMeaning(Piece.TOM_1),
        51: NoteMeaning(Piece.RIDE, Zone.BOW),
        52: NoteMeaning(Piece.CHINA, Zone.EDGE),
        53: NoteMeaning(Piece.RIDE, Zone.BELL),
        54: NoteMeaning(Piece.TAMBOURINE),
        55: NoteMeaning(Piece.SPLASH, Zone.EDGE),
        56: NoteMeaning(Piece.COWBELL),
        57: NoteMeaning(Piece.CRASH_2, Zone.EDGE),
        59: NoteMeaning(Piece.RIDE_2, Zone.BOW),
    }
)

V_DRUMS: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        22: NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=_CLOSED),
        26: NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=_OPEN),
        43: NoteMeaning(Piece.FLOOR_TOM_1),
        45: NoteMeaning(Piece.TOM_2),
        47: NoteMeaning(Piece.TOM_2, Zone.RIM),
        48: NoteMeaning(Piece.TOM_1),
        49: NoteMeaning(Piece.CRASH_1, Zone.BOW),
        50: NoteMeaning(Piece.TOM_1, Zone.RIM),
        52: NoteMeaning(Piece.CRASH_2, Zone.EDGE),
        55: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        57: NoteMeaning(Piece.CRASH_2, Zone.BOW),
        58: NoteMeaning(Piece.FLOOR_TOM_1, Zone.RIM),
        59: NoteMeaning(Piece.RIDE, Zone.EDGE),
    }
)

_V_DRUMS_ALONE = frozenset({22, 26})
"""Numbers that General MIDI leaves undefined and every V-Drums hi-hat sends."""


def guess_map(midi_notes: Collection[int]) -> KitMap:
    """The map that a file with these note numbers was most likely written for: V-Drums or General MIDI."""
    return V_DRUMS if _V_DRUMS_ALONE.intersection(midi_notes) else GENERAL_MIDI


def strike_of(midi_note: int, kit_map: KitMap) -> NoteMeaning:
    """What `midi_note` means on this kit; a number that the map lacks is `Piece.PERCUSSION`."""
    return kit_map.get(midi_note, NoteMeaning(Piece.PERCUSSION))


_BEST_NOTE = {Piece.KICK: 36, Piece.SNARE: 38, Piece.RIDE: 51}
"""Where General MIDI has several numbers for a piece, the plain one."""
_LOWEST_NOTE = {strike.piece: note for note, strike in sorted(GENERAL_MIDI.items(), reverse=True)}
_UNMAPPED_NOTE = 75
"""Claves: a number that every General MIDI kit sounds, and that reads back as percussion of no kit."""


def general_midi_note(piece: Piece, zone: Zone, articulation: Articulation, openness: float | None = None) -> int:
    """The General MIDI number that sounds closest (hi-hat open from openness 0.5 up)."""
    if piece is Piece.HIHAT:
        return 46 if (openness or 0.0) >= HALF_OPEN else 42
    if piece is Piece.SNARE and articulation is Articulation.CROSS_STICK:
        return 37
    if piece is Piece.SNARE and articulation is Articulation.RIM_SHOT:
        return 40
    if piece is Piece.RIDE and zone is Zone.BELL:
        return 53
    return _BEST_NOTE.get(piece, _LOWEST_NOTE.get(piece, _UNMAPPED_NOTE))
