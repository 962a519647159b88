"""A face shows what it is told: each expected direction is what the muscles of a face do (Ekman & Friesen's units)."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.motion.kinematics.look import Girths
from station.render.figure.bones import FACE_BONES, Bone
from station.render.figure.expression import (
    BROW_M,
    EYE_M,
    LID_OPEN_RAD,
    LOWER_LID_RAD,
    MOUTH_M,
    Expression,
    face_matrices,
)
from station.render.figure.face import face_skins
from station.render.geometry.materials import Material

REST = Expression(smile=0.0)
LEFT = np.array([-1.0, 1.0, 1.0])
IRIS = EYE_M + np.array([0.0, 0.0185, 0.0])
INNER_BROW = BROW_M - np.array([0.020, 0.0, 0.0])


def carried(shown: Expression, bone: Bone, point: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where `bone` carries a point of the face as it was made."""
    m = face_matrices(shown)[FACE_BONES.index(bone)]
    return np.asarray(m[:3, :3] @ point + m[:3, 3])


def lid(bone: Bone, edge_rad: float) -> NDArray[np.float64]:
    """The middle of a lid's edge."""
    return EYE_M + 0.0197 * np.array([0.0, np.cos(edge_rad), np.sin(edge_rad)])


def opening_m(shown: Expression) -> float:
    """How far the lids stand apart."""
    upper = carried(shown, Bone.UPPER_LIDS, lid(Bone.UPPER_LIDS, LID_OPEN_RAD))
    return float(upper[2] - carried(shown, Bone.LOWER_LIDS, lid(Bone.LOWER_LIDS, LOWER_LID_RAD))[2])


def test_a_blank_face_is_as_it_was_made() -> None:
    assert np.allclose(face_matrices(REST), np.eye(4), atol=1e-12)


def test_every_bone_turns_without_stretching() -> None:
    for shown in (Expression(1, 1, 1, 1, (0.5, 0.5)), Expression(-1, 1, -1, 1, (-0.5, -0.5), 0.0)):
        turns = face_matrices(shown)[:, :3, :3]
        assert np.allclose(turns @ turns.transpose(0, 2, 1), np.eye(3), atol=1e-12)


@pytest.mark.parametrize("sides", [(Bone.RIGHT_BROW, 1.0), (Bone.LEFT_BROW, -1.0)])
def test_brows_rise_and_frown(sides: tuple[Bone, float]) -> None:
    """Units 1 + 2 raise them; unit 4 lowers them and draws their inner ends together."""
    bone, side = sides
    inner = INNER_BROW * [side, 1.0, 1.0]
    raised, frowning = (carried(replace(REST, brow=b), bone, inner) - inner for b in (1.0, -1.0))
    assert raised[2] > 0.005
    assert frowning[2] < -0.005
    assert side * frowning[0] < -0.001


def test_a_mouth_opens_downward_and_its_chin_goes_along() -> None:
    """Units 26 and 27: the jaw drops, the upper lip hardly moves."""
    shown = replace(REST, mouth=1.0)
    chin = np.array([0.0, 0.09, 0.005])
    assert carried(shown, Bone.LOWER_LIP, MOUTH_M)[2] < MOUTH_M[2] - 0.012
    assert carried(shown, Bone.JAW, chin)[2] < chin[2] - 0.010
    assert abs(carried(shown, Bone.UPPER_LIP, MOUTH_M)[2] - MOUTH_M[2]) < 0.004


def test_a_smile_lifts_and_parts_the_corners_and_sadness_lowers_them() -> None:
    """Unit 12 draws the corners up and out, unit 15 down."""
    for bone, side in ((Bone.RIGHT_CORNER, 1.0), (Bone.LEFT_CORNER, -1.0)):
        corner = MOUTH_M * [side, 1.0, 1.0]
        glad, sad = (carried(replace(REST, smile=s), bone, corner) - corner for s in (1.0, -1.0))
        assert glad[2] > 0.004
        assert side * glad[0] > 0.002
        assert sad[2] < -0.004


def test_effort_narrows_the_eyes_and_a_smile_a_little() -> None:
    """Units 6 and 7 tighten the lids."""
    rest, tense, glad = (opening_m(s) for s in (REST, replace(REST, effort=1.0), replace(REST, smile=1.0)))
    assert tense < 0.8 * rest
    assert tense < glad < rest


@pytest.mark.parametrize("effort", [0.0, 1.0])
@pytest.mark.parametrize("down", [-0.3, 0.0, 0.4])
def test_shut_eyes_are_shut_whatever_the_face_does(effort: float, down: float) -> None:
    shown = replace(REST, effort=effort, gaze=(0.0, down), eyes=0.0)
    assert opening_m(shown) < 0.002
    half = opening_m(replace(shown, eyes=0.5))
    assert opening_m(shown) < half < opening_m(replace(shown, eyes=1.0))


def test_eyes_turn_where_they_look_and_the_upper_lids_follow_down() -> None:
    for bone, side in ((Bone.RIGHT_EYE, 1.0), (Bone.LEFT_EYE, -1.0)):
        iris = IRIS * [side, 1.0, 1.0]
        left, down = (carried(replace(REST, gaze=g), bone, iris) - iris for g in ((0.3, 0.0), (0.0, 0.3)))
        assert left[0] == pytest.approx(-0.0185 * np.sin(0.3))  # left is −x
        assert down[2] == pytest.approx(-0.0185 * np.sin(0.3))
    assert opening_m(replace(REST, gaze=(0.0, 0.3))) < opening_m(REST)


@pytest.mark.parametrize("fineness", [1.0, 3.0])
def test_nothing_of_the_eye_looks_through_shut_lids(fineness: float) -> None:
    """All that turns with the eye lies deeper than the lids do, their triangles' middles included."""
    skins = face_skins(Girths(), fineness)
    lids = [s for s in skins if s.bones[0, 0] == Bone.UPPER_LIDS and s.material[0] == Material.SKIN]
    eyes = [s for s in skins if s.bones[0, 0] in (Bone.RIGHT_EYE, Bone.LEFT_EYE)]
    assert len(lids) == len(eyes) == 2
    deepest_lid = min(_depth(s.position[s.faces].mean(axis=1)).min() for s in lids)
    assert max(_depth(s.position).max() for s in eyes) < deepest_lid


def _depth(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far points are from the middle of the eye on their side."""
    return np.asarray(np.linalg.norm(points * np.where(points[:, :1] < 0, LEFT, 1.0) - EYE_M, axis=1))
