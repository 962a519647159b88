"""What a sensor on the drummer's stick measures, against physics."""

import numpy as np
import pytest

from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.core.pieces import Limb
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.sync.drill.stick_signals import GRID_HZ, StickSignals, stick_signals


@pytest.fixture(scope="module")
def drummer() -> Drummer:
    return Drummer(find_lesson("single-paradiddle").score)


@pytest.fixture(scope="module")
def played(drummer: Drummer) -> StickSignals:
    return stick_signals(drummer, 0.5, 2.5, rate_hz=GRID_HZ)


def test_a_stick_on_the_lap_feels_one_g_upwards_and_does_not_turn(drummer: Drummer) -> None:
    """The drummer breathes, which turns a stick by less than a degree a second."""
    resting = stick_signals(drummer, -6.0, -5.0)
    assert np.linalg.norm(resting.force_m_s2, axis=2) == pytest.approx(STANDARD_GRAVITY_M_S2, abs=0.02)
    up = np.einsum("nsij,nsj->nsi", resting.turn, resting.force_m_s2)
    assert up[:, :, 2] == pytest.approx(STANDARD_GRAVITY_M_S2, abs=0.02)


def test_the_rates_added_up_are_the_turn(played: StickSignals) -> None:
    """Rodrigues' rotations of the rates, one after the other, take the first axes to the last."""
    for side in (0, 1):
        turn = played.turn[0, side]
        for rate in played.rate_rad_s[:-1, side]:
            turn = turn @ rotated(rate / GRID_HZ)
        apart = np.arccos(np.clip((np.trace(turn.T @ played.turn[-1, side]) - 1) / 2, -1, 1))
        assert apart < np.radians(1.5)


def rotated(vector: np.ndarray) -> np.ndarray:
    angle = float(np.linalg.norm(vector))
    if angle == 0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def test_the_force_added_up_twice_is_the_way_of_the_sensor(drummer: Drummer, played: StickSignals) -> None:
    """∬ (R f − g) dt² from where the sensor was, as fast as it was, leads to where it is."""
    rows = drummer.rows(played.time_s)
    butt, tip = rows[:, frame.BUTT][:, :3], rows[:, frame.TIP][:, :3]
    place = butt + 0.076 * (tip - butt) / 0.406
    pull = np.einsum("nij,nj->ni", played.turn[:, 0], played.force_m_s2[:, 0])
    pull[:, 2] -= 9.80665
    speed = (place[20] - place[0]) * GRID_HZ / 20  # at the middle of the first ten milliseconds
    speeds = speed + np.cumsum(pull[10:], axis=0) / GRID_HZ
    ways = place[10] + np.cumsum(speeds, axis=0) / GRID_HZ
    span = int(0.6 * GRID_HZ)
    assert np.abs(ways[:span] - place[10 : 10 + span]).max() < 0.006


def test_x_runs_along_the_stick_and_z_points_up_at_the_strokes(drummer: Drummer, played: StickSignals) -> None:
    rows = drummer.rows(played.time_s)
    along = (rows[:, frame.TIP] - rows[:, frame.BUTT]).reshape(-1, 2, 3) / 0.406
    assert np.abs(played.turn[:, :, :, 0] - along).max() < 1e-6
    onsets, limbs = drummer.score.onset_s, drummer.assignment.limbs
    for side, limb in ((0, Limb.RIGHT_HAND), (1, Limb.LEFT_HAND)):
        struck = np.searchsorted(played.time_s, onsets[(limbs == limb) & (onsets > 0.6) & (onsets < 2.4)])
        assert len(struck) > 2
        assert (played.turn[struck, side, 2, 2] > 0.9).all()


def test_a_falling_tip_turns_about_y(drummer: Drummer, played: StickSignals) -> None:
    """In the 20 ms before a hand's stroke its stick's tip falls: a positive turn about the axis to its left."""
    limbs, onsets = drummer.assignment.limbs, drummer.score.onset_s
    for side, limb in ((0, Limb.RIGHT_HAND), (1, Limb.LEFT_HAND)):
        for onset in onsets[(limbs == limb) & (onsets > 0.6) & (onsets < 2.4)]:
            falling = (played.time_s > onset - 0.02) & (played.time_s < onset - 0.005)
            assert played.rate_rad_s[falling, side, 1].mean() > 1.0


def test_a_sensor_at_the_tip_is_shaken_more_than_one_at_the_butt(drummer: Drummer) -> None:
    def shaken(butt_m: float) -> float:
        at = [Mounting(Limb.RIGHT_HAND, butt_m=butt_m, tip_m=0.406 - butt_m)]
        return float(stick_signals(drummer, 0.5, 1.5, at).force_m_s2[:, 0].std())

    assert shaken(0.38) > 1.5 * shaken(0.05)


def test_no_sample_is_refused(drummer: Drummer) -> None:
    with pytest.raises(ValueError, match="no sample"):
        stick_signals(drummer, 1.0, 1.0)


def test_channels_are_the_right_stick_then_the_left(played: StickSignals) -> None:
    channels = played.channels()
    assert channels.shape == (len(played.time_s), 12)
    assert (channels[:, 3:6] == played.rate_rad_s[:, 0]).all()
    assert (channels[:, 6:9] == played.force_m_s2[:, 1]).all()
