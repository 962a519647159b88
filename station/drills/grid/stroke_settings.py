"""How the strokes of a grid are struck: the velocity of each dynamic, and the grace strokes of flams and drags."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.pieces import Dynamic, Piece
from station.music.grace_strokes import Graces
from station.music.stroke_velocities import USUAL_VELOCITIES


@dataclass(frozen=True, slots=True)
class Velocities:
    """The velocity of each dynamic: (ghost, normal, accent), with others for some pieces.

    The defaults are HUMANS' ranges: ghost 20–45, normal 60–95, accent 105–127.
    """

    usual: tuple[int, int, int] = USUAL_VELOCITIES
    of_piece: Mapping[Piece, tuple[int, int, int]] = field(default_factory=lambda: MappingProxyType({}))

    def of(self, piece: Piece, dynamic: Dynamic) -> int:
        """Velocity 1–127 of a stroke of `piece`."""
        return self.of_piece.get(piece, self.usual)[dynamic]


@dataclass(frozen=True, slots=True)
class StrokeSettings:
    """How the strokes of one grid are struck."""

    velocities: Velocities = field(default_factory=Velocities)
    graces: Graces = field(default_factory=Graces)
