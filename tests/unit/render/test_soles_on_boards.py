"""The shoes as they are drawn lie on the boards: whole with the heel down, bent at the ball with the heel up."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.figure.body import build_body
from station.render.figure.bones import Bone
from station.render.figure.skeleton import Skeleton
from station.render.figure.skin import Skin
from station.render.geometry.materials import Material

FIGURE = figure_of()
SCORE = Score.from_notes([Note(k * PPQ, Piece.KICK) for k in range(4)], TempoMap.constant(120))


@pytest.fixture(scope="module")
def skin() -> Skin:
    return build_body(FIGURE, 0.5)


@pytest.mark.parametrize("heel", ["down", "up"])
@pytest.mark.parametrize("time_s", [0.5, 0.94, 1.2])
def test_the_drawn_sole_is_on_the_kicks_board(heel: str, time_s: float, skin: Skin) -> None:
    pose = Drummer(SCORE, figure=FIGURE, style=Style(heel=heel)).pose(time_s)
    matrices = Skeleton(FIGURE).matrices(pose)
    sole = (skin.material == Material.SOLE) & (np.isin(skin.bones[:, 0], (Bone.RIGHT_FOOT, Bone.RIGHT_TOES)))
    at = np.hstack([skin.position[sole], np.ones((sole.sum(), 1))])
    carried = np.einsum("nk,nkij,nj->ni", skin.weights[sole], matrices[skin.bones[sole]], at)[:, :3]
    board = load_kit().pedals[Piece.KICK]
    raised = pose.footboard_rad[0]
    over = (carried - board.heel_m) @ [0.0, -np.sin(raised), np.cos(raised)]
    assert over.min() > -0.001, "not through the board"
    along = (carried[:, 1] - carried[:, 1].min()) / np.ptp(carried[:, 1])
    assert over[(along > 0.4) & (along < 0.8)].min() < 0.002, "the ball is on it, as finely as the sole is cut"
    back = over[along < 0.2].min()
    assert back < 0.001 if heel == "down" else back > 0.02
