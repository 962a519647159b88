import math

import pytest

from station.motion.kinematics.figure import figure_of
from station.motion.kinematics.footings import footings
from station.motion.kinematics.leg import Footing, Place, leg
from station.motion.kinematics.maths import ONE
from station.motion.kinematics.trunk import TrunkAngles, trunk
from station.motion.kit.kit import Pedal, load_kit

FIGURE = figure_of()
PELVIS = (0.0, 0.0, 0.59)
UPRIGHT = TrunkAngles(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
BOARD = Pedal((0.2, 0.44, 0.03), (0.2, 0.71, 0.03), math.radians(20))
FOOTING = Footing.of(FIGURE, Place.on(BOARD, (0.34, 0.6, 0.72)))


def test_upright_the_shoulders_are_level_and_half_the_breadth_apart_from_the_neck() -> None:
    body = trunk(ONE, FIGURE, PELVIS, UPRIGHT)
    assert body.neck == pytest.approx((0.0, 0.0, 0.59 + FIGURE.trunk_m))
    assert body.right_shoulder == pytest.approx((FIGURE.shoulder_breadth_m / 2, 0.0, 0.59 + FIGURE.trunk_m))
    assert body.facing == pytest.approx((0.0, 1.0, 0.0))


def test_a_lean_brings_the_shoulders_lower_and_forward() -> None:
    body = trunk(ONE, FIGURE, PELVIS, UPRIGHT._replace(lean=0.2))
    assert body.right_shoulder[2] < 0.59 + FIGURE.trunk_m
    assert body.right_shoulder[1] > 0.05


def test_a_twist_to_the_left_brings_the_right_shoulder_forward() -> None:
    body = trunk(ONE, FIGURE, PELVIS, UPRIGHT._replace(twist=math.pi / 2))
    half = FIGURE.shoulder_breadth_m / 2
    assert body.right_shoulder == pytest.approx((0.0, half, 0.59 + FIGURE.trunk_m), abs=1e-9)


def test_the_head_nods_down_turns_left_and_tilts_right() -> None:
    body = trunk(ONE, FIGURE, PELVIS, UPRIGHT._replace(nod=0.3, turn=0.4, tilt=0.2))
    assert body.facing[2] == pytest.approx(-math.sin(0.3))
    assert body.facing[0] < 0
    assert body.crown[0] > body.head[0] - 0.05


def test_segments_keep_their_lengths_whatever_the_angles() -> None:
    body = trunk(ONE, FIGURE, PELVIS, TrunkAngles(0.3, 0.2, 0.1, 0.2, 0.3, 0.1, 0.0))
    assert math.dist(body.right_shoulder, body.left_shoulder) == pytest.approx(FIGURE.shoulder_breadth_m)
    assert math.dist(body.head, body.crown) == pytest.approx(FIGURE.head_m)


@pytest.mark.parametrize("board", [0.0, 0.2, 0.35])
@pytest.mark.parametrize("heel", [0.0, 0.4])
def test_thigh_and_shank_keep_their_lengths(board: float, heel: float) -> None:
    hip = (0.1, 0.0, 0.59)
    one = leg(ONE, FOOTING, hip, board, heel)
    assert math.dist(hip, one.knee) == pytest.approx(FIGURE.thigh_m)
    assert math.dist(one.knee, one.ankle) == pytest.approx(FIGURE.shank_m)


def test_the_right_knee_clears_the_snare() -> None:
    one = leg(ONE, footings(load_kit(), FIGURE)[0], (0.1, 0.0, 0.59), 0.3, 0.0)
    assert one.knee[0] >= 0.20  # HUMANS, Kit: knees at x >= +.20


def test_heel_up_lifts_the_thigh_and_leaves_the_ball_on_the_board() -> None:
    down, up = (leg(ONE, FOOTING, (0.1, 0.0, 0.59), 0.1, heel) for heel in (0.0, 0.4))
    assert up.knee[2] > down.knee[2] + 0.01
    assert up.ankle[2] > down.ankle[2] + 0.04
    assert up.toe == pytest.approx(down.toe)
