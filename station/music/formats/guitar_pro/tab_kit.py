"""What Guitar Pro's percussion numbers mean: General MIDI's, and its own for what General MIDI cannot say.

Source: the articulations with their input numbers that Guitar Pro 7 writes into every drum track (`InputMidiNumbers` in
`score.gpif`); GP6's elements and variations as alphaTab documents them (PROTOCOLS § 10).
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.note_map import GENERAL_MIDI, KitMap, NoteMeaning
from station.core.pieces import HALF_OPEN, Articulation, Piece, Zone

_CROSS_STICK = NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK)

TAB_KIT: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        29: NoteMeaning(Piece.RIDE_2, Zone.EDGE),  # choked
        31: _CROSS_STICK,
        40: NoteMeaning(Piece.SNARE),  # electric snare: another sound, struck the same
        59: NoteMeaning(Piece.RIDE_2, Zone.EDGE),
        91: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        92: NoteMeaning(Piece.HIHAT, Zone.BOW, openness=HALF_OPEN),
        93: NoteMeaning(Piece.RIDE, Zone.EDGE),
        94: NoteMeaning(Piece.RIDE, Zone.EDGE),  # choked
        95: NoteMeaning(Piece.SPLASH, Zone.EDGE),  # choked
        96: NoteMeaning(Piece.CHINA, Zone.EDGE),  # choked
        97: NoteMeaning(Piece.CRASH_1, Zone.EDGE),  # choked
        98: NoteMeaning(Piece.CRASH_2, Zone.EDGE),  # choked
        **dict.fromkeys((99, 100, 101, 102, 103), NoteMeaning(Piece.COWBELL)),
        **dict.fromkeys((111, 112, 113), NoteMeaning(Piece.TAMBOURINE)),
        115: NoteMeaning(Piece.CRASH_1, Zone.EDGE),  # orchestral cymbals
        116: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        126: NoteMeaning(Piece.RIDE_2, Zone.BOW),
        127: NoteMeaning(Piece.RIDE_2, Zone.BELL),
    }
)

CHOKED = frozenset({29, 94, 95, 96, 97, 98})
"""Struck and grabbed: the grab comes where the note ends."""

_OF_GP6 = {
    (0, 0): 35,
    (1, 0): 38,
    (1, 1): 91,
    (1, 2): 37,
    (2, 0): 99,
    (2, 1): 100,
    (3, 0): 56,
    (3, 1): 101,
    (4, 0): 102,
    (4, 1): 103,
    (5, 0): 43,
    (6, 0): 45,
    (7, 0): 47,
    (8, 0): 48,
    (9, 0): 50,
    (10, 0): 42,
    (10, 1): 92,
    (10, 2): 46,
    (11, 0): 44,
    (12, 0): 57,
    (12, 1): 98,
    (13, 0): 49,
    (13, 1): 97,
    (14, 0): 55,
    (14, 1): 95,
    (15, 0): 51,
    (15, 1): 93,
    (15, 2): 53,
    (15, 3): 94,
    (16, 0): 52,
    (16, 1): 96,
}
OF_ELEMENT: Mapping[tuple[int, int], int] = MappingProxyType(_OF_GP6)
"""GP6's (element, variation) -> number. Its ride bell is 127 in alphaTab's table, the same cymbal's bell here."""
