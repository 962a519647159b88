"""The skeleton of a motion-capture file, in metres, with the legs' joints under one set of names.

The CMU database counts in 1/0.45 inches in both its editions (its FAQ: "multiply by 2.54 / 0.45 for centimetres"); an
ASF file says so itself, a BVH file says nothing.
"""

from math import radians
from pathlib import Path

from station.core.errors import BadInput
from station.core.toml.schema import either
from station.sync.signals.amc import skeleton_beside
from station.sync.signals.asf import AsfSkeleton, Bone, read_asf
from station.sync.signals.bvh_motion import BONES, BvhMotion, read_bvh
from station.sync.walking.mocap_skeleton import Channel, Joint, Skeleton

INCH_M = 0.0254
BVH_UNIT_M = INCH_M / 0.45
"""That of the CMU database's BVH edition."""
FEET = {"RightFoot": "rfoot", "LeftFoot": "lfoot", "RightToeBase": "rtoes", "LeftToeBase": "ltoes"}
"""Joints of the BVH edition that are bones of the AMC edition, besides those of the phase's channels."""
_NAMES = BONES | FEET
_AXES = "xyz"
_ENDINGS = (".amc", ".bvh")


def skeleton_of(path: Path) -> Skeleton:
    """The skeleton that moves in the file at `path`; its channels are named as `read_signal` names them.

    Raises `BadInput`, also for a file without a skeleton, such as a table of numbers.
    """
    ending = path.suffix.lower()
    if ending == ".amc":
        return of_asf(read_asf(skeleton_beside(path)))
    if ending == ".bvh":
        return of_bvh(read_bvh(path))
    raise BadInput(path, "", f"holds no skeleton: expected a name that ends in {either(_ENDINGS)}")


def of_asf(asf: AsfSkeleton) -> Skeleton:
    """The joints at the bones' near ends; a bone that carries none has its own end as a joint, `rtoes_end`."""
    unit_m = INCH_M / asf.length_unit
    joints: list[Joint] = []
    numbers = {name: number for number, name in enumerate(asf.bones)}
    for bone in asf.bones.values():
        parent = -1 if bone.parent is None else numbers[bone.parent]
        offset = (0.0, 0.0, 0.0) if bone.parent is None else _end(asf.bones[bone.parent], unit_m)
        joints.append(Joint(bone.name, parent, offset, _rest(bone), *_moves(bone.name, _in_order(bone))))
    leaves = [name for name in asf.bones if not any(bone.parent == name for bone in asf.bones.values())]
    joints += [Joint(f"{name}_end", numbers[name], _end(asf.bones[name], unit_m)) for name in leaves]
    return Skeleton(tuple(joints), unit_m)


def of_bvh(motion: BvhMotion) -> Skeleton:
    """The joints of the file; the legs' have the names of the AMC edition."""
    numbers = {joint.name: number for number, joint in enumerate(motion.joints)}
    joints = []
    for joint in motion.joints:
        parent = -1 if joint.parent is None else numbers[joint.parent]
        x, y, z = joint.offset
        offset = (x * BVH_UNIT_M, y * BVH_UNIT_M, z * BVH_UNIT_M)
        channel_name = BONES.get(joint.name, joint.name)
        moves = _moves(channel_name, joint.channels)
        joints.append(Joint(_NAMES.get(joint.name, joint.name), parent, offset, (0.0, 0.0, 0.0), *moves))
    return Skeleton(tuple(joints), BVH_UNIT_M)


def skeleton_with_heels(path: Path) -> Skeleton:
    """A file's skeleton with its heels; raises `BadInput` where there are no legs."""
    try:
        return skeleton_of(path).with_heels()
    except KeyError as missing:
        raise BadInput(path, "", f"the skeleton has no {missing.args[0]}") from None


def _end(bone: Bone, unit_m: float) -> tuple[float, float, float]:
    x, y, z = bone.direction
    length_m = bone.length * unit_m
    return (x * length_m, y * length_m, z * length_m)


def _rest(bone: Bone) -> tuple[float, float, float]:
    x, y, z = bone.axis_deg
    return (radians(x), radians(y), radians(z))


def _in_order(bone: Bone) -> tuple[str, ...]:
    """A bone's freedoms in the order in which their matrices are multiplied: its axes' order backwards."""
    order = bone.axis_order.lower()
    return tuple(sorted(bone.freedoms, key=lambda freedom: -order.find(freedom[-1])))


def _moves(name: str, freedoms: tuple[str, ...]) -> tuple[tuple[Channel, ...], tuple[Channel, ...]]:
    """The channels that turn a joint and those that shift it."""
    channels = [Channel(f"{name}_{freedom}", _AXES.index(freedom[-1])) for freedom in freedoms]
    turns = tuple(each for each, freedom in zip(channels, freedoms, strict=True) if freedom[0] == "r")
    return turns, tuple(each for each in channels if each not in turns)
