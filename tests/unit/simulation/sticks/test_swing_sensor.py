"""The sensor on a simulated stick, against data sheets and textbook filters."""

import math

import numpy as np
import pytest

from station.core.imu import STANDARD_GRAVITY_M_S2
from station.core.pieces import Limb
from station.simulation.sticks.stick_swing import HANDS, SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_sensor import Link, SensorSpec, matrix_of, quaternions, random_turn
from station.simulation.sticks.swing_spec import GestureKind, StickGesture, StickStrokeSpec

R, L = HANDS
STILL = (1.0, 0.0, 0.0, 0.0)


def _played(sensor: SensorSpec, strokes: int = 4, speed_m_s: float = 3.0, seed: int = 2) -> SimulatedSticks:
    notes = [StickStrokeSpec(3 + 0.25 * i, R, speed_m_s=speed_m_s) for i in range(strokes)]
    return play(notes, pair=StickPair(dict.fromkeys(HANDS, sensor)), seed=seed)


def test_hard_stroke_is_clipped_at_16_g_and_2000_degrees() -> None:
    sensors = {hand: SensorSpec(rate_hz=1000, turn=STILL) for hand in HANDS}
    hard = [StickStrokeSpec(3.0, R, speed_m_s=13.0, height_m=0.4)]  # 13 m/s · 85 % / 27 cm: 2340 °/s
    stick = play(hard, pair=StickPair(sensors, dict.fromkeys(HANDS, "german"))).sticks[R]
    assert stick.rate is not None
    step = 2.0**-15
    assert np.abs(stick.acceleration).max() == pytest.approx(16 * STANDARD_GRAVITY_M_S2, rel=2 * step)
    assert np.degrees(np.abs(stick.rate)).max() == pytest.approx(2000, rel=2 * step)


def test_values_are_of_16_bits() -> None:
    stick = _played(SensorSpec(turn=STILL)).sticks[R]
    counts = stick.acceleration / (16 * STANDARD_GRAVITY_M_S2 / 2**15)
    assert np.abs(counts - np.rint(counts)).max() < 1e-6


def test_noise_is_the_data_sheets_density_in_the_filters_band() -> None:
    """Of a white density n through a second-order Butterworth low pass at f: n·√(1.11 f) (its noise bandwidth)."""
    resting = [StickGesture(4.0, 12.0, R, GestureKind.REST)]
    sensor = SensorSpec(rate_hz=200, chip="mpu9250", turn=STILL)
    strokes = [StickStrokeSpec(3.0, R), StickStrokeSpec(17.0, R)]
    stick = play(strokes, resting, pair=StickPair(dict.fromkeys(HANDS, sensor))).sticks[R]
    still = (stick.time_s > 5.0) & (stick.time_s < 15.0)
    rough = np.diff(stick.acceleration[still, 0])
    noise = 300e-6 * STANDARD_GRAVITY_M_S2 * math.sqrt(1.11 * 80)
    # successive samples of so filtered noise hardly correlate: their difference has about √2 of its SD
    assert rough.std() == pytest.approx(math.sqrt(2) * noise, rel=0.25)


def test_turned_sensor_feels_the_same_in_its_own_axes() -> None:
    turn = random_turn(np.random.default_rng(3))
    straight = _played(SensorSpec(chip="perfect", turn=STILL)).sticks[R]
    turned = _played(SensorSpec(chip="perfect", turn=turn)).sticks[R]
    assert turned.mounting.turn == turn
    since = straight.time_s[:, None] - 3 - 0.25 * np.arange(4)
    slow = ~((since > -0.005) & (since < 0.1)).any(axis=1)  # where neither was clipped, nor rings still
    seen = turned.acceleration[slow] @ matrix_of(turn).T
    assert np.abs(seen - straight.acceleration[slow]).max() < 1.0


def test_filter_delays_as_a_butterworth_does() -> None:
    """Group delay at low frequencies √2/(2π f): 200 Hz sampled, band 80 Hz: 2.8 ms; at 1 kHz 0.56 ms."""
    peaks = {}
    for rate in (200, 1000):
        stick = _played(SensorSpec(rate_hz=rate, chip="perfect", turn=STILL), strokes=20).sticks[R]
        assert stick.rate is not None
        fine = stick.motion.rate_rad_s()[:, 1]
        delays = np.arange(0, 0.006, 1e-4)
        off = [np.abs(np.interp(stick.time_s - d, stick.motion.time_s, fine) - stick.rate[:, 1]).mean() for d in delays]
        peaks[rate] = delays[int(np.argmin(off))]
    assert peaks[200] == pytest.approx(math.sqrt(2) / (2 * math.pi * 80), abs=8e-4)
    assert peaks[1000] == pytest.approx(math.sqrt(2) / (2 * math.pi * 400), abs=3e-4)


def test_clock_runs_fast_by_parts_in_a_million() -> None:
    stick = _played(SensorSpec(rate_hz=1000, clock_ppm=100), strokes=40).sticks[R]
    assert np.diff(stick.time_s).mean() == pytest.approx(0.001 / (1 + 1e-4), rel=1e-7)


def test_lost_packets_are_lost_together() -> None:
    stick = _played(SensorSpec(link=Link(loss=0.02, samples_a_packet=5)), strokes=80).sticks[R]
    lost = np.setdiff1d(np.arange(stick.measured), stick.number)
    assert len(lost) / stick.measured == pytest.approx(0.02, abs=0.012)
    assert (np.bincount(lost // 5)[np.unique(lost // 5)] >= 1).all()
    whole = np.bincount(lost // 5)
    assert set(whole[whole > 0][:-1].tolist()) <= {5}


def test_serial_arrivals_are_late_by_at_most_the_jitter_and_in_order() -> None:
    stick = _played(SensorSpec(link=Link(jitter_s=0.005))).sticks[R]
    late = stick.arrival_ns / 1e9 - stick.time_s
    assert (np.diff(stick.arrival_ns) >= 0).all()
    assert late.min() >= 0.001 - 1e-9
    assert late.max() < 0.0061
    assert late.max() > 0.004


def test_bluetooth_arrives_in_clumps() -> None:
    played = _played(SensorSpec(rate_hz=200, link=Link(interval_s=0.030)), strokes=20)
    events = played.sticks[R].events()
    sizes = [len(event.samples) for event in events]
    assert np.median(sizes) == 6  # 200 Hz · 30 ms
    assert sum(sizes) == played.sticks[R].measured


def test_nothing_comes_while_disconnected() -> None:
    stick = _played(SensorSpec(link=Link(away_s=((3.2, 3.4),)))).sticks[R]
    assert not ((stick.time_s > 3.2) & (stick.time_s < 3.4)).any()
    assert stick.measured > len(stick.time_s)


def test_events_hold_all_samples_in_order() -> None:
    stick = _played(SensorSpec(link=Link(samples_a_packet=4, loss=0.02))).sticks[L]
    assert tuple(s for event in stick.events() for s in event.samples) == stick.samples
    assert stick.limb is Limb.LEFT_HAND


def test_stamps_wander_by_what_was_asked() -> None:
    off = []
    for seed in range(12):
        stick = _played(SensorSpec(stamp_wander_s=0.001), strokes=1, seed=seed).sticks[R]
        off.append(stick.stamp_ns / 1e9 - stick.time_s)
    assert np.concatenate(off).std() == pytest.approx(0.001, rel=0.5)


def test_orientation_takes_the_measured_gravity_upwards() -> None:
    resting = [StickGesture(4.0, 4.0, R, GestureKind.REST)]
    sensor = SensorSpec(chip="perfect", tells_orientation=True)
    strokes = [StickStrokeSpec(3.0, R), StickStrokeSpec(9.0, R)]
    stick = play(strokes, resting, pair=StickPair(dict.fromkeys(HANDS, sensor))).sticks[R]
    assert stick.orientation is not None
    row = int(np.searchsorted(stick.time_s, 6.0))
    w, x, y, z = stick.orientation[row].tolist()
    assert matrix_of((w, x, y, z)) @ stick.acceleration[row] == pytest.approx([0, 0, STANDARD_GRAVITY_M_S2], abs=0.1)


def test_quaternions_and_matrices_are_each_others_inverse() -> None:
    rng = np.random.default_rng(1)
    turns = [random_turn(rng) for _ in range(50)] + [(0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)]
    back = quaternions(np.array([matrix_of(turn) for turn in turns]))
    assert np.abs(np.einsum("ni,ni->n", back, np.array(turns))) == pytest.approx(1.0)


def test_chip_warms_and_its_bias_with_it() -> None:
    """MPU-9250: 0.24 °/s a kelvin at the most; within 42 s it warms by 9 K·(1 − e^(−42/240)) = 1.4 K."""
    resting = [StickGesture(3.5, 38.0, R, GestureKind.REST)]
    sensor = SensorSpec(rate_hz=100, chip="mpu9250", turn=STILL)
    strokes = [StickStrokeSpec(43.0, R)]
    stick = play(strokes, resting, pair=StickPair(dict.fromkeys(HANDS, sensor)), seed=6).sticks[R]
    assert stick.rate is not None
    assert stick.temperature_c[-1] - stick.temperature_c[0] == pytest.approx(1.5, abs=0.1)
    early, late = ((stick.time_s > t) & (stick.time_s < t + 5) for t in (5.0, 34.0))
    drift = np.degrees(stick.rate[late].mean(axis=0) - stick.rate[early].mean(axis=0))
    assert np.abs(drift).max() < 0.24 * 1.4 + 0.06
    assert np.abs(drift).max() > 0.02
