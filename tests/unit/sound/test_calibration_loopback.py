"""Loopback on synthetic recordings: the true delay is the one that the room was made with."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal

from station.core.errors import DeviceError
from station.sound.calibration.chirp import HIGH_HZ, LENGTH_S, LOW_HZ, RULER, chirp, coherence
from station.sound.calibration.latency_estimate import LatencyEstimate
from station.sound.calibration.loopback import LoopbackRound, loopback
from station.sound.calibration.timeline import TimedRecording
from tests.fakes.rooms import Room, chirps_played_ns, room_with_chirps


def rounds(room: Room, *delays_ms: float) -> list[LoopbackRound]:
    return [LoopbackRound(chirps_played_ns(), room_with_chirps(room, delay)) for delay in delays_ms]


def measured(room: Room, delay_ms: float) -> LatencyEstimate:
    return loopback(rounds(room, delay_ms, delay_ms))


@pytest.mark.parametrize(
    ("room", "delay_ms"),
    [
        (Room(), 12.345),
        (Room(), -20.1),  # a driver that reports more than there is
        (Room(gain=-0.2), 12.345),  # polarity
        (Room(noise=0.0), 0.0),
        (Room(gain=0.1, noise=0.1), 3.3),  # the noise is louder than the chirp
        (Room(rate_hz=44_100), 250.007),  # a wireless headphone
        (Room(rate_hz=96_000), 3.0),
        (Room(gain=1.5, clip=0.2), 8.2),  # overdriven
        (Room(hum=0.5), 8.2),
        (Room(crackles=400), 8.2),
        (Room(echo_ms=3.0, echo_gain=1.5), 8.2),  # an echo louder than the direct sound
        (Room(echo_ms=170.0, echo_gain=-1.3), 8.2),
        (Room(ppm=300.0), 8.2),  # two cards with crystals of their own
    ],
)
def test_the_delay_is_found(room: Room, delay_ms: float) -> None:
    found = measured(room, delay_ms)
    assert found.value_ms == pytest.approx(delay_ms, abs=0.05)
    assert found.half_ms < 0.2
    assert found.trusted, found.doubts


def test_silence_and_mere_noise_are_no_measurement() -> None:
    for room, word in [(Room(gain=0.0, noise=0.0), "nothing at all"), (Room(gain=0.0, noise=0.1), "loudest")]:
        with pytest.raises(DeviceError, match=word):
            measured(room, 5.0)


def test_chance_rarely_looks_like_a_chirp() -> None:
    """Twenty seconds of noise have as many places as thirteen measurements."""
    noise = np.random.default_rng(5).standard_normal(20 * 48_000).astype(np.float32)
    assert coherence(noise, 48_000).max() < 0.2


def test_each_opening_that_differs_widens_the_interval() -> None:
    steady, jumpy = loopback(rounds(Room(), 10.0, 10.0, 10.0)), loopback(rounds(Room(), 8.7, 10.0, 11.3))
    assert jumpy.value_ms == pytest.approx(10.0, abs=0.05)
    assert steady.half_ms < 0.05
    assert jumpy.half_ms == pytest.approx(4.303 * 1.3 / 3**0.5, rel=0.05)  # t(2) from a table, SD of the three
    assert not jumpy.trusted


def test_few_chirps_are_doubted() -> None:
    whole = rounds(Room(), 10.0)[0]
    sound = whole.recording.sound.copy()
    sound[: len(sound) // 2] = 0.0
    found = loopback([LoopbackRound(whole.played_ns, TimedRecording(sound, whole.recording.timeline))])
    assert found.value_ms == pytest.approx(10.0, abs=0.05)
    assert any("came back alike" in doubt for doubt in found.doubts)


def test_a_delay_that_moves_is_doubted() -> None:
    """Half of the chirps left 0.8 ms sooner than reported."""
    slipping = chirps_played_ns() - np.array([0, 0, 0, 800_000, 800_000, 800_000])
    found = loopback([LoopbackRound(slipping, room_with_chirps(Room(), 10.0))])
    assert any("moved by 0.8 ms" in doubt for doubt in found.doubts)


def test_chirps_that_each_come_back_at_another_time_are_no_measurement() -> None:
    stalled = chirps_played_ns() - np.array([0, 30, 7, 90, 55, 120]) * 1_000_000
    with pytest.raises(DeviceError, match="another delay"):
        loopback([LoopbackRound(stalled, room_with_chirps(Room(), 10.0))])


def test_an_impossible_delay_is_doubted() -> None:
    assert any("beyond" in doubt for doubt in measured(Room(), 700.0).doubts)


def test_an_overdriven_input_is_remarked() -> None:
    assert any("overdriven" in remark for remark in measured(Room(gain=1.5, clip=0.2), 8.2).remarks)
    assert not measured(Room(), 8.2).remarks


def test_the_chirp_is_that_of_another_implementation() -> None:
    at_s = np.arange(2_880) / 48_000
    sweep: NDArray[np.float64] = signal.chirp(at_s, LOW_HZ, LENGTH_S, HIGH_HZ, phi=-90)
    middle = slice(500, -500)  # between swell and fade
    np.testing.assert_allclose(chirp(48_000)[middle], sweep[middle], atol=1e-9)


def test_no_two_chirps_of_the_train_are_equally_far_apart() -> None:
    apart = [b - a for index, a in enumerate(RULER) for b in RULER[index + 1 :]]
    assert len(set(apart)) == len(apart)
