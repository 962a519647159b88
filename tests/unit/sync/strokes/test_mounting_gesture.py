"""The sensor's axes are the test's own, drawn or laid out; the gesture is made of physics (`fakes.stick_physics`)."""

import math

import numpy as np
import pytest

from station.core.imu import ImuSample, Mounting
from station.core.pieces import Limb
from station.sync.strokes.mounting_gesture import learn_mounting
from station.sync.strokes.stick_axes import rows_of
from tests.fakes.stick_physics import FINE_HZ, Array, Sensor, Stroke, measured, moved_slowly, strokes_by_angle


def taps(start_s: float, total_s: float = 9.0) -> Array:
    """Two seconds on the head, lifted, four taps from `start_s` on, and on the head again."""
    angle, _, _ = strokes_by_angle([Stroke(0.3)] * 4, rest_s=0.1)
    up = moved_slowly(0.0, 0.3, 0.5)
    lying = np.zeros(round((start_s - 0.5) * FINE_HZ))
    whole = np.concatenate([lying, up, angle])
    return np.concatenate([whole, np.full(max(round(total_s * FINE_HZ) - len(whole), 1), whole[-1])])


def turned_rows(seed: int) -> Array:
    """A rotation drawn at random: the sensor's axes from the stick's."""
    square, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return np.asarray(square * np.sign(np.linalg.det(square)))


@pytest.mark.parametrize("rate_hz", [100, 400])
@pytest.mark.parametrize("seed", range(4))
def test_the_axes_and_the_hands_are_found(seed: int, rate_hz: float) -> None:
    rows = {"a": turned_rows(seed), "b": turned_rows(seed + 10)}
    starts = {"a": 5.0, "b": 2.5}
    samples = {
        device: measured(taps(starts[device]), Sensor(rate_hz, rows=rows[device], bias_rad_s=(0.03, 0.01, -0.02)))
        for device in rows
    }
    result = learn_mounting(samples, {"a": Mounting(tip_m=0.3)})
    assert result.faults == ()
    assert [result.mountings[device].limb for device in "ab"] == [Limb.LEFT_HAND, Limb.RIGHT_HAND]
    assert result.mountings["a"].tip_m == 0.3
    for device, mounting in result.mountings.items():
        assert mounting.learnt
        off = np.array(rows_of(mounting.turn)) @ rows[device]
        assert math.degrees(math.acos((np.trace(off) - 1) / 2)) < 3.0


def test_a_sensor_without_a_gyro_shows_its_axes_by_its_orientation() -> None:
    angle = taps(2.5)
    samples = [
        ImuSample(s.at_ns, s.acceleration_m_s2, None, (math.cos(a / 2), 0.0, -math.sin(a / 2), 0.0))
        for s in measured(angle, Sensor(100, noise_m_s2=0.02))
        if (a := float(angle[round(s.at_ns * FINE_HZ / 1e9)])) > -9
    ]
    result = learn_mounting({"one": samples}, {})
    assert result.faults == ("only one stick tapped: which hand holds it is not known",)
    assert result.mountings["one"].learnt
    assert np.allclose(rows_of(result.mountings["one"].turn), np.eye(3), atol=0.06)


def sideways(angle: Array) -> list[ImuSample]:
    """Swung about the vertical instead of tapped."""
    return [
        ImuSample(s.at_ns, (0.0, 0.0, 9.81), (0.0, 0.0, s.rate_rad_s[1]))
        for s in measured(angle, Sensor(200))
        if s.rate_rad_s is not None
    ]


def test_what_was_not_shown_is_said_and_not_guessed() -> None:
    still = measured(np.zeros(5 * FINE_HZ), Sensor(200))
    before = Mounting(Limb.LEFT_HAND)
    result = learn_mounting({"s": still}, {"s": before})
    assert result.mountings == {"s": before}
    assert result.faults == ("s: it was not tapped",)
    assert learn_mounting({"s": sideways(taps(2.5))}, {}).faults == (
        "s: it was swung sideways, not tapped up and down",
    )
    waved = measured(0.5 * np.sin(2 * np.pi * 2 * np.arange(0, 5, 1 / FINE_HZ)), Sensor(200))
    assert learn_mounting({"s": waved}, {}).faults == ("s: it did not lie still for 1 s",)
    bare = [ImuSample(sample.at_ns, (0.0, 0.0, 9.8)) for sample in still]
    assert learn_mounting({"s": bare}, {}).faults == ("s: it tells neither turning nor orientation",)


def test_sticks_that_begin_at_once_are_not_told_apart() -> None:
    samples = {device: measured(taps(2.5), Sensor(200, seed=k)) for k, device in enumerate("ab")}
    result = learn_mounting(samples, {})
    assert result.faults == ("both sticks began to tap at once: which is the right one is not known",)
    assert {mounting.limb for mounting in result.mountings.values()} == {Limb.UNKNOWN}
