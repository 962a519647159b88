import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.body.gaze import LEAD_S, GazeTargets, gaze_curve
from station.motion.drummer import Drummer
from station.motion.kinematics.frame import ANGLES, FACING
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.kinematics.splines import SplineChannels
from station.motion.style.style import Style
from tests.unit.motion.patterns import score_of

Array = NDArray[np.float64]
LEFT, RIGHT = [0.6, 0.3], [-0.6, 0.3]


def curve(
    strikes: Array, place: NDArray[np.int64], directions: list[list[float]], around: float = 0.0, seed: int = 1
) -> SplineChannels:
    """In bars of two seconds."""
    sights = GazeTargets(strikes, place, np.array(directions).reshape(-1, 2), np.full(len(strikes), 2.0))
    return gaze_curve(sights, np.array([around]), seed)


def test_the_head_leads_a_move_by_200_to_300_ms() -> None:
    strikes = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 4.0])
    place = np.array([0, 0, 0, 0, 0, 1])
    look = curve(strikes, place, [LEFT] * 5 + [RIGHT])
    assert look.at(4.0 - 0.2)[0] < -0.55
    assert look.at(4.0 - 0.3)[0] < -0.3
    assert look.at(4.0 - 0.9)[0] > 0.5  # still at home
    assert 0.2 <= LEAD_S <= 0.3


def test_it_never_follows_an_ostinato() -> None:
    strikes = np.arange(0, 8, 0.3)
    place = np.arange(len(strikes)) % 2
    look = curve(strikes, place, ([LEFT, RIGHT] * 20)[: len(strikes)])
    bearings = look.many(np.arange(1.5, 8, 0.02))[0]
    assert np.ptp(bearings) < 0.05


def test_looking_around_in_rests_repeats_with_its_seed() -> None:
    strikes = np.array([0.0, 5.0, 10.0, 15.0])
    place, direction = np.zeros(4, np.int64), [LEFT] * 4
    at = np.arange(0, 16, 0.1)
    first, second, other = (curve(strikes, place, direction, 1.0, seed).many(at)[0] for seed in (1, 1, 2))
    still = curve(strikes, place, direction).many(at)[0]
    assert (first == second).all()
    assert np.abs(first - other).max() > 0.05
    assert np.ptp(still) < 0.01 < np.ptp(first)


def test_no_strokes_no_looks() -> None:
    look = curve(np.zeros(0), np.zeros(0, np.int64), [], 0.5)
    assert look.at(3.0)[0] == 0.0


def test_what_comes_once_a_bar_is_an_ostinato_however_slow() -> None:
    strikes = np.arange(0.0, 20.0, 1.0)  # a snare once in a bar of two seconds, between strokes elsewhere
    look = curve(strikes, np.arange(20) % 2, [LEFT, RIGHT] * 10)
    assert np.ptp(look.many(np.arange(4.0, 16.0, 0.02))[0]) < 0.05


def test_the_face_is_turned_to_a_new_piece_a_quarter_second_before_it_is_struck() -> None:
    """Measured on the drummer: two bars of hi-hat at 100 bpm, then the floor tom on the right."""
    score = score_of([*((i, Piece.HIHAT) for i in range(0, 32, 2)), (32, Piece.FLOOR_TOM_1), (40, Piece.SNARE)])
    drummer = Drummer(score, style=Style(amplitude_neck=0, look_around=0))
    strike_s = 8 * 0.6
    at = strike_s + np.array([-1.5, -0.3, -0.2, 0.0])
    rows = drummer.rows(at)
    bearing = np.degrees(np.arctan2(-rows[:, FACING.start], rows[:, FACING.start + 1]))
    before, early, late, struck = bearing.tolist()
    assert before > 0 > struck
    assert struck < -20
    assert late == pytest.approx(struck, abs=4.0)  # arrived 200 ms before
    assert early < before - 0.5 * (before - struck)  # well under way 300 ms before
    twist = np.degrees(rows[:, ANGLES.start + ANGLE_NAMES.index("torso_twist")])
    assert abs(late - struck) < abs(twist[2] - twist[3]) + 4.0  # eyes and head lead, the torso follows


def test_a_groove_leaves_the_face_where_it_is() -> None:
    slow = score_of(
        [(i, p) for i in range(0, 128, 16) for p in (Piece.HIHAT,)] + [(8 + 16 * i, Piece.SNARE) for i in range(8)], 60
    )
    rows = Drummer(slow, style=Style(amplitude_neck=0, amplitude_twist=0, look_around=0, variation=0)).rows(
        np.arange(8.0, 28.0, 0.02)
    )
    turn = np.degrees(rows[:, ANGLES.start + ANGLE_NAMES.index("head_turn")])
    assert np.ptp(turn) < 3.0
