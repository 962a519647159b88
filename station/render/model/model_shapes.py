"""The shapes of the model: what the pictures are made of, part by part and material by material.

The figure's skin is made for a face that moves and for fingers that open; in the model both stay as they are in one
pose, so that twenty bones carry it all.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import word
from station.motion.export.glb_file import Glb, Primitive
from station.motion.export.plain_solids import Solid
from station.motion.kinematics.grip import Hold
from station.motion.kinematics.look import Colours
from station.motion.kinematics.pose import Pose
from station.render.figure.bones import BODY_BONES, FINGERS, Bone
from station.render.figure.skeleton import Skeleton
from station.render.figure.skin import INFLUENCES, Skin
from station.render.geometry.materials import Material, shader_table
from station.render.geometry.mesh import Mesh
from station.render.geometry.transforms import Matrix, Vector, translation, unit
from station.render.kit.held_meshes import HELD_BONES, HELD_PARTS
from station.render.kit.instrument_meshes import HOLE_M
from station.render.kit.kit_rig import KitRig
from station.render.model.model_motion import STICK_OF, SWINGING

_FULL = 255
_VARNISHED = 0.5
"""A clear coat makes rough things so much smoother where no coat of its own is drawn (our choice)."""


class Materials:
    """The materials of a scene, each made when it is first asked for; skin, hair and clothes have `colours`."""

    def __init__(self, scene: Glb, colours: Colours) -> None:
        self._scene = scene
        self._looks = shader_table(colours)
        self._made: dict[int, int] = {}

    def of(self, material: int) -> int:
        """The number of a `Material` in the scene."""
        if material not in self._made:
            (*colour, rough), (metal, coat, _, _) = (look[material].tolist() for look in self._looks)
            red, green, blue = colour
            roughness = rough * (1 - _VARNISHED * min(coat, 1.0))
            self._made[material] = self._scene.material(
                Material(material).name.lower(), (red, green, blue), metal, roughness
            )
        return self._made[material]


def rigid_primitives(mesh: Mesh, faces: NDArray[np.uint32], materials: Materials, place: Matrix) -> list[Primitive]:
    """Some faces of a mesh as parts of one material each, carried back from where `place` has them."""
    return [
        Primitive(solid, materials.of(material), mesh.ao[corners])
        for material, corners, solid in _by_material(mesh.moved(np.asarray(np.linalg.inv(place), np.float64)), faces)
    ]


def skin_primitives(skin: Skin, materials: Materials) -> list[Primitive]:
    """A skin that hangs on `BODY_BONES` alone as parts of one material each; joints are the bones' numbers."""
    weights = _in_255ths(skin.weights)
    bones = np.where(weights > 0, skin.bones, 0).astype(np.uint8)
    return [
        Primitive(solid, materials.of(material), skin.ao[corners], bones[corners], weights[corners])
        for material, corners, solid in _by_material(skin, skin.faces)
    ]


def _by_material(shape: Mesh | Skin, faces: NDArray[np.uint32]) -> Iterator[tuple[int, NDArray[np.int64], Solid]]:
    """For each material its number, the corners that its faces have, and the solid that these make."""
    of_face = shape.material[faces[:, 0]]
    for material in np.unique(of_face).tolist():
        corners, triangles = np.unique(faces[of_face == material], return_inverse=True)
        solid = Solid(shape.position[corners], unit(shape.normal[corners]), triangles.reshape(-1, 3))
        yield material, corners.astype(np.int64), solid


def with_still_face(skin: Skin, skeleton: Skeleton, pose: Pose) -> Skin:
    """The skin with face and fingers as they are in a pose, on the bones of `BODY_BONES` alone."""
    on = _carriers()
    now = skeleton.matrices(pose)
    shifts = np.linalg.inv(now[on]) @ now  # of a bone against the one that carries it, in the stance of the skin
    pulled = np.einsum("vk,vkij->vij", skin.weights, shifts[skin.bones])
    position = np.einsum("vij,vj->vi", pulled[:, :3, :3], skin.position) + pulled[:, :3, 3]
    normal = np.einsum("vij,vj->vi", pulled[:, :3, :3], skin.normal)
    bones, weights = _merged(on[skin.bones], skin.weights)
    return replace(skin, position=position, normal=normal, bones=bones, weights=weights)


def _carriers() -> NDArray[np.uint8]:
    """By the number of every bone that of `BODY_BONES` on which it hangs."""
    hands = dict(sorted(FINGERS.items(), key=lambda item: item[1]))
    starts = [*hands.values()]
    digits = [int(hand) for hand in hands for _ in range(starts[1] - starts[0])]
    return np.array([*range(len(BODY_BONES)), *[Bone.HEAD] * (len(Bone) - len(BODY_BONES)), *digits], np.uint8)


def _merged(bones: NDArray[np.uint8], weights: Vector) -> tuple[NDArray[np.uint8], Vector]:
    """The weights (v, 4) of bones that occur twice at a corner added to the first of them."""
    weights = weights.copy()
    for later in range(1, INFLUENCES):
        for first in range(later):
            same = (bones[:, first] == bones[:, later]) & (weights[:, later] > 0)
            weights[same, first] += weights[same, later]
            weights[same, later] = 0.0
    return bones, weights


def _in_255ths(weights: Vector) -> NDArray[np.uint8]:
    """Weights (v, 4) that sum to 1 as whole 255ths that sum to 255: what rounding leaves is the strongest's."""
    whole = np.rint(weights * _FULL).astype(np.int64)
    strongest = whole.argmax(axis=1)
    whole[np.arange(len(whole)), strongest] += _FULL - whole.sum(axis=1)
    return whole.astype(np.uint8)


def faces_of_bones(mesh: Mesh, bones: Sequence[int]) -> NDArray[np.uint32]:
    """The faces (m, 3) of a mesh that hang on some bones."""
    return mesh.faces[np.isin(mesh.bone[mesh.faces[:, 0]], list(bones))]


def resting_shapes(rig: KitRig, held: Sequence[Hold]) -> dict[str, tuple[list[int], Matrix]]:
    """By the names of the nodes that move the rig's bones that make each, and where in the mesh the node stands."""
    turning = ("right_board", "left_board", "slave_board", "beater", "slave_beater")
    shapes = {
        name: ([getattr(rig.pedals, name)], translation(pivot))
        for name, pivot in zip(turning, rig.pedal_rig.pivot, strict=True)
    }
    shapes["hat_rod"] = ([rig.pedals.hat_rod], np.eye(4))
    for piece, bone in rig.piece_bones.items():
        part = rig.kit.pieces[piece]
        if part.kind in SWINGING:
            shapes[word(piece)] = ([bone], translation(part.centre + HOLE_M * part.normal))
    for side, (name, hold) in enumerate(zip(STICK_OF.values(), held, strict=True)):
        bones, _ = HELD_PARTS.get(hold.held.name, ((), 0.0))
        shapes[name] = ([rig.sticks.start + HELD_BONES * side + bone for bone in bones], np.eye(4))
    return shapes
