"""The kit as one mesh on bones: every piece that moves has a bone, all hardware stands on bone 0.

`bone_matrices` poses the bones; the drawing turns mesh and matrices into pixels. Where a `Kit` is silent (stands, legs,
pedal frames, throne) the hardware follows from where the pieces are.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit import Kit
from station.motion.piece import KitPiece
from station.motion.pose import LEFT, RIGHT, Pose
from station.render import drums, hardware
from station.render.drums import Detail
from station.render.mesh import Mesh, joined
from station.render.pedals import axle_of, pedal_meshes, pedals_by_foot, raised
from station.render.room import Disc
from station.render.space import Matrix, frame, rotation_at, translation

WORLD = 0
_LUGS = {Piece.SNARE: 10, Piece.FLOOR_TOM_1: 8, Piece.FLOOR_TOM_2: 8}
_RACK_LUGS = 6


@dataclass(frozen=True)
class KitRig:
    """`mesh` in the pose of rest, and the bone of each moving part."""

    kit: Kit
    mesh: Mesh
    piece_bones: dict[Piece, int]
    boards: tuple[int, int]
    beater: int
    sticks: tuple[int, int]
    axle_m: NDArray[np.float64]
    bone_count: int


def build_kit(kit: Kit, detail: Detail) -> KitRig:
    """Meshes of all pieces, their hardware, the throne and the sticks."""
    bones = {piece: 1 + i for i, piece in enumerate(kit.pieces)}
    first = 1 + len(bones)
    boards, beater, sticks = (first, first + 1), first + 2, (first + 3, first + 4)
    axle = axle_of(kit)
    parts = [_piece_mesh(p, detail).moved(_place(p)).on_bone(bones[p.piece]) for p in kit.pieces.values()]
    parts += [hardware.stands(kit, p, detail) for p in kit.pieces.values()]
    parts += pedal_meshes(kit, boards, beater, axle)
    parts.append(hardware.throne(kit.seat_m, detail))
    parts += [drums.stick(drums.STICK_M).on_bone(bone) for bone in sticks]
    return KitRig(kit, joined(parts), bones, boards, beater, sticks, axle, first + 5)


def _place(piece: KitPiece) -> Matrix:
    m = np.eye(4)
    m[:3, :3] = piece.axes.T
    m[:3, 3] = piece.centre
    return m


def _piece_mesh(piece: KitPiece, detail: Detail) -> Mesh:
    if piece.kind == "kick":
        return drums.kick(piece.radius_m, piece.depth_m, detail)
    if piece.kind in ("cymbal", "hihat"):
        return drums.cymbal(piece.radius_m, detail)
    if piece.kind == "block":
        return drums.block(piece.radius_m, piece.depth_m)
    return drums.drum(piece.radius_m, piece.depth_m, _LUGS.get(piece.piece, _RACK_LUGS), detail)


# --- posing -----------------------------------------------------------------------------------------------------------


def bone_matrices(rig: KitRig, pose: Pose | None) -> Matrix:
    """A matrix for every bone of the rig, (bones, 4, 4); without a pose the kit is at rest and the sticks are away."""
    m = np.tile(np.eye(4), (rig.bone_count, 1, 1))
    if pose is None:
        m[list(rig.sticks)] = 0.0
        return m
    for (piece, bone), swing in zip(rig.piece_bones.items(), pose.swing_rad, strict=True):
        part = rig.kit.pieces[piece]
        if swing[0] or swing[1]:
            right, away, _ = part.axes
            m[bone] = rotation_at(part.centre, right, swing[0]) @ rotation_at(part.centre, away, swing[1])
        if part.kind == "hihat":
            m[bone] = translation(part.normal * pose.hat_gap_m) @ m[bone]
    for bone, pedal, angle in zip(rig.boards, pedals_by_foot(rig.kit), pose.footboard_rad, strict=True):
        m[bone] = raised(pedal, angle)
    m[rig.beater] = rotation_at(rig.axle_m, [1, 0, 0], pose.beater_rad)
    for side in (RIGHT, LEFT):
        along = pose.tip_m[side] - pose.butt_m[side]
        m[rig.sticks[side]] = frame(pose.butt_m[side], along, [1, 0, 0])
        m[rig.sticks[side]][:3, 2] *= np.linalg.norm(along) / drums.STICK_M
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
    for pedal in kit.pedals.values():
        heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
        discs += [(*(heel + (toe - heel) * k)[:2].tolist(), 0.02, 0.05) for k in (0.1, 0.5, 0.9)]
    return discs
