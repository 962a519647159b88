"""The bones that carry the figure's skin: their frames in any pose, and the pose in which the skin was made.

The skin is made sitting, arms half bent, near to how a drummer always is, so that no joint ever turns far from it.
"""

from dataclasses import dataclass

import numpy as np

from station.motion.kinematics.figure import Figure, Joint
from station.motion.kinematics.pose import Pose
from station.render.figure.bones import BODY_BONES, Bone
from station.render.figure.expression import Expression, face_matrices
from station.render.geometry.transforms import Matrix, Vector, cross, frames, unit

_ARMS = (
    (Bone.RIGHT_UPPER_ARM, Joint.RIGHT_SHOULDER, Joint.RIGHT_ELBOW, Joint.RIGHT_WRIST, Joint.RIGHT_HAND),
    (Bone.LEFT_UPPER_ARM, Joint.LEFT_SHOULDER, Joint.LEFT_ELBOW, Joint.LEFT_WRIST, Joint.LEFT_HAND),
)
_LEGS = (
    (Bone.RIGHT_THIGH, Joint.RIGHT_HIP, Joint.RIGHT_KNEE, Joint.RIGHT_ANKLE, Joint.RIGHT_TOE),
    (Bone.LEFT_THIGH, Joint.LEFT_HIP, Joint.LEFT_KNEE, Joint.LEFT_ANKLE, Joint.LEFT_TOE),
)
_LIMB_JOINTS = np.array([joints for _, *joints in (*_ARMS, *_LEGS)])
_FIRST = np.array([Bone.RIGHT_UPPER_ARM, Bone.LEFT_UPPER_ARM, Bone.RIGHT_THIGH, Bone.LEFT_THIGH])
_SECOND = _FIRST + 1
_TWIST = _FIRST[:2] + 2
_THIRD = _FIRST + np.array([3, 3, 2, 2])
_TRUNK = slice(Bone.WAIST, Bone.HEAD + 1)
_TRUNK_FROM = np.array([Joint.PELVIS, Joint.SPINE, Joint.NECK, Joint.HEAD])
_TRUNK_TO = np.array([Joint.SPINE, Joint.NECK, Joint.HEAD, Joint.CROWN])
HEAD_M = 0.2146
"""The head's height that the face was designed for."""


@dataclass(frozen=True, eq=False)
class Stance:
    """What the frames follow from: `joints_m` (21, 3), backs of the hands `palm` (2, 3), the head's directions."""

    joints_m: Vector
    palm: Vector
    facing: Vector
    head_up: Vector

    @classmethod
    def of(cls, pose: Pose) -> "Stance":
        """That of a pose."""
        return cls(pose.joints_m, pose.palm, pose.facing, pose.head_up)


def bind_stance(figure: Figure) -> Stance:
    """The stance in which the skin is made, sitting at the origin."""
    j = np.zeros((len(Joint), 3))
    j[Joint.PELVIS] = (0.0, 0.0, 0.59)
    j[Joint.SPINE] = j[Joint.PELVIS] + [0.0, 0.005, 0.42 * figure.trunk_m]
    j[Joint.NECK] = j[Joint.SPINE] + [0.0, 0.020, 0.58 * figure.trunk_m]
    j[Joint.HEAD] = j[Joint.NECK] + [0.0, 0.010, figure.neck_m]
    j[Joint.CROWN] = j[Joint.HEAD] + [0.0, 0.0, figure.head_m]
    for side, (_, shoulder, elbow, wrist, hand) in zip((1.0, -1.0), _ARMS, strict=True):
        out = np.array([side, 1.0, 1.0])
        j[shoulder] = j[Joint.NECK] + [side * figure.shoulder_breadth_m / 2, 0.0, 0.0]
        j[elbow] = j[shoulder] + figure.upper_arm_m * unit([0.58, 0.25, -0.78]) * out
        j[wrist] = j[elbow] + figure.forearm_m * unit([-0.35, 0.92, 0.05]) * out
        j[hand] = j[wrist] + figure.hand_m * unit([-0.30, 0.92, -0.12]) * out
    for side, (_, hip, knee, ankle, toe) in zip((1.0, -1.0), _LEGS, strict=True):
        out = np.array([side, 1.0, 1.0])
        j[hip] = j[Joint.PELVIS] + [side * figure.hip_breadth_m / 2, 0.0, 0.0]
        j[knee] = j[hip] + figure.thigh_m * unit([0.36, 0.92, -0.12]) * out
        j[ankle] = j[knee] + figure.shank_m * unit([0.0, 0.10, -0.99])
        j[toe] = j[ankle] + [0.0, 0.75 * figure.foot_m, -figure.ankle_height_m]
    palm = np.array([unit([0.0, 0.13, 0.99]), unit([0.0, 0.13, 0.99])])
    return Stance(j, palm, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))


def bone_frames(stance: Stance) -> Matrix:
    """The frame of every bone of `BODY_BONES`, (18, 4, 4): z along the bone."""
    j = stance.joints_m
    origin, along, side = np.empty((3, len(BODY_BONES), 3))
    shoulders = j[Joint.RIGHT_SHOULDER] - j[Joint.LEFT_SHOULDER]
    hips = j[Joint.RIGHT_HIP] - j[Joint.LEFT_HIP]
    right = cross(stance.facing, stance.head_up)
    origin[_TRUNK] = j[_TRUNK_FROM]
    along[_TRUNK] = j[_TRUNK_TO] - j[_TRUNK_FROM]
    along[Bone.HEAD] = stance.head_up
    side[_TRUNK] = (unit(hips) + 0.5 * unit(shoulders), shoulders, unit(shoulders) + right, right)
    a, b, c, d = (j[column] for column in _LIMB_JOINTS.T)  # each (4, 3): arms, then legs
    first, second, third = b - a, c - b, d - c
    hinge = cross(first, second)
    palm = cross(stance.palm, second[:2]), cross(stance.palm, third[:2])
    origin[_FIRST], along[_FIRST], side[_FIRST] = a, first, hinge
    origin[_SECOND], along[_SECOND], side[_SECOND] = b, second, hinge
    origin[_TWIST], along[_TWIST] = b[:2], second[:2]
    side[_TWIST] = unit(palm[0]) - unit(hinge[:2])  # half of the palm's turn: its other half is the wrist's
    origin[_THIRD], along[_THIRD] = c, third
    side[_THIRD[:2]], side[_THIRD[2:]] = palm[1], hinge[2:]
    return frames(origin, along, side)


class Skeleton:
    """Turns poses into the matrices that carry the skin from where it was made."""

    def __init__(self, figure: Figure) -> None:
        self.bind = bind_stance(figure)
        self.frames = bone_frames(self.bind)
        self._back = np.linalg.inv(self.frames)
        self._face_scale = figure.head_m / HEAD_M

    def matrices(self, pose: Pose) -> Matrix:
        """One matrix a bone, (bones, 4, 4)."""
        out = np.empty((len(Bone), 4, 4))
        now = bone_frames(Stance.of(pose))
        out[: len(BODY_BONES)] = now @ self._back
        face = face_matrices(Expression.of(pose))
        face[:, :3, 3] *= self._face_scale
        out[len(BODY_BONES) :] = now[Bone.HEAD] @ face @ self._back[Bone.HEAD]
        return out
