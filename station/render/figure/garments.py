"""Garments and stretches of skin as smoothly blended solids on bones: how they are shaped, hung, creased and hemmed.

Metres in the stance of `skeleton`. A corner of the skin follows the bones whose solids are near it, by a soft minimum
of their distances, so that weights and shape come from one description; round the trunk it follows waist and chest by
its height, so that a shirt twists over its whole length.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from station.render.figure.bones import Bone
from station.render.figure.skin import Skin, skin_of
from station.render.geometry.implicit import Array, Cone, Egg, Field, Surface, clipped, surface, united
from station.render.geometry.materials import Material
from station.render.geometry.mesh import grid_mesh, tube
from station.render.geometry.transforms import frame, unit

Solid = Cone | Egg

_SOFTNESS_M = 0.022
"""How far beyond the nearest solid another bone still pulls the skin (our choice: a third of an arm's width)."""
_INSIDE_SKY = 0.35
"""How dark it is inside a sleeve (our choice)."""
_CREASED_CELL_M, _SMOOTH_CELL_M = 0.016, 0.030
"""In cells up to the first creases are as deep as designed; in cells from the second there are none."""


@dataclass(frozen=True, slots=True)
class Crease:
    """Folds round a point: waves across `axis`, `wave_m` apart, `depth_m` deep, within about `reach_m` of `at`."""

    at: Array
    axis: Array
    reach_m: float = 0.06
    wave_m: float = 0.050
    depth_m: float = 0.0030

    def __call__(self, p: Array) -> Array:
        """How far the folds stand in at each point."""
        away = p - self.at
        near = np.exp(-np.einsum("ij,ij->i", away, away) / (2 * self.reach_m**2))
        bent = 0.9 * np.sin((away @ np.roll(self.axis, 1)) / (0.9 * self.wave_m))
        return np.asarray(self.depth_m * near * np.sin(2 * np.pi * (away @ self.axis) / self.wave_m + bent), np.float64)


@dataclass(frozen=True, slots=True)
class End:
    """Where a garment ends: at the plane through `at` across `way`, the way out, no farther than `reach_m` from it."""

    at: Array
    way: Array
    reach_m: float = 1.0

    def __call__(self, p: Array) -> Array:
        """How far beyond the end each point lies."""
        away = p - self.at
        far = np.sqrt(np.einsum("ij,ij->i", away, away))
        return np.asarray(np.minimum(away @ unit(self.way), self.reach_m - far), np.float64)


@dataclass(frozen=True, eq=False)
class Garment:
    """One garment or stretch of skin: its solids by bone, how they join, the cell it is cut with.

    What lies in `holes`, where their fields are positive, is cut out of its surface. `spine`: from which height on it
    follows the chest, and from which on the chest alone.
    """

    material: Material
    solids: Sequence[tuple[Bone, Solid]]
    blend: float
    cell: float
    holes: tuple[Field, ...] = ()
    creases: tuple[Crease, ...] = ()
    softness: float = _SOFTNESS_M
    spine: tuple[float, float] | None = None

    @cached_property
    def whole(self) -> Field:
        """The shape without folds and holes."""
        return united([s for _, s in self.solids], self.blend)

    def surface(self, cell: float) -> Surface:
        """The cloth, in cells of this size."""
        mesh = surface(self._creased(cell), *self.bounds(cell), cell)
        return clipped(mesh, lambda p: np.max([hole(p) for hole in self.holes], axis=0)) if self.holes else mesh

    def _creased(self, cell: float) -> Field:
        """The shape with its folds, as far as cells of this size show them."""
        share = float(np.clip((_SMOOTH_CELL_M - cell) / (_SMOOTH_CELL_M - _CREASED_CELL_M), 0, 1))
        if share == 0.0 or not self.creases:
            return self.whole
        whole, creases = self.whole, self.creases
        return lambda p: np.asarray(whole(p) + share * sum(crease(p) for crease in creases), np.float64)

    def bounds(self, cell: float) -> tuple[Array, Array]:
        """A box that holds every solid and its rounding."""
        lows, highs = zip(*(_extent(s) for _, s in self.solids), strict=True)
        margin = 0.4 * self.blend + 2.5 * cell
        return np.min(lows, axis=0) - margin, np.max(highs, axis=0) + margin

    def weights(self, p: Array) -> Array:
        """How strongly each bone pulls each point, (n, bones), rows summing to 1."""
        distance = np.full((len(p), len(Bone)), np.inf)
        for bone, solid in self.solids:
            distance[:, bone] = np.minimum(distance[:, bone], solid(p))
        pull = np.exp(-(distance - distance.min(axis=1, keepdims=True)) / self.softness)
        pull /= pull.sum(axis=1, keepdims=True)
        if self.spine is not None:
            low, high = self.spine
            t = np.clip((p[:, 2] - low) / (high - low), 0, 1)
            trunk = pull[:, Bone.WAIST] + pull[:, Bone.CHEST]
            pull[:, Bone.CHEST] = trunk * t * t * (3 - 2 * t)
            pull[:, Bone.WAIST] = trunk - pull[:, Bone.CHEST]
        return np.asarray(pull, np.float64)

    def hem(self, end: End, radius: float, fineness: float, material: Material | None = None) -> list[Skin]:
        """A rounded edge where the garment ends, and what closes it."""
        rim = self.rim(end.at, end.way, max(10, round(30 / fineness)))
        lid = grid_mesh(np.stack([rim, end.at + 0.02 * (rim - end.at)]), self.material)
        edge = self.piping(rim, radius, fineness, self.material if material is None else material)
        return [edge, skin_of(lid, self.weights(lid.position), ao=_INSIDE_SKY)]

    def piping(self, rim: Array, radius: float, fineness: float, material: Material) -> Skin:
        """A rounded edge along a closed line (k, 3) whose last point is its first."""
        overlapped = np.concatenate([rim[-2:-1], rim, rim[1:2]])  # so that no seam gapes
        mesh = tube(overlapped, radius, material, max(5, round(8 / fineness)))
        return skin_of(mesh, self.weights(mesh.position))

    def rim(self, at: ArrayLike, way: ArrayLike, count: int, most: float = 0.30) -> Array:
        """Where the plane through `at` across `way` leaves the garment, (count + 1, 3), the first point again last."""
        axes = frame(at, way, [1.0, 0.0, 0.0] if abs(np.asarray(way)[0]) < 0.8 else [0.0, 1.0, 0.0])
        a = np.linspace(0, 2 * np.pi, count + 1)
        rays = np.cos(a)[:, None] * axes[:3, 0] + np.sin(a)[:, None] * axes[:3, 1]
        steps = np.linspace(0.0, most, 61)
        along = (axes[:3, 3] + steps[:, None, None] * rays).reshape(-1, 3)
        outside = self.whole(along).reshape(len(steps), -1) > 0
        first = np.where(outside.any(axis=0), outside.argmax(axis=0), len(steps) - 1)
        near, far = steps[np.maximum(first - 1, 0)], steps[first]
        for _ in range(10):
            middle = (near + far) / 2
            inside = self.whole(axes[:3, 3] + middle[:, None] * rays) < 0
            near, far = np.where(inside, middle, near), np.where(inside, far, middle)
        return np.asarray(axes[:3, 3] + near[:, None] * rays, np.float64)


def _extent(solid: Solid) -> tuple[Array, Array]:
    if isinstance(solid, Egg):
        return solid.centre - solid.half, solid.centre + solid.half
    reach = max(solid.radii)
    return np.minimum(solid.start, solid.end) - reach, np.maximum(solid.start, solid.end) + reach
