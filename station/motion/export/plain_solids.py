"""The plain solids that an exported drummer and kit are made of: triangle meshes with normals, in metres, along z."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STICK_RADIUS_M = 0.007


@dataclass(frozen=True, eq=False)
class Solid:
    """A triangle mesh: `points` and `normals` (v, 3), `triangles` (t, 3) of indices, counterclockwise from outside."""

    points: Array
    normals: Array
    triangles: NDArray[np.int64]


def lathe(profile: list[tuple[float, float]], sides: int) -> Solid:
    """A solid of revolution about z: `profile` of (radius, z) from bottom to top, each ring with its own normals."""
    angles = np.linspace(0, 2 * np.pi, sides + 1)
    circle = np.stack([np.cos(angles), np.sin(angles)], 1)
    n, k = sides + 1, np.arange(sides)
    points: list[Array] = []
    normals: list[Array] = []
    triangles: list[NDArray[np.int64]] = []
    for (r0, z0), (r1, z1) in pairwise(profile):
        slope = np.array([z1 - z0, r0 - r1]) / max(float(np.hypot(z1 - z0, r0 - r1)), 1e-12)
        first = 2 * n * len(triangles)
        rings = [np.c_[r * circle, np.full(n, z)] for r, z in ((r0, z0), (r1, z1))]
        points.append(np.concatenate(rings))
        normals.append(np.tile(np.c_[slope[0] * circle, np.full(n, slope[1])], (2, 1)))
        triangles.append(first + np.stack([k, k + 1, k + n + 1, k, k + n + 1, k + n], 1).reshape(-1, 3))
    return Solid(np.concatenate(points), np.concatenate(normals), np.concatenate(triangles))


def limb(length: float, radius: float) -> Solid:
    """A spindle from 0 to `length`, rounded off a little beyond both ends."""
    r = min(radius, 0.5 * length)
    return lathe([(0.0, -0.3 * r), (0.8 * r, 0.0), (r, 0.35 * length), (0.75 * r, length), (0.0, length + 0.3 * r)], 12)


def stick(length: float) -> Solid:
    """A drumstick from its butt to its tip: a shaft, a taper and a bead."""
    r = STICK_RADIUS_M
    taper = [(0.6 * r, 0.965 * length), (0.85 * r, 0.985 * length), (0.0, length)]
    return lathe([(0.0, 0.0), (r, 0.0), (r, 0.75 * length), *taper], 8)


def brush(length: float) -> Solid:
    """A brush: a handle, and its wires as one flat fan."""
    r, end, half = STICK_RADIUS_M, 0.48 * length, 0.046
    handle = lathe([(0.0, 0.0), (r, 0.0), (0.85 * r, end), (0.0, end)], 8)
    fan = lathe([(0.5 * r, end), (half, length), (0.0, length)], 12)
    flat, steep = np.array([1.0, 0.03, 1.0]), np.array([1.0, 1 / 0.03, 1.0])
    normals = fan.normals * steep / np.linalg.norm(fan.normals * steep, axis=1, keepdims=True)
    return Solid(
        np.concatenate([handle.points, flat * fan.points]),
        np.concatenate([handle.normals, normals]),
        np.concatenate([handle.triangles, fan.triangles + len(handle.points)]),
    )


def mallet(length: float) -> Solid:
    """A mallet: a shaft and a felt head."""
    r, felt = 0.9 * STICK_RADIUS_M, 0.015
    ball = [(0.7 * felt, length - 2 * felt), (felt, length - felt), (0.7 * felt, length - 0.2 * felt), (0.0, length)]
    return lathe([(0.0, 0.0), (r, 0.0), (0.7 * r, length - 2.3 * felt), *ball], 10)


HELD: Mapping[str, Callable[[float], Solid]] = MappingProxyType({"stick": stick, "brush": brush, "mallet": mallet})
"""What hands hold, by the names of `grip.HELD`; a bare hand holds nothing."""


def cymbal(radius: float, hangs: float) -> Solid:
    """A cymbal that hangs at z 0, its bow so far below, with its bell between."""
    bow = [(0.0, -0.012), (radius, -0.008), (radius, -0.006), (0.2 * radius, 0.0)]
    return lathe([(r, z - hangs) for r, z in (*bow, (0.12 * radius, 0.02), (0.0, 0.022))], 32)


def block(radius: float, depth: float) -> Solid:
    """A cowbell: four flat sides, the struck one at z 0."""
    return lathe([(0.0, -depth), (radius, -depth), (radius, 0.0), (0.0, 0.0)], 4)


def drum(radius: float, depth: float) -> Solid:
    """A shell with both heads, the struck one at z 0."""
    return lathe([(0.0, -depth), (radius, -depth), (radius, 0.0), (0.0, 0.0)], 32)


def beater(length: float) -> Solid:
    """A shaft from its axle with a felt of 4 cm about its end."""
    r, felt = 0.005, 0.025
    ball = [(felt, length - 0.02), (felt, length + 0.02), (0.0, length + 0.02)]
    return lathe([(0.0, 0.0), (r, 0.0), (r, length - 0.03), *ball], 12)


def plate(half_width: float, length: float) -> Solid:
    """A flat board from 0 to `length`, 6 mm thick under y 0."""
    thick = 0.006
    corners = np.array([[x, y, z] for x in (-half_width, half_width) for y in (-thick, 0.0) for z in (0.0, length)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    points = np.concatenate([corners[list(face)] for face in faces])
    sides = points.reshape(-1, 4, 3)
    normals = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    triangles = np.concatenate([4 * k + np.array([[0, 1, 2], [0, 2, 3]]) for k in range(len(faces))])
    return Solid(points, np.repeat(normals, 4, 0), triangles)


def turned_to(solid: Solid, along: tuple[float, float, float]) -> Solid:
    """The same with its z axis turned to `along`, one of the axes."""
    z = np.array(along)
    x = np.array([0.0, 1.0, 0.0]) if abs(z[1]) < 0.5 else np.array([1.0, 0.0, 0.0])
    turn = np.stack([x, np.cross(z, x), z], 1)
    return Solid(solid.points @ turn.T, solid.normals @ turn.T, solid.triangles)
