"""What hands hold, as meshes on bones: sticks, brushes and mallets, of which one a hand is there at a time.

Each lies along z, butt at 0. A brush's wires have two bones, for they bend where they lie on a head. Bones count from
the first of the right hand's, `HELD_BONES` a hand, in the order of `STICK` … `FAR_WIRES`.
"""

import math
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.motion.kinematics.figure import Joint
from station.motion.kinematics.grip import HELD
from station.motion.kinematics.grip import STICK_RADIUS_M as R
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, joined, lathe, tube
from station.render.geometry.transforms import Matrix, Vector, cross

STICK_M = 0.406
"""A 5A stick (HUMANS, Kit); longer or shorter ones are stretched."""
BRUSH_M, MALLET_M = (HELD[name].length * STICK_M for name in ("brush", "mallet"))
HELD_BONES = 5
STICK, MALLET, HANDLE, NEAR_WIRES, FAR_WIRES = range(HELD_BONES)
HELD_PARTS = MappingProxyType(
    {
        "stick": ((STICK,), STICK_M),
        "mallet": ((MALLET,), MALLET_M),
        "brush": ((HANDLE, NEAR_WIRES, FAR_WIRES), BRUSH_M),
    }
)
"""By the names of `grip.HELD` the bones of what is held, and how long it is; a bare hand holds nothing."""
_HANDS = (Joint.RIGHT_HAND, Joint.LEFT_HAND)

_HANDLE_M = 0.165
_BEND_M = 0.5 * (_HANDLE_M + BRUSH_M)
_FAN_M = 0.046
"""Half as wide is a brush's fan at its end; common ones open to 9–12 cm."""
_WIRE_M = 0.0007
"""Half the thickness of a wire: thrice a real one's, else none would be seen (our choice)."""
_SAG_M, _SAG_SHARE, _PRESSED_FROM_M = 0.010, 0.7, 0.03
"""Pressed wires sag so far in their middle, at most by this share of its height, and begin to when the tip is so near
the head (our choice)."""
_FELT_M, _FELT_LONG = 0.015, 1.25
"""Half the thickness of a mallet's felt, and how much longer it is than thick."""


def stick(length: float) -> Mesh:
    """A 5A stick along z: butt at 0, tip at `length`; taper and acorn tip after a common 5A's drawing."""
    profile: NDArray[np.float64] = np.array(
        [
            (0.0, 0.0),
            (R * 0.8, 0.001),
            (R, 0.006),
            (R, length * 0.72),
            (R * 0.62, length * 0.93),
            (R * 0.40, length - 0.014),
            (R * 0.62, length - 0.009),
            (R * 0.60, length - 0.005),
            (R * 0.35, length - 0.001),
            (0.0, length),
        ]
    )
    return lathe(profile, 10, Material.WOOD)


def held_meshes(first: int, segments: int) -> list[Mesh]:
    """Everything that both hands may hold, on the bones from `first` on; `segments` a drum's circle is cut into."""
    wires = max(9, segments // 3)
    meshes = [(stick(STICK_M), STICK), (_mallet(), MALLET), (_handle(), HANDLE)]
    meshes += [(_wires(wires, _HANDLE_M, _BEND_M), NEAR_WIRES), (_wires(wires, _BEND_M, BRUSH_M), FAR_WIRES)]
    return [mesh.on_bone(first + HELD_BONES * hand + bone) for hand in (0, 1) for mesh, bone in meshes]


def _mallet() -> Mesh:
    top, r = MALLET_M, _FELT_M
    angle = np.linspace(-np.pi / 2, np.pi / 2, 9)
    felt = np.stack([r * np.cos(angle), top - _FELT_LONG * r * (1 - np.sin(angle))], axis=1)
    shaft = [(0.0, 0.0), (R * 0.9, 0.002), (R * 0.9, 0.6 * top), (R * 0.7, top - 2 * r)]
    return joined([lathe(shaft, 10, Material.WOOD), lathe(felt, 14, Material.FELT)])


def _handle() -> Mesh:
    end = _HANDLE_M
    grip = lathe([(0, 0), (R, 0.002), (R * 1.05, 0.5 * end), (R * 0.85, end - 0.02)], 10, Material.RUBBER)
    return joined([grip, lathe([(R * 0.7, end - 0.02), (R * 0.7, end), (0, end)], 10, Material.STEEL)])


def _wires(count: int, start: float, end: float) -> Mesh:
    """The wires of a fan from `start` to `end`, spread in the plane of x and z."""
    z = np.array([start, end])
    opened = (z - _HANDLE_M) / (BRUSH_M - _HANDLE_M)
    places = [
        np.stack([share * (0.5 * R + (_FAN_M - 0.5 * R) * opened), np.zeros(2), z], axis=1)
        for share in np.linspace(-1.0, 1.0, count)
    ]
    return joined([tube(path, _WIRE_M, Material.STEEL, 3) for path in places])


def held_matrices(pose: Pose | None, kit: Kit) -> Matrix:
    """A matrix for each bone of what is held, (2 · HELD_BONES, 4, 4): zero for what is not there."""
    m = np.zeros((2 * HELD_BONES, 4, 4))
    if pose is None:
        return m
    for hand, hold in enumerate(pose.holds):
        butt, tip, first = pose.butt_m[hand], pose.tip_m[hand], HELD_BONES * hand
        match hold.held.name:
            case "stick":
                m[first + STICK] = _stretched(butt, tip, 0.0, STICK_M)
            case "mallet":
                m[first + MALLET] = _on_its_felt(butt, tip, pose.joints_m[_HANDS[hand]])
            case "brush":
                m[first + HANDLE : first + HELD_BONES] = _brush(butt, tip, kit)
    return m


def _stretched(start: Vector, end: Vector, low: float, high: float, side: ArrayLike = (1.0, 0.0, 0.0)) -> Matrix:
    """What carries the stretch of z from `low` to `high` to the line between two points, x to one `side`."""
    way = end - start
    x, y, z = way.tolist()
    a, b, c = np.asarray(side).tolist()
    along = (a * x + b * y + c * z) / (x * x + y * y + z * z)
    a, b, c = a - along * x, b - along * y, c - along * z  # the side across the line; numbers outrun small arrays
    length, wide = math.sqrt(x * x + y * y + z * z), math.sqrt(a * a + b * b + c * c)
    a, b, c, grown = a / wide, b / wide, c / wide, 1 / (high - low)
    d, e, f = ((y * c - z * b) / length, (z * a - x * c) / length, (x * b - y * a) / length)
    x, y, z = x * grown, y * grown, z * grown
    i, j, k = start.tolist()
    rows = (a, d, x, i - low * x), (b, e, y, j - low * y), (c, f, z, k - low * z), (0.0, 0.0, 0.0, 1.0)
    return np.array(rows)


def _on_its_felt(butt: Vector, tip: Vector, hand: Vector) -> Matrix:
    """The felt's side, not its end, touches what the tip does: the mallet is turned up in the hand by as much."""
    ahead, behind = float(np.linalg.norm(tip - hand)), float(np.linalg.norm(butt - hand))
    up = _FELT_M * (1 - _FELT_LONG * float(hand[2] - tip[2]) / ahead)
    way = tip + np.array([0.0, 0.0, up]) - hand
    way /= np.linalg.norm(way)
    return _stretched(hand - behind * way, hand + ahead * way, 0.0, MALLET_M)


def _brush(butt: Vector, tip: Vector, kit: Kit) -> Matrix:
    """Handle, near and far wires, which sag onto the head on which they are pressed."""
    way = (tip - butt) / BRUSH_M
    press, normal = _pressed(tip, kit)
    start, middle, side = butt + _HANDLE_M * way, butt + _BEND_M * way, cross(way, normal)
    sag = press * min(_SAG_M, _SAG_SHARE * float((middle - tip) @ normal))
    bend = middle - sag * normal
    near, far = (_stretched(*part, side) for part in ((start, bend, _HANDLE_M, _BEND_M), (bend, tip, _BEND_M, BRUSH_M)))
    return np.stack([_stretched(butt, tip, 0.0, BRUSH_M), near, far])


def _pressed(tip: Vector, kit: Kit) -> tuple[float, Vector]:
    """How much the wires are pressed, 0 … 1, and the normal of what they lie on."""
    press, normal = 0.0, np.array([0.0, 0.0, 1.0])
    for piece in kit.pieces.values():
        away = tip - piece.centre
        over = abs(float(away @ piece.normal))
        if piece.kind != "kick" and over < _PRESSED_FROM_M and float(away @ away) < piece.radius_m**2:
            press, normal = max(press, 1 - over / _PRESSED_FROM_M), piece.normal
    return press, normal
