"""Biovision motion (`.bvh`): joints with their offsets, and the angles of every frame.

The format: M. Meredith and S. Maddock, "Motion Capture File Formats Explained", University of Sheffield CS-01-11, 2001.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from station.core.counts import is_count
from station.core.errors import BadInput
from station.sync.signals.signal import FloatArray, Signal
from station.sync.signals.signal_text import SHORTEST_S, numbered_lines, numbers

Vector = tuple[float, float, float]
Lines = Iterator[tuple[int, str]]
END_SITE = "End Site"
_LONGEST_S = 100.0
"""From frame to frame (our choice): in no file that can be read do times then grow too large for nanoseconds."""
BONES = {"RightUpLeg": "rfemur", "LeftUpLeg": "lfemur", "RightLeg": "rtibia", "LeftLeg": "ltibia"}
"""Joints of the CMU database's BVH edition that are bones of its AMC edition; their angles differ by constants."""
_KINDS = {
    f"{axis}{kind}": f"{kind[0].replace('p', 't')}{axis.lower()}" for axis in "XYZ" for kind in ("position", "rotation")
}


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint: `offset` from its parent (None of the root) in the file's unit; `channels` such as rz, in their order.

    The end of a limb is a joint of its own without channels, called after its parent: `LeftToeBase End Site`.
    """

    name: str
    parent: str | None
    offset: Vector
    channels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class BvhMotion:
    """Joints, every parent before its children, and the signal of their channels, such as `lfemur_rx` and `Hips_tx`."""

    joints: tuple[Joint, ...]
    signal: Signal


def read_bvh(path: Path) -> BvhMotion:
    """The motion of a file, angles in degrees. A rest pose that stands as a frame before the motion is left out.

    Raises `BadInput`.
    """
    lines = iter(list(numbered_lines(path, "a BVH motion")))
    _expect(lines, "HIERARCHY", path)
    joints = _joints(lines, path)
    names = tuple(f"{BONES.get(joint.name, joint.name)}_{each}" for joint in joints for each in joint.channels)
    values, interval_s = _frames(lines, len(names), path)
    values = values[_rest_frames(values, names) :]
    return BvhMotion(joints, Signal(np.arange(len(values), dtype=np.float64) * interval_s, names, values, str(path)))


def _rest_frames(values: FloatArray, names: tuple[str, ...]) -> int:
    """1 where the first frame is a rest pose, whose angles are whole degrees, unlike the second's.

    So begins every file of the CMU database's BVH edition.
    """
    if len(values) < 2:
        return 0
    angles = values[:2, [name[-2] == "r" for name in names]]
    is_whole = (angles % 1.0 == 0).all(axis=1)
    return int(is_whole[0] and not is_whole[1])


# --- the joints -------------------------------------------------------------------------------------------------------


def _joints(lines: Lines, path: Path) -> tuple[Joint, ...]:
    joints: list[Joint] = []
    open_joints: list[str] = []
    names: set[str] = set()
    for line, text in lines:
        kind, *words = text.split()
        if kind == "}" and open_joints:
            open_joints.pop()
            if not open_joints:
                return tuple(joints)
            continue
        parent = open_joints[-1] if open_joints else None
        name = _joint_name(kind, words, parent, path, line)
        if name in names:
            raise BadInput(path, f"line {line}", f"{name} is here twice")
        names.add(name)
        _expect(lines, "{", path)
        offset = _offset(lines, path)
        channels = () if kind == "End" else _channels(lines, path)
        joints.append(Joint(name, parent, offset, channels))
        open_joints.append(name)
    raise BadInput(path, "", "the joints do not end; expected } and MOTION")


def _joint_name(kind: str, words: list[str], parent: str | None, path: Path, line: int) -> str:
    expected = "ROOT" if parent is None else "JOINT"
    if kind == "End" and words == ["Site"] and parent is not None:
        return f"{parent} {END_SITE}"
    if kind != expected or not words:
        raise BadInput(path, f"line {line}", f"expected {expected} and a name, found {kind}")
    return " ".join(words)


def _offset(lines: Lines, path: Path) -> Vector:
    line, words = _entry(lines, "OFFSET", path)
    if len(words) != 3:
        raise BadInput(path, f"line {line}", f"expected 3 numbers, found {len(words)}")
    x, y, z = numbers(words, path, line)
    return x, y, z


def _channels(lines: Lines, path: Path) -> tuple[str, ...]:
    line, words = _entry(lines, "CHANNELS", path)
    strange = next((word for word in words[1:] if word not in _KINDS), None)
    if strange is not None:
        raise BadInput(path, f"line {line}", f"no such channel: {strange}; expected one of {', '.join(_KINDS)}")
    if words[:1] != [str(len(words) - 1)]:
        raise BadInput(
            path, f"line {line}", f"expected the number of channels and their names, found {' '.join(words)}"
        )
    return tuple(_KINDS[word] for word in words[1:])


# --- the frames -------------------------------------------------------------------------------------------------------


def _frames(lines: Lines, width: int, path: Path) -> tuple[FloatArray, float]:
    """The frames (n, `width`), and the seconds between two."""
    _expect(lines, "MOTION", path)
    line, words = _entry(lines, "Frames:", path)
    if len(words) != 1 or not is_count(words[0]):
        raise BadInput(path, f"line {line}", "expected the number of frames")
    count = int(words[0])
    line, words = _entry(lines, "Frame", path)
    interval_s = numbers(words[1:], path, line)[0] if len(words) == 2 and words[0] == "Time:" else 0.0
    if not SHORTEST_S <= interval_s <= _LONGEST_S:
        fault = f"expected Frame Time: and seconds from {SHORTEST_S:g} to {_LONGEST_S:g}"
        raise BadInput(path, f"line {line}", fault)
    rows = [_row(text.split(), width, path, at) for at, text in lines]
    if len(rows) != count:
        raise BadInput(path, f"line {line - 1}", f"{count} frames announced, {len(rows)} found")
    return np.array(rows, dtype=np.float64).reshape(len(rows), width), interval_s


def _row(words: list[str], width: int, path: Path, line: int) -> list[float]:
    if len(words) != width:
        raise BadInput(path, f"line {line}", f"expected {width} numbers, found {len(words)}")
    return numbers(words, path, line)


def _entry(lines: Lines, key: str, path: Path) -> tuple[int, list[str]]:
    """Number and words of the next line, which begins with `key`."""
    line, text = next(lines, (0, ""))
    words = text.split()
    if words[:1] != [key]:
        place = f"line {line}" if line else "the end"
        raise BadInput(path, place, f"expected {key}, found {words[0] if words else 'nothing'}")
    return line, words[1:]


def _expect(lines: Lines, word: str, path: Path) -> None:
    _entry(lines, word, path)
