"""The skin of a right hand in its own axes and at rest: a palm of blended solids, and a rounded cone a finger's bone.

Bones are numbered here as `hand_bones` has the digits', from 1 on; 0 is the palm. A finger's joints bend as round ends
turn in each other, so that no bend ever thins them; only between palm and thumb does the skin stretch.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from station.render.figure.hand_bones import BONES_M, DIGITS, JOINTS, KNUCKLES_M, RADII_M, REST
from station.render.geometry.implicit import Array, Field, cone, egg, surface, united
from station.render.geometry.materials import Material
from station.render.geometry.mesh import lathe

_CELL_M = 0.0042
_STRETCH_M = 0.006
"""How far beyond the nearest solid the other bone still pulls the palm's skin (our choice)."""
_THUMB_BONE = 1
_OVER_M = 0.0008
"""So far the palm's skin lies over the roots of the fingers (our choice)."""
_INSIDE = 0.96
"""A bone's flesh begins inside the round end of the one before, so that one of the two alone is seen."""


@dataclass(frozen=True, eq=False)
class HandSkin:
    """`position`, `normal` (n, 3), `bones`, `weights` (n, 2), `ao` (n,), `faces` (m, 3)."""

    position: Array
    normal: Array
    bones: NDArray[np.uint8]
    weights: Array
    ao: Array
    faces: NDArray[np.uint32]


@cache
def hand_skin(fineness: float) -> HandSkin:
    """The whole hand; `fineness` multiplies the size of its cells."""
    parts = [_palm(fineness)]
    bones = [(digit, joint) for digit in range(DIGITS) for joint in range(JOINTS)]
    parts += [_phalanx(digit, joint, fineness) for digit, joint in bones[_THUMB_BONE:]]
    starts = np.cumsum([0] + [len(part.position) for part in parts])
    return HandSkin(
        np.concatenate([part.position for part in parts]),
        np.concatenate([part.normal for part in parts]),
        np.concatenate([part.bones for part in parts]),
        np.concatenate([part.weights for part in parts]),
        np.concatenate([part.ao for part in parts]),
        np.concatenate([part.faces + np.uint32(a) for part, a in zip(parts, starts, strict=False)]),
    )


def _palm(fineness: float) -> HandSkin:
    hand: list[Field] = [
        cone((0, 0, -0.006), (0, 0, 0.02), 0.0240, 0.0235),
        egg((-0.004, -0.003, 0.054), (0.038, 0.0165, 0.046)),
        egg((-0.022, -0.009, 0.036), (0.014, 0.013, 0.030)),
        cone((0.022, -0.001, 0.084), (-0.029, -0.005, 0.075), 0.0130, 0.0105),
    ]
    start, way = REST[0, :3, 3], REST[0, :3, 2]
    ball = cone(start, start + BONES_M[0, 0] * way, 0.0145, RADII_M[0, 1] + _OVER_M)
    knuckles = [
        cone(0.75 * knuckle, knuckle, radius, radius + _OVER_M)
        for knuckle, radius in zip(KNUCKLES_M[1:], RADII_M[1:, 0], strict=True)
    ]
    whole = united([united([*hand, ball], 0.012), *knuckles], 0.008)
    mesh = surface(whole, (-0.06, -0.055, -0.04), (0.075, 0.035, 0.125), _CELL_M * fineness)
    p = mesh.position
    nearer = np.min([field(p) for field in hand], axis=0) - ball(p)
    thumb = 1 / (1 + np.exp(-nearer / _STRETCH_M))
    return HandSkin(
        p,
        mesh.normal,
        np.tile(np.array([0, _THUMB_BONE], np.uint8), (len(p), 1)),
        np.stack([1 - thumb, thumb], axis=1),
        np.clip(0.85 + 5 * p[:, 1], 0.5, 1),
        mesh.faces,
    )


def _phalanx(digit: int, joint: int, fineness: float) -> HandSkin:
    """A bone's flesh: from its joint, where the one before it rounds it off, to a round end of its own."""
    segments, rounds = max(5, round(14 / fineness)), max(2, round(4 / fineness))
    low, high = RADII_M[digit, joint : joint + 2].tolist()
    length = float(BONES_M[digit, joint]) - (high if joint == JOINTS - 1 else 0.0)
    a = np.linspace(0, np.pi / 2, rounds + 1)
    end = np.stack([high * np.cos(a), length + high * np.sin(a)], axis=1)
    mesh = lathe(
        np.concatenate([[(_INSIDE * low, 0.0), (0.49 * (low + high), 0.5 * length)], end]), segments, Material.SKIN
    )
    mesh = mesh.moved(REST[JOINTS * digit + joint])
    n = len(mesh.position)
    bones = np.tile(np.array([1 + JOINTS * digit + joint, 0], np.uint8), (n, 1))
    return HandSkin(
        mesh.position,
        mesh.normal,
        bones,
        np.tile([1.0, 0.0], (n, 1)),
        0.82 + 0.18 * mesh.normal[:, 1],
        mesh.faces,
    )
