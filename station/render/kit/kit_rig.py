"""The kit as one mesh on bones: every piece that moves has a bone, all hardware stands on bone 0.

`bone_matrices` poses the bones; the drawing turns mesh and matrices into pixels. Where a `Kit` is silent (stands, legs,
pedal frames, throne) the hardware follows from where the pieces are.
"""

from dataclasses import dataclass, replace
from math import cos, sin

import numpy as np

from station.core.pieces import Piece
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, joined
from station.render.geometry.transforms import Matrix, translation
from station.render.kit import hardware, instrument_meshes, pad_meshes
from station.render.kit.held_meshes import HELD_BONES, held_matrices, held_meshes
from station.render.kit.instrument_meshes import Detail
from station.render.kit.pedal_meshes import clutch_foot, pedal_meshes
from station.render.kit.pedal_rig import PedalBones, PedalRig
from station.render.kit.room import Disc

WORLD = 0
_LUGS = {Piece.SNARE: 10, Piece.FLOOR_TOM_1: 8, Piece.FLOOR_TOM_2: 8}
_RACK_LUGS = 6


@dataclass(frozen=True)
class KitRig:
    """`mesh` in the pose of rest, and the bone of each moving part; `sticks` of all that hands may hold.

    The mesh's faces lie bone by bone, `faces_of` tells where; the first `still_faces` hardly ever move: hardware and
    drums, which shake by less than a degree.
    """

    kit: Kit
    mesh: Mesh
    piece_bones: dict[Piece, int]
    pedals: PedalBones
    pedal_rig: PedalRig
    sticks: range
    bone_count: int
    faces_of: dict[int, slice]
    still_faces: int


def kit_mesh(kit: Kit, detail: Detail) -> Mesh:
    """All pieces, their hardware, the throne and the sticks; the rest of the rig follows from it at once."""
    bones = _bones(kit)
    shell = _SHELLS[kit.finish]
    parts = [_piece_mesh(p, detail, shell).moved(_place(p)).on_bone(bones.of[p.piece]) for p in kit.pieces.values()]
    parts += hardware.hardware(kit, detail)
    parts += pedal_meshes(kit, bones.pedals)
    if (pulled := kit.pulled_hat) is not None:
        parts.append(clutch_foot(pulled).on_bone(bones.of[pulled.piece]))
    parts += held_meshes(bones.sticks.start, detail.segments)
    return _bone_by_bone(joined(parts), bones.still)


def rig_of(kit: Kit, mesh: Mesh) -> KitRig:
    """The rig of what `kit_mesh` has made of `kit`."""
    bones, faces_of = _bones(kit), _faces_of(mesh)
    still_faces = max(faces_of[bone].stop for bone in bones.still)
    return KitRig(
        kit, mesh, bones.of, bones.pedals, PedalRig.of(kit), bones.sticks, bones.sticks.stop, faces_of, still_faces
    )


@dataclass(frozen=True, slots=True)
class _Bones:
    """The numbers of a kit's bones: `of` its pieces, and the `still` ones, whose faces lie first."""

    of: dict[Piece, int]
    pedals: PedalBones
    sticks: range
    still: list[int]


def _bones(kit: Kit) -> _Bones:
    of = {piece: 1 + i for i, piece in enumerate(kit.pieces)}
    first = 1 + len(of)
    still = [WORLD, *(of[p.piece] for p in kit.pieces.values() if p.kind not in _SWINGING)]
    pedals = PedalBones.of(first)
    held = pedals[-1] + 1
    return _Bones(of, pedals, range(held, held + 2 * HELD_BONES), still)


_SWINGING = ("cymbal", "hihat")


def _bone_by_bone(mesh: Mesh, first: list[int]) -> Mesh:
    """The mesh with the faces of each bone together, those of the bones `first` before all others.

    Among a bone's faces those with near corners are neighbours: a software driver shades fewer corners twice.
    """
    bone = mesh.bone[mesh.faces[:, 0]]
    return replace(mesh, faces=mesh.faces[np.lexsort((mesh.faces.min(axis=1), bone, ~np.isin(bone, first)))])


def _faces_of(mesh: Mesh) -> dict[int, slice]:
    """Where the faces of each bone lie, which are together."""
    bones, starts, counts = np.unique(mesh.bone[mesh.faces[:, 0]], return_index=True, return_counts=True)
    rows = zip(bones.tolist(), starts.tolist(), counts.tolist(), strict=True)
    return {b: slice(start, start + count) for b, start, count in rows}


def _place(piece: KitPiece) -> Matrix:
    m = np.eye(4)
    m[:3, :3] = piece.axes.T
    m[:3, 3] = piece.centre
    return m


_SHELLS = {"teal": Material.SHELL, "maple": Material.MAPLE, "black": Material.LACQUER}


def _piece_mesh(piece: KitPiece, detail: Detail, shell: Material) -> Mesh:
    radius, depth = piece.radius_m, piece.depth_m
    if piece.kind == "block":
        return instrument_meshes.block(radius, depth)
    if piece.kind in ("cymbal", "hihat"):
        if piece.electronic:
            return pad_meshes.rubber_cymbal(radius, detail)
        return instrument_meshes.cymbal(radius, detail, is_china=piece.piece is Piece.CHINA)
    if piece.electronic:
        return (pad_meshes.kick_pad if piece.kind == "kick" else pad_meshes.pad)(radius, depth, detail)
    if piece.kind == "kick":
        return instrument_meshes.kick(radius, depth, detail, shell)
    return instrument_meshes.drum(radius, depth, _LUGS.get(piece.piece, _RACK_LUGS), detail, shell)


# --- posing -----------------------------------------------------------------------------------------------------------


def bone_matrices(rig: KitRig, pose: Pose | None) -> Matrix:
    """A matrix for every bone of the rig, (bones, 4, 4); without a pose the kit is at rest and the sticks are away."""
    m = np.tile(np.eye(4), (rig.bone_count, 1, 1))
    if pose is None:
        m[rig.sticks] = 0.0
        return m
    for (piece, bone), swing in zip(rig.piece_bones.items(), pose.swing_rad, strict=True):
        part = rig.kit.pieces[piece]
        if swing[0] or swing[1]:
            m[bone] = _tipped(part, float(swing[0]), float(swing[1]))
        if part is rig.kit.pulled_hat:
            m[bone] = translation(part.normal * pose.hat_gap_m) @ m[bone]
    m[list(rig.pedals)] = rig.pedal_rig.matrices(pose)
    m[rig.sticks] = held_matrices(pose, rig.kit)
    return m


def _tipped(piece: KitPiece, back_rad: float, side_rad: float) -> Matrix:
    """A turn about the piece's away axis, then about its right axis, round a cymbal's hole or a drum's centre."""
    (ca, sa), (cb, sb) = ((cos(angle), sin(angle)) for angle in (back_rad, side_rad))
    own = np.array([[cb, 0.0, sb], [sa * sb, ca, -sa * cb], [-ca * sb, sa, ca * cb]])
    m = np.eye(4)
    m[:3, :3] = piece.axes.T @ own @ piece.axes
    at = piece.centre + instrument_meshes.HOLE_M * piece.normal if piece.kind in _SWINGING else piece.centre
    m[:3, 3] = at - m[:3, :3] @ at
    return m


def floor_discs(kit: Kit) -> list[Disc]:
    """What shades the floor, for `room.floor_picture`."""
    discs: list[Disc] = [(*kit.seat_m[:2], kit.seat_m[2] - 0.08, 0.22)]
    for piece in kit.pieces.values():
        x, y, z = piece.centre_m
        if piece.kind == "kick":
            discs += [(x, y + piece.depth_m * k, 0.06, piece.radius_m * 0.7) for k in (0.2, 0.5, 0.8)]
        elif piece.kind in ("cymbal", "hihat"):
            discs += [(x, y, z, piece.radius_m * 0.8), (x, y, 0.02, 0.06)]
        else:
            discs.append((x, y, max(z - piece.depth_m, 0.05), piece.radius_m))
    for pedal in (*kit.pedals.values(), *([kit.slave] if kit.slave else [])):
        heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
        discs += [(*(heel + (toe - heel) * k)[:2].tolist(), 0.02, 0.05) for k in (0.1, 0.5, 0.9)]
    return discs
