"""Expected values: the motion that the test itself lays out (`fakes.stick_physics`), and one recorded stroke."""

import csv
import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.events import StickStroke
from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample, Mounting
from station.core.pieces import Limb
from station.sync.strokes.stick_axes import rows_of, turn_of
from station.sync.strokes.stroke_detector import StrokeDetector
from tests.fakes.stick_physics import (
    FINE_HZ,
    FULCRUM_FROM_TIP_M,
    Sensor,
    Stroke,
    measured,
    moved_slowly,
    strokes_by_angle,
)
from tests.real_data import DATA

Array = NDArray[np.float64]
MOUNTING = Mounting(Limb.RIGHT_HAND)


def found(samples: list[ImuSample], mounting: Mounting = MOUNTING) -> list[StickStroke]:
    detector = StrokeDetector("stick", mounting)
    return [stroke for sample in samples for stroke in detector.feed(sample)]


STROKES = {
    "full": Stroke(),
    "ghost": Stroke(0.05, 0.04),
    "high": Stroke(1.0, 0.06),
    "pressed": Stroke(rebound=0.0),
    "long_contact": Stroke(contact_s=0.006),
    "short_contact": Stroke(contact_s=0.003),
}


@pytest.mark.parametrize("rate_hz", [200, 400, 1000])
@pytest.mark.parametrize("stroke", STROKES.values(), ids=STROKES)
def test_a_stroke_is_found_with_its_onset_speed_height_and_rebound(rate_hz: float, stroke: Stroke) -> None:
    angle, onsets_s, rates = strokes_by_angle([stroke] * 4)
    heard = found(measured(angle, Sensor(rate_hz)))
    assert len(heard) == 4
    within_s = 0.0015 if rate_hz < 1000 else 0.0003
    for one, onset_s, rate in zip(heard, onsets_s, rates, strict=True):
        assert one.limb is Limb.RIGHT_HAND
        assert one.at_ns / 1e9 == pytest.approx(onset_s, abs=within_s)
        assert one.speed_m_s == pytest.approx(rate * FULCRUM_FROM_TIP_M, rel=0.04)
        assert one.height_m == pytest.approx(FULCRUM_FROM_TIP_M * math.sin(stroke.height_rad), rel=0.06)
        assert one.rebound == pytest.approx(stroke.rebound, abs=0.05)
        assert one.angle_rad == pytest.approx(0.0, abs=0.03)
        assert not one.clipped


def test_at_100_hz_strokes_are_found_to_2_ms() -> None:
    angle, onsets_s, _ = strokes_by_angle([Stroke(), Stroke(0.2), Stroke(0.05, 0.04), Stroke(1.0)])
    heard = found(measured(angle, Sensor(100)))
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.002)


def test_the_mounting_of_the_sensor_does_not_matter() -> None:
    """A sensor on its side and back to front, with a biased gyro, told of by the mounting."""
    rows = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
    angle, onsets_s, rates = strokes_by_angle([Stroke()] * 3, rest_s=3.0)
    samples = measured(angle, Sensor(rows=rows, bias_rad_s=(0.02, -0.01, 0.015)))
    heard = found(samples, Mounting(Limb.LEFT_HAND, turn_of(rows.T.tolist())))
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.0005)
    assert heard[0].speed_m_s == pytest.approx(rates[0] * FULCRUM_FROM_TIP_M, rel=0.03)
    assert heard[0].angle_rad == pytest.approx(0.0, abs=0.03)
    assert np.allclose(rows_of(turn_of(rows.tolist())), rows)


def test_a_gyro_at_its_limit_is_said_and_the_stroke_still_timed() -> None:
    angle, onsets_s, rates = strokes_by_angle([Stroke(1.2, 0.05)] * 2)  # 48 rad/s = 2750 °/s
    heard = found(measured(angle, Sensor()))
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.0015)
    assert all(one.clipped for one in heard)
    assert heard[0].speed_m_s is not None
    assert heard[0].speed_m_s < rates[0] * FULCRUM_FROM_TIP_M


def test_a_narrower_gyro_at_its_limit_is_said_as_well() -> None:
    angle, onsets_s, _ = strokes_by_angle([Stroke()] * 4)  # 15 rad/s = 860 °/s
    heard = found(measured(angle, Sensor(range_rad_s=math.radians(500.0))))
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.0015)
    assert all(one.clipped for one in heard)


def test_bounces_50_ms_apart_are_strokes_of_their_own() -> None:
    """A stick that falls on a head and bounces by itself: each fall and rise is a parabola of the angle."""
    falls = [Stroke(0.3, 0.08, rebound=0.0)]
    angle, onsets_s, rates = strokes_by_angle(falls)
    angle = angle[: round(onsets_s[0] * FINE_HZ)]
    rate, parts, onsets = rates[0], [angle], [onsets_s[0]]
    for gap_s in (0.05, 0.05, 0.04):
        touch = np.arange(1, round(0.004 * FINE_HZ) + 1) / FINE_HZ
        up = min(0.6 * rate, 6.0)
        turning = -rate + (rate + up) * (1 - np.cos(np.pi * touch / 0.004)) / 2
        parts.append(parts[-1][-1] + np.cumsum(turning) / FINE_HZ)
        air = np.arange(1, round((gap_s - 0.004) * FINE_HZ) + 1) / FINE_HZ
        parts.append(parts[-1][-1] + up * air - up / air[-1] * air**2)
        onsets.append(sum(map(len, parts)) / FINE_HZ)
        rate = up
    heard = found(measured(np.concatenate(parts), Sensor()))
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets[:3], abs=0.001)


def wave(rate_hz: float, size_rad: float) -> Array:
    time = np.arange(0, 4.0, 1 / FINE_HZ)
    grown = np.minimum(time, 1.0)
    return np.asarray(size_rad * grown * np.sin(2 * np.pi * rate_hz * time))


def moved(goals_rad: list[float], within_s: float) -> Array:
    """From goal to goal, half a second still in each."""
    parts = [np.full(FINE_HZ // 2, goals_rad[0])]
    for start, goal in pairwise(goals_rad):
        parts += [moved_slowly(start, goal, within_s), np.full(FINE_HZ // 2, goal)]
    return np.concatenate(parts)


NO_STROKES = {
    "still": np.full(2 * FINE_HZ, 0.3),
    "lifts": moved([0.0, 1.0, 0.0, 1.2, 0.2], 0.2),
    "twitches": moved([0.2, 0.3, 0.2, 0.25, 0.15], 0.06),
    "waved at 3 Hz": wave(3, 0.6),
    "waved at 7 Hz": wave(7, 0.25),
    "twirled": moved([0.0, 2 * np.pi, 0.0], 0.4),
}


@pytest.mark.parametrize("rate_hz", [100, 200, 1000])
@pytest.mark.parametrize("angle", NO_STROKES.values(), ids=NO_STROKES)
def test_what_a_hand_stops_is_no_stroke(rate_hz: float, angle: Array) -> None:
    assert found(measured(angle, Sensor(rate_hz))) == []


@pytest.mark.parametrize("rate_hz", [100, 200, 400])
def test_a_sensor_that_comes_in_the_middle_of_the_playing_is_followed_within_a_second(rate_hz: float) -> None:
    """As one that was unplugged and plugged in again: nobody holds the stick still for it."""
    angle, onsets_s, _ = strokes_by_angle([Stroke()] * 24)
    samples = measured(angle, Sensor(rate_hz))
    for begin_s in np.arange(onsets_s[4], onsets_s[6], 0.03):
        heard = [one.at_ns / 1e9 for one in found([one for one in samples if one.at_ns / 1e9 > begin_s])]
        wanted = [at_s for at_s in onsets_s if at_s > begin_s + 1.0]
        late_s = 0.003 if rate_hz > 100 else 0.005
        assert heard[-len(wanted) :] == pytest.approx(wanted, abs=late_s), f"from {begin_s - onsets_s[4]:.2f} s on"


def test_lost_samples_lose_no_other_stroke() -> None:
    angle, onsets_s, _ = strokes_by_angle([Stroke()] * 6)
    samples = measured(angle, Sensor(400))
    kept = [sample for k, sample in enumerate(samples) if k % 50]
    heard = found(kept)
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.005)


@pytest.mark.parametrize("seed", range(8))
def test_however_many_samples_are_lost_strokes_come_in_order_and_with_sense(seed: int) -> None:
    angle, onsets_s, _ = strokes_by_angle([Stroke(), Stroke(0.1), Stroke(1.0)] * 3)
    samples, random = measured(angle, Sensor(200)), np.random.default_rng(seed)
    heard = found([sample for sample in samples if random.random() > 0.1 * seed])
    times = [one.at_ns for one in heard]
    assert times == sorted(times)
    assert len(heard) <= len(onsets_s)
    assert all(one.speed_m_s is not None and 0 <= one.speed_m_s < 30 for one in heard)
    if seed < 2:
        assert len(heard) >= 8


def test_a_sensor_without_a_gyro_tells_strokes_by_its_own_orientation() -> None:
    angle, onsets_s, _ = strokes_by_angle([Stroke()] * 3)
    samples = [
        ImuSample(s.at_ns, s.acceleration_m_s2, None, (math.cos(a / 2), 0.0, -math.sin(a / 2), 0.0))
        for s in measured(angle, Sensor(100))
        if (a := float(angle[round(s.at_ns * FINE_HZ / 1e9)])) is not None
    ]
    heard = found(samples)
    assert [one.at_ns / 1e9 for one in heard] == pytest.approx(onsets_s, abs=0.004)


def test_a_sensor_that_tells_no_motion_tells_no_strokes() -> None:
    assert found([ImuSample(k * 10**7, (0.0, 0.0, STANDARD_GRAVITY_M_S2)) for k in range(200)]) == []


def joint(name: str) -> tuple[Array, Array]:
    """Times (n,) s and places (n, 2) m of a joint of the recorded player."""
    columns = []
    for axis in "XY":
        with (DATA / "stroke" / f"JointCenters_{axis}Pose_cm.csv").open() as file:
            rows = list(csv.reader(file))
        columns.append([float(row[rows[0].index(name)]) / 100 for row in rows[1:]])
    return np.arange(len(columns[0])) / 240, np.array(columns).T


def test_the_recorded_stroke_has_its_published_speed_height_and_rebound() -> None:
    """HUMANS.md of the design, from Pearl 2023: 9.4 m/s, 56 cm, rebound 0.51, at the tip's lowest point."""
    time, tip = joint("Drum Bead")
    _, finger = joint("Finger Joint")
    along = tip - finger
    length = float(np.hypot(*along.T).mean())
    along /= np.hypot(*along.T)[:, None]
    angle = np.arctan2(along[:, 1], along[:, 0])
    force = np.gradient(np.gradient(tip - length * along, time, axis=0), time, axis=0) + np.array(
        [0, STANDARD_GRAVITY_M_S2]
    )
    across = np.stack([-along[:, 1], along[:, 0]], 1)
    rows = np.stack([(force * along).sum(1), (force * across).sum(1), -np.gradient(angle, time)], 1)
    still = [STANDARD_GRAVITY_M_S2 * along[0, 1], STANDARD_GRAVITY_M_S2 * across[0, 1], 0.0]
    rows = np.concatenate([np.tile(still, (240, 1)), rows])
    samples = [ImuSample(round(k * 1e9 / 240), (a, 0.0, b), (0.0, w, 0.0)) for k, (a, b, w) in enumerate(rows.tolist())]
    (stroke,) = found(samples, Mounting(Limb.RIGHT_HAND, tip_m=length, butt_m=length / 2))
    lowest_s = 1 + time[np.argmin(tip[:, 1])]
    assert stroke.at_ns / 1e9 == pytest.approx(lowest_s, abs=0.006)
    assert stroke.speed_m_s == pytest.approx(9.4, rel=0.1)
    assert stroke.height_m == pytest.approx(0.56, rel=0.12)
    assert stroke.rebound == pytest.approx(0.51, abs=0.06)
