"""Solid shapes as distance fields, blended smoothly, and the surface that they bound as triangles.

A field maps points (n, 3) to their signed distance (n,), negative inside. Blends are Quilez's polynomial smooth
minimum. The surface is cut by naive surface nets (Gibson 1998): one corner in each cell that the surface crosses, at
the middle of its crossings, then drawn onto the surface by a Newton step.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.render.geometry.transforms import unit

Array = NDArray[np.float64]
Field = Callable[[Array], Array]


def _lengths(v: Array) -> Array:
    """Of many vectors (n, 3); half the time that numpy's norm takes."""
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", v, v)), np.float64)


def _share(x: Array) -> Array:
    """What is below 0 is 0, what is above 1 is 1; in a third of the time that numpy's clip takes for few numbers."""
    return np.asarray(np.minimum(np.maximum(x, 0.0), 1.0), np.float64)


@dataclass(frozen=True, eq=False)
class Cone:
    """A round cone: a ball rolled from `start` to `end` whose radius goes from `radii[0]` to `radii[1]`."""

    start: Array
    end: Array
    radii: tuple[float, float]

    def __call__(self, p: Array) -> Array:
        """Distance to the rolled ball, its radius taken at the nearest point of the axis."""
        axis = self.end - self.start
        t = _share((p - self.start) @ axis / max(float(axis @ axis), 1e-12))
        gap = _lengths(p - self.start - t[:, None] * axis)
        return np.asarray(gap - (self.radii[0] + t * (self.radii[1] - self.radii[0])), np.float64)


@dataclass(frozen=True, eq=False)
class Egg:
    """An ellipsoid along the axes: distance to first order."""

    centre: Array
    half: Array

    def __call__(self, p: Array) -> Array:
        """Distance, exact on the surface and along the axes."""
        q = (p - self.centre) / self.half
        k0, k1 = _lengths(q), _lengths(q / self.half)
        return np.asarray(k0 * (k0 - 1) / np.maximum(k1, 1e-9), np.float64)


@dataclass(frozen=True, eq=False)
class Plane:
    """Everything behind a plane."""

    point: Array
    normal: Array

    def __call__(self, p: Array) -> Array:
        """Distance in front of the plane."""
        return np.asarray((p - self.point) @ self.normal, np.float64)


def cone(start: ArrayLike, end: ArrayLike, r0: float, r1: float) -> Cone:
    """A round cone from points of any kind."""
    return Cone(np.asarray(start, np.float64), np.asarray(end, np.float64), (r0, r1))


def egg(centre: ArrayLike, half: ArrayLike) -> Egg:
    """An ellipsoid from points of any kind."""
    return Egg(np.asarray(centre, np.float64), np.asarray(half, np.float64))


def plane(point: ArrayLike, normal: ArrayLike) -> Plane:
    """A half space from points of any kind; `normal` of any length."""
    return Plane(np.asarray(point, np.float64), unit(normal))


def smooth_min(a: Array, b: Array, blend: float) -> Array:
    """The smaller of two, rounded over a width of `blend`."""
    h = _share(0.5 + 0.5 / blend * (b - a))
    return np.asarray(b + (a - b) * h - blend * h * (1 - h), np.float64)


def united(fields: Sequence[Field], blend: float) -> Field:
    """All fields in one, their joints rounded."""

    def field(p: Array) -> Array:
        total = fields[0](p)
        for other in fields[1:]:
            total = smooth_min(total, other(p), blend)
        return total

    return field


def cut(field: Field, away: Field, blend: float = 0.004) -> Field:
    """`field` where it is behind `away`, the edge rounded."""
    return lambda p: -smooth_min(-field(p), -away(p), blend)


def without(field: Field, hole: Field, blend: float = 0.004) -> Field:
    """`field` less `hole`, the edge rounded."""
    return lambda p: -smooth_min(-field(p), hole(p), blend)


@dataclass(frozen=True, eq=False)
class Surface:
    """`position`, `normal` (n, 3), `faces` (m, 3) counter-clockwise from outside."""

    position: Array
    normal: Array
    faces: NDArray[np.uint32]


_AROUND = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], np.float64)
"""A tetrahedron's corners: from four values there follow slope and value, with no more error than from six."""


def slope_and_value(field: Field, p: Array, step: float = 5e-4) -> tuple[Array, Array]:
    """The field's slope (n, 3) and, to second order, its value (n,)."""
    values = field((p + step * _AROUND[:, None]).reshape(-1, 3)).reshape(4, -1)
    return np.asarray(values.T @ _AROUND / (4 * step)), np.asarray(values.mean(axis=0))


_CORNERS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if np.abs(_CORNERS[a] - _CORNERS[b]).sum() == 1]


def surface(field: Field, low: ArrayLike, high: ArrayLike, cell: float) -> Surface:
    """The zero surface of `field` inside the box `low` … `high`, in cells of size `cell` metres."""
    low_, high_ = np.asarray(low, np.float64), np.asarray(high, np.float64)
    counts = np.ceil((high_ - low_) / cell).astype(int) + 1
    axes = [low_[k] + cell * np.arange(counts[k]) for k in range(3)]
    values = _sampled(field, axes, cell)
    corners = np.stack([values[_shifted(c, counts)] for c in _CORNERS])
    crossed = (corners < 0).any(axis=0) & (corners >= 0).any(axis=0)
    index = np.full(crossed.shape, -1, np.int64)
    index[crossed] = np.arange(np.count_nonzero(crossed))
    position = low_ + cell * (np.argwhere(crossed) + _crossing_mean(corners[:, crossed]))
    for _ in range(2):
        slope, value = slope_and_value(field, position)
        length_2 = np.maximum(np.sum(slope**2, axis=1), 1e-6)
        step = np.clip(value / np.sqrt(length_2), -cell, cell) / np.sqrt(length_2)
        position = position - step[:, None] * slope
    return Surface(position, unit(slope_and_value(field, position)[0]), _quads(values, index))


_BLOCK = 4
"""Cells along the edge of the blocks that are looked at whole first."""
_STEEPEST = 1.6
"""How much faster than the way gone a field here may change: waves and eggs are no exact distances (our choice)."""


def _sampled(field: Field, axes: Sequence[Array], cell: float) -> Array:
    """The field on a grid; blocks that lie far from its surface have the value of their middle throughout."""
    counts = [len(axis) for axis in axes]
    blocks = [-(-count // _BLOCK) for count in counts]
    middles = [
        axis[0] + cell * (_BLOCK * np.arange(n) + (_BLOCK - 1) / 2) for axis, n in zip(axes, blocks, strict=True)
    ]
    rough = field(np.stack(np.meshgrid(*middles, indexing="ij"), axis=-1).reshape(-1, 3))
    whole = np.broadcast_to(
        rough.reshape(blocks[0], 1, blocks[1], 1, blocks[2], 1), [s for n in blocks for s in (n, _BLOCK)]
    )
    values = whole.reshape([n * _BLOCK for n in blocks])[: counts[0], : counts[1], : counts[2]].copy()
    reach = _STEEPEST * cell * np.sqrt(3) * (_BLOCK + 1) / 2
    near = np.nonzero(np.abs(values) < reach)
    values[near] = field(np.stack([axis[at] for axis, at in zip(axes, near, strict=True)], axis=1))
    return values


def clipped(whole: Surface, away: Field) -> Surface:
    """The part of a surface that lies behind `away`, its edge cut exactly across the triangles."""
    side = away(whole.position)
    keeps = side < 0
    count = keeps[whole.faces].sum(axis=1)
    position, normal, faces = [whole.position], [whole.normal], [whole.faces[count == 3]]
    first = len(whole.position)
    for kept in (1, 2):
        cut_faces = whole.faces[count == kept].astype(np.int64)
        alone = keeps[cut_faces] if kept == 1 else ~keeps[cut_faces]
        a, b, c = (np.take_along_axis(cut_faces, (alone.argmax(axis=1)[:, None] + i) % 3, 1)[:, 0] for i in range(3))
        n = len(a)
        for other in (b, c):
            t = (side[a] / (side[a] - side[other]))[:, None]
            position.append(whole.position[a] + t * (whole.position[other] - whole.position[a]))
            normal.append(unit(whole.normal[a] + t * (whole.normal[other] - whole.normal[a])))
        on_b, on_c = first + np.arange(n), first + n + np.arange(n)
        first += 2 * n
        cut_in = [(a, on_b, on_c)] if kept == 1 else [(on_b, b, c), (on_b, c, on_c)]
        faces += [np.stack(corners, axis=1).astype(np.uint32) for corners in cut_in]
    return _used(Surface(np.concatenate(position), np.concatenate(normal), np.concatenate(faces)))


def _used(whole: Surface) -> Surface:
    """A surface without the corners that no face has."""
    kept, faces = np.unique(whole.faces, return_inverse=True)
    return Surface(whole.position[kept], whole.normal[kept], faces.reshape(-1, 3).astype(np.uint32))


def _shifted(corner: NDArray[np.int64], counts: NDArray[np.int64]) -> tuple[slice, ...]:
    return tuple(slice(int(c), int(n) - 1 + int(c)) for c, n in zip(corner, counts, strict=True))


def _crossing_mean(corners: Array) -> Array:
    """The mean place (cells, 3) in the unit cell of where its edges cross zero; `corners` (8, cells)."""
    total, count = np.zeros((corners.shape[1], 3)), np.zeros(corners.shape[1])
    for a, b in _EDGES:
        va, vb = corners[a], corners[b]
        crosses = (va < 0) != (vb < 0)
        t = np.where(crosses, va / np.where(crosses, va - vb, 1.0), 0.0)
        total += crosses[:, None] * (_CORNERS[a] + t[:, None] * (_CORNERS[b] - _CORNERS[a]))
        count += crosses
    return total / count[:, None]


def _quads(values: Array, index: NDArray[np.int64]) -> NDArray[np.uint32]:
    """Two triangles round every grid edge that the surface crosses, facing outward."""
    inside = values < 0
    faces: list[NDArray[np.int64]] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        first = np.moveaxis(inside, (axis, u, v), (0, 1, 2))
        cells = np.moveaxis(index, (axis, u, v), (0, 1, 2))
        starts, ends = first[:-1, 1:-1, 1:-1], first[1:, 1:-1, 1:-1]
        for outward in (True, False):
            i, j, k = np.nonzero(starts & ~ends if outward else ~starts & ends)
            ring = [cells[i, j, k], cells[i, j + 1, k], cells[i, j + 1, k + 1], cells[i, j, k + 1]]
            quad = np.stack(ring if outward else ring[::-1], axis=1)
            faces += [quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]]
    return np.concatenate(faces).astype(np.uint32)
