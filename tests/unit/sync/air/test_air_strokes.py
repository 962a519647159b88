"""Strokes in the air against kinematics that know when each beat was meant (`tests.fakes.air_stick`)."""

import numpy as np
import pytest

from station.core.imu import NO_TURN, STANDARD_GRAVITY_M_S2
from station.sync.air.air_strokes import AirBeat, AirStrokes, most_strokes_hz
from station.sync.air.air_swing import SwingReader, swing_between
from station.sync.strokes.stick_orientation import StickMotion
from tests.fakes.air_stick import Played, Stroke, play
from tests.real_data import DATA

TIP_M = 0.33


def beats_of(motions: list[StickMotion]) -> list[AirBeat]:
    reader, strokes = SwingReader(TIP_M), AirStrokes()
    swings = [swing for motion in motions if (swing := reader.feed(motion)) is not None]
    return [beat for swing in swings if (beat := strokes.feed(swing)) is not None]


def errors_ms(played: Played, beats: list[AirBeat]) -> np.ndarray:
    assert len(beats) == len(played.beat_s)
    return (np.array([beat.at_ns for beat in beats]) / 1e9 - played.beat_s) * 1e3


@pytest.mark.parametrize("rate_hz", [100.0, 200.0, 400.0, 1000.0])
@pytest.mark.parametrize(("speed_m_s", "brake_s"), [(1.2, 0.05), (3.5, 0.05), (6.0, 0.04)])
def test_every_stroke_is_found_once_at_its_beat(rate_hz: float, speed_m_s: float, brake_s: float) -> None:
    strokes = tuple(Stroke(0.6 + 0.4 * n, speed_m_s, brake_s=brake_s, push_s=0.08) for n in range(6))
    played = play(strokes, rate_hz, 3.2)
    errors = errors_ms(played, beats_of(played.motions()))
    assert abs(errors.mean()) < 1.5
    assert errors.std() < 2.0


@pytest.mark.parametrize("interval_s", [0.2, 0.4, 1.2])
def test_the_beat_does_not_depend_on_the_tempo(interval_s: float) -> None:
    strokes = tuple(Stroke(0.6 + interval_s * n, 3.0, push_s=0.07) for n in range(5))
    played = play(strokes, 400.0, 1.0 + 5 * interval_s)
    assert abs(np.median(errors_ms(played, beats_of(played.motions())))) < 0.5


def test_a_faster_tip_is_told_as_faster() -> None:
    played = play((Stroke(0.6, 2.0), Stroke(1.1, 4.0)), 400.0, 1.7)
    soft, hard = beats_of(played.motions())
    assert hard.speed_m_s / soft.speed_m_s == pytest.approx(2.0, rel=0.03)


def test_the_stick_points_where_it_was_stopped() -> None:
    played = play((Stroke(0.6, 3.0, heading_deg=-40.0, low_deg=5.0),), 400.0, 1.2)
    (beat,) = beats_of(played.motions())
    assert np.degrees(beat.heading_rad) == pytest.approx(-40.0, abs=0.5)
    # half of what a raised cosine of 50 ms takes from 3 m/s is still to come: about 8°
    assert 5.0 < np.degrees(beat.elevation_rad) < 13.0


def test_raising_and_lowering_are_no_strokes() -> None:
    # 3 m/s up within 120 ms, then down over half a second: the fake's stroke upside down, and a soft one
    played = play((Stroke(0.6, 0.8, push_s=0.5, brake_s=0.5),), 400.0, 1.6)
    assert beats_of(played.motions()) == []
    upwards = [
        replace_rate(motion, (-motion.rate_rad_s[0], -motion.rate_rad_s[1], -motion.rate_rad_s[2]))
        for motion in play((Stroke(0.6, 4.0),), 400.0, 1.2).motions()
    ]
    assert beats_of(upwards) == []


def replace_rate(motion: StickMotion, rate: tuple[float, float, float]) -> StickMotion:
    return motion._replace(rate_rad_s=rate)


def test_a_sideways_sweep_that_stops_is_no_stroke() -> None:
    # the stick lies level and turns about the vertical: 10 rad/s to nothing in 50 ms
    times = np.arange(0.0, 0.6, 0.0025)
    rates = np.where(times < 0.3, 10.0 * np.clip(times / 0.1, 0, 1), 10.0 * np.clip(1 - (times - 0.3) / 0.05, 0, 1))
    turned = np.cumsum(rates) * 0.0025
    motions = [
        StickMotion(
            int(t * 1e9),
            (np.cos(a / 2), 0.0, 0.0, np.sin(a / 2)),
            (0.0, 0.0, r),
            (0.0, 0.0, 9.80665),
            False,
            False,
            False,
        )
        for t, a, r in zip(times.tolist(), turned.tolist(), rates.tolist(), strict=True)
    ]
    assert beats_of(motions) == []


def test_a_trembling_stop_is_one_stroke() -> None:
    strokes = (Stroke(0.6, 4.0), Stroke(0.72, 0.3, push_s=0.02, brake_s=0.02))
    assert len(beats_of(play(strokes, 400.0, 1.2).motions())) == 1


def test_a_stroke_too_quick_for_the_sensor_is_counted_and_not_invented() -> None:
    played = play(tuple(Stroke(0.6 + 0.1 * n, 2.0, push_s=0.03, brake_s=0.03) for n in range(6)), 40.0, 1.6)
    reader, strokes = SwingReader(TIP_M), AirStrokes()
    told = [
        beat
        for motion in played.motions()
        if (swing := reader.feed(motion)) is not None and (beat := strokes.feed(swing)) is not None
    ]
    assert len(told) + strokes.unresolved <= 6
    assert strokes.unresolved > 0


def test_a_sensor_tells_an_eighth_of_its_rate() -> None:
    # up and down, four samples each
    assert most_strokes_hz(40.0) == 5.0
    assert most_strokes_hz(200.0) == 25.0


def test_a_stick_at_rest_has_no_speed_and_feels_no_jolt() -> None:
    still = StickMotion(0, NO_TURN, (0.0, 0.0, 0.0), (0.0, 0.0, STANDARD_GRAVITY_M_S2), True, False, False)
    swing = swing_between(still, still._replace(at_ns=4_000_000), TIP_M)
    assert swing == (2_000_000, 0.0, 0.0, 0.0, 0.0, 0.0)


def test_the_tip_of_a_stick_that_spins_about_its_sensor_is_pulled_inwards() -> None:
    # 10 rad/s about the vertical: 0.33 m from the axis, v = 3.3 m/s, a = ω²r = 33 m/s²
    spun = StickMotion(0, NO_TURN, (0.0, 0.0, 10.0), (0.0, 0.0, STANDARD_GRAVITY_M_S2), False, False, False)
    swing = swing_between(spun, spun._replace(at_ns=4_000_000), TIP_M)
    assert swing.speed_m_s == pytest.approx(3.3)
    assert swing.down_m_s == pytest.approx(0.0)
    assert swing.jolt_m_s2 == pytest.approx(33.0)


def test_a_real_stroke_is_one_stroke_where_its_tip_is_lowest() -> None:
    """One drummer's full stroke on a pad (Pearl 2023, 240 Hz); a sensor where stick and hand meet."""
    x, y = (
        np.genfromtxt(DATA / f"stroke/JointCenters_{axis}Pose_cm.csv", delimiter=",", skip_header=1) for axis in "XY"
    )
    times, hand, tip = x[:, 0], np.stack([x[:, 4], y[:, 4]], 1) / 100, np.stack([x[:, 5], y[:, 5]], 1) / 100
    elevation = np.unwrap(np.arctan2(*(tip - hand).T[::-1]))
    force = np.gradient(np.gradient(hand, times, axis=0), times, axis=0) + np.array([0.0, STANDARD_GRAVITY_M_S2])
    cosine, sine = np.cos(elevation), np.sin(elevation)
    along, above = force[:, 0] * cosine + force[:, 1] * sine, force[:, 1] * cosine - force[:, 0] * sine
    rows = zip(times, elevation, np.gradient(elevation, times), along, above, strict=True)
    motions = [
        StickMotion(
            int(t * 1e9), (np.cos(e / 2), 0.0, -np.sin(e / 2), 0.0), (0.0, -r, 0.0), (a, 0.0, u), False, False, False
        )
        for t, e, r, a, u in (map(float, row) for row in rows)
    ]
    (beat,) = beats_of(motions)
    assert beat.at_ns / 1e9 == pytest.approx(times[np.argmin(tip[:, 1])], abs=0.008)
