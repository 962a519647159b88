"""How the strokes of a grid are struck: the velocity of each dynamic, and the grace strokes of flams and drags."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.pieces import Dynamic, Ornament, Piece

MIN_VELOCITY, MAX_VELOCITY = 1, 127
"""MIDI 1.0: 0 would be a note off."""


@dataclass(frozen=True, slots=True)
class Velocities:
    """The velocity of each dynamic: (ghost, normal, accent), with others for some pieces.

    The defaults are HUMANS' ranges: ghost 20–45, normal 60–95, accent 105–127.
    """

    usual: tuple[int, int, int] = (32, 80, 116)
    of_piece: Mapping[Piece, tuple[int, int, int]] = field(default_factory=lambda: MappingProxyType({}))

    def of(self, piece: Piece, dynamic: Dynamic) -> int:
        """Velocity 1–127 of a stroke of `piece`."""
        return self.of_piece.get(piece, self.usual)[dynamic]


@dataclass(frozen=True, slots=True)
class Graces:
    """The grace strokes of flams and drags: spacings in ms, whatever the tempo, and their share of the velocity.

    `flam_ms` before its note sounds a flam's grace stroke (the middle of 15–40 ms); `drag_ms` apart are a drag's three
    strokes (the middle of 40–70 ms); `share` of its note's velocity has each (25–50 %). Source: HUMANS, Timing.
    """

    flam_ms: float = 30.0
    drag_ms: float = 55.0
    share: float = 0.4

    def leads_ms(self, ornament: Ornament) -> tuple[float, ...]:
        """How long before its note each grace stroke sounds, the first first; none for what has none."""
        if ornament is Ornament.FLAM:
            return (self.flam_ms,)
        return (2 * self.drag_ms, self.drag_ms) if ornament is Ornament.DRAG else ()

    def velocity(self, main: int) -> int:
        """Velocity 1–127 of a grace stroke before a note of velocity `main`."""
        return max(MIN_VELOCITY, round(main * self.share))


@dataclass(frozen=True, slots=True)
class StrokeSettings:
    """How the strokes of one grid are struck."""

    velocities: Velocities = field(default_factory=Velocities)
    graces: Graces = field(default_factory=Graces)
