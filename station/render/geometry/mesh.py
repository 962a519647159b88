"""Triangle meshes and the solids that the kit is made of: lathes, rods, boxes.

Metres. A mesh carries for each corner: where it is, which way the surface looks, the direction of its grain
(`tangent`), a place on the surface (`uv`, what it means is the material's affair), its material, its share of open sky
(`ao`, 0–1) and the bone that moves it. Faces wind counter-clockwise seen from outside.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.render.geometry.transforms import Matrix, frame, unit

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Mesh:
    """`position`, `normal`, `tangent` (n, 3), `uv` (n, 2), `material`, `bone` (n,) uint8, `ao` (n,), `faces` (m, 3)."""

    position: Points
    normal: Points
    tangent: Points
    uv: Points
    material: NDArray[np.uint8]
    bone: NDArray[np.uint8]
    ao: Points
    faces: NDArray[np.uint32]

    def moved(self, matrix: Matrix) -> "Mesh":
        """The mesh carried by a rigid motion (no scaling)."""
        turn = matrix[:3, :3].T
        return replace(
            self,
            position=self.position @ turn + matrix[:3, 3],
            normal=self.normal @ turn,
            tangent=self.tangent @ turn,
        )

    def on_bone(self, bone: int) -> "Mesh":
        """The mesh hung on another bone."""
        return replace(self, bone=np.full_like(self.bone, bone))

    def shaded(self, ao: float | Points) -> "Mesh":
        """The mesh with less sky, uniformly or corner by corner."""
        return replace(self, ao=self.ao * ao)


def joined(meshes: Iterable[Mesh]) -> Mesh:
    """One mesh of many; at least one."""
    parts = list(meshes)
    starts = np.cumsum([0] + [len(p.position) for p in parts])
    return Mesh(
        np.concatenate([p.position for p in parts]),
        np.concatenate([p.normal for p in parts]),
        np.concatenate([p.tangent for p in parts]),
        np.concatenate([p.uv for p in parts]),
        np.concatenate([p.material for p in parts]),
        np.concatenate([p.bone for p in parts]),
        np.concatenate([p.ao for p in parts]),
        np.concatenate([p.faces + np.uint32(s) for p, s in zip(parts, starts, strict=False)]),
    )


def new_mesh(
    position: Points, normal: Points, faces: NDArray[np.uint32], material: int, tangent: Points | None = None
) -> Mesh:
    """A mesh on bone 0 under open sky, its uv all zero."""
    n = len(position)
    return Mesh(
        position,
        normal,
        np.zeros((n, 3)) if tangent is None else tangent,
        np.zeros((n, 2)),
        np.full(n, material, np.uint8),
        np.zeros(n, np.uint8),
        np.ones(n),
        faces,
    )


def _grid_faces(rows: int, columns: int) -> NDArray[np.uint32]:
    """Two triangles for each cell of a grid of corners, row by row."""
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (i * columns + j).ravel()
    quads = np.stack([a, a + columns, a + columns + 1, a + 1], axis=1)
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.uint32)


def lathe(profile: ArrayLike, segments: int, material: int, smooth: bool = True) -> Mesh:
    """A solid of revolution about z from a profile (k, 2) of (radius, height), walked with the outside to its right.

    `uv` is (radius, angle / 2π). With `smooth` false every stretch of the profile keeps its own flat shading.
    """
    p = np.asarray(profile, np.float64)
    if not smooth:
        return joined([lathe(p[i : i + 2], segments, material) for i in range(len(p) - 1)])
    step = np.diff(p, axis=0)
    side = unit(np.stack([step[:, 1], -step[:, 0]], axis=1))
    slope = unit(np.concatenate([side[:1], side[:-1] + side[1:], side[-1:]]))
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    position = np.concatenate([p[:, None, :1] * ring, np.broadcast_to(p[:, None, 1:], (len(p), len(ring), 1))], axis=2)
    normal = np.concatenate(
        [slope[:, None, :1] * ring, np.broadcast_to(slope[:, None, 1:], (len(p), len(ring), 1))], axis=2
    )
    around = np.stack([-np.sin(angle), np.cos(angle), np.zeros_like(angle)], axis=1)
    mesh = new_mesh(
        position.reshape(-1, 3),
        normal.reshape(-1, 3),
        _grid_faces(len(p), len(ring))[:, ::-1],
        material,
        np.broadcast_to(around, (len(p), len(ring), 3)).reshape(-1, 3),
    )
    uv = np.stack(np.broadcast_arrays(p[:, :1], angle / (2 * np.pi)), axis=2).reshape(-1, 2)
    return replace(mesh, uv=uv)


def rod(
    start: ArrayLike, end: ArrayLike, radius: float | tuple[float, float], material: int, segments: int = 8
) -> Mesh:
    """A round rod with flat ends; two radii make it taper."""
    a, b = np.asarray(start, np.float64), np.asarray(end, np.float64)
    length = float(np.linalg.norm(b - a))
    low, high = radius if isinstance(radius, tuple) else (radius, radius)
    sides = lathe([(low, 0), (high, length)], segments, material)
    caps = [lathe([(0, 0), (low, 0)], segments, material), lathe([(high, length), (0, length)], segments, material)]
    return joined([sides, *caps]).moved(frame(a, b - a, [1.0, 0.0, 0.0]))


def ball(centre: ArrayLike, radius: float, material: int, segments: int = 12) -> Mesh:
    """A sphere."""
    a = np.linspace(-np.pi / 2, np.pi / 2, max(segments // 2, 4) + 1)
    mesh = lathe(np.stack([radius * np.cos(a), radius * np.sin(a)], axis=1), segments, material)
    return replace(mesh, position=mesh.position + np.asarray(centre, np.float64))


def box(size: Sequence[float], material: int, bevel: float = 0.0) -> Mesh:
    """A box about the origin with chamfered edges, flatly shaded."""
    half = np.asarray(size, np.float64) / 2
    model = _model_box(bevel > 0)
    out = np.where(np.abs(model.position) < 1, half - bevel, half)
    return replace(model, position=np.sign(model.position) * out, material=np.full_like(model.material, material))


@cache
def _model_box(chamfered: bool) -> Mesh:
    """The box from −1 to +1, of which all others are made: what is not at ±1 is drawn in by the bevel."""
    half, bevel = np.ones(3), 0.5 if chamfered else 0.0
    faces: list[Mesh] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for way in (-1.0, 1.0):
            corners = np.zeros((4, 3))
            corners[:, axis] = way * half[axis]
            corners[:, u] = np.array([-1, 1, 1, -1]) * (half[u] - bevel)
            corners[:, v] = np.array([-1, -1, 1, 1]) * (half[v] - bevel)
            faces.append(_flat(corners if way > 0 else corners[::-1]))
    return joined([*faces, *_chamfers(half, bevel)] if chamfered else faces)


def _flat(corners: Points) -> Mesh:
    normal = unit(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
    triangles = np.array([[0, k, k + 1] for k in range(1, len(corners) - 1)], np.uint32)
    return new_mesh(corners, np.repeat(normal[None], len(corners), axis=0), triangles, 0)


def _chamfers(half: Points, bevel: float) -> list[Mesh]:
    """The twelve slanting edges and eight corners of a chamfered box."""
    meshes: list[Mesh] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for su in (-1.0, 1.0):
            for sv in (-1.0, 1.0):
                corners = np.zeros((4, 3))
                corners[:, axis] = np.array([-1, 1, 1, -1]) * (half[axis] - bevel)
                corners[:, u] = su * np.array([half[u], half[u], half[u] - bevel, half[u] - bevel])
                corners[:, v] = sv * np.array([half[v] - bevel, half[v] - bevel, half[v], half[v]])
                meshes.append(_outward(corners))
    for signs in np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).T.reshape(-1, 3):
        corners = np.array([[half[k] - (0 if k == axis else bevel) for k in range(3)] for axis in range(3)])
        meshes.append(_outward(signs * corners))
    return meshes


def _outward(corners: Points) -> Mesh:
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    return _flat(corners if np.dot(normal, corners.mean(axis=0)) > 0 else corners[::-1])


def grid_mesh(grid: Points, material: int) -> Mesh:
    """A sheet through points (rows, columns, 3): it faces where a row's way and a column's, in this order, turn to."""
    along_rows, along_columns = np.gradient(grid, axis=0), np.gradient(grid, axis=1)
    normal = unit(np.cross(along_rows, along_columns))
    return new_mesh(grid.reshape(-1, 3), normal.reshape(-1, 3), _grid_faces(*grid.shape[:2]), material)


def tube(path: ArrayLike, radius: float | Points, material: int, segments: int = 8) -> Mesh:
    """A bent pipe along `path` (k, 3), k ≥ 2, open at its ends; `radius` may be one for each point (k,)."""
    p = np.asarray(path, np.float64)
    radii = np.broadcast_to(radius, len(p))
    along = unit(np.gradient(p, axis=0))
    side = np.cross(along[0], [0.0, 0.0, 1.0] if abs(along[0][2]) < 0.9 else [0.0, 1.0, 0.0])
    rings, normals = [], []
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    for point, way, thick in zip(p, along, radii, strict=True):
        side = unit(side - way * np.dot(side, way))
        normal = np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * np.cross(way, side)
        rings.append(point + thick * normal)
        normals.append(normal)
    faces = _grid_faces(len(p), len(angle))[:, ::-1]
    return new_mesh(np.concatenate(rings), np.concatenate(normals), faces, material)
