"""How deep sticks pass through drums, cymbals, each other and the arms, over many poses at once.

For tests and benchmarks, which hold the motion to it, and for whoever edits a kit. Drums are cylinders under their
heads, cymbals thin discs, all at rest; sticks are lines, arms capsules. Depths in metres, 0 where nothing touches: for
a drum how far the deepest point would have to move to be out, for a cymbal the least of the ways out for the stick.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.maths import blocks
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece

Array = NDArray[np.float64]

_STICKS_AT_ONCE = 1024
"""So many sticks at once are looked at as fast as all of them (our choice)."""
ALONG = np.linspace(0.0, 1.0, 33)
"""Places on the stick at which it is looked at, from butt to tip: 13 mm apart."""
TOUCH_M = 0.001
"""A point this near to a surface touches it (the tip's own exactness)."""
STICK_RADIUS_M = 0.007
ARM_RADIUS_M = 0.035
"""A 5A stick is 14 mm thick (ASTM has no standard; makers agree); a forearm near the wrist 7 cm (our choice)."""


@dataclass(frozen=True, eq=False)
class Collisions:
    """Depths at each time: `pieces` (n, 2) per piece for the right and left stick, `sticks` (n,), `arms` (n, 2).

    `sticks`: the sticks through each other; `arms`: each stick through the other forearm.
    """

    pieces: Mapping[Piece, Array]
    sticks: Array
    arms: Array


def collisions(rows: Array, kit: Kit) -> Collisions:
    """The depths in poses given as rows (n, fields) in the layout of `frame`."""
    butt, tip = rows[:, frame.BUTT].reshape(-1, 2, 3), rows[:, frame.TIP].reshape(-1, 2, 3)
    joints = rows[:, frame.JOINTS].reshape(-1, 21, 3)
    points = butt[:, :, None] + ALONG[:, None] * (tip - butt)[:, :, None]
    through = {
        p.piece: np.stack([depth(p, points[:, side]) for side in (0, 1)], 1)
        for p in kit.pieces.values()
        if p.kind != "kick"
    }
    gap = segments_apart(butt[:, 0], tip[:, 0], butt[:, 1], tip[:, 1])
    elbows, wrists = joints[:, (Joint.LEFT_ELBOW, Joint.RIGHT_ELBOW)], joints[:, (Joint.LEFT_WRIST, Joint.RIGHT_WRIST)]
    arms = [
        np.maximum(ARM_RADIUS_M - segments_apart(butt[:, k], tip[:, k], elbows[:, k], wrists[:, k]), 0.0)
        for k in range(2)
    ]
    return Collisions(through, np.maximum(2 * STICK_RADIUS_M - gap, 0.0), np.stack(arms, 1))


def depth_in_kit(kit: Kit, butt: Array, tip: Array) -> Array:
    """How deep sticks from `butt` to `tip` (n, 3), at n moments in order, are in the deepest of the kit's pieces, (n,).

    The kick is left out: no stick comes to it.
    """
    middle, reach = 0.5 * (butt + tip), 0.5 * np.linalg.norm(tip - butt, axis=1)
    deepest = np.zeros(len(butt))
    for piece in kit.pieces.values():
        size = np.hypot(piece.radius_m, piece.depth_m)
        away = middle - piece.centre
        near = np.flatnonzero(_dot(away, away) < (reach + size) ** 2) if piece.kind != "kick" else np.zeros(0, np.intp)
        for block in blocks(len(near), _STICKS_AT_ONCE):
            on = near[max(block.start - 1, 0) : block.stop]  # with the one before, from which a cymbal is jumped
            points = butt[on, None] + ALONG[:, None] * (tip - butt)[on, None]
            deepest[on] = np.maximum(deepest[on], depth(piece, points, np.diff(on) == 1))
    return deepest


def depth(piece: KitPiece, points: Array, follows: NDArray[np.bool_] | bool = True) -> Array:
    """How deep the sticks' points (n, k, 3), of n moments in order, are in `piece`, (n,).

    `follows` (n − 1,): whether no moment is left out before each but the first.
    A cymbal is thin enough to be jumped through between two moments: where a point of the stick changes its side within
    the edge, it has gone through by its distance from the edge.
    """
    away = points - piece.centre
    height = away @ piece.normal
    radial = np.sqrt(np.maximum(_dot(away, away) - height**2, 0.0))
    if piece.kind in ("drum", "block"):
        inside = np.minimum(np.minimum(-height, piece.radius_m - radial), height + piece.depth_m)
        return np.asarray(np.maximum(inside.max(-1), 0.0))
    above, below = height[:, :-1], height[:, 1:]
    crosses = above * below < 0
    share = above / np.where(crosses, above - below, 1.0)
    at = radial[:, :-1] + share * (radial[:, 1:] - radial[:, :-1])
    inside = np.where(crosses, piece.radius_m - at, 0.0).max(-1)
    near = radial < piece.radius_m
    up, down = np.where(near, height, 0.0).max(-1), np.where(near, -height, 0.0).max(-1)
    through = np.minimum(inside, np.minimum(up, down))
    before, after = height[:-1], height[1:]
    jumped = (before * after < 0) & np.reshape(follows, (-1, 1)) & (np.minimum(np.abs(before), np.abs(after)) > TOUCH_M)
    swept = np.where(jumped, piece.radius_m - np.maximum(radial[:-1], radial[1:]), 0.0).max(-1)
    return np.asarray(np.maximum(np.maximum(through, np.concatenate((np.zeros(1), swept))), 0.0))


def segments_apart(a: Array, b: Array, c: Array, d: Array) -> Array:
    """The least distance between segments ab and cd, all (n, 3) (Ericson, Real-Time Collision Detection, § 5.1.9)."""
    u, v, w = b - a, d - c, a - c
    uu, vv, uv, uw, vw = _dot(u, u), _dot(v, v), _dot(u, v), _dot(u, w), _dot(v, w)
    denominator = np.maximum(uu * vv - uv * uv, 1e-12)
    s = np.clip((uv * vw - vv * uw) / denominator, 0.0, 1.0)
    t = np.clip((uv * s + vw) / vv, 0.0, 1.0)
    s = np.clip((uv * t - uw) / uu, 0.0, 1.0)
    apart = w + s[:, None] * u - t[:, None] * v
    return np.sqrt(_dot(apart, apart))


def _dot(a: Array, b: Array) -> Array:
    """The scalar products of vectors (…, 3); a sum over so short an axis is slow."""
    return np.asarray(np.einsum("...i,...i->...", a, b))
