"""The kit as one mesh on bones: every piece that moves has a bone, all hardware stands on bone 0.

`bone_matrices` poses the bones; the drawing turns mesh and matrices into pixels. Where a `Kit` is silent (stands, legs,
pedal frames, throne) the hardware follows from where the pieces are.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit import Kit, Pedal
from station.motion.piece import KitPiece
from station.motion.pose import LEFT, RIGHT, Pose
from station.render import drums
from station.render.drums import Detail
from station.render.materials import Material
from station.render.mesh import Mesh, ball, box, joined, lathe, rod, tube
from station.render.room import Disc
from station.render.space import Matrix, frame, rotation, rotation_at, translation, unit

WORLD = 0
_LUGS = {Piece.SNARE: 10, Piece.FLOOR_TOM_1: 8, Piece.FLOOR_TOM_2: 8}
_RACK_LUGS = 6
_FLOOR_TOMS = frozenset({Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2})
_POLE_M = 0.0125
_BEATER_LENGTH_M = 0.20
"""From the pedal's axle to the middle of the beater; common pedals set it to 19–22 cm."""
_BEATER_HALF_M = 0.016
"""Half the felt's thickness, from the shaft to the face that strikes (our choice)."""


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
    parts += [_stands(kit, p, detail) for p in kit.pieces.values()]
    parts += _pedals(kit, boards, beater, axle)
    parts.append(_throne(kit.seat_m, detail))
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


# --- hardware ---------------------------------------------------------------------------------------------------------


def _stands(kit: Kit, piece: KitPiece, detail: Detail) -> Mesh:
    """What holds a piece up."""
    n = 10 if detail.hardware else 6
    if piece.kind == "kick":
        return _spurs(piece, n)
    if piece.kind == "hihat":
        return _hat_stand(kit, piece, detail, n)
    if piece.kind in ("cymbal", "block"):
        top = piece.centre - 0.012 * piece.normal
        return _stand_of(top, piece.normal, n)
    if piece.piece in _FLOOR_TOMS:
        return _legs(piece, n)
    if piece.piece is Piece.SNARE:
        return _snare_stand(piece, n)
    return _tom_holder(kit, piece, n)


def _tripod(x: float, y: float, spread: float, height: float, segments: int, turn: float = 0.5) -> list[Mesh]:
    """Three double legs with rubber feet and the collar that they meet in."""
    parts = [lathe([(0, 0), (0.02, 0), (0.02, 0.05), (0, 0.05)], 10, Material.BLACK).moved(translation([x, y, height]))]
    for k in range(3):
        a = turn + 2 * np.pi * k / 3
        foot = np.array([x + spread * np.cos(a), y + spread * np.sin(a), 0.012])
        parts.append(rod([x, y, height + 0.02], foot, 0.0085, Material.CHROME, segments))
        parts.append(
            rod([x, y, height - 0.14], (foot * 2 + [x, y, height + 0.02]) / 3, 0.006, Material.CHROME, segments)
        )
        parts.append(ball(foot, 0.017, Material.RUBBER, 8))
    return parts


def _stand_of(top: NDArray[np.float64], normal: NDArray[np.float64], segments: int) -> Mesh:
    """A straight stand under `top`, its last inch along `normal`."""
    joint = top - 0.06 * normal
    x, y = float(joint[0]), float(joint[1])
    parts = _tripod(x, y, 0.27, 0.36, segments, turn=float(np.arctan2(y, x)))
    middle = 0.36 + 0.45 * (joint[2] - 0.36)
    parts += [
        rod([x, y, 0.16], [x, y, middle], _POLE_M, Material.CHROME, segments),
        rod([x, y, middle], joint, _POLE_M * 0.72, Material.CHROME, segments),
        rod([x, y, middle - 0.02], [x, y, middle + 0.02], _POLE_M * 1.6, Material.BLACK, segments),
        ball(joint, 0.017, Material.BLACK, 10),
        rod(joint, top, 0.005, Material.STEEL, segments),
        lathe([(0, 0), (0.018, 0), (0.018, 0.010), (0, 0.010)], 10, Material.FELT).moved(
            frame(top - 0.006 * normal, normal, [1, 0, 0])
        ),
    ]
    return joined(parts)


def _hat_stand(kit: Kit, piece: KitPiece, detail: Detail, segments: int) -> Mesh:
    top, normal = piece.centre, piece.normal
    x, y = float(top[0]), float(top[1])
    low = top - normal * drums.HAT_GAP_M
    parts = [
        drums.hat_bottom(piece.radius_m, detail).moved(frame(low, normal, piece.axes[0])),
        *_tripod(x, y, 0.26, 0.26, segments, turn=2.2),
        rod([x, y, 0.03], [x, y, low[2] - 0.05], _POLE_M, Material.CHROME, segments),
        lathe([(0, 0), (0.03, 0.0), (0.03, 0.014), (0, 0.014)], 14, Material.FELT).moved(
            translation([x, y, low[2] - 0.052])
        ),
        rod([x, y, low[2] - 0.05], top + normal * 0.20, 0.0042, Material.STEEL, segments),
    ]
    return joined(parts)


def _spurs(piece: KitPiece, segments: int) -> Mesh:
    parts = []
    for side in (-1.0, 1.0):
        hold = piece.centre + np.array([side * piece.radius_m * 0.93, piece.depth_m * 0.72, -piece.radius_m * 0.36])
        foot = np.array([hold[0] + side * 0.13, hold[1] + 0.12, 0.01])
        parts += [rod(hold, foot, 0.009, Material.CHROME, segments), ball(foot, 0.015, Material.RUBBER, 8)]
    return joined(parts)


def _legs(piece: KitPiece, segments: int) -> Mesh:
    """Three legs of a floor tom, held by brackets on its shell."""
    right, away, normal = piece.axes
    parts = []
    for k in range(3):
        a = np.pi / 2 + 2 * np.pi * k / 3
        out = np.cos(a) * right + np.sin(a) * away
        hold = piece.centre + out * (piece.radius_m + 0.022) - normal * piece.depth_m * 0.45
        knee = hold - normal * max(piece.depth_m * 0.62, 0.05)
        foot = np.array([knee[0] + 0.05 * out[0], knee[1] + 0.05 * out[1], 0.014])
        parts += [
            rod(hold + normal * 0.10, knee, 0.0065, Material.CHROME, segments),
            rod(knee, foot, 0.0065, Material.CHROME, segments),
            ball(foot, 0.017, Material.RUBBER, 8),
            box((0.035, 0.05, 0.06), Material.CHROME, 0.008).moved(frame(hold - 0.01 * out, normal, out)),
        ]
    return joined(parts)


def _snare_stand(piece: KitPiece, segments: int) -> Mesh:
    right, away, normal = piece.axes
    under = piece.centre - normal * (piece.depth_m + 0.015)
    hub = under - normal * 0.10
    x, y = float(hub[0]), float(hub[1])
    parts = _tripod(x, y, 0.24, 0.24, segments, turn=1.2)
    parts.append(rod([x, y, 0.10], hub, _POLE_M, Material.CHROME, segments))
    for k in range(3):
        a = np.pi / 2 + 2 * np.pi * k / 3
        out = np.cos(a) * right + np.sin(a) * away
        reach = under + out * (piece.radius_m + 0.016)
        parts.append(
            tube(
                [hub, under + out * piece.radius_m * 0.75 - normal * 0.012, reach, reach + normal * 0.03],
                0.006,
                Material.CHROME,
                segments,
            )
        )
        parts.append(ball(reach + normal * 0.03, 0.012, Material.RUBBER, 8))
    return joined(parts)


def _tom_holder(kit: Kit, piece: KitPiece, segments: int) -> Mesh:
    """An arm from the bass drum's top to the shell, or a stand where the bass drum is too far."""
    base = kit.pieces[Piece.KICK]
    post = np.array([base.centre[0], base.centre[1] + 0.5 * base.depth_m, base.centre[2] + base.radius_m])
    side = 1.0 if piece.centre[0] > post[0] else -1.0
    post = post + np.array([side * 0.05, 0.0, 0.0])
    shell = piece.centre - piece.normal * piece.depth_m * 0.5
    way = unit((post - shell) * [1, 1, 0])
    way = unit(way - piece.normal * np.dot(way, piece.normal))
    hold = shell + way * (piece.radius_m + 0.01)
    if np.linalg.norm((hold - post)[:2]) > _ARM_M:
        return _stand_of(hold - np.array([0, 0, 0.02]), np.array([0.0, 0.0, 1.0]), segments)
    elbow = np.array([post[0], post[1], max(hold[2], post[2] + 0.08)])
    return joined(
        [
            rod(post - np.array([0, 0, 0.05]), elbow, 0.0125, Material.CHROME, segments),
            ball(elbow, 0.022, Material.BLACK, 10),
            rod(elbow, hold, 0.0095, Material.CHROME, segments),
            box((0.03, 0.05, 0.07), Material.CHROME, 0.008).moved(frame(hold, piece.normal, way)),
            lathe([(0, 0), (0.035, 0), (0.03, 0.02), (0, 0.02)], 14, Material.CHROME).moved(
                translation(post - np.array([0, 0, 0.02]))
            ),
        ]
    )


_ARM_M = 0.45
"""The longest tom arm; farther toms stand on their own (our choice)."""


def _throne(seat_m: tuple[float, float, float], detail: Detail) -> Mesh:
    x, y, z = seat_m
    cushion = [
        (0, z - 0.085),
        (0.15, z - 0.085),
        (0.172, z - 0.075),
        (0.176, z - 0.05),
        (0.172, z - 0.02),
        (0.15, z - 0.004),
        (0.10, z),
        (0, z - 0.006),
    ]
    parts = [
        lathe(cushion, detail.segments, Material.CUSHION).moved(translation([x, y, 0])),
        lathe(
            [(0.1765, z - 0.056), (0.1775, z - 0.05), (0.1765, z - 0.044)], detail.segments, Material.SHELL_RING
        ).moved(translation([x, y, 0])),
        rod([x, y, 0.10], [x, y, z - 0.08], 0.016, Material.CHROME, 10),
        *_tripod(x, y, 0.25, 0.24, 8, turn=np.pi / 2),
    ]
    return joined(parts)


# --- pedals -----------------------------------------------------------------------------------------------------------


def axle_of(kit: Kit) -> NDArray[np.float64]:
    """The middle of the bass pedal's axle: right below the beater's rest on the head, a beater's length under it."""
    head = kit.pieces[Piece.KICK].centre
    return np.array([head[0], head[1] - _BEATER_HALF_M, head[2] - _BEATER_LENGTH_M])


def _pedals(kit: Kit, boards: tuple[int, int], beater: int, axle: NDArray[np.float64]) -> list[Mesh]:
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    parts = [_board(pedal).on_bone(bone) for pedal, bone in zip(_pedals_by_foot(kit), boards, strict=True)]
    parts += [_base(kick), _base(hat)]
    x, y, z = axle
    for side in (-0.055, 0.055):
        parts.append(rod([x + side, y, 0.01], [x + side, y, z], 0.011, Material.BLACK, 8))
    parts.append(rod([x - 0.07, y, z], [x + 0.07, y, z], 0.007, Material.STEEL, 8))
    top, half = axle + np.array([0, 0, _BEATER_LENGTH_M]), _BEATER_HALF_M
    felt = [(0, -half), (0.02, -half), (0.025, -half / 2), (0.025, half / 2), (0.02, half), (0, half)]
    shaft = [
        rod(axle, top, 0.0045, Material.STEEL, 6),
        lathe(felt, 14, Material.FELT).moved(frame(top, [0, 1, 0], [1, 0, 0])),
    ]
    parts += [p.on_bone(beater) for p in shaft]
    return parts


def _pedals_by_foot(kit: Kit) -> tuple[Pedal, Pedal]:
    """The pedals under the right and the left foot."""
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    return (hat, kick) if kit.left_handed else (kick, hat)


def _board(pedal: Pedal) -> Mesh:
    """The footboard lying flat."""
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    along = unit(toe - heel)
    length = float(np.linalg.norm(toe - heel))
    side = unit(np.cross(along, [0.0, 0.0, 1.0]))
    plate = box((0.085, 0.012, length), Material.STEEL, 0.004).moved(
        frame((heel + toe) / 2 - np.array([0, 0, 0.008]), along, side)
    )
    grip = box((0.06, 0.004, length * 0.55), Material.RUBBER, 0.001).moved(
        frame(heel + along * length * 0.62, along, side)
    )
    return joined([plate, grip])


def _base(pedal: Pedal) -> Mesh:
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    along = unit(toe - heel)
    side = unit(np.cross(along, [0.0, 0.0, 1.0]))
    middle = (heel + toe) / 2
    length = float(np.linalg.norm(toe - heel))
    plate = box((0.10, 0.008, length + 0.06), Material.BLACK, 0.002).moved(
        frame([middle[0], middle[1], 0.006], along, side)
    )
    block = box((0.09, 0.02, 0.05), Material.STEEL, 0.004).moved(
        frame(heel - along * 0.035 - np.array([0, 0, 0.012]), along, side)
    )
    return joined([plate, block])


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
    for bone, pedal, angle in zip(rig.boards, _pedals_by_foot(rig.kit), pose.footboard_rad, strict=True):
        m[bone] = _raised(pedal, angle)
    m[rig.beater] = rotation_at(rig.axle_m, [1, 0, 0], pose.beater_rad)
    for side in (RIGHT, LEFT):
        along = pose.tip_m[side] - pose.butt_m[side]
        m[rig.sticks[side]] = frame(pose.butt_m[side], along, [1, 0, 0])
        m[rig.sticks[side]][:3, 2] *= np.linalg.norm(along) / drums.STICK_M
    return m


def _raised(pedal: Pedal, angle_rad: float) -> Matrix:
    heel = np.array(pedal.heel_m)
    along = unit(np.array(pedal.toe_m) - heel)
    axis = np.cross(along, [0.0, 0.0, 1.0])
    return translation(heel) @ rotation(axis, angle_rad) @ translation(-heel)


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
