"""The head: skull and face, hair, eyes, brows, mouth and headphones, in the head's own axes.

Origin at the joint of head and neck, x to the right, y where the face looks, z up; designed for a head 0.2146 m high.
The features are few and round, so that they read from across a room.
"""

from functools import cache

import numpy as np

from station.render.figure.skeleton import EYE_HEIGHT, Bone
from station.render.geometry.implicit import (
    Array,
    Field,
    Surface,
    cone,
    egg,
    plane,
    smooth_min,
    surface,
    united,
    without,
)
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, ball, joined, lathe, new_mesh, tube
from station.render.geometry.transforms import frame, rotation, translation

_EYE = np.array([0.0335, 0.079, EYE_HEIGHT])


def face_meshes(scale: float, fineness: float) -> list[Mesh]:
    """Everything above the neck, on the bones `HEAD` and `EYES`, `scale` times as large as designed."""
    parts = [
        *(_mesh(part, Material.SKIN) for part in _skull(fineness)),
        _mesh(_hair(fineness), Material.HAIR),
        *_lids(fineness),
        *_brows(fineness),
        *_mouth(fineness),
        *_headphones(fineness),
    ]
    meshes = [
        _scaled(joined(parts).on_bone(Bone.HEAD), scale),
        _scaled(joined(_eyes(fineness)).on_bone(Bone.EYES), scale),
    ]
    return meshes


def _scaled(mesh: Mesh, scale: float) -> Mesh:
    return Mesh(
        mesh.position * scale, mesh.normal, mesh.tangent, mesh.uv, mesh.material, mesh.bone, mesh.ao, mesh.faces
    )


def _mesh(skin: Surface, material: Material) -> Mesh:
    return new_mesh(skin.position, skin.normal, skin.faces, material)


def _skull_field() -> Field:
    return united([_bare_skull_field(), _nose_field()], 0.014)


def _nose_field() -> Field:
    return united(
        [cone((0, 0.088, 0.096), (0, 0.1045, 0.067), 0.008, 0.0120), egg((0, 0.099, 0.063), (0.0165, 0.011, 0.0095))],
        0.010,
    )


def _bare_skull_field() -> Field:
    solids: list[Field] = [
        egg((0, -0.008, 0.128), (0.079, 0.096, 0.092)),
        egg((0, 0.030, 0.066), (0.064, 0.064, 0.072)),
        egg((0, 0.060, 0.018), (0.034, 0.034, 0.028)),
        egg((0.036, 0.056, 0.060), (0.030, 0.030, 0.028)),
        egg((-0.036, 0.056, 0.060), (0.030, 0.030, 0.028)),
    ]
    head = united(solids, 0.035)
    sockets = united([egg((s * 0.034, 0.104, EYE_HEIGHT), (0.026, 0.024, 0.020)) for s in (-1.0, 1.0)], 0.004)
    face = without(head, sockets, 0.022)
    ears = united([egg((s * 0.083, -0.006, 0.088), (0.012, 0.022, 0.030)) for s in (-1.0, 1.0)], 0.002)
    return united([face, ears], 0.008)


_COARSE = 2.0
"""Cells that are so many times as large as designed lose a nose: then it is a solid of its own, set on the face."""
_BOX = (-0.11, -0.12, -0.03), (0.11, 0.14, 0.235)


@cache
def _skull(fineness: float) -> list[Surface]:
    cell = 0.0075 * fineness
    if fineness <= _COARSE:
        return [surface(_skull_field(), *_BOX, cell)]
    nose = surface(_nose_field(), (-0.03, 0.06, 0.03), (0.03, 0.13, 0.12), 0.4 * cell)
    return [surface(_bare_skull_field(), *_BOX, cell), nose]


@cache
def _hair(fineness: float) -> Surface:
    """A cap with a quiff: the skull a little larger, behind the hairline, with combed locks on top."""
    cap = egg((0, -0.016, 0.134), (0.086, 0.099, 0.096))
    line = united([plane((0, 0.062, 0.150), (0, 0.86, -0.5)), plane((0, -0.002, 0.075), (0, 0.35, -0.94))], 0.02)
    locks = [
        cone((-0.045, 0.050, 0.192), (0.035, 0.070, 0.222), 0.026, 0.022),
        cone((0.000, 0.058, 0.208), (0.052, 0.074, 0.212), 0.024, 0.016),
        cone((-0.050, 0.010, 0.206), (0.040, 0.020, 0.226), 0.030, 0.026),
        cone((-0.040, -0.040, 0.205), (0.040, -0.035, 0.212), 0.030, 0.028),
    ]
    body = _behind(cap, line)
    hair = united([body, united(locks, 0.014)], 0.018)

    def combed(p: Array) -> Array:
        wave = np.sin(95 * (p[:, 1] + 0.35 * p[:, 0]) + 3 * np.sin(40 * p[:, 2]))
        return np.asarray(hair(p) + 0.0012 * wave, np.float64)

    return surface(combed, (-0.12, -0.14, 0.0), (0.12, 0.13, 0.265), 0.0075 * fineness)


def _behind(field: Field, wall: Field) -> Field:
    return lambda p: -smooth_min(-field(p), -wall(p), 0.012)


def _eyes(fineness: float) -> list[Mesh]:
    parts: list[Mesh] = []
    for side in (-1.0, 1.0):
        centre = _EYE * [side, 1, 1]
        white = ball((0, 0, 0), 0.0185, Material.EYE_WHITE, max(10, round(20 / fineness)))
        parts.append(_stretched(white, (0.98, 0.62, 1.06)).moved(translation(centre)))
        look = frame(centre + np.array([0, 0.0088, 0]), [side * 0.06, 1, -0.04], [1, 0, 0])
        iris = lathe(
            [(0.0118, 0.0), (0.0108, 0.0022), (0.0068, 0.0038), (0.0, 0.0044)], _cuts(16, fineness), Material.EYE
        )
        parts.append(iris.moved(look))
        parts.append(ball(centre + np.array([0.0042, 0.0126, 0.0040]), 0.0023, Material.EYE_WHITE, 6))
    return parts


def _cuts(most: int, fineness: float) -> int:
    """Into how many pieces a round is cut: `most`, less where the surface is cut coarser than usual."""
    return max(5, round(most * min(1.0, 1.8 / fineness)))


def _lids(fineness: float) -> list[Mesh]:
    """Upper lids: caps a little larger than the eyes."""
    a = np.linspace(np.pi / 2, 0.42, 7)
    profile = np.stack([0.0203 * np.cos(a), 0.0203 * np.sin(a)], axis=1)[::-1]
    cap = lathe(profile, _cuts(18, fineness), Material.SKIN)
    lid = _stretched(cap, (1.0, 0.66, 1.06))
    return [lid.moved(translation(_EYE * [side, 1, 1]) @ rotation([1, 0, 0], -0.12)) for side in (-1.0, 1.0)]


def _stretched(mesh: Mesh, factors: tuple[float, float, float]) -> Mesh:
    f = np.array(factors)
    normal = mesh.normal / f
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return Mesh(mesh.position * f, normal, mesh.tangent, mesh.uv, mesh.material, mesh.bone, mesh.ao, mesh.faces)


def _brows(fineness: float) -> list[Mesh]:
    t = np.linspace(0, 1, _cuts(7, fineness))
    parts = []
    for side in (-1.0, 1.0):
        x = 0.013 + 0.040 * t
        z = 0.127 + 0.009 * np.sin(np.pi * (0.2 + 0.65 * t)) - 0.006 * t
        y = _front(x, z) + 0.002
        path = np.stack([side * x, y, z], axis=1)
        parts.append(tube(path, 0.0052, Material.HAIR, _cuts(6, fineness)))
        parts += [ball(path[end], 0.0052, Material.HAIR, _cuts(8, fineness)) for end in (0, -1)]
    return parts


def _mouth(fineness: float) -> list[Mesh]:
    t = np.linspace(-1, 1, _cuts(9, fineness))
    x = 0.021 * t + 0.002
    z = 0.031 + 0.0055 * t**2 + 0.0015 * t
    path = np.stack([x, _front(x, z) - 0.0004, z], axis=1)
    return [
        tube(path, 0.0026, Material.LIP, _cuts(6, fineness)),
        *(ball(path[end], 0.0026, Material.LIP, _cuts(6, fineness)) for end in (0, -1)),
    ]


def _front(x: Array, z: Array) -> Array:
    """Where the face's surface lies in y at (x, z), by bisection from outside."""
    field = _skull_field()
    near, far = np.full_like(x, 0.02), np.full_like(x, 0.16)
    for _ in range(24):
        middle = (near + far) / 2
        inside = field(np.stack([x, middle, z], axis=1)) < 0
        near, far = np.where(inside, middle, near), np.where(inside, far, middle)
    return near


def _headphones(fineness: float) -> list[Mesh]:
    angle = np.linspace(0.10, np.pi - 0.10, max(9, round(30 / fineness)))
    band = np.stack([0.098 * np.cos(angle), np.full_like(angle, -0.006), 0.100 + 0.132 * np.sin(angle)], axis=1)
    parts = [
        tube(band + np.array([0, dy, 0]), 0.0065, Material.HEADPHONES, _cuts(6, fineness))
        for dy in (-0.009, 0.0, 0.009)
    ]
    segments = max(10, round(28 / fineness))
    cup = [(0.0, 0.0), (0.030, 0.0), (0.041, 0.006), (0.042, 0.018), (0.036, 0.027), (0.020, 0.031), (0.0, 0.031)]
    ring = [(0.0265, 0.0300), (0.0265, 0.0312), (0.0215, 0.0322)]
    for side in (-1.0, 1.0):
        turn = rotation([0, 1, 0], side * np.pi / 2)
        at = translation([side * 0.079, -0.006, 0.088])
        parts.append(lathe(cup, segments, Material.HEADPHONES).moved(at @ turn))
        parts.append(lathe(ring, segments, Material.GLOW).moved(at @ turn))
    return parts
