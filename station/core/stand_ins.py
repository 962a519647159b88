"""Which piece stands in for one that a kit lacks: for the drummer who shows it, in judging, and in a folded lesson."""

from collections.abc import Collection, Mapping
from types import MappingProxyType

from station.core.pieces import Piece

STAND_INS: Mapping[Piece, tuple[Piece, ...]] = MappingProxyType(
    {
        Piece.CRASH_1: (Piece.CRASH_2, Piece.CHINA, Piece.RIDE, Piece.RIDE_2, Piece.HIHAT),
        Piece.CRASH_2: (Piece.CRASH_1, Piece.CHINA, Piece.RIDE, Piece.RIDE_2, Piece.HIHAT),
        Piece.SPLASH: (Piece.CRASH_1, Piece.CRASH_2, Piece.RIDE, Piece.RIDE_2, Piece.HIHAT),
        Piece.CHINA: (Piece.CRASH_2, Piece.CRASH_1, Piece.RIDE, Piece.RIDE_2, Piece.HIHAT),
        Piece.RIDE: (Piece.RIDE_2, Piece.CRASH_2, Piece.CRASH_1, Piece.HIHAT),
        Piece.RIDE_2: (Piece.RIDE, Piece.CRASH_2, Piece.CRASH_1, Piece.HIHAT),
        Piece.HIHAT: (Piece.RIDE, Piece.CRASH_1),
        Piece.TOM_1: (Piece.TOM_2, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_2: (Piece.TOM_1, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_3: (Piece.TOM_2, Piece.TOM_4, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_4: (Piece.TOM_3, Piece.FLOOR_TOM_1, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.FLOOR_TOM_1: (Piece.FLOOR_TOM_2, Piece.TOM_4, Piece.TOM_3, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.FLOOR_TOM_2: (Piece.FLOOR_TOM_1, Piece.TOM_4, Piece.TOM_3, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.COWBELL: (Piece.RIDE, Piece.HIHAT),
        Piece.TAMBOURINE: (Piece.HIHAT, Piece.RIDE),
        Piece.CLAP: (Piece.SNARE,),
        Piece.PERCUSSION: (Piece.RIDE, Piece.HIHAT, Piece.CRASH_1),
        Piece.SNARE: (Piece.TOM_1,),
    }
)
"""Where a drummer goes instead of a piece that a kit lacks, nearest first: its like, then what sounds and lies nearest,
at last what every kit has (our choice). A foot has nowhere else to go."""


def stand_in(piece: Piece, kit: Collection[Piece]) -> Piece | None:
    """`piece` if it is one of the `kit`, else the nearest that is; None where nothing stands in for it."""
    return piece if piece in kit else next((other for other in STAND_INS.get(piece, ()) if other in kit), None)
