"""What each way of striking aims at on a kit: the point that stick or beater touches.

Metres; x to the drummer's right, y forward, z up; azimuths in radians from straight ahead, to the left positive.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece, Target
from station.motion.strokes.hand_events import SHOW, WAIT
from station.music.score import Score

Array = NDArray[np.float64]

_LAID_AZIMUTHS = tuple(math.radians(d) for d in (62.0, 50.0, 38.0, 26.0, 14.0))
_LAID_UNDER_M, _LAID_ASIDE_M = 0.04, 0.03
"""A cross-stick's hand lies on the head, so far to its own side of the middle, where the other's stick may strike; the
stick strikes the rim beyond, across the player in the first of these directions from straight ahead in which its end is
not under another piece, nor so near (our choice)."""

WAIT_M = (0.10, 0.02, 0.07)
"""Where a waiting stick's tip is: to the hand's own side of its spot on the snare, nearer, higher (our choice)."""
SHOW_M = (0.08, 0.17, 0.40)
"""Where a stick's tip is before it is spun or tossed: high enough for all of it to turn over the kit (our choice)."""


@dataclass(frozen=True, slots=True)
class Strike:
    """One way of striking: what, where, how and with which hand."""

    piece: Piece
    zone: Zone
    articulation: int  # `Articulation`, or `GRAB`, `WAIT` or `SHOW` of `events`
    limb: Limb


def target_of(kit: Kit, strike: Strike) -> Target:
    """What the stick aims at: a rim shot's tip is on the head while its shaft meets the rim, a cross-stick's too."""
    drum = kit.pieces[kit.stand_in(strike.piece)]
    if strike.articulation == Articulation.CROSS_STICK and drum.kind == "drum":
        rim = kit.target(strike.piece, Zone.RIM, strike.limb)
        azimuth = laid_azimuth(kit, drum, strike.limb)
        point = drum.centre + _to_the_rim(drum, azimuth) + rim.raised_m * drum.normal
        return replace(rim, point_m=point, centre_m=point)
    zone = Zone.HEAD if strike.articulation == Articulation.RIM_SHOT else strike.zone
    target = kit.target(strike.piece, zone, strike.limb)
    if strike.articulation not in (WAIT, SHOW):
        return target
    x, y, z = WAIT_M if strike.articulation == WAIT else SHOW_M
    side = 1.0 if strike.limb == Limb.RIGHT_HAND else -1.0
    return replace(target, point_m=target.point_m + np.array([side * x, y, z]))


def _to_the_rim(drum: KitPiece, azimuth: float) -> Array:
    """From the middle of `drum` to where a cross-stick that points to `azimuth` lies on the rim."""
    across = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    across -= (across @ drum.normal) * drum.normal
    across /= np.linalg.norm(across)
    aside = math.copysign(_LAID_ASIDE_M, azimuth) * np.cross(across, drum.normal)
    return np.asarray(aside + math.sqrt(drum.radius_m**2 - _LAID_ASIDE_M**2) * across)


def laid_azimuth(kit: Kit, drum: KitPiece, limb: Limb) -> float:
    """Where a cross-stick on `drum` points, from straight ahead to the left."""
    others = [p for p in kit.pieces.values() if p is not drum and p.kind != "kick"]
    for azimuth in _LAID_AZIMUTHS:
        turned = azimuth if limb == Limb.RIGHT_HAND else -azimuth
        x, y, _ = drum.centre + (1 + _LAID_UNDER_M / drum.radius_m) * _to_the_rim(drum, turned)
        if all(math.hypot(x - p.centre_m[0], y - p.centre_m[1]) > p.radius_m + _LAID_UNDER_M for p in others):
            break
    return turned


def strike_points(score: Score, kit: Kit, limbs: NDArray[np.int8]) -> Array:
    """The point that each stroke touches, (n, 3)."""
    notes = score.notes
    key = np.stack([notes["piece"], notes["zone"], notes["articulation"], limbs], 1)
    kinds, which = np.unique(key, axis=0, return_inverse=True)
    points = [target_of(kit, Strike(Piece(p), Zone(z), a, Limb(limb))).point_m for p, z, a, limb in kinds.tolist()]
    return np.array(points).reshape(-1, 3)[which.reshape(-1)]
