"""The bones that carry the figure's skin: their frames in any pose, and the pose in which the skin was made.

The skin is made sitting, arms half bent, near to how a drummer always is, so that no joint ever turns far from it.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from station.motion.kinematics import frame
from station.motion.kinematics.figure import Figure, Joint
from station.motion.kinematics.grip import GRIPS, HAND_M, Grip, Hold, line_axes
from station.motion.kinematics.leg import ANKLE_ALONG, BALL_ALONG
from station.motion.kinematics.pose import Pose
from station.render.figure.bones import BODY_BONES, BONES, FINGERS, Bone
from station.render.figure.expression import Expression, face_matrices
from station.render.figure.hand_bones import REST, STEPS, finger_frames
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
_BEFORE_BALL = slice(Bone.RIGHT_TOES, Bone.LEFT_TOES + 1)
_TRUNK = slice(Bone.WAIST, Bone.HEAD + 1)
_TRUNK_FROM = np.array([Joint.PELVIS, Joint.SPINE, Joint.NECK, Joint.HEAD])
_TRUNK_TO = np.array([Joint.SPINE, Joint.NECK, Joint.HEAD, Joint.CROWN])
_ANKLES, _TOES = [Joint.RIGHT_ANKLE, Joint.LEFT_ANKLE], [Joint.RIGHT_TOE, Joint.LEFT_TOE]
_UP = np.array([[0.0, 0.0, 1.0]])
HEAD_M = 0.2146
"""The head's height that the face was designed for."""


@dataclass(frozen=True, eq=False)
class Stance:
    """What the frames follow from: `joints_m` (…, 21, 3), backs of the hands `palm` (…, 2, 3), the head's directions.

    All but `hands` may be of many instants. `hands` (2, 3, 3) turn from the axes of each hand to those of its line
    between wrist and fulcrum; `balls` (…, 2, 3) are where the soles bend.
    """

    joints_m: Vector
    palm: Vector
    facing: Vector
    head_up: Vector
    hands: Vector
    balls: Vector

    @classmethod
    def of(cls, pose: Pose, sole_m: tuple[float, float]) -> "Stance":
        """That of a pose of somebody whose ball of the foot is `sole_m` from ankle and toe."""
        hands = _hands(pose.holds)
        return cls(pose.joints_m, pose.palm, pose.facing, pose.head_up, hands, _balls(pose.joints_m, sole_m))

    @classmethod
    def of_rows(cls, rows: Vector, holds: tuple[Hold, Hold], sole_m: tuple[float, float]) -> "Stance":
        """Those of many poses, rows (n, fields) in the layout of `frame`, of one who holds sticks by `holds`."""
        joints_m, palm = rows[:, frame.JOINTS].reshape(-1, len(Joint), 3), rows[:, frame.PALM].reshape(-1, 2, 3)
        facing, head_up = rows[:, frame.FACING], rows[:, frame.HEAD_UP]
        return cls(joints_m, palm, facing, head_up, _hands(holds), _balls(joints_m, sole_m))


def _hands(holds: tuple[Hold, Hold]) -> Vector:
    return np.stack([_lines(hold.grip)[side] for side, hold in enumerate(holds)])


def sole_of(figure: Figure) -> tuple[float, float]:
    """From the ball of the foot to the ankle and to the toe."""
    behind = (BALL_ALONG - ANKLE_ALONG) * figure.foot_m
    return float(np.hypot(behind, figure.ankle_height_m)), (1 - BALL_ALONG) * figure.foot_m


def _balls(joints_m: Vector, sole_m: tuple[float, float]) -> Vector:
    """The balls of both feet, (…, 2, 3): under the line from ankle to toe, so far from both."""
    ankle, toe = joints_m[..., _ANKLES, :], joints_m[..., _TOES, :]
    way = toe - ankle
    reach = np.sqrt((way * way).sum(axis=-1, keepdims=True))
    way = way / reach
    behind, before = sole_m
    along = (reach**2 + behind**2 - before**2) / (2 * reach)
    under = way[..., 2:] * way - _UP
    under /= np.sqrt((under * under).sum(axis=-1, keepdims=True))
    return np.asarray(ankle + along * way + np.sqrt(np.maximum(behind**2 - along**2, 0.0)) * under)


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
    return Stance(
        j, palm, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]), _lines(_BIND_GRIP), _balls(j, sole_of(figure))
    )


def bone_frames(stance: Stance) -> Matrix:
    """The frame of every bone of `BODY_BONES`, (…, 20, 4, 4): z along the bone, a hand's as `hand_bones` says."""
    j = stance.joints_m
    origin, along, side = np.empty((3, *j.shape[:-2], len(BODY_BONES), 3))
    shoulders = j[..., Joint.RIGHT_SHOULDER, :] - j[..., Joint.LEFT_SHOULDER, :]
    hips = j[..., Joint.RIGHT_HIP, :] - j[..., Joint.LEFT_HIP, :]
    right = cross(stance.facing, stance.head_up)
    origin[..., _TRUNK, :] = j[..., _TRUNK_FROM, :]
    along[..., _TRUNK, :] = j[..., _TRUNK_TO, :] - j[..., _TRUNK_FROM, :]
    along[..., Bone.HEAD, :] = stance.head_up
    side[..., Bone.WAIST, :], side[..., Bone.CHEST, :] = unit(hips) + 0.5 * unit(shoulders), shoulders
    side[..., Bone.NECK, :], side[..., Bone.HEAD, :] = unit(shoulders) + right, right
    a, b, c, d = (j[..., column, :] for column in _LIMB_JOINTS.T)  # each (…, 4, 3): arms, then legs
    first, second, third = b - a, c - b, d - c
    hinge = cross(first, second)
    palm = cross(stance.palm, second[..., :2, :]), cross(stance.palm, third[..., :2, :])
    origin[..., _FIRST, :], along[..., _FIRST, :], side[..., _FIRST, :] = a, first, hinge
    origin[..., _SECOND, :], along[..., _SECOND, :], side[..., _SECOND, :] = b, second, hinge
    origin[..., _TWIST, :], along[..., _TWIST, :] = b[..., :2, :], second[..., :2, :]
    # half of the palm's turn: its other half is the wrist's
    side[..., _TWIST, :] = unit(palm[0]) - unit(hinge[..., :2, :])
    third[..., 2:, :] = stance.balls - c[..., 2:, :]
    origin[..., _THIRD, :], along[..., _THIRD, :] = c, third
    origin[..., _BEFORE_BALL, :], along[..., _BEFORE_BALL, :] = stance.balls, d[..., 2:, :] - stance.balls
    level = cross(third[..., 2:, :], _UP)  # soles lie flat, wherever the knees point
    side[..., _THIRD[:2], :], side[..., _THIRD[2:], :], side[..., _BEFORE_BALL, :] = palm[1], level, level
    flat = frames(origin.reshape(-1, 3), along.reshape(-1, 3), side.reshape(-1, 3))
    found = flat.reshape(*origin.shape[:-1], 4, 4)
    found[..., _HANDS, :3, :3] = found[..., _HANDS, :3, :3] @ stance.hands
    return found


_HANDS = [Bone.RIGHT_HAND, Bone.LEFT_HAND]
_BIND_GRIP = GRIPS["american"]
_MIRROR = np.diag([-1.0, 1.0, 1.0])
"""A left hand is a right one with x turned round."""


@lru_cache(maxsize=16)
def _lines(grip: Grip) -> Vector:
    """`Stance.hands` for two hands with `grip`."""
    turn = line_axes(grip.fulcrum)
    return np.stack([turn, _MIRROR @ turn @ _MIRROR])


def _moves(grip: Grip, scale: float) -> Matrix:
    """How the digits of both hands move in them from where the skin was made, (2, STEPS, 15, 4, 4), open to closed."""
    right = finger_frames(grip) @ np.linalg.inv(REST)
    right[..., :3, 3] *= scale
    left = right.copy()
    left[..., :3, :3] = _MIRROR @ right[..., :3, :3] @ _MIRROR
    left[..., 0, 3] *= -1
    return np.stack([right, left])


class Skeleton:
    """Turns poses into the matrices that carry the skin from where it was made."""

    def __init__(self, figure: Figure) -> None:
        self.bind = bind_stance(figure)
        self.frames = bone_frames(self.bind)
        self._sole_m = sole_of(figure)
        self._back = np.linalg.inv(self.frames)
        self.hand_scale = figure.hand_m / HAND_M
        self._face_scale = figure.head_m / HEAD_M
        self._moves: dict[str, Matrix] = {}

    def matrices(self, pose: Pose) -> Matrix:
        """One matrix a bone, (BONES, 4, 4)."""
        out = np.empty((BONES, 4, 4))
        now = bone_frames(Stance.of(pose, self._sole_m))
        out[: len(BODY_BONES)] = now @ self._back
        face = face_matrices(Expression.of(pose))
        face[:, :3, 3] *= self._face_scale
        out[len(BODY_BONES) : len(Bone)] = now[Bone.HEAD] @ face @ self._back[Bone.HEAD]
        for side, (hold, closed) in enumerate(zip(pose.holds, pose.fingers.tolist(), strict=True)):
            step, share = divmod(closed * (STEPS - 1), 1.0)
            moves = self._digits(hold.grip)[side]
            low, high = moves[int(step)], moves[min(int(step) + 1, STEPS - 1)]
            first = FINGERS[_HANDS[side]]
            out[first : first + len(low)] = now[_HANDS[side]] @ (low + share * (high - low))
        return out

    def _digits(self, grip: Grip) -> Matrix:
        """From where the skin was made to the digits in both hands' axes, (2, STEPS, 15, 4, 4), open to closed."""
        if grip.name not in self._moves:
            back = self._back[_HANDS][:, None, None]
            self._moves[grip.name] = _moves(grip, self.hand_scale) @ back
        return self._moves[grip.name]
