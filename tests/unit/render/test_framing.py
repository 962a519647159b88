"""Named views: what must be seen lies in the picture, whatever the kit and the player."""

from functools import lru_cache
from itertools import product

import numpy as np
import pytest

from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Joint, figure_names, load_figure
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import kit_names, load_kit
from station.motion.style.style import Style
from station.render.framing import Stage, named
from tests.unit.render.scores import rock

ASPECTS = (4 / 3, 16 / 9, 2.54, 21 / 9)
"""Pictures, and 16:9 less the score."""
_BY_STATURE = sorted(figure_names(), key=lambda name: load_figure(name).stature_m)
CASES = list(product(kit_names(), (_BY_STATURE[0], _BY_STATURE[-1]), (0.0, 1.0)))


def places(points: np.ndarray, stage: Stage, view: NamedView, aspect: float) -> np.ndarray:
    """Where points (n, 3) lie in the picture, (n, 2), −1 … 1."""
    clip = np.column_stack([points, np.ones(len(points))]) @ named(view, stage).matrix(aspect).T
    assert (clip[:, 3] > 0).all(), "before the camera"
    return np.asarray(clip[:, :2] / clip[:, 3:])


@lru_cache(maxsize=2 * len(CASES))
def poses(stage: Stage) -> list[Pose]:
    drummer = Drummer(rock(2), stage.kit, stage.figure, Style(stand=stage.stand))
    return [drummer.pose(float(at_s)) for at_s in np.arange(0.0, 4.0, 0.21)]


@pytest.mark.parametrize(("kit", "figure", "stand"), CASES)
@pytest.mark.parametrize("view", [NamedView.FRONT, NamedView.SHOULDER, NamedView.TOP])
def test_wide_views_crop_no_piece(view: NamedView, kit: str, figure: str, stand: float) -> None:
    stage = Stage(load_kit(kit), load_figure(figure), stand)
    middles = np.array([piece.centre for piece in stage.kit.pieces.values()])
    reach = np.array([piece.radius_m for piece in stage.kit.pieces.values()])
    for side, aspect in product((-1, 1), ASPECTS):
        seen = places(middles + np.outer(reach * side, [1, 0, 0]), stage, view, aspect)
        assert np.abs(seen).max() < 1


@pytest.mark.parametrize(("kit", "figure", "stand"), CASES)
@pytest.mark.parametrize("view", [NamedView.FRONT, NamedView.SHOULDER, NamedView.TOP])
def test_wide_views_crop_neither_head_nor_sticks(view: NamedView, kit: str, figure: str, stand: float) -> None:
    stage = Stage(load_kit(kit), load_figure(figure), stand)
    for pose in poses(stage):
        body = np.array([pose.joints_m[j] for j in (Joint.CROWN, Joint.RIGHT_ELBOW, Joint.LEFT_ELBOW)])
        assert np.abs(places(np.concatenate([body, pose.tip_m]), stage, view, 2.54)).max() < 1


@pytest.mark.parametrize(("kit", "figure", "stand"), CASES)
def test_from_the_eyes_one_sees_what_hands_strike_but_beside_the_player(kit: str, figure: str, stand: float) -> None:
    stage = Stage(load_kit(kit), load_figure(figure), stand)
    beside = (Piece.KICK, Piece.FLOOR_TOM_2)  # the large kit's lies at the hip
    struck = np.array([piece.centre for word, piece in stage.kit.pieces.items() if word not in beside])
    assert np.abs(places(struck, stage, NamedView.EYES, 2.54)).max() < 0.95


@pytest.mark.parametrize(("kit", "figure", "stand"), CASES)
def test_the_eyes_are_before_the_face_and_no_farther_than_a_hand(kit: str, figure: str, stand: float) -> None:
    stage = Stage(load_kit(kit), load_figure(figure), stand)
    eye = np.array(named(NamedView.EYES, stage).eye)
    for pose in poses(stage):
        head = pose.joints_m[[Joint.HEAD, Joint.CROWN]].mean(axis=0)
        assert 0.09 < np.linalg.norm(eye - head) < 0.30


@pytest.mark.parametrize(("kit", "figure", "stand"), CASES)
def test_the_front_view_shows_the_face(kit: str, figure: str, stand: float) -> None:
    """No cymbal's middle is seen within a face's half height, 11 cm, of the face."""
    stage = Stage(load_kit(kit), load_figure(figure), stand)
    pose = poses(stage)[0]
    face = pose.joints_m[[Joint.HEAD, Joint.CROWN]].mean(axis=0)
    cymbals = [piece.centre for piece in stage.kit.pieces.values() if piece.kind == "cymbal"]
    eye = np.array(named(NamedView.FRONT, stage).eye)
    way = (face - eye) / np.linalg.norm(face - eye)
    beside = np.array(cymbals) - eye
    assert np.linalg.norm(beside - np.outer(beside @ way, way), axis=1).min() > 0.11
