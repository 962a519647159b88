"""What each letter of a GrooveScribe line plays, both ways, and the MIDI note that GrooveScribe plays for it.

The line of cymbals (H) has one letter a moment, so does the snare's (S); the feet share a line (K), whose X is both.
GrooveScribe has rows for the first and the fourth tom alone: T2 and T3, which older links may have, are neither shown
nor played. Its stacker is a china to us, its metronome's wood blocks are percussion.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.pieces import CLOSED, OPEN, Articulation, Dynamic, Ornament, Piece, Zone

NORMAL_VELOCITY, ACCENT_VELOCITY, GHOST_VELOCITY = 85, 120, 50
"""What GrooveScribe's General MIDI plays (js/constants.js)."""

VELOCITIES: Mapping[Dynamic, int] = MappingProxyType(
    {Dynamic.NORMAL: NORMAL_VELOCITY, Dynamic.ACCENT: ACCENT_VELOCITY, Dynamic.GHOST: GHOST_VELOCITY}
)


@dataclass(frozen=True, slots=True)
class GrooveStroke:
    """What a letter says of one stroke."""

    piece: Piece
    zone: Zone = Zone.HEAD
    articulation: Articulation = Articulation.NORMAL
    dynamic: Dynamic = Dynamic.NORMAL
    openness: float | None = None
    ornament: Ornament = Ornament.NONE


_KICK = GrooveStroke(Piece.KICK)
_CHICK = GrooveStroke(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, openness=CLOSED)
_CLOSED_HAT = GrooveStroke(Piece.HIHAT, Zone.BOW, openness=CLOSED)
_RIDE = GrooveStroke(Piece.RIDE, Zone.BOW)
_BELL = GrooveStroke(Piece.RIDE, Zone.BELL)
_BLOCK = GrooveStroke(Piece.PERCUSSION)
_BUZZ = GrooveStroke(Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL)

HANDS = ("H", "S", "T1", "T2", "T3", "T4")
"""The lines that hands play."""
UNHEARD = ("T2", "T3")
"""GrooveScribe's page has no rows for these, and its MIDI leaves them out."""

LETTERS: Mapping[str, Mapping[str, tuple[GrooveStroke, ...]]] = MappingProxyType(
    {
        "H": {
            "x": (_CLOSED_HAT,),
            "X": (GrooveStroke(Piece.HIHAT, Zone.BOW, dynamic=Dynamic.ACCENT, openness=CLOSED),),
            "o": (GrooveStroke(Piece.HIHAT, Zone.BOW, openness=OPEN),),
            "+": (_CLOSED_HAT,),
            "r": (_RIDE,),
            "R": (_RIDE,),
            "b": (_BELL,),
            "B": (_BELL,),
            "c": (GrooveStroke(Piece.CRASH_1, Zone.EDGE),),
            "s": (GrooveStroke(Piece.CHINA, Zone.EDGE),),
            "m": (GrooveStroke(Piece.COWBELL),),
            "n": (_BLOCK,),
            "N": (_BLOCK,),
        },
        "S": {
            "o": (GrooveStroke(Piece.SNARE),),
            "O": (GrooveStroke(Piece.SNARE, dynamic=Dynamic.ACCENT),),
            "g": (GrooveStroke(Piece.SNARE, dynamic=Dynamic.GHOST),),
            "x": (GrooveStroke(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),),
            "f": (GrooveStroke(Piece.SNARE, ornament=Ornament.FLAM),),
            "d": (GrooveStroke(Piece.SNARE, ornament=Ornament.DRAG),),
            "b": (_BUZZ,),
            "B": (_BUZZ,),
        },
        "K": {"o": (_KICK,), "x": (_CHICK,), "X": (_KICK, _CHICK)},
        "T1": {letter: (GrooveStroke(Piece.TOM_1),) for letter in "ox"},
        "T2": {"o": (GrooveStroke(Piece.TOM_2),)},
        "T3": {"o": (GrooveStroke(Piece.TOM_3),)},
        "T4": {letter: (GrooveStroke(Piece.FLOOR_TOM_1),) for letter in "ox"},
    }
)

LETTER_OF: Mapping[GrooveStroke, tuple[str, str]] = MappingProxyType(
    {
        strokes[0]: (line, letter)
        for line, letters in LETTERS.items()
        for letter, strokes in reversed(list(letters.items()))
        if len(strokes) == 1 and line not in UNHEARD
    }
)
"""The line and the first letter for each stroke."""

MIDI_LETTERS: Mapping[int, tuple[str, str]] = MappingProxyType(
    {
        21: ("S", "g"),
        22: ("S", "O"),
        35: ("K", "o"),
        37: ("S", "x"),
        38: ("S", "o"),
        42: ("H", "x"),
        43: ("T4", "o"),
        44: ("K", "x"),
        45: ("T3", "o"),
        46: ("H", "o"),
        47: ("T2", "o"),
        48: ("T1", "o"),
        49: ("H", "c"),
        51: ("H", "r"),
        52: ("H", "s"),
        53: ("H", "b"),
        76: ("H", "N"),
        77: ("H", "n"),
        103: ("S", "d"),
        104: ("S", "b"),
        105: ("H", "m"),
        107: ("S", "f"),
        108: ("H", "X"),
    }
)
"""Source: constant_OUR_MIDI_* of js/constants.js. The numbers from 103 up are samples of its own sound font."""

LOUD_LETTERS: Mapping[tuple[int, int], tuple[str, str]] = MappingProxyType(
    {
        (38, ACCENT_VELOCITY): ("S", "O"),
        (38, GHOST_VELOCITY): ("S", "g"),
        (42, ACCENT_VELOCITY): ("H", "X"),
    }
)
"""What number and velocity say where GrooveScribe saves General MIDI; flams and drags are accents there."""

METRONOME_NOTES = (76, 77)
"""Clicks, but for those of velocity `NORMAL_VELOCITY`, which are written in the line H."""
