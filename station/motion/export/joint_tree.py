"""The drummer as a tree of rigid bones with rotations, for formats that know no points: BVH and glTF.

World axes of the export: y up, the figure faces +z, x to its left (both formats' custom); metres. Each bone starts at a
joint and points to another; at rest, all rotations zero, the figure stands with its arms stretched to the sides. A
bone's rotation is found from its direction and from a second direction that fixes its roll: the plane of elbow or knee,
the back of the hand, the line of shoulders or hips.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics import frame
from station.motion.kinematics.figure import Figure, Joint

Array = NDArray[np.float64]

TURN = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""From the station's axes (x right, y forward, z up) to the export's."""

_UP, _FORWARD = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_RIGHT, _LEFT, _DOWN = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)


@dataclass(frozen=True, slots=True)
class JointNode:
    """A bone from joint `start` to joint `end`; `rest` its direction and `roll` its second direction at rest."""

    name: str
    parent: str | None
    start: Joint
    end: Joint
    rest: tuple[float, float, float]
    roll: tuple[float, float, float]


BONES = (
    JointNode("pelvis", None, Joint.PELVIS, Joint.SPINE, _UP, _LEFT),
    JointNode("chest", "pelvis", Joint.SPINE, Joint.NECK, _UP, _LEFT),
    JointNode("neck", "chest", Joint.NECK, Joint.HEAD, _UP, _FORWARD),
    JointNode("head", "neck", Joint.HEAD, Joint.CROWN, _UP, _FORWARD),
    JointNode("right_upper_arm", "chest", Joint.RIGHT_SHOULDER, Joint.RIGHT_ELBOW, _RIGHT, _FORWARD),
    JointNode("right_forearm", "right_upper_arm", Joint.RIGHT_ELBOW, Joint.RIGHT_WRIST, _RIGHT, _UP),
    JointNode("right_hand", "right_forearm", Joint.RIGHT_WRIST, Joint.RIGHT_HAND, _RIGHT, _UP),
    JointNode("left_upper_arm", "chest", Joint.LEFT_SHOULDER, Joint.LEFT_ELBOW, _LEFT, _FORWARD),
    JointNode("left_forearm", "left_upper_arm", Joint.LEFT_ELBOW, Joint.LEFT_WRIST, _LEFT, _UP),
    JointNode("left_hand", "left_forearm", Joint.LEFT_WRIST, Joint.LEFT_HAND, _LEFT, _UP),
    JointNode("right_thigh", "pelvis", Joint.RIGHT_HIP, Joint.RIGHT_KNEE, _DOWN, _FORWARD),
    JointNode("right_shank", "right_thigh", Joint.RIGHT_KNEE, Joint.RIGHT_ANKLE, _DOWN, _FORWARD),
    JointNode("right_foot", "right_shank", Joint.RIGHT_ANKLE, Joint.RIGHT_TOE, _FORWARD, _UP),
    JointNode("left_thigh", "pelvis", Joint.LEFT_HIP, Joint.LEFT_KNEE, _DOWN, _FORWARD),
    JointNode("left_shank", "left_thigh", Joint.LEFT_KNEE, Joint.LEFT_ANKLE, _DOWN, _FORWARD),
    JointNode("left_foot", "left_shank", Joint.LEFT_ANKLE, Joint.LEFT_TOE, _FORWARD, _UP),
)
"""Parents before children."""
STICKS = ("right_stick", "left_stick")
_BY_NAME = {bone.name: bone for bone in BONES}


@dataclass(frozen=True, eq=False)
class JointTree:
    """Every bone over time: `start_m` (n, 3) and `rotation` (n, 3, 3) in the world, `length_m`; by name."""

    start_m: dict[str, Array]
    rotation: dict[str, Array]
    length_m: dict[str, float]


def skeleton(rows: Array, figure: Figure, stick_m: float) -> JointTree:
    """The bones and sticks in poses given as rows (n, fields) in the layout of `frame`."""
    joints = rows[:, frame.JOINTS].reshape(-1, len(Joint), 3) @ TURN.T
    rolls = _rolls(joints, rows)
    start, rotation, length = {}, {}, {}
    for bone in BONES:
        along = joints[:, bone.end] - joints[:, bone.start]
        start[bone.name] = joints[:, bone.start]
        rotation[bone.name] = _turned(bone.rest, bone.roll, along, rolls[bone.name])
        length[bone.name] = float(np.linalg.norm(along, axis=1).mean())
    butts, tips = (rows[:, part].reshape(-1, 2, 3) @ TURN.T for part in (frame.BUTT, frame.TIP))
    for side, (name, hand) in enumerate(zip(STICKS, ("right_hand", "left_hand"), strict=True)):
        start[name] = butts[:, side]
        rotation[name] = _turned(_FORWARD, _UP, tips[:, side] - butts[:, side], rolls[hand])
        length[name] = stick_m
    return JointTree(start, rotation, length)


def _rolls(joints: Array, rows: Array) -> dict[str, Array]:
    """The second direction of each bone, (n, 3)."""
    across_hips = joints[:, Joint.LEFT_HIP] - joints[:, Joint.RIGHT_HIP]
    across = joints[:, Joint.LEFT_SHOULDER] - joints[:, Joint.RIGHT_SHOULDER]
    facing = rows[:, frame.FACING] @ TURN.T
    backs = rows[:, frame.PALM].reshape(-1, 2, 3) @ TURN.T
    rolls = {"pelvis": across_hips, "chest": across, "neck": facing, "head": facing}
    for side, name in enumerate(("right", "left")):
        shoulder, wrist = joints[:, Joint[f"{name.upper()}_SHOULDER"]], joints[:, Joint[f"{name.upper()}_WRIST"]]
        rolls[f"{name}_upper_arm"] = wrist - shoulder  # where the elbow bends to
        rolls[f"{name}_forearm"] = backs[:, side]
        rolls[f"{name}_hand"] = backs[:, side]
        hip, knee, ankle = (joints[:, Joint[f"{name.upper()}_{part}"]] for part in ("HIP", "KNEE", "ANKLE"))
        forward = knee - 0.5 * (hip + ankle)
        rolls[f"{name}_thigh"] = rolls[f"{name}_shank"] = forward
        rolls[f"{name}_foot"] = knee - ankle
    return rolls


def _turned(rest: tuple[float, ...], rest_roll: tuple[float, ...], along: Array, roll: Array) -> Array:
    """Rotations (n, 3, 3) that carry `rest` to `along` and `rest_roll` into its half-plane with `roll`."""
    return np.asarray(_frames(along, roll) @ _frames(np.array([rest]), np.array([rest_roll]))[0].T)


def _frames(along: Array, roll: Array) -> Array:
    """Orthonormal frames (n, 3, 3): columns along, across, and what is left of `roll`."""
    first = along / np.linalg.norm(along, axis=1, keepdims=True)
    third = roll - (roll * first).sum(1, keepdims=True) * first
    third = third / np.maximum(np.linalg.norm(third, axis=1, keepdims=True), 1e-9)
    return np.stack([first, np.cross(third, first), third], axis=2)


def local(bones: JointTree, name: str) -> tuple[Array, Array]:
    """Translation (n, 3) and rotation (n, 3, 3) of a bone against its parent; of pelvis and sticks in the world."""
    parent = _BY_NAME[name].parent if name in _BY_NAME else None
    if parent is None:
        return bones.start_m[name], bones.rotation[name]
    back = np.swapaxes(bones.rotation[parent], 1, 2)
    offset = bones.start_m[name] - bones.start_m[parent]
    return np.einsum("nij,nj->ni", back, offset), back @ bones.rotation[name]
