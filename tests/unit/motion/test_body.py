import numpy as np
import pytest

from station.motion.body import TWIST_RAD_S, limited, mean_bearing, sharpness
from station.motion.drummer import Drummer
from station.motion.frame import ANGLES
from station.motion.pose import ANGLE_NAMES
from station.motion.style import Style
from tests.unit.motion.patterns import ROCK, score_of

RNG = np.random.default_rng(7)


def angle(drummer: Drummer, name: str, at: np.ndarray) -> np.ndarray:
    return drummer.rows(at)[:, ANGLES.start + ANGLE_NAMES.index(name)]


def test_the_speed_ceiling_holds_and_gentle_turns_stay() -> None:
    times = np.sort(RNG.uniform(0, 60, 400))
    wild = RNG.uniform(-1, 1, 400)
    turned = limited(times, wild, 0.8)
    assert (np.abs(np.diff(turned)) <= 0.8 * np.diff(times) + 1e-9).all()
    gentle = 0.3 * np.sin(times)
    assert limited(times, gentle, 0.8) == pytest.approx(gentle)


def test_the_ceiling_looks_ahead() -> None:
    times = np.array([0.0, 1.0, 2.0, 3.0])
    turned = limited(times, np.array([0.0, 0.0, 1.0, 1.0]), 0.5)
    assert turned[1] > 0.1  # it has begun to turn a second before
    assert turned.tolist() == pytest.approx([0.0, 0.25, 0.75, 1.0])


def test_both_hands_at_once_face_between_them() -> None:
    strikes = np.repeat(np.arange(0, 6, 0.5), 2)
    facing = mean_bearing(np.array([2.0, 3.25]), strikes, np.tile([0.4, -0.2], 12))
    assert facing == pytest.approx([0.1, 0.1])


def test_in_a_long_rest_the_torso_turns_back() -> None:
    facing = mean_bearing(np.array([0.0, 5.0, 10.0]), np.array([0.0, 10.0]), np.array([0.5, 0.5]))
    assert facing[1] == pytest.approx(0.0)
    assert min(facing[0], facing[2]) > 0.3


def test_alternating_pieces_are_faced_in_the_middle() -> None:
    strikes = np.arange(0, 10, 0.25)
    bearing = np.where(np.arange(len(strikes)) % 2 == 0, 0.5, -0.5)
    assert np.abs(mean_bearing(np.arange(2.0, 8.0, 0.5), strikes, bearing)).max() < 0.12


def test_a_higher_frequency_turns_sharper_on_the_beat() -> None:
    assert sharpness(np.array([1.0]))[0] == 0.0
    assert -1.0 < sharpness(np.array([2.0]))[0] < sharpness(np.array([1.5]))[0] < 0.0
    assert sharpness(np.array([0.5]))[0] > 0.0


def test_the_back_sways_forward_on_the_beat_and_up_between() -> None:
    drummer = Drummer(score_of([(4 * i, p) for i in range(32) for p in (1,)], tempo_bpm=100))  # type: ignore[misc]
    beats = 0.6 * np.arange(4, 20)
    on, between = angle(drummer, "torso_lean", beats), angle(drummer, "torso_lean", beats + 0.3)
    assert (on - between).min() > np.radians(2.0)


def test_above_130_bpm_it_sways_in_half_time() -> None:
    drummer = Drummer(score_of(ROCK * 1, tempo_bpm=150))
    lean = angle(drummer, "torso_lean", 0.4 * np.arange(4))
    assert lean[0] > lean[1] + np.radians(1.5)
    assert lean[2] > lean[1] + np.radians(1.5)


def test_the_torso_turns_no_faster_than_its_ceiling() -> None:
    wide = [(i, piece) for i in range(0, 64, 4) for piece in ((13,) if i % 8 else (5,))]  # floor tom, crash
    drummer = Drummer(score_of(wide, tempo_bpm=140))  # type: ignore[arg-type]
    at = np.arange(0, 6, 0.01)
    speed = np.abs(np.gradient(angle(drummer, "torso_twist", at), at))
    assert speed.max() < 1.5 * TWIST_RAD_S  # a spline through keys that keep the ceiling


def test_bobs_on_half_beats() -> None:
    score = score_of(ROCK)
    whole, half = (Drummer(score, style=Style(bobs_per_beat=n, amplitude_gaze=0)) for n in (1, 2))
    between = 0.3 + 0.6 * np.arange(3)
    assert angle(half, "head_nod", between).mean() > angle(whole, "head_nod", between).mean() + np.radians(0.5)
