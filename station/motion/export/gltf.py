"""The motion as glTF: the drummer of rigid bones, sticks and kit, animated, in one .glb that Blender opens.

Metres, y up, the figure faces +z (`skeleton`). The bones are a tree of nodes, each with its own solid; sticks, cymbals,
footboards and the beater are nodes of their own. Time 0 of the animation is the first of the given times.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.pieces import Piece, word
from station.motion.drummer import Drummer
from station.motion.export import plain_solids
from station.motion.export.glb_file import Glb, quaternions
from station.motion.export.joint_tree import BONES, STICKS, TURN, local, skeleton
from station.motion.kinematics import frame
from station.motion.kinematics.pedal_motion import BEATER_HALF_M, BEATER_LENGTH_M
from station.motion.kit.kit import Kit
from station.motion.kit.piece import BELL_ABOVE_BOW_M, KitPiece
from station.motion.motion_plan import holds

Array = NDArray[np.float64]

_THICKNESS_M = {
    "pelvis": 0.13,
    "chest": 0.14,
    "neck": 0.05,
    "head": 0.085,
    "upper_arm": 0.042,
    "forearm": 0.034,
    "hand": 0.03,
    "thigh": 0.07,
    "shank": 0.05,
    "foot": 0.035,
}
"""Half the width of each bone's solid (our choice)."""
_MATERIALS = {
    "skin": ((0.58, 0.36, 0.26), 0.0, 0.7),
    "cloth": ((0.05, 0.07, 0.12), 0.0, 0.9),
    "wood": ((0.62, 0.44, 0.24), 0.0, 0.6),
    "shell": ((0.35, 0.03, 0.05), 0.1, 0.35),
    "bronze": ((0.80, 0.58, 0.25), 1.0, 0.35),
    "rubber": ((0.02, 0.02, 0.022), 0.0, 0.8),
    "steel": ((0.55, 0.56, 0.58), 1.0, 0.4),
}
_BARE = ("head", "neck", "right_forearm", "left_forearm", "right_hand", "left_hand")


def write_glb(drummer: Drummer, path: Path, time_s: Array) -> None:
    """Write the poses at `time_s` (n,), rising, whole to `path`; raises `DeviceError` if the disk refuses."""
    write_whole(path, glb_bytes(drummer, time_s))


def glb_bytes(drummer: Drummer, time_s: Array) -> bytes:
    """The file's bytes."""
    scene = Glb()
    materials = {name: scene.material(name, *look) for name, look in _MATERIALS.items()}
    scene.clock(time_s - time_s[0])
    rows = drummer.rows(time_s)
    _figure(scene, materials, drummer, rows)
    for index, piece in enumerate(drummer.kit.pieces.values()):
        _piece(scene, materials, piece, drummer.swings(index, time_s))
    _pedals(scene, materials, drummer.kit, rows)
    return scene.data("drum station")


def _figure(scene: Glb, materials: dict[str, int], drummer: Drummer, rows: Array) -> None:
    hold, _ = holds(drummer.style)
    bones = skeleton(rows, drummer.figure, hold.length_m(drummer.figure))
    nodes: dict[str, int] = {}
    for bone in BONES:
        thick = _THICKNESS_M[bone.name.removeprefix("right_").removeprefix("left_")]
        solid = plain_solids.turned_to(plain_solids.limb(bones.length_m[bone.name], thick), bone.rest)
        mesh = scene.mesh(bone.name, solid, materials["skin" if bone.name in _BARE else "cloth"])
        nodes[bone.name] = scene.node(bone.name, None if bone.parent is None else nodes[bone.parent], mesh)
        _move(scene, nodes[bone.name], *local(bones, bone.name))
    for name in STICKS:
        held = plain_solids.HELD.get(hold.held.name)
        in_hand = None if held is None else scene.mesh(name, held(bones.length_m[name]), materials["wood"])
        _move(scene, scene.node(name, None, in_hand), *local(bones, name))


def _move(scene: Glb, node: int, place: Array, turn: Array) -> None:
    """Animate `node`; what does not move is placed once."""
    quaternion = quaternions(turn)
    scene.place(node, place[0], quaternion[0])
    if np.ptp(place, axis=0).max() > _STILL:
        scene.animate(node, "translation", place)
    if np.ptp(quaternion, axis=0).max() > _STILL:
        scene.animate(node, "rotation", quaternion)


_STILL = 1e-6


def _piece(scene: Glb, materials: dict[str, int], piece: KitPiece, swing: Array) -> None:
    """One piece; its swing (n, 2) tips it about its own right and away axes, a cymbal where it hangs."""
    hangs = BELL_ABOVE_BOW_M if piece.kind in ("cymbal", "hihat") else 0.0
    if hangs:
        solid, material = plain_solids.cymbal(piece.radius_m, hangs), "bronze"
    elif piece.kind == "block":
        solid, material = plain_solids.block(piece.radius_m, piece.depth_m), "steel"
    else:
        solid, material = plain_solids.drum(piece.radius_m, piece.depth_m), "shell"
    material = "rubber" if piece.electronic else material
    node = scene.node(word(piece.piece), None, scene.mesh(word(piece.piece), solid, materials[material]))
    at = piece.centre + hangs * piece.normal
    world = (TURN @ piece.axes.T)[None] @ _tips(swing)
    _move(scene, node, np.repeat((TURN @ at)[None], len(swing), 0), world)


def _tips(swing: Array) -> Array:
    """Rotations (n, 3, 3) about a piece's right axis and then its away axis."""
    one, zero = np.ones(len(swing)), np.zeros(len(swing))
    (cx, cy), (sx, sy) = np.cos(swing).T, np.sin(swing).T
    about_right = np.stack([one, zero, zero, zero, cx, -sx, zero, sx, cx], 1).reshape(-1, 3, 3)
    about_away = np.stack([cy, zero, sy, zero, one, zero, -sy, zero, cy], 1).reshape(-1, 3, 3)
    return np.asarray(about_away @ about_right)


def _pedals(scene: Glb, materials: dict[str, int], kit: Kit, rows: Array) -> None:
    right, left = zip(kit.pedals_by_foot, rows[:, frame.BOARDS].T, strict=True)
    boards = [("right_board", *right), ("left_board", *left)]
    if kit.slave is not None:
        boards.append(("slave_board", kit.slave, rows[:, frame.SLAVE_BOARD]))
    for name, pedal, angle in boards:
        along = np.array(pedal.toe_m) - np.array(pedal.heel_m)
        length = float(np.linalg.norm(along))
        mesh = scene.mesh(name, plain_solids.plate(0.045, length), materials["steel"])
        heading = np.array([along[0] / length, along[1] / length, 0.0])
        across = np.array([heading[1], -heading[0], 0.0])
        up = np.array([0.0, 0.0, 1.0])
        turned = np.cos(angle)[:, None] * heading + np.sin(angle)[:, None] * up
        frames = np.stack([np.broadcast_to(across, turned.shape), np.cross(turned, across), turned], 2)
        place = np.repeat((TURN @ np.array(pedal.heel_m))[None], len(angle), 0)
        _move(scene, scene.node(name, None, mesh), place, TURN @ frames)
    axle = kit.pieces[Piece.KICK].centre - np.array([0.0, BEATER_HALF_M, BEATER_LENGTH_M])
    _beater(scene, materials, "beater", axle, rows[:, frame.BEATER])
    if kit.slave is not None:
        _beater(scene, materials, "slave_beater", axle + kit.second_beater_m, rows[:, frame.SLAVE_BEATER])


def _beater(scene: Glb, materials: dict[str, int], name: str, axle: Array, angle: Array) -> None:
    mesh = scene.mesh(name, plain_solids.beater(BEATER_LENGTH_M), materials["steel"])
    c, s, one, zero = np.cos(angle), np.sin(angle), np.ones_like(angle), np.zeros_like(angle)
    turn = np.stack([one, zero, zero, zero, c, -s, zero, s, c], 1).reshape(-1, 3, 3)
    _move(scene, scene.node(name, None, mesh), np.repeat((TURN @ axle)[None], len(angle), 0), TURN @ turn)
