"""Where the things stand that are struck, and from where each hand reaches them.

Metres in the house's axes: x to the drummer's right, y forward, z up. The layout is that of `shared/HUMANS.md`.
"""

import math
from types import MappingProxyType

from station.core.pieces import Limb, Piece

PLACES = MappingProxyType(
    {
        Piece.SNARE: (-0.07, 0.45, 0.66),
        Piece.HIHAT: (-0.42, 0.62, 0.86),
        Piece.TOM_1: (-0.12, 0.80, 0.82),
        Piece.TOM_2: (0.25, 0.80, 0.82),
        Piece.FLOOR_TOM_1: (0.55, 0.38, 0.62),
        Piece.CRASH_1: (-0.45, 0.85, 1.10),
        Piece.CRASH_2: (0.45, 0.90, 1.10),
        Piece.RIDE: (0.65, 0.75, 0.95),
    }
)
CLICK_PLACE = (0.0, 0.50, 1.00)
"""Where sticks are clicked together: before the chest (our choice)."""

ELBOWS = MappingProxyType({Limb.RIGHT_HAND: (0.27, 0.05), Limb.LEFT_HAND: (-0.27, 0.05)})
"""Where an elbow hangs, from above (x, y): beside the trunk, shoulders .259 of 1.76 m apart plus the arms' width."""

LAP = (0.18, 0.35, 0.56)
"""Where a right stick rests on the thigh; the left one mirrored (our choice: seat at 0.50 m)."""


def place(piece: Piece) -> tuple[float, float, float]:
    """Where `piece` is struck; a piece without a place of its own stands where the snare does."""
    return PLACES.get(piece, PLACES[Piece.SNARE])


def heading_rad(limb: Limb, at: tuple[float, float, float]) -> float:
    """The stick's direction from above, from the x axis to the left, when `limb` reaches `at`."""
    x, y = ELBOWS[limb]
    return math.atan2(at[1] - y, at[0] - x)
