"""How far a cymbal tips under the hardest stroke, and in a kit without touching a neighbour or what that one does.

A cymbal that tips by up to θ any way sweeps, in its own axes, what lies within |height| ≤ radial · tan θ of its plane
and within its radius of its centre. Two cymbals are looked at with both at their farthest; drums stand still. Radians.
"""

import math
from collections.abc import Mapping
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece

Array = NDArray[np.float64]

INCH_M = 0.0254
_MOST_RAD = math.radians(30.0)
"""No cymbal tips farther: its wing nut holds it (crashes on loose felts tip 15–30° under full force)."""
_REFERENCE_M, _REFERENCE_RAD = 8 * INCH_M, math.radians(25.0)
"""A 16″ crash tips by this much, and larger ones less, as the square of the size: by their weight."""
_OPEN_HAT = 0.25
"""The share of a free cymbal's swing that clutch and foot leave an open hi-hat (our choice)."""
_STEP_RAD = math.radians(1.0)
_LEAST_RAD = math.radians(1.0)
_PAD = 0.35
"""The share of a metal cymbal's swing that a rubber one has: its stopper and cable hold it (our choice)."""
_SPARE = 1.2
"""A stroke on a cymbal that still moves may tip it so much farther (our choice)."""
_CLEAR_M = 0.01
"""So far neighbours stay from each other (our choice: a cymbal's bell and felt, and what a drawn edge is thick)."""
_AROUND = np.linspace(0.0, 2 * np.pi, 36, endpoint=False)


def hardest_rad(piece: KitPiece) -> float:
    """The first swing of a cymbal that the hardest stroke hits on its edge, if nothing is in its way."""
    own = _REFERENCE_RAD * (_REFERENCE_M / piece.radius_m) ** 2
    return own * (_OPEN_HAT if piece.kind == "hihat" else 1.0) * (_PAD if piece.electronic else 1.0)


def swing_room(kit: Kit) -> Mapping[Piece, float]:
    """The farthest that each cymbal of `kit` may tip."""
    cymbals = [p for p in kit.pieces.values() if p.kind in ("cymbal", "hihat")]
    room = {p.piece: min(_MOST_RAD, _SPARE * hardest_rad(p)) for p in cymbals}
    for one in cymbals:
        for other in kit.pieces.values():
            if other.kind not in ("cymbal", "hihat"):
                while room[one.piece] > _LEAST_RAD and _meets(one, room[one.piece], _shell(other)):
                    room[one.piece] -= _STEP_RAD
    for one, other in permutations(cymbals, 2):
        while _meets(one, room[one.piece], _swept(other, room[other.piece])):
            wider = one if room[one.piece] >= room[other.piece] else other
            if room[wider.piece] <= _LEAST_RAD:
                break
            room[wider.piece] -= _STEP_RAD
    return room


def _meets(piece: KitPiece, tip_rad: float, points: Array) -> bool:
    """Whether any of `points` (n, 3) is in what `piece` sweeps, or all but."""
    off = points - piece.centre
    height = np.abs(off @ piece.normal)
    far = np.sqrt((off**2).sum(1))
    radial = np.sqrt(np.maximum(far**2 - height**2, 0.0))
    return bool(((height < radial * math.tan(tip_rad) + _CLEAR_M) & (far < piece.radius_m + _CLEAR_M)).any())


def _swept(piece: KitPiece, tip_rad: float) -> Array:
    """Points of a cymbal and its edge when it tips by up to `tip_rad` any way."""
    right, away, normal = piece.axes
    radii = piece.radius_m * np.linspace(0.2, 1.0, 5)
    r, a, t = (g.ravel() for g in np.meshgrid(radii, _AROUND, np.linspace(-tip_rad, tip_rad, 5)))
    flat = np.cos(a)[:, None] * right + np.sin(a)[:, None] * away
    return np.asarray(piece.centre + (r * np.cos(t))[:, None] * flat + (r * np.sin(t))[:, None] * normal)


def _shell(piece: KitPiece) -> Array:
    """Points of a drum's heads and shell."""
    right, away, normal = piece.axes
    radii = piece.radius_m * np.linspace(0.2, 1.0, 5)
    r, a, h = (g.ravel() for g in np.meshgrid(radii, _AROUND, np.linspace(0.0, -piece.depth_m, 4)))
    return np.asarray(
        piece.centre + (r * np.cos(a))[:, None] * right + (r * np.sin(a))[:, None] * away + h[:, None] * normal
    )
