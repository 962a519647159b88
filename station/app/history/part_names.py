"""What limbs and pieces are called over the columns of a table: in full, and as a narrow column has it."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.labels import name_of, piece_name
from station.core.pieces import Piece, word
from station.store.rows import Part

_PIECES = frozenset(map(word, Piece))
_SHORT: Mapping[str, str] = MappingProxyType(
    {
        piece_name(Piece.HIHAT_PEDAL): "hat foot",
        piece_name(Piece.CRASH_2): "crash 2",
        piece_name(Piece.RIDE_2): "ride 2",
        piece_name(Piece.TOM_2): "mid tom",
        piece_name(Piece.TOM_4): "tom 4",
        piece_name(Piece.FLOOR_TOM_2): "floor tom 2",
        "right hand": "R hand",
        "left hand": "L hand",
        "right foot": "R foot",
        "left foot": "L foot",
    }
)


def full_name(part: Part, name: str) -> str:
    """A limb or piece, written as reports write it, as a drummer says it."""
    return name_of(name) if part is Part.PIECE and name in _PIECES else name.replace("_", " ")


def short_name(part: Part, name: str) -> str:
    """The same in ten letters or so."""
    full = full_name(part, name)
    return _SHORT.get(full, full)
