"""The head's bare shape: skull, jaw, nose and ears as solids, and how its skin follows the bones of the face.

Origin at the joint of head and neck, x to the right, y where the face looks, z up; designed for a head 0.2146 m high.
The features are few and round, so that they read from across a room.
"""

from functools import cache

import numpy as np

from station.motion.kinematics.look import Girths
from station.render.figure.bones import Bone
from station.render.figure.expression import BROW_M, EYE_M, MOUTH_M
from station.render.figure.skin import Pull, Skin, hung, skin_of
from station.render.geometry.implicit import Array, Field, Surface, cone, egg, smooth_min, surface, united, without
from station.render.geometry.materials import Material

_COARSE = 2.0
"""Cells so many times as large as designed lose nose and ears: then they are solids of their own, set on the face."""
_BOX = (-0.11, -0.12, -0.03), (0.11, 0.14, 0.235)
_CELL_M = 0.0075


def head_skins(girths: Girths, fineness: float) -> list[Skin]:
    """The skin of skull, nose and ears."""
    return [_skin(part) for part in _surfaces(girths, fineness)]


def skull_field(girths: Girths) -> Field:
    """The whole head without hair."""
    return united([united([_face_field(girths), _EARS], 0.008), _nose_field(girths)], 0.012)


@cache
def _surfaces(girths: Girths, fineness: float) -> list[Surface]:
    cell = _CELL_M * fineness
    if fineness <= _COARSE:
        return [surface(skull_field(girths), *_BOX, cell)]
    nose = surface(_nose_field(girths), (-0.03, 0.06, 0.03), (0.03, 0.13, 0.12), 0.4 * cell)
    ears = surface(_EARS, (-0.105, -0.04, 0.05), (0.105, 0.03, 0.13), 0.5 * cell)
    return [surface(_face_field(girths), *_BOX, 0.8 * cell), nose, ears]


def _nose_field(girths: Girths) -> Field:
    wide = 0.5 + 0.5 * girths.chin
    return united(
        [
            cone((0, 0.087, 0.098), (0, 0.1045, 0.068), 0.0075 * wide, 0.0112 * wide),
            egg((0, 0.100, 0.0635), (0.0158 * wide, 0.0115, 0.0095)),
        ],
        0.010,
    )


def _face_field(girths: Girths) -> Field:
    chin = girths.chin
    solids: list[Field] = [
        egg((0, -0.008, 0.128), (0.079, 0.096, 0.092)),
        egg((0, 0.030, 0.066), (0.064 * chin, 0.064, 0.072)),
        egg((0, 0.062, 0.016), (0.033 * chin**2, 0.032, 0.027)),
        egg((0.036 * chin, 0.056, 0.062), (0.030, 0.030, 0.027)),
        egg((-0.036 * chin, 0.056, 0.062), (0.030, 0.030, 0.027)),
    ]
    head = united(solids, 0.032)
    brows = united([egg((s * 0.030, 0.074, 0.122), (0.026, 0.016, 0.009)) for s in (-1.0, 1.0)], 0.01)
    sockets = united([egg((s * 0.034, 0.104, EYE_M[2]), (0.026, 0.024, 0.020)) for s in (-1.0, 1.0)], 0.004)
    face = without(united([head, brows], 0.014), sockets, 0.020)
    mouth = egg((0, 0.090, 0.031), (0.022, 0.006, 0.010))  # the lips' swelling
    return united([face, mouth], 0.012)


_EARS = without(
    united([egg((s * 0.083, -0.006, 0.088), (0.011, 0.021, 0.030)) for s in (-1.0, 1.0)], 0.002),
    united([egg((s * 0.094, -0.002, 0.091), (0.006, 0.011, 0.018)) for s in (-1.0, 1.0)], 0.002),
)
"""Both ears, hollow outside."""


def front(girths: Girths, x: Array, z: Array) -> Array:
    """Where the bare face's surface lies in y at (x, z), by bisection from outside."""
    return front_of(skull_field(girths), x, z)


def front_of(field: Field, x: Array, z: Array, y: tuple[float, float] = (0.02, 0.16)) -> Array:
    """Where a solid's surface lies in y at (x, z), between the inside `y[0]` and the outside `y[1]`."""
    near, far = np.full_like(x, y[0]), np.full_like(x, y[1])
    for _ in range(24):
        middle = (near + far) / 2
        inside = field(np.stack([x, middle, z], axis=1)) < 0
        near, far = np.where(inside, middle, near), np.where(inside, far, middle)
    return near


# --- how the skin follows the face ------------------------------------------------------------------------------------

_JAW_FROM_M, _JAW_WHOLE_M = 0.036, 0.010
"""From this height down the skin begins to follow the jaw, and from there on follows it whole."""


def face_pull(p: Array) -> Pull:
    """How strongly the face's bones pull the skin, hair or beard at each point (n, 3)."""
    before = _rise(p[:, 1], -0.010, 0.050)
    below = _rise(-p[:, 2], -_JAW_FROM_M, -_JAW_WHOLE_M)
    pull: dict[Bone, Array | float] = {Bone.JAW: before * below}
    for side, corner, brow in ((1.0, Bone.RIGHT_CORNER, Bone.RIGHT_BROW), (-1.0, Bone.LEFT_CORNER, Bone.LEFT_BROW)):
        out = np.array([side, 1.0, 1.0])
        pull[corner] = 0.75 * _near(p, MOUTH_M * out + (0.004 * side, 0.0, 0.004), 0.019)
        pull[brow] = 0.70 * _near(p, BROW_M * out, 0.020)
    pull[Bone.LOWER_LIP] = 0.5 * _near(p, np.array([0.0, 0.092, 0.024]), 0.010) * (1 - before * below)
    return pull


def _near(p: Array, at: Array, reach: float) -> Array:
    """1 at a point, falling as a bell of this width."""
    away = p - at
    return np.asarray(np.exp(-np.einsum("ij,ij->i", away, away) / (2 * reach**2)), np.float64)


def _rise(x: Array, low: float, high: float) -> Array:
    """0 below `low`, 1 above `high`, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), np.float64)


def _skin(part: Surface) -> Skin:
    p = part.position
    lit = 1 - 0.35 * _rise(-p[:, 2], -0.02, 0.02) * _rise(-p[:, 1], -0.09, -0.04)  # under the chin
    hollow = 1 - 0.25 * sum(_near(p, EYE_M * (s, 1.0, 1.0) + (0.0, 0.012, 0.0), 0.014) for s in (-1.0, 1.0))
    return skin_of(part, hung(Bone.HEAD, len(p), face_pull(p)), Material.SKIN, lit * hollow)


def shell(girths: Girths, thickness: float, region: Field, blend: float) -> Field:
    """What lies on the head in `region` as a layer of this thickness."""
    skull = skull_field(girths)
    return lambda p: -smooth_min(-(skull(p) - thickness), -region(p), blend)
