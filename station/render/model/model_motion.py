"""How every part of the model moves: the drummer's bones, sticks, pedals and cymbals over many instants at once.

Frames are the skin's own (`figure.skeleton`) in the station's axes. Arms, legs and sticks hang on nothing, so that no
tip is where a coarse trunk takes it; what follows a limb's first bone hangs on the bone before it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, word
from station.motion.drummer import Drummer
from station.motion.export.glb_file import quaternions
from station.motion.kinematics import frame
from station.motion.motion_plan import holds
from station.render.figure.bones import BODY_BONES, LIMB_BONES, Bone
from station.render.figure.skeleton import Stance, bone_frames, sole_of
from station.render.kit.instrument_meshes import HOLE_M
from station.render.kit.kit_rig import KitRig

Array = NDArray[np.float64]

HANGS_ON = {
    Bone.CHEST: Bone.WAIST,
    Bone.NECK: Bone.CHEST,
    Bone.HEAD: Bone.NECK,
    Bone.RIGHT_FOREARM: Bone.RIGHT_UPPER_ARM,
    Bone.RIGHT_TWIST: Bone.RIGHT_FOREARM,
    Bone.RIGHT_HAND: Bone.RIGHT_FOREARM,
    Bone.LEFT_FOREARM: Bone.LEFT_UPPER_ARM,
    Bone.LEFT_TWIST: Bone.LEFT_FOREARM,
    Bone.LEFT_HAND: Bone.LEFT_FOREARM,
    Bone.RIGHT_SHANK: Bone.RIGHT_THIGH,
    Bone.RIGHT_FOOT: Bone.RIGHT_SHANK,
    Bone.RIGHT_TOES: Bone.RIGHT_FOOT,
    Bone.LEFT_SHANK: Bone.LEFT_THIGH,
    Bone.LEFT_FOOT: Bone.LEFT_SHANK,
    Bone.LEFT_TOES: Bone.LEFT_FOOT,
}
"""The bone before each that follows one."""
STICK_OF = {Limb.RIGHT_HAND: "right_stick", Limb.LEFT_HAND: "left_stick"}
BOARD_OF = {Limb.RIGHT_FOOT: "right_board", Limb.LEFT_FOOT: "left_board"}


@dataclass(frozen=True, eq=False)
class NodeMotion:
    """One node over n instants: `place_m` (n, 3) and `turn` (n, 4), quaternions x, y, z, w, against its parent."""

    name: str
    parent: str | None
    place_m: Array
    turn: Array


@dataclass(frozen=True, eq=False)
class MovingGroup:
    """Nodes that move together, and the times (k,) of the strokes at which they must be exactly where they are."""

    nodes: tuple[NodeMotion, ...]
    strikes_s: Array


def moving_groups(drummer: Drummer, rig: KitRig, time_s: Array) -> list[MovingGroup]:
    """All that moves of a drummer and the rig of their kit at `time_s` (n,), which holds the times of all strokes."""
    rows = drummer.rows(time_s)
    sole_m = sole_of(drummer.figure)
    bones = bone_frames(Stance.of_rows(rows, holds(drummer.style), sole_m))
    onset_s, limbs = drummer.score.onset_s, drummer.assignment.limbs
    groups = [MovingGroup(_bones(bones, (Bone.WAIST, Bone.CHEST, Bone.NECK, Bone.HEAD)), np.empty(0))]
    for limb, own in LIMB_BONES.items():
        nodes = _bones(bones, tuple(Bone(bone) for bone in own if bone < len(BODY_BONES)))
        more = _stick(rows, limb) if limb.is_hand else _board(rows, rig, limb)
        groups.append(MovingGroup((*nodes, more), onset_s[limbs == limb]))
    feet_s = onset_s[~np.isin(limbs, [limb for limb in Limb if limb.is_hand])]
    groups.append(MovingGroup(_beaters(rows, rig), feet_s))
    return groups + _swinging(drummer, rig, rows, time_s)


def _bones(frames: Array, bones: tuple[Bone, ...]) -> tuple[NodeMotion, ...]:
    return tuple(_bone(frames, bone) for bone in bones)


def _bone(frames: Array, bone: Bone) -> NodeMotion:
    own, name, before = frames[:, bone], bone.name.lower(), HANGS_ON.get(bone)
    if before is None:
        return NodeMotion(name, None, own[:, :3, 3], quaternions(own[:, :3, :3]))
    back = np.swapaxes(frames[:, before, :3, :3], 1, 2)
    away = own[:, :3, 3] - frames[:, before, :3, 3]
    return NodeMotion(
        name, before.name.lower(), np.einsum("nij,nj->ni", back, away), quaternions(back @ own[:, :3, :3])
    )


def _stick(rows: Array, limb: Limb) -> NodeMotion:
    """A stick from its butt on, its z axis along it; how it is turned about that cannot be seen."""
    side = 0 if limb is Limb.RIGHT_HAND else 1
    butt, tip = (rows[:, part].reshape(-1, 2, 3)[:, side] for part in (frame.BUTT, frame.TIP))
    x, y, z = ((tip - butt) / np.linalg.norm(tip - butt, axis=1, keepdims=True)).T
    half = np.stack([-y, x, np.zeros_like(z), np.maximum(1 + z, 1e-6)], axis=1)
    return NodeMotion(STICK_OF[limb], None, butt, half / np.linalg.norm(half, axis=1, keepdims=True))


def _board(rows: Array, rig: KitRig, limb: Limb) -> NodeMotion:
    side = 0 if limb is Limb.RIGHT_FOOT else 1
    return _turning(rig, side, BOARD_OF[limb], rows[:, frame.BOARDS][:, side])


def _beaters(rows: Array, rig: KitRig) -> tuple[NodeMotion, ...]:
    """What turns with the kick's strokes but its boards: both beaters, and the slave's board."""
    hat_board = rows[:, frame.BOARDS][:, rig.pedal_rig.hat_board]
    lifted = hat_board[:, None] * rig.pedal_rig.lift
    return (
        _turning(rig, 2, "slave_board", rows[:, frame.SLAVE_BOARD]),
        _turning(rig, 3, "beater", rows[:, frame.BEATER]),
        _turning(rig, 4, "slave_beater", rows[:, frame.SLAVE_BEATER]),
        NodeMotion("hat_rod", None, lifted, _still(len(rows))),
    )


def _turning(rig: KitRig, part: int, name: str, angle: Array) -> NodeMotion:
    """A part of the pedals, turned by `angle` (n,) about its axis through its pivot."""
    skew = rig.pedal_rig.spin[part]
    axis = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    turn = np.concatenate([np.sin(angle / 2)[:, None] * axis, np.cos(angle / 2)[:, None]], axis=1)
    return NodeMotion(name, None, np.broadcast_to(rig.pedal_rig.pivot[part], (len(angle), 3)), turn)


def _still(count: int) -> Array:
    return np.broadcast_to([0.0, 0.0, 0.0, 1.0], (count, 4))


def _swinging(drummer: Drummer, rig: KitRig, rows: Array, time_s: Array) -> list[MovingGroup]:
    """The cymbals, each about its hole; the upper hi-hat goes up and down with its rod."""
    score = drummer.score
    stands = np.array([int(drummer.kit.stand_in(Piece(p))) for p in range(len(Piece))])
    struck = stands[score.notes["piece"]] if len(score) else np.empty(0, np.int64)
    groups = []
    for index, piece in enumerate(drummer.kit.pieces.values()):
        if piece.kind not in SWINGING:
            continue
        a, b = drummer.swings(index, time_s).T / 2
        right, away, normal = piece.axes
        # about the piece's away axis first, then about its right axis: the product of two half turns
        own = [np.sin(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a) * np.sin(b), np.cos(a) * np.cos(b)]
        turn = np.stack([*(np.stack(own[:3], axis=1) @ np.stack([right, away, normal])).T, own[3]], axis=1)
        place = np.tile(piece.centre + HOLE_M * piece.normal, (len(rows), 1))
        if piece is rig.kit.pulled_hat:
            place = place + rows[:, frame.GAP, None] * piece.normal
        nodes = (NodeMotion(word(piece.piece), None, place, turn),)
        groups.append(MovingGroup(nodes, score.onset_s[struck == piece.piece]))
    return groups


SWINGING = ("cymbal", "hihat")
"""The kinds of pieces that swing so far that it is seen; drums shake by less than a degree."""
