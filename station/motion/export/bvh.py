"""The motion as BVH: a tree of joints with Euler angles, which most animation programs read.

Centimetres and degrees, y up, the figure faces +z (`skeleton`). Every joint has the channels Z, X, Y of rotation; the
pelvis, shoulders, hips and sticks have positions too, for they move against their parents: shoulders shrug and reach,
sticks pivot in the hand.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.motion.drummer import Drummer
from station.motion.export.joint_tree import BONES, STICKS, JointTree, local, skeleton

Array = NDArray[np.float64]

CM = 100.0
_HELD = {"right_hand": STICKS[0], "left_hand": STICKS[1]}
_MOVED = {"pelvis", "right_upper_arm", "left_upper_arm", "right_thigh", "left_thigh", *STICKS}
"""Joints whose place against their parent changes; a stick pivots at the fulcrum, and may be tossed."""
_ROTATIONS = "Zrotation Xrotation Yrotation"


def write_bvh(drummer: Drummer, path: Path, time_s: Array) -> None:
    """Write the poses at the evenly spaced `time_s` (n,) whole to `path`; raises `DeviceError` if the disk refuses."""
    write_whole(path, bvh_text(drummer, time_s).encode())


def bvh_text(drummer: Drummer, time_s: Array) -> str:
    """The file's text."""
    stick_m = drummer.figure.stick_m
    bones = skeleton(drummer.rows(time_s), drummer.figure, stick_m)
    columns: list[Array] = []
    lines = ["HIERARCHY", *_joint(bones, "pelvis", 0, columns)]
    step = float(time_s[1] - time_s[0]) if len(time_s) > 1 else 1 / 60
    lines += ["MOTION", f"Frames: {len(time_s)}", f"Frame Time: {step:.8f}"]
    table = np.concatenate(columns, axis=1)
    lines += [" ".join(f"{v:.5f}" for v in row) for row in table.tolist()]
    return "\n".join(lines) + "\n"


def _joint(bones: JointTree, name: str, depth: int, columns: list[Array]) -> list[str]:
    """The lines of a joint and all below it; its channels are appended to `columns`."""
    place, turn = _stick_in_hand(bones, name) if name in STICKS else local(bones, name)
    offset = place.mean(0) * CM
    pad = "  " * depth
    moved = name in _MOVED
    channels = f"6 Xposition Yposition Zposition {_ROTATIONS}" if moved else f"3 {_ROTATIONS}"
    columns += [place * CM, _euler_zxy(turn)] if moved else [_euler_zxy(turn)]
    lines = [f"{pad}{'JOINT' if depth else 'ROOT'} {name}", pad + "{", f"{pad}  OFFSET {_numbers(offset)}"]
    lines.append(f"{pad}  CHANNELS {channels}")
    children = [bone.name for bone in BONES if bone.parent == name] + ([_HELD[name]] if name in _HELD else [])
    for child in children:
        lines += _joint(bones, child, depth + 1, columns)
    if not children:
        lines += [f"{pad}  End Site", pad + "  {", f"{pad}    OFFSET {_numbers(_end(bones, name))}", pad + "  }"]
    return [*lines, pad + "}"]


def _stick_in_hand(bones: JointTree, name: str) -> tuple[Array, Array]:
    """A stick against its hand, from its butt on."""
    hand = next(h for h, stick in _HELD.items() if stick == name)
    back = np.swapaxes(bones.rotation[hand], 1, 2)
    return np.einsum("nij,nj->ni", back, bones.start_m[name] - bones.start_m[hand]), back @ bones.rotation[name]


def _end(bones: JointTree, name: str) -> Array:
    rest = next((bone.rest for bone in BONES if bone.name == name), (0.0, 0.0, 1.0))
    return np.array(rest) * bones.length_m[name] * CM


def _euler_zxy(turn: Array) -> Array:
    """Degrees (n, 3) about z, x, y with R = Rz Rx Ry, each as near to the one before as there is.

    Every rotation has two such triples, (z, x, y) and (z + 180°, 180° − x, y + 180°), and those that differ by turns.
    """
    x = np.arcsin(np.clip(turn[:, 2, 1], -1.0, 1.0))
    z = np.arctan2(-turn[:, 0, 1], turn[:, 1, 1])
    y = np.arctan2(-turn[:, 2, 0], turn[:, 2, 2])
    angles: Array = np.degrees(np.stack([z, x, y], 1))
    for before, now in pairwise(angles):
        here = now + 360 * np.round((before - now) / 360)
        other = _FLIPPED + _FLIP * now
        other += 360 * np.round((before - other) / 360)
        now[:] = here if np.abs(here - before).sum() <= np.abs(other - before).sum() else other
    return angles


_FLIPPED, _FLIP = np.array([180.0, 180.0, 180.0]), np.array([1.0, -1.0, 1.0])


def _numbers(values: Array) -> str:
    return " ".join(f"{v:.5f}" for v in values.tolist())
