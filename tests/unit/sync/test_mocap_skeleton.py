"""Forward kinematics against positions worked out by hand."""

import numpy as np
import pytest

from station.sync.signals.asf import AsfSkeleton, Bone
from station.sync.signals.bvh_motion import BvhMotion
from station.sync.signals.bvh_motion import Joint as BvhJoint
from station.sync.signals.signal import Signal
from station.sync.walking.mocap_skeleton import Skeleton, about
from station.sync.walking.skeleton_of import of_asf, of_bvh

UNIT_M = 0.0254 / 0.45


def asf(*bones: Bone) -> Skeleton:
    root = Bone("root", freedoms=("tx", "ty", "tz", "rx", "ry", "rz"))
    return of_asf(AsfSkeleton({bone.name: bone for bone in (root, *bones)}, 0.45))


THIGH = Bone("thigh", (0.0, -1.0, 0.0), 8.0, freedoms=("rx", "ry", "rz"), parent="root")
SHANK = Bone("shank", (0.0, -1.0, 0.0), 7.0, freedoms=("rx",), parent="thigh")


def placed(skeleton: Skeleton, **channels: float) -> dict[str, np.ndarray]:
    """Where the joints are, in the file's own units."""
    places = skeleton.positions(tuple(channels), np.array([list(channels.values())], float).reshape(1, -1))[0]
    return dict(zip(skeleton.names, places / UNIT_M, strict=True))


@pytest.mark.parametrize(
    ("axis", "sends", "to"),
    [(0, (0, 1, 0), (0, 0, 1)), (1, (0, 0, 1), (1, 0, 0)), (2, (1, 0, 0), (0, 1, 0))],
)
def test_a_quarter_turn_is_right_handed(
    axis: int, sends: tuple[float, float, float], to: tuple[float, float, float]
) -> None:
    assert about(axis, np.array([np.pi / 2]))[0] @ np.array(sends) == pytest.approx(np.array(to), abs=1e-12)


def test_a_leg_hangs_at_rest() -> None:
    places = placed(asf(THIGH, SHANK))
    assert places["shank"] == pytest.approx([0, -8, 0])
    assert places["shank_end"] == pytest.approx([0, -15, 0])


def test_a_knee_that_bends_brings_the_foot_behind() -> None:
    """Thigh forward by 90° about −x, knee back by 90° about x: the shank hangs from a level thigh."""
    places = placed(asf(THIGH, SHANK), thigh_rx=-90.0, shank_rx=90.0)
    assert places["shank"] == pytest.approx([0, 0, 8], abs=1e-9)
    assert places["shank_end"] == pytest.approx([0, -7, 8], abs=1e-9)


def test_the_root_moves_in_the_files_units_and_turns_x_first() -> None:
    places = placed(asf(THIGH), root_tx=1.0, root_ty=2.0, root_tz=3.0, root_rx=90.0, root_rz=90.0)
    # (0, −8, 0) about x by 90° is (0, 0, −8), which a turn about z leaves
    assert places["thigh_end"] == pytest.approx([1, 2, -5], abs=1e-9)


def test_a_bones_angles_are_about_its_own_axes() -> None:
    """An axis turned by 90° about z makes the bone's x the room's y."""
    bone = Bone("arm", (1.0, 0.0, 0.0), 2.0, (0.0, 0.0, 90.0), freedoms=("rx",), parent="root")
    places = placed(asf(bone), arm_rx=90.0)
    assert places["arm_end"] == pytest.approx([0, 0, -2], abs=1e-9)


def test_bvh_channels_turn_in_the_order_written() -> None:
    """Z then X in the file: the X turn acts first on what hangs below."""
    joints = (
        BvhJoint("Hips", None, (0.0, 0.0, 0.0), ("tx", "ty", "tz", "rz", "rx")),
        BvhJoint("LeftUpLeg", "Hips", (1.0, 0.0, 0.0), ("rx",)),
        BvhJoint("LeftUpLeg End Site", "LeftUpLeg", (0.0, -4.0, 0.0), ()),
    )
    signal = Signal(np.zeros(1), ("Hips_rz",), np.zeros((1, 1)))
    skeleton = of_bvh(BvhMotion(joints, signal))
    places = placed(skeleton, Hips_rz=90.0, Hips_rx=90.0, lfemur_rx=-90.0)
    # the leg's turn undoes the hips' about x: it hangs along −y, which z turns to +x
    assert places["lfemur"] == pytest.approx([0, 1, 0], abs=1e-9)
    assert places["LeftUpLeg End Site"] == pytest.approx([4, 1, 0], abs=1e-9)


def legs() -> Skeleton:
    bones = []
    for side, x in (("r", -1.0), ("l", 1.0)):
        bones += [
            Bone(f"{side}hip", (x, 0.0, 0.0), 2.0, parent="root"),
            Bone(f"{side}femur", (0.0, -1.0, 0.0), 8.0, freedoms=("rx",), parent=f"{side}hip"),
            Bone(f"{side}tibia", (0.0, -1.0, 0.0), 8.0, freedoms=("rx",), parent=f"{side}femur"),
            Bone(f"{side}foot", (0.0, 0.0, 1.0), 2.0, freedoms=("rx",), parent=f"{side}tibia"),
            Bone(f"{side}toes", (0.0, 0.0, 1.0), 1.0, freedoms=("rx",), parent=f"{side}foot"),
        ]
    return asf(*bones)


def test_a_heel_lies_below_and_behind_the_ankle_and_goes_with_the_foot() -> None:
    skeleton = legs().with_heels()
    stature = 16 / 0.491
    rest = placed(skeleton)["rheel"]
    assert rest == pytest.approx([-2, -16 - 0.039 * stature, -0.25 * 0.152 * stature])
    raised = placed(skeleton, rfoot_rx=90.0)  # toes down: what was behind the ankle is above it
    assert raised["rheel"] == pytest.approx([-2, -16 + 0.25 * 0.152 * stature, -0.039 * stature], abs=1e-9)
    assert raised["lheel"] == pytest.approx(placed(skeleton)["lheel"])


def test_without_legs_there_are_no_heels() -> None:
    with pytest.raises(KeyError):
        asf(THIGH, SHANK).with_heels()
