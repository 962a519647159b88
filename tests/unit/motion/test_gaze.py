import numpy as np

from station.motion.gaze import LEAD_S, gaze_curve

LEFT, RIGHT = [0.6, 0.3], [-0.6, 0.3]


def test_the_head_leads_a_move_by_200_to_300_ms() -> None:
    strikes = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 4.0])
    place = np.array([0, 0, 0, 0, 0, 1])
    look = gaze_curve(strikes, place, np.array([LEFT] * 5 + [RIGHT]), 0.0, 1)
    assert look.at(4.0 - 0.2)[0] < -0.55
    assert look.at(4.0 - 0.3)[0] < -0.3
    assert look.at(4.0 - 0.9)[0] > 0.5  # still at home
    assert 0.2 <= LEAD_S <= 0.3


def test_it_never_follows_an_ostinato() -> None:
    strikes = np.arange(0, 8, 0.3)
    place = np.arange(len(strikes)) % 2
    look = gaze_curve(strikes, place, np.array([LEFT, RIGHT] * 20)[: len(strikes)], 0.0, 1)
    bearings = look.many(np.arange(1.5, 8, 0.02))[0]
    assert np.ptp(bearings) < 0.05


def test_looking_around_in_rests_repeats_with_its_seed() -> None:
    strikes = np.array([0.0, 5.0, 10.0, 15.0])
    place, direction = np.zeros(4, np.int64), np.array([LEFT] * 4)
    at = np.arange(0, 16, 0.1)
    first, second, other = (gaze_curve(strikes, place, direction, 1.0, seed).many(at)[0] for seed in (1, 1, 2))
    still = gaze_curve(strikes, place, direction, 0.0, 1).many(at)[0]
    assert (first == second).all()
    assert np.abs(first - other).max() > 0.05
    assert np.ptp(still) < 0.01 < np.ptp(first)


def test_no_strokes_no_looks() -> None:
    look = gaze_curve(np.zeros(0), np.zeros(0, np.int64), np.zeros((0, 2)), 0.5, 1)
    assert look.at(3.0)[0] == 0.0
