"""The drummer's body: a stylised hero in a shirt, made of smoothly blended solids in the stance of `skeleton`.

Garments, hands and head come from modules of their own; here they become one table of corners with their bones. Metres;
designed for the median figure and scaled with the stature.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.figure import MEDIAN_STATURE_M, Figure
from station.render.figure.face import face_meshes
from station.render.figure.garments import Garment, bands, body_parts
from station.render.figure.hand_solid import hand_skin
from station.render.figure.skeleton import FINGERS, HEAD_M, Bone, Skeleton
from station.render.geometry.implicit import Array, Field, Surface, surface
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh

_INFLUENCES = 4


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


def build_body(figure: Figure, fineness: float) -> Skin:
    """The skin of `figure`; `fineness` multiplies the cells that its surfaces are cut with (1 is fine, 2 coarse)."""
    skeleton = Skeleton(figure)
    scale = figure.stature_m / MEDIAN_STATURE_M
    parts = body_parts(skeleton, scale)
    whole = [part.field for part in parts]
    skins = [_part_skin(part, fineness * scale, whole) for part in parts]
    skins += [hand_part(skeleton, fineness, side) for side in (Bone.RIGHT_HAND, Bone.LEFT_HAND)]
    segments = max(12, round(32 / fineness))
    for upper in (Bone.RIGHT_UPPER_ARM, Bone.LEFT_UPPER_ARM):
        skins += [_rigid_skin(mesh) for mesh in bands(skeleton, scale, upper, segments)]
    head = skeleton.frames[Bone.HEAD]
    skins += [_rigid_skin(mesh.moved(head)) for mesh in face_meshes(figure.head_m / HEAD_M, fineness)]
    return _joined(skins)


# --- from parts to skin -----------------------------------------------------------------------------------------------


def _part_skin(part: Garment, fineness: float, whole: Sequence[Field]) -> Skin:
    cell = part.cell * fineness
    mesh = surface(part.field, *replace(part, cell=cell).bounds(), cell)
    bones, weights = _strongest(part.weights(mesh.position))
    material = np.full(len(mesh.position), part.material, np.uint8)
    return Skin(mesh.position, mesh.normal, bones, weights, material, _open_sky(mesh, whole), mesh.faces)


def _strongest(weights: Array) -> tuple[NDArray[np.uint8], Array]:
    order = np.argsort(-weights, axis=1)[:, :_INFLUENCES]
    kept = np.take_along_axis(weights, order, axis=1)
    return order.astype(np.uint8), kept / kept.sum(axis=1, keepdims=True)


_AO_STEPS_M = (0.02, 0.05, 0.10, 0.16)


def _open_sky(mesh: Surface, whole: Sequence[Field]) -> Array:
    """How little the body stands in its own way: distance to it along the normal, against the way gone (Evans 2006)."""
    closed = np.zeros(len(mesh.position))
    for i, step in enumerate(_AO_STEPS_M):
        p = mesh.position + step * mesh.normal
        near = np.min([field(p) for field in whole], axis=0)
        closed += 0.5**i * np.clip((step - near) / step, 0, 1)
    return np.asarray(np.clip(1 - 0.62 * closed / sum(0.5**i for i in range(len(_AO_STEPS_M))) * 1.6, 0.15, 1))


def hand_part(skeleton: Skeleton, fineness: float, hand: Bone) -> Skin:
    """The skin of one hand, in the stance of `skeleton`."""
    skin = hand_skin(fineness)
    position, normal, faces = skin.position * skeleton.hand_scale, skin.normal, skin.faces
    if hand is Bone.LEFT_HAND:
        mirror = np.array([-1.0, 1.0, 1.0])
        position, normal, faces = position * mirror, normal * mirror, faces[:, ::-1]
    m, n = skeleton.frames[hand], len(position)
    bones, weights = np.zeros((n, _INFLUENCES), np.uint8), np.zeros((n, _INFLUENCES))
    strongest = np.argsort(-skin.weights, axis=1)
    own = np.where(skin.bones > 0, FINGERS[hand] + skin.bones - 1, hand)
    bones[:, :2] = np.take_along_axis(own, strongest, axis=1)
    weights[:, :2] = np.take_along_axis(skin.weights, strongest, axis=1)
    turn = m[:3, :3].T
    return Skin(
        position @ turn + m[:3, 3], normal @ turn, bones, weights, np.full(n, Material.SKIN, np.uint8), skin.ao, faces
    )


def _rigid_skin(mesh: Mesh) -> Skin:
    n = len(mesh.position)
    bones, weights = np.zeros((n, _INFLUENCES), np.uint8), np.zeros((n, _INFLUENCES))
    bones[:, 0], weights[:, 0] = mesh.bone, 1.0
    return Skin(mesh.position, mesh.normal, bones, weights, mesh.material, mesh.ao, mesh.faces)


def _joined(skins: Sequence[Skin]) -> Skin:
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
