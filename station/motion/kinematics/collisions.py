"""How deep sticks and arms pass through drums, cymbals, each other and the body, over many poses at once.

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
from station.motion.kinematics.body_solids import ArmPoints, BodyPoints, arm_in_kit, in_each_other, in_the_body
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


@dataclass(frozen=True, eq=False)
class Collisions:
    """Depths at each time: `pieces` (n, 2) per piece for the right and left stick, `limbs` (n,) by what is in what."""

    pieces: Mapping[Piece, Array]
    limbs: Mapping[str, Array]


def collisions(rows: Array, kit: Kit, stature_m: float) -> Collisions:
    """The depths in poses given as rows (n, fields) in the layout of `frame`."""
    right, left, body = points_of(rows)
    points = np.stack([arm.butt[:, None] + ALONG[:, None] * (arm.tip - arm.butt)[:, None] for arm in (right, left)], 1)
    through = {
        p.piece: np.stack([depth(p, points[:, side]) for side in (0, 1)], 1)
        for p in kit.pieces.values()
        if p.kind != "kick"
    }
    limbs = {f"right {name}": d for name, d in in_each_other(right, left, stature_m).items()}
    for side, arm in (("right", right), ("left", left)):
        own = in_the_body(arm, body, stature_m) | arm_in_kit(kit, arm, stature_m)
        limbs |= {f"{side} {name}": d for name, d in own.items()}
    return Collisions(through, {name: np.maximum(d, 0.0) for name, d in limbs.items()})


def points_of(rows: Array) -> tuple[ArmPoints, ArmPoints, BodyPoints]:
    """The right and the left arm and the body in rows of `frame`."""
    joints = rows[:, frame.JOINTS].reshape(-1, 21, 3)
    ends = [rows[:, part].reshape(-1, 2, 3) for part in (frame.BUTT, frame.TIP)]
    arms = [
        ArmPoints(*(joints[:, first + k] for k in range(4)), *(end[:, side] for end in ends))
        for side, first in enumerate((Joint.RIGHT_SHOULDER, Joint.LEFT_SHOULDER))
    ]
    pelvis, neck, head, crown = (joints[:, j] for j in (Joint.PELVIS, Joint.NECK, Joint.HEAD, Joint.CROWN))
    thighs = [(joints[:, hip], joints[:, hip + 1]) for hip in (Joint.RIGHT_HIP, Joint.LEFT_HIP)]
    body = BodyPoints(pelvis, neck, head, crown, (arms[0].shoulder, arms[1].shoulder), (thighs[0], thighs[1]))
    return arms[0], arms[1], body


def depth_in_kit(kit: Kit, butt: Array, tip: Array, follows: NDArray[np.bool_] | None = None) -> Array:
    """How deep sticks from `butt` to `tip` (n, 3), at n moments in order, are in the deepest of the kit's pieces, (n,).

    The kick is left out: no stick comes to it. Only moments that follow one another tell whether a cymbal was jumped
    through: `follows` (n,), whether each follows the one before; all, where it is not given.
    """
    middle, reach = 0.5 * (butt + tip), 0.5 * np.linalg.norm(tip - butt, axis=1)
    deepest = np.zeros(len(butt))
    follows = np.ones(len(butt), bool) if follows is None else follows
    for piece in kit.pieces.values():
        if piece.kind == "kick":
            continue
        size = np.hypot(piece.radius_m, piece.depth_m)
        away = middle - piece.centre
        near = np.flatnonzero(_dot(away, away) < (reach + size) ** 2)
        near = near[_may_touch(piece, np.stack((butt[near], tip[near])))]
        for block in blocks(len(near), _STICKS_AT_ONCE):
            on = near[max(block.start - 1, 0) : block.stop]  # with the one before, from which a cymbal is jumped
            points = butt[on, None] + ALONG[:, None] * (tip - butt)[on, None]
            deepest[on] = np.maximum(deepest[on], depth(piece, points, follows[on[1:]] & (np.diff(on) == 1)))
    return deepest


def _may_touch(piece: KitPiece, ends: Array) -> NDArray[np.bool_]:
    """Which sticks with these ends (2, n, 3), at n moments in order, may be in `piece`, (n,): few that are near it are.

    A stick is looked at by the heights of its ends over the piece's plane. Beside it stays the one before, from which
    it may have jumped through a cymbal.
    """
    height = (ends - piece.centre) @ piece.normal
    solid = piece.kind in ("drum", "block")
    above, below = height.min(0) > TOUCH_M, height.max(0) < -TOUCH_M - solid * piece.depth_m
    may = ~(above | below)
    if solid:
        return np.asarray(may)
    may[1:] |= (above[1:] != above[:-1]) | (below[1:] != below[:-1])
    may[:-1] |= may[1:]
    return np.asarray(may)


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


def _dot(a: Array, b: Array) -> Array:
    """The scalar products of vectors (…, 3); a sum over so short an axis is slow."""
    return np.asarray(np.einsum("...i,...i->...", a, b))
