"""What people call the pieces and their own limbs."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.pieces import Limb, Piece, word

_NAMES: Mapping[Piece, str] = MappingProxyType(
    {
        Piece.HIHAT: "hi-hat",
        Piece.HIHAT_PEDAL: "hi-hat foot",
        Piece.CRASH_1: "crash",
        Piece.CRASH_2: "second crash",
        Piece.RIDE_2: "second ride",
        Piece.TOM_1: "high tom",
        Piece.TOM_2: "middle tom",
        Piece.TOM_3: "low tom",
        Piece.TOM_4: "fourth tom",
        Piece.FLOOR_TOM_1: "floor tom",
        Piece.FLOOR_TOM_2: "second floor tom",
    }
)


def piece_name(piece: Piece) -> str:
    """The piece as a drummer says it."""
    return _NAMES.get(piece, word(piece))


LIMB_LETTERS: Mapping[Limb, str] = MappingProxyType(
    {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L", Limb.RIGHT_FOOT: "R", Limb.LEFT_FOOT: "L"}
)
"""Its side, as sticking has it."""


def limb_name(limb: Limb) -> str:
    """The limb as a drummer says it."""
    return word(limb).replace("_", " ")


_OF_WORD: Mapping[str, str] = MappingProxyType({word(piece): piece_name(piece) for piece in Piece})


def name_of(piece_word: str) -> str:
    """`piece_name` of the piece that files and reports write as `piece_word`."""
    return _OF_WORD[piece_word]
