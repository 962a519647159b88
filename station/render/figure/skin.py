"""The figure's surface as one table of corners, each with the bones that pull it; what pieces of it are joined from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.render.figure.bones import Bone
from station.render.geometry.implicit import Array, Surface
from station.render.geometry.mesh import Mesh
from station.render.geometry.transforms import Matrix

INFLUENCES = 4
"""As many bones as pull one corner."""
Pull = Mapping[Bone, Array | float]
"""How strongly bones pull each of some corners, (n,); what is left of 1 is the first bone's."""


@dataclass(frozen=True, eq=False)
class Skin:
    """The figure's surface: `position`, `normal` (n, 3), `bones`, `weights` (n, 4), `material`, `ao` (n,)."""

    position: Array
    normal: Array
    bones: NDArray[np.uint8]
    weights: Array
    material: NDArray[np.uint8]
    ao: Array
    faces: NDArray[np.uint32]

    def moved(self, matrix: Matrix) -> "Skin":
        """The skin carried by a rigid motion."""
        turn = matrix[:3, :3].T
        return replace(self, position=self.position @ turn + matrix[:3, 3], normal=self.normal @ turn)

    def scaled(self, factor: float) -> "Skin":
        """The skin so many times as large."""
        return replace(self, position=self.position * factor)


def skin_of(mesh: Mesh | Surface, weights: Array, material: int | None = None, ao: Array | float = 1.0) -> Skin:
    """A skin of a mesh whose corners hang on the bones by `weights` (n, bones), rows summing to 1."""
    bones, kept = _strongest(weights)
    own = mesh.material if isinstance(mesh, Mesh) and material is None else np.full(len(bones), material, np.uint8)
    sky = mesh.ao * ao if isinstance(mesh, Mesh) else np.broadcast_to(np.float64(ao), len(bones)) * 1.0
    return Skin(mesh.position, mesh.normal, bones, kept, own, sky, mesh.faces)


def rigid_skin(mesh: Mesh) -> Skin:
    """A skin of a mesh that hangs on one bone, its own."""
    return skin_of(mesh, np.eye(len(Bone))[mesh.bone])


def hung(on: Bone, count: int, pull: Pull | None = None) -> Array:
    """Weights (count, bones): as `pull` says, and what is left of 1 on the bone `on`."""
    weights = np.zeros((count, len(Bone)))
    for bone, share in (pull or {}).items():
        weights[:, bone] += share
    total = weights.sum(axis=1, keepdims=True)
    weights /= np.maximum(total, 1.0)
    weights[:, on] += 1 - weights.sum(axis=1)
    return weights


def _strongest(weights: Array) -> tuple[NDArray[np.uint8], Array]:
    order = np.argsort(-weights, axis=1)[:, :INFLUENCES]
    kept = np.take_along_axis(weights, order, axis=1)
    return order.astype(np.uint8), kept / kept.sum(axis=1, keepdims=True)


def joined_skins(skins: Sequence[Skin]) -> Skin:
    """One skin; faces with near corners are neighbours, for then a software driver shades fewer corners twice."""
    starts = np.cumsum([0] + [len(s.position) for s in skins])
    faces = np.concatenate([s.faces + np.uint32(a) for s, a in zip(skins, starts, strict=False)])
    return Skin(
        np.concatenate([s.position for s in skins]),
        np.concatenate([s.normal for s in skins]),
        np.concatenate([s.bones for s in skins]),
        np.concatenate([s.weights for s in skins]),
        np.concatenate([s.material for s in skins]),
        np.concatenate([s.ao for s in skins]),
        faces[np.argsort(faces.min(axis=1), kind="stable")],
    )
