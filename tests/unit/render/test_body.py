"""The figure: its skin is whole, symmetrical, and goes where the joints go."""

import numpy as np
import pytest

from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kinematics.pose import Pose
from station.render.figure.body import build_body
from station.render.figure.bones import BONES, FACE_BONES, Bone
from station.render.figure.expression import Expression, face_matrices
from station.render.figure.skeleton import Skeleton, bind_stance, bone_frames
from station.render.geometry.materials import TABLE, Material, shader_table
from tests.unit.render.poses import pose_of

FIGURE = figure_of()
SKIN = build_body(FIGURE, 2.5)


def moved(shift: tuple[float, float, float]) -> Pose:
    return pose_of(FIGURE, joints_m=bind_stance(FIGURE).joints_m + np.array(shift))


def test_weights_add_up_and_no_corner_hangs_on_nothing() -> None:
    assert np.allclose(SKIN.weights.sum(axis=1), 1)
    assert SKIN.bones.max() < BONES
    assert SKIN.faces.max() < len(SKIN.position)
    assert ((SKIN.ao > 0) & (SKIN.ao <= 1)).all()


def test_the_figure_is_as_tall_as_it_sits() -> None:
    stance = bind_stance(FIGURE)
    crown = stance.joints_m[Joint.CROWN][2]
    assert crown < SKIN.position[:, 2].max() < crown + 0.06, "hair and headphones above the crown"
    assert abs(SKIN.position[:, 2].min() - stance.joints_m[Joint.RIGHT_TOE][2]) < 0.02, "the soles are its lowest"


def test_left_and_right_are_alike() -> None:
    """All but the face's smile and the quiff, which lean."""
    low = SKIN.position[SKIN.position[:, 2] < 1.0]
    assert low[:, 0].max() == pytest.approx(-low[:, 0].min(), abs=0.01)
    assert abs(low[:, 0].mean()) < 0.005


def test_normals_have_length_one() -> None:
    assert np.allclose(np.linalg.norm(SKIN.normal, axis=1), 1, atol=1e-6)


def test_in_its_own_pose_nothing_moves() -> None:
    matrices = Skeleton(FIGURE).matrices(pose_of(FIGURE))[: len(Bone)]
    assert np.allclose(matrices, np.eye(4), atol=1e-9)


def test_a_pose_says_what_the_face_shows() -> None:
    """In the pose in which the skin was made the head's axes are the world's."""
    pose = pose_of(FIGURE, face=(-0.5, 0.7, 0.3, 0.9), gaze=(0.2, 0.1), eyes=0.6)
    face = face_matrices(Expression(-0.5, 0.7, 0.3, 0.9, (0.2, 0.1), 0.6))
    turns = Skeleton(FIGURE).matrices(pose)[FACE_BONES, :3, :3]
    assert np.allclose(turns, face[:, :3, :3], atol=1e-9)


def test_when_the_body_moves_all_of_it_moves() -> None:
    matrices = Skeleton(FIGURE).matrices(moved((0.1, -0.2, 0.3)))[: len(Bone)]
    assert np.allclose(matrices[:, :3, 3], [0.1, -0.2, 0.3], atol=1e-9)


def test_bones_begin_at_their_joints_and_point_along() -> None:
    stance = bind_stance(FIGURE)
    frames = bone_frames(stance)
    assert np.allclose(frames[Bone.RIGHT_FOREARM][:3, 3], stance.joints_m[Joint.RIGHT_ELBOW])
    along = stance.joints_m[Joint.LEFT_KNEE] - stance.joints_m[Joint.LEFT_HIP]
    assert np.allclose(frames[Bone.LEFT_THIGH][:3, 2], along / np.linalg.norm(along))
    for m in frames:
        assert np.linalg.det(m[:3, :3]) == pytest.approx(1)


def test_segments_keep_their_lengths_in_the_bind_pose() -> None:
    j = bind_stance(FIGURE).joints_m
    assert np.linalg.norm(j[Joint.RIGHT_ELBOW] - j[Joint.RIGHT_SHOULDER]) == pytest.approx(FIGURE.upper_arm_m)
    assert np.linalg.norm(j[Joint.LEFT_ANKLE] - j[Joint.LEFT_KNEE]) == pytest.approx(FIGURE.shank_m)


def test_a_finer_skin_has_more_corners_on_the_same_body() -> None:
    fine = build_body(FIGURE, 1.5)
    assert len(fine.faces) > 1.5 * len(SKIN.faces)
    assert np.allclose(fine.position.max(axis=0), SKIN.position.max(axis=0), atol=0.02)


def test_every_material_has_a_look() -> None:
    assert set(TABLE) == set(Material)
    first, second = shader_table()
    assert first.shape == second.shape == (len(Material), 4)
    assert (first >= 0).all()
    assert (first <= 1).all()
