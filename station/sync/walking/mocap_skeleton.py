"""Where the joints of a recorded body are: forward kinematics of motion capture, from angles in degrees to metres.

A joint stands `offset_m` from its parent, in the parent's axes; its own turn is R_rest · R(angles) · R_restᵀ on top of
its parent's. Where all angles are 0 every joint's axes are the room's: x to the body's left, y up, z forward.
So the bones of an ASF file (Acclaim, 1995: direction, length, axis) and the joints of a BVH file (Biovision) are one
thing; only the order in which the angles turn differs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
"""Positions in metres, shape (n, joints, 3)."""
Turns = NDArray[np.float64]
"""Rotation matrices, shape (n, 3, 3)."""

NO_PARENT = -1
LEG = 0.245 + 0.246
"""Thigh and shank as a share of stature (Winter 2009, after Drillis & Contini)."""
ANKLE_HEIGHT, FOOT_LENGTH = 0.039, 0.152
"""The ankle above the sole, the foot's length: shares of stature (the same source)."""
BEHIND_ANKLE = 0.25
"""So much of the foot's length lies behind the ankle (our choice; half of it moves contacts by 13 ms)."""
SIDES = ("r", "l")


@dataclass(frozen=True, slots=True)
class Channel:
    """A number that moves a joint: its name in the signal, and the axis (0 x, 1 y, 2 z) about or along which."""

    name: str
    axis: int


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint, or the end of a bone, which nothing turns.

    `rest_rad` turns the joint's axes for its angles: about x, then y, then z. `turns` (degrees) stand in the order in
    which their matrices are multiplied, the last one turning first; `shifts` are added to the place, in units of
    `Skeleton.unit_m`.
    """

    name: str
    parent: int = NO_PARENT
    offset_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rest_rad: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turns: tuple[Channel, ...] = ()
    shifts: tuple[Channel, ...] = ()


@dataclass(frozen=True, slots=True)
class Skeleton:
    """Joints, every parent before its children; `unit_m` is what the file's unit of length comes to in metres."""

    joints: tuple[Joint, ...]
    unit_m: float

    def __post_init__(self) -> None:
        assert all(joint.parent < k for k, joint in enumerate(self.joints)), "a parent comes before its children"

    @property
    def names(self) -> tuple[str, ...]:
        """The joints' names, in order."""
        return tuple(joint.name for joint in self.joints)

    def index(self, name: str) -> int:
        """The number of a joint; raises `KeyError` where there is none of that name."""
        for number, joint in enumerate(self.joints):
            if joint.name == name:
                return number
        raise KeyError(name)

    @property
    def bones(self) -> tuple[tuple[int, int], ...]:
        """Pairs of joints, parent and child, between which a line is a bone."""
        return tuple((joint.parent, k) for k, joint in enumerate(self.joints) if joint.parent != NO_PARENT)

    def at_rest(self) -> Points:
        """Where the joints are with every channel at 0, shape (joints, 3)."""
        rest: Points = self.positions((), np.zeros((1, 0)))[0]
        return rest

    def positions(self, names: Sequence[str], values: NDArray[np.float64]) -> Points:
        """Where the joints are: `values` (n, channels) of the channels `names`; a channel that is missing is 0."""
        columns = {name: values[:, k] for k, name in enumerate(names)}
        places: list[NDArray[np.float64]] = []
        turned: list[Turns] = []
        for joint in self.joints:
            place, turn = np.zeros((len(values), 3)), np.broadcast_to(np.eye(3), (len(values), 3, 3))
            if joint.parent != NO_PARENT:
                place, turn = places[joint.parent], turned[joint.parent]
            place = place + turn @ np.array(joint.offset_m)
            for shift in joint.shifts:
                if shift.name in columns:
                    place[:, shift.axis] += self.unit_m * columns[shift.name]
            places.append(place)
            turned.append(turn @ _own_turn(joint, columns) if joint.turns else turn)
        return np.stack(places, axis=1)

    def with_heels(self) -> "Skeleton":
        """The same with joints `rheel` and `lheel`, fixed to the feet; needs the legs by CMU's names.

        The heel lies below the ankle, along the shank of the body at rest, and behind it. Raises `KeyError` where a leg
        is missing.
        """
        rest, more = self.at_rest(), []
        for side in SIDES:
            hip, knee, ankle, ball = (self.index(side + bone) for bone in ("femur", "tibia", "foot", "toes"))
            shank = rest[ankle] - rest[knee]
            stature = (np.linalg.norm(rest[knee] - rest[hip]) + np.linalg.norm(shank)) / LEG
            down = shank / np.linalg.norm(shank)
            ahead = rest[ball] - rest[ankle]
            ahead = ahead - (ahead @ down) * down
            ahead /= np.linalg.norm(ahead)
            heel = stature * (ANKLE_HEIGHT * down - BEHIND_ANKLE * FOOT_LENGTH * ahead)
            more.append(Joint(side + "heel", ankle, (float(heel[0]), float(heel[1]), float(heel[2]))))
        return replace(self, joints=(*self.joints, *more))


def _own_turn(joint: Joint, columns: Mapping[str, NDArray[np.float64]]) -> Turns:
    rest = np.eye(3)
    for axis, angle in enumerate(joint.rest_rad):
        rest = about(axis, np.array([angle]))[0] @ rest
    turn: Turns = rest[None]
    for channel in joint.turns:
        if channel.name in columns:
            turn = turn @ about(channel.axis, np.radians(columns[channel.name]))
    return turn @ rest.T


def about(axis: int, angle_rad: NDArray[np.float64]) -> Turns:
    """Turns by `angle_rad` (n,) about a main axis (0 x, 1 y, 2 z), right-handed."""
    turns = np.zeros((len(angle_rad), 3, 3))
    b, c = (axis + 1) % 3, (axis + 2) % 3
    turns[:, axis, axis] = 1.0
    turns[:, b, b] = turns[:, c, c] = np.cos(angle_rad)
    turns[:, c, b] = np.sin(angle_rad)
    turns[:, b, c] = -turns[:, c, b]
    return turns
