"""Which piece of a kit a lane stands for, and which lane a piece is charted in.

As pro drums has it: red snare; yellow, blue and green are hi-hat, ride and crash, or high, mid and floor tom. Of five
lanes red, blue and green are drums, yellow and orange cymbals, in the documentation's conversion to pro drums.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.note_map import NoteMeaning
from station.core.pieces import CLOSED, Piece, Zone
from station.music.formats.clone_hero.drum_chart import ChartNote, Lane

_KICK = NoteMeaning(Piece.KICK)
_SNARE = NoteMeaning(Piece.SNARE)
_HIHAT = NoteMeaning(Piece.HIHAT, Zone.BOW, openness=CLOSED)
_RIDE = NoteMeaning(Piece.RIDE, Zone.BOW)
_CRASH = NoteMeaning(Piece.CRASH_1, Zone.EDGE)
_FLOOR_TOM = NoteMeaning(Piece.FLOOR_TOM_1)

DRUM_OF: Mapping[Lane, NoteMeaning] = MappingProxyType(
    {
        Lane.KICK: _KICK,
        Lane.RED: _SNARE,
        Lane.YELLOW: NoteMeaning(Piece.TOM_1),
        Lane.BLUE: NoteMeaning(Piece.TOM_2),
        Lane.ORANGE_GREEN: _FLOOR_TOM,
        Lane.FIFTH: _FLOOR_TOM,
    }
)
CYMBAL_OF: Mapping[Lane, NoteMeaning] = MappingProxyType(
    {Lane.YELLOW: _HIHAT, Lane.BLUE: _RIDE, Lane.ORANGE_GREEN: _CRASH}
)
_FIVE_LANES: Mapping[Lane, NoteMeaning] = MappingProxyType({**DRUM_OF, Lane.YELLOW: _HIHAT, Lane.ORANGE_GREEN: _CRASH})

STRIKE_OF: Mapping[Piece, NoteMeaning] = MappingProxyType(
    {
        **{m.piece: m for m in (*DRUM_OF.values(), *CYMBAL_OF.values())},
        Piece.CRASH_2: NoteMeaning(Piece.CRASH_2, Zone.EDGE),
    }
)
"""How each piece is struck that a lane or the game's drummer may mean."""

_CRASHES = (Piece.CRASH_1, Piece.CRASH_2)
MOTIONS_OF: Mapping[Piece, tuple[Piece, ...]] = MappingProxyType(
    {
        Piece.SNARE: (Piece.SNARE,),
        Piece.HIHAT: (Piece.HIHAT, *_CRASHES, Piece.RIDE),
        Piece.RIDE: (Piece.RIDE, Piece.CRASH_2, Piece.CRASH_1, Piece.HIHAT),
        Piece.CRASH_1: (*_CRASHES, Piece.RIDE, Piece.HIHAT),
        Piece.TOM_1: (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1),
        Piece.TOM_2: (Piece.TOM_2, Piece.TOM_1, Piece.FLOOR_TOM_1),
        Piece.FLOOR_TOM_1: (Piece.FLOOR_TOM_1, Piece.TOM_2, Piece.TOM_1),
    }
)
"""The piece that a lane stands for by itself -> the pieces that the game's drummer may be playing there, likeliest
first: a lane is a colour, and a song with two crashes charts one of them in blue."""

LANE_OF: Mapping[Piece, tuple[Lane, bool]] = MappingProxyType(
    {
        Piece.KICK: (Lane.KICK, False),
        Piece.SNARE: (Lane.RED, False),
        Piece.HIHAT: (Lane.YELLOW, True),
        Piece.RIDE: (Lane.BLUE, True),
        Piece.CRASH_1: (Lane.ORANGE_GREEN, True),
        Piece.TOM_1: (Lane.YELLOW, False),
        Piece.TOM_2: (Lane.BLUE, False),
        Piece.FLOOR_TOM_1: (Lane.ORANGE_GREEN, False),
    }
)
"""Piece -> its lane and whether it is a cymbal there; these come back as they are."""

NEAR_LANE_OF: Mapping[Piece, tuple[Lane, bool]] = MappingProxyType(
    {
        Piece.RIDE_2: (Lane.BLUE, True),
        Piece.CRASH_2: (Lane.ORANGE_GREEN, True),
        Piece.CHINA: (Lane.ORANGE_GREEN, True),
        Piece.SPLASH: (Lane.YELLOW, True),
        Piece.TOM_3: (Lane.BLUE, False),
        Piece.TOM_4: (Lane.ORANGE_GREEN, False),
        Piece.FLOOR_TOM_2: (Lane.ORANGE_GREEN, False),
    }
)
"""Pieces that a chart has no lane for, and the lane that charters give them."""


def meaning_of(note: ChartNote, has_five_lanes: bool) -> NoteMeaning:
    """What `note` strikes."""
    if has_five_lanes:
        return _FIVE_LANES[note.lane]
    return CYMBAL_OF[note.lane] if note.is_cymbal and note.lane in CYMBAL_OF else DRUM_OF[note.lane]
