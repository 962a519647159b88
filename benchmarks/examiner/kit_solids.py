"""The examiner's kit: drums are closed cylinders, cymbals thin discs, stands upright tubes; from the kit's file alone.

Cymbals are taken at rest and flat: a crash that swings away from its stroke is not followed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from examiner.body import Capsule
from station.core.pieces import word
from station.motion.kit.kit import Kit

Array = NDArray[np.float64]
_EVERY_M = 0.012
"""So far apart are the points of a stick or arm that are looked at."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A disc or cylinder: its top's `centre` and `normal`, `depth_m` below it."""

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
        """From the surface, (…,) metres, negative inside; `point` (…, 3)."""
        away = point - self.centre
        height = away @ self.normal
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
        reach = np.hypot(self.radius_m, self.depth_m) + max(part.a_m, part.b_m)
        near = gap < reach
        if near.any():
            deep[near] = self._depth(part.at(near))
        return deep

    def _depth(self, part: Capsule) -> Array:
        count = 2 + int(np.linalg.norm(part.b[0] - part.a[0]) / _EVERY_M)
        shares = np.linspace(0, 1, count)
        points = part.a[:, None] + shares[:, None] * (part.b - part.a)[:, None]
        radii = part.a_m + shares * (part.b_m - part.a_m)
        deep = np.asarray((radii - self.distance(points)).max(axis=1))
        return np.maximum(deep, self._through(part)) if self.is_thin else deep

    def _through(self, part: Capsule) -> Array:
        """How far the axis of `part` stands through a disc: the least way out of it, 0 where it does not."""
        a, b = (part.a - self.centre) @ self.normal, (part.b - self.centre) @ self.normal
        crosses = a * b < 0
        share = np.where(crosses, a / np.where(crosses, a - b, 1.0), 0.0)
        point = part.a + share[:, None] * (part.b - part.a)
        inside = self.radius_m - np.linalg.norm(point - self.centre, axis=1)
        return np.where(crosses & (inside > 0), np.minimum(inside, np.minimum(abs(a), abs(b))), 0.0)


def solids(kit: Kit) -> list[Solid]:
    """Every piece of the kit."""
    return [
        Solid(word(name), piece.kind, piece.centre, piece.normal, piece.radius_m, _depth_m(piece.kind, piece.depth_m))
        for name, piece in kit.pieces.items()
    ]


def _depth_m(kind: str, depth_m: float) -> float:
    """A cymbal's metal is 1–2 mm thick; a hi-hat's lower cymbal is 3 cm lower."""
    return {"cymbal": 0.002, "hihat": 0.03}.get(kind, depth_m)


def stands(kit: Kit) -> list[Capsule]:
    """The upright tubes under cymbals, 25 mm thick, from 5 cm under the metal to the floor; at one instant."""
    tubes = []
    for name, piece in kit.pieces.items():
        if piece.kind in ("cymbal", "hihat"):
            x, y, z = piece.centre_m
            tubes.append(
                Capsule(f"{word(name)} stand", np.array([[x, y, z - 0.05]]), np.array([[x, y, 0.0]]), 0.0125, 0.0125)
            )
    return tubes
