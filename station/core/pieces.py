"""What is struck, where, how and by which limb: the small enumerations that every other module speaks in.

The values are stored in numpy arrays and captures, so a number, once given, is never given again.
"""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType

CLOSED, HALF_OPEN, OPEN = 0.0, 0.5, 1.0
"""Openness of a hi-hat."""


class Piece(IntEnum):
    """An instrument of the kit. The hi-hat under a hand and under the foot are two pieces, for two limbs play them."""

    KICK = 0
    SNARE = 1
    HIHAT = 2
    HIHAT_PEDAL = 3
    RIDE = 4
    CRASH_1 = 5
    CRASH_2 = 6
    SPLASH = 7
    CHINA = 8
    TOM_1 = 9
    TOM_2 = 10
    TOM_3 = 11
    TOM_4 = 12
    FLOOR_TOM_1 = 13
    FLOOR_TOM_2 = 14
    COWBELL = 15
    TAMBOURINE = 16
    CLAP = 17
    PERCUSSION = 18
    RIDE_2 = 19


class Zone(IntEnum):
    """The part of a piece that is struck."""

    HEAD = 0
    RIM = 1
    BOW = 2
    BELL = 3
    EDGE = 4
    PEDAL = 5


class Articulation(IntEnum):
    """How a piece is struck."""

    NORMAL = 0
    CROSS_STICK = 1
    RIM_SHOT = 2
    BUZZ = 3
    CHICK = 4
    SPLASH = 5


class Limb(IntEnum):
    """Who strikes. `UNKNOWN` where nobody has said."""

    UNKNOWN = -1
    RIGHT_HAND = 0
    LEFT_HAND = 1
    RIGHT_FOOT = 2
    LEFT_FOOT = 3

    @property
    def is_hand(self) -> bool:
        """Whether this limb is a hand."""
        return self in (Limb.RIGHT_HAND, Limb.LEFT_HAND)


class Dynamic(IntEnum):
    """The written loudness class of a note."""

    GHOST = 0
    NORMAL = 1
    ACCENT = 2


class Ornament(IntEnum):
    """What a stroke belongs to. Grace strokes of flams and drags have a `lead_ms` > 0."""

    NONE = 0
    FLAM = 1
    DRAG = 2
    DIDDLE = 3
    ROLL = 4


OTHER_HAND: Mapping[Limb, Limb] = MappingProxyType({Limb.RIGHT_HAND: Limb.LEFT_HAND, Limb.LEFT_HAND: Limb.RIGHT_HAND})
HAND_PIECES = frozenset(Piece) - {Piece.KICK, Piece.HIHAT_PEDAL}
CYMBALS = frozenset({Piece.RIDE, Piece.RIDE_2, Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA})
CHOKEABLE = CYMBALS | {Piece.HIHAT}
"""What rings and can be grabbed."""
TOMS = (Piece.TOM_1, Piece.TOM_2, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2)
DRUMS = frozenset({Piece.SNARE, *TOMS})
"""The drums that hands play: where sticks bounce."""
USUAL_FEET: Mapping[Piece, Limb] = MappingProxyType({Piece.KICK: Limb.RIGHT_FOOT, Piece.HIHAT_PEDAL: Limb.LEFT_FOOT})
"""Which foot a pedal is under where nobody says."""


def word(member: IntEnum) -> str:
    """The member's name as files and reports write it: `floor_tom_1`, `right_hand`."""
    return member.name.lower()
