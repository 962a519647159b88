"""The examiner's kit: drums are closed cylinders, cymbals thin discs; from the kit's file alone.

Cymbals are flat; they swing as `Pose.swing_rad` says.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.body import Capsule
from station.core.pieces import word
from station.motion.kit.kit import Kit

Array = NDArray[np.float64]
_EVERY_M = 0.012
"""So far apart are the points of a stick or arm that are looked at."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A disc or cylinder: its top's `centre` (3,) and `normal`, (3,) or (n, 3) as it swings, `depth_m` below it."""

    name: str
    kind: str
    centre: Array
    normal: Array
    radius_m: float
    depth_m: float

    @property
    def is_thin(self) -> bool:
        """A cymbal: one goes through it or does not."""
        return self.kind in ("cymbal", "hihat")

    def distance(self, point: Array) -> Array:
        """From the surface at rest, (…,) metres, negative inside; `point` (…, 3)."""
        return self._distance(point, self.normal)

    def _distance(self, point: Array, normal: Array) -> Array:
        away = point - self.centre
        height = (away * normal).sum(-1)
        radial = np.sqrt(np.maximum((away * away).sum(-1) - height * height, 0.0)) - self.radius_m
        axial = np.maximum(height, -height - self.depth_m)
        outside = np.hypot(np.maximum(radial, 0), np.maximum(axial, 0))
        return np.asarray(outside + np.minimum(np.maximum(radial, axial), 0.0))

    def depth_of(self, part: Capsule) -> Array:
        """How deep `part` is in it at each instant, (n,), −1 where it is far away."""
        deep = np.full(len(part.a), -1.0)
        way = part.b - part.a
        share = np.clip(((self.centre - part.a) * way).sum(1) / np.maximum((way * way).sum(1), 1e-12), 0, 1)
        gap = np.linalg.norm(part.a + share[:, None] * way - self.centre, axis=1)
        near = gap < np.hypot(self.radius_m, self.depth_m) + max(part.a_m, part.b_m)
        if near.any():
            deep[near] = self._depth(part.at(near), np.broadcast_to(self.normal, part.a.shape)[near])
        return deep

    def _depth(self, part: Capsule, normal: Array) -> Array:
        count = 2 + int(np.linalg.norm(part.b[0] - part.a[0]) / _EVERY_M)
        shares = np.linspace(0, 1, count)
        points = part.a[:, None] + shares[:, None] * (part.b - part.a)[:, None]
        radii = part.a_m + shares * (part.b_m - part.a_m)
        deep = np.asarray((radii - self._distance(points, normal[:, None])).max(axis=1))
        return np.maximum(deep, self._through(part, normal)) if self.is_thin else deep

    def _through(self, part: Capsule, normal: Array) -> Array:
        """How far the axis of `part` stands through a disc: the least way out of it, 0 where it does not."""
        a, b = ((part.a - self.centre) * normal).sum(1), ((part.b - self.centre) * normal).sum(1)
        crosses = a * b < 0
        share = np.where(crosses, a / np.where(crosses, a - b, 1.0), 0.0)
        point = part.a + share[:, None] * (part.b - part.a)
        inside = self.radius_m - np.linalg.norm(point - self.centre, axis=1)
        return np.where(crosses & (inside > 0), np.minimum(inside, np.minimum(abs(a), abs(b))), 0.0)


def swinging(kit: Kit, solid: Solid, index: int, swing_rad: Array) -> Solid:
    """`solid`, piece `index` of the kit, as it has tipped about its right and away axes, `swing_rad` (n, 2)."""
    right, away, normal = list(kit.pieces.values())[index].axes
    tipped = normal + swing_rad[:, :1] * np.cross(right, normal) + swing_rad[:, 1:] * np.cross(away, normal)
    return replace(solid, normal=tipped / np.linalg.norm(tipped, axis=1, keepdims=True))


def solids(kit: Kit) -> list[Solid]:
    """Every piece of the kit."""
    return [
        Solid(word(name), piece.kind, piece.centre, piece.normal, piece.radius_m, _depth_m(piece.kind, piece.depth_m))
        for name, piece in kit.pieces.items()
    ]


def _depth_m(kind: str, depth_m: float) -> float:
    """A cymbal's metal is 1–2 mm thick; a hi-hat's lower cymbal is 3 cm lower."""
    return {"cymbal": 0.002, "hihat": 0.03}.get(kind, depth_m)


def hat_stand(kit: Kit) -> Capsule | None:
    """The upright tube of a hi-hat, 25 mm thick, from 5 cm under the metal to a hand over the floor; at one instant.

    Cymbals' stands may have booms, of which a kit's file says nothing.
    """
    hats = [piece for piece in kit.pieces.values() if piece.kind == "hihat"]
    if not hats:
        return None
    x, y, z = hats[0].centre_m
    return Capsule("hi-hat stand", np.array([[x, y, z - 0.05]]), np.array([[x, y, 0.15]]), 0.0125, 0.0125)
