import numpy as np
import pytest

from station.sound.calibration.timeline import Timeline
from station.sound.output.dac_clock import DacClock

BEGIN_NS = 3_000_000_000_000


def timeline(ppm: float, seconds: float = 10.0, jitter_ms: float = 0.0) -> Timeline:
    """A stream that runs `ppm` too fast, its reports smoothed as the station does."""
    rng = np.random.default_rng(4)
    frames = np.arange(0, round(seconds * 48_000), 256)
    reported = BEGIN_NS + np.round(frames / (48_000 * (1 + ppm / 1e6)) * 1e9).astype(np.int64)
    reported += np.round(jitter_ms * 1e6 * rng.standard_normal(len(frames))).astype(np.int64)
    clock = DacClock(48_000)
    return Timeline(frames, np.array([clock.block(256, int(each)) for each in reported]), 48_000)


def test_frames_and_times_are_each_others_inverse_inside_and_outside() -> None:
    line = timeline(200.0)
    frames = np.array([-480.0, 0.0, 0.5, 255.9, 1_000.25, 479_000.0, 600_000.0])
    np.testing.assert_allclose(line.frame_at(line.at_ns(frames)), frames, atol=1e-3)
    assert line.at_ns(np.array([-480.0]))[0] == pytest.approx(BEGIN_NS - 10_000_000, abs=10)


def test_a_lost_block_moves_what_follows() -> None:
    line = Timeline(np.array([0, 480, 960]), BEGIN_NS + np.array([0, 10_000_000, 30_000_000]), 48_000)
    assert line.at_ns(np.array([480.0, 960.0, 1_008.0])).tolist() == [
        BEGIN_NS + 10_000_000,
        BEGIN_NS + 30_000_000,
        BEGIN_NS + 31_000_000,
    ]


@pytest.mark.parametrize("ppm", [-150.0, 0.0, 40.0, 200.0])
@pytest.mark.parametrize("jitter_ms", [0.0, 0.3])
def test_drift_is_measured(ppm: float, jitter_ms: float) -> None:
    drift = timeline(ppm, 20.0, jitter_ms).drift_ppm()
    assert drift is not None
    value, half = drift
    assert abs(value - ppm) < max(half, 3.0)
    assert half < 60.0


def test_a_short_stream_tells_no_drift() -> None:
    assert timeline(100.0, 1.5).drift_ppm() is None
