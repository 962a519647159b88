"""Beyond the paper: cadences from half to double, standing still, backwards and other motion, one channel alone."""

import numpy as np
import pytest

from station.sync.phase.confidence import confidences, locks
from station.sync.phase.periodic_model import Exemplar, PeriodicModel, fitted, wrapped
from station.sync.phase.phase_tracker import ADAPTIVE, PAPER, PhaseTrack, PhaseTracker, TrackerSettings, tracked
from station.sync.signals.running_mean import high_passed, running_means
from station.sync.signals.signal import FloatArray

COUNT = 1000


def walk(phase_rad: FloatArray) -> FloatArray:
    """Four channels, roughly hips and knees of a walker in degrees (n, 4)."""
    hip, knee = phase_rad, 2 * phase_rad
    columns = [
        20 * np.sin(hip),
        -20 * np.sin(hip),
        15 * np.cos(hip) + 8 * np.sin(knee),
        8 * np.sin(knee) - 15 * np.cos(hip),
    ]
    values: FloatArray = np.stack(columns, axis=1) + np.array([-15.0, -15.0, 30.0, 30.0])
    return values


@pytest.fixture(scope="module")
def model() -> PeriodicModel:
    phase = np.linspace(0, 2 * np.pi, 130, endpoint=False)
    return fitted(("rf", "lf", "rt", "lt"), [Exemplar(walk(phase), phase)])


def ramp(cadence_rad: float, start_rad: float = 2.0) -> FloatArray:
    return start_rad + cadence_rad * np.arange(COUNT, dtype=np.float64)


def noisy(values: FloatArray, degrees: float = 1.0) -> FloatArray:
    return values + degrees * np.random.default_rng(3).standard_normal(values.shape)


def late_error_turns(track: PhaseTrack, truth_rad: FloatArray) -> float:
    return float(np.abs(wrapped(track.phase_rad - truth_rad))[COUNT // 2 :].mean() / (2 * np.pi))


@pytest.mark.parametrize("tempo", [0.5, 0.7, 1.0, 1.4, 2.0])
def test_half_to_double_cadence_locks_without_lag(model: PeriodicModel, tempo: float) -> None:
    truth = ramp(0.05 * tempo)
    track = tracked(model, noisy(walk(truth)), ADAPTIVE)
    assert late_error_turns(track, truth) < 0.006
    assert track.locked[COUNT // 2 :].all()
    assert track.cadence_rad[COUNT // 2 :].mean() == pytest.approx(0.05 * tempo, rel=0.03)


@pytest.mark.parametrize("tempo", [0.5, 2.0])
def test_the_paper_s_lags_there(model: PeriodicModel, tempo: float) -> None:
    truth = ramp(0.05 * tempo)
    assert late_error_turns(tracked(model, noisy(walk(truth)), PAPER), truth) > 0.015


def test_standing_still_in_any_pose_unlocks(model: PeriodicModel) -> None:
    for pose in range(16):
        held = np.concatenate([ramp(0.05)[:400], np.full(600, ramp(0.05)[400] + pose * np.pi / 8)])
        track = tracked(model, noisy(walk(held)), ADAPTIVE)
        assert track.locked[300:400].all()
        assert not track.locked[600:].any()


def test_a_sensor_that_only_trembles_has_no_phase(model: PeriodicModel) -> None:
    track = tracked(model, noisy(np.tile(model.mean, (COUNT, 1)), 0.5), ADAPTIVE)
    assert track.confidence.max() < 0.3
    assert not track.locked.any()


def test_single_wild_samples_do_not_unlock(model: PeriodicModel) -> None:
    wild = noisy(walk(ramp(0.05)))
    wild[300::60] *= 40
    track = tracked(model, wild, ADAPTIVE)
    assert track.locked[300:].all()


def test_a_motion_that_is_far_too_large_is_not_locked(model: PeriodicModel) -> None:
    large = (walk(ramp(0.05)) - model.mean) * 6 + model.mean
    assert not tracked(model, large, ADAPTIVE).locked.any()


def test_backwards_is_not_locked(model: PeriodicModel) -> None:
    track = tracked(model, noisy(walk(-ramp(0.05))), ADAPTIVE)
    assert track.locked[100:].mean() < 0.05


def test_other_motion_is_not_locked(model: PeriodicModel) -> None:
    turning = ramp(0.05)
    other = np.stack([20 * np.sin(rate * turning) for rate in (1.0, 1.0, 2.3, 3.1)], axis=1) + model.mean
    assert tracked(model, other, ADAPTIVE).locked[100:].mean() < 0.3
    rng = np.random.default_rng(4)
    assert not tracked(model, 20 * rng.standard_normal((COUNT, 4)) + model.mean, ADAPTIVE).locked.any()


def test_whoever_is_lost_begins_anew(model: PeriodicModel) -> None:
    truth = np.concatenate([ramp(0.05)[:500], ramp(0.05)[500:] + np.pi])  # half a cycle is skipped at once
    adaptive, paper = tracked(model, walk(truth), ADAPTIVE), tracked(model, walk(truth), PAPER)
    off = [np.abs(wrapped(track.phase_rad - truth)) > 0.3 for track in (adaptive, paper)]
    assert off[0][500:].sum() < 12
    assert off[1][500:].sum() > 20


def test_one_channel_is_ambiguous_at_an_instant_and_not_with_its_past() -> None:
    phase = np.linspace(0, 2 * np.pi, 130, endpoint=False)
    model = fitted(("a",), [Exemplar(np.sin(phase)[:, None], phase)])
    truth = ramp(0.04)
    values = np.sin(truth)[:, None]
    alone = tracked(model, values, TrackerSettings(start_rad=None, feedback=0.02))
    together = tracked(model, values, TrackerSettings(start_rad=None, feedback=0.02, lags=(0, 15, 30)))
    assert late_error_turns(together, truth) < 0.01
    assert late_error_turns(alone, truth) > 0.05
    assert together.locked[COUNT // 2 :].all()


def test_scale_of_units(model: PeriodicModel) -> None:
    phase = np.linspace(0, 2 * np.pi, 130, endpoint=False)
    mixed = fitted(model.channels, [Exemplar(walk(phase) * [1000, 1, 1, 1], phase)], one_unit=False)
    truth = ramp(0.05)
    assert late_error_turns(tracked(mixed, walk(truth) * [1000, 1, 1, 1], ADAPTIVE), truth) < 0.01


def test_one_and_no_sample(model: PeriodicModel) -> None:
    assert len(tracked(model, np.zeros((0, 4))).phase_rad) == 0
    one = tracked(model, walk(np.array([1.0])), ADAPTIVE)
    assert one.phase_rad[0] == pytest.approx(1.0, abs=0.2)
    assert not one.locked[0]


@pytest.mark.parametrize(
    "settings",
    [
        PAPER,
        TrackerSettings(smoothing=2.0, start_rad=-3.0),
        ADAPTIVE,
        TrackerSettings(start_rad=None, feedback=0.05, lags=(0, 12, 24), most_doubt=0.3),
    ],
)
def test_lanes_are_the_tracker(model: PeriodicModel, settings: TrackerSettings) -> None:
    """Walking, standing, backwards, other motion and silence, one after the other, long enough for lanes."""
    rng = np.random.default_rng(8)
    speeds = np.repeat(rng.choice([0.05, 0.0, -0.05, 0.09, 0.03], 53), 400)
    values = noisy(walk(np.cumsum(speeds)), 2.0)
    values[3000:3600] = 20 * rng.standard_normal((600, 4))
    values[5000:5600:50] *= 40
    values[9000:9500] = model.mean
    tracker = PhaseTracker(model, settings)
    steps = np.array([tracker.step(sample) for sample in values], dtype=np.float64)
    track = tracked(model, values, settings)
    assert np.abs(wrapped(track.phase_rad - steps[:, 0])).max() < 1e-9
    np.testing.assert_allclose(track.quality, steps[:, 1], atol=1e-9)
    np.testing.assert_allclose(track.confidence, steps[:, 2], atol=1e-9)
    np.testing.assert_allclose(track.cadence_rad, steps[:, 3], atol=1e-9)
    assert np.array_equal(track.locked, steps[:, 4] > 0)


def test_locks_have_hysteresis() -> None:
    confidence = np.array([0.0, 0.5, 0.6, 0.4, 0.3, 0.29, 0.5, 0.7, 0.31])
    assert locks(confidence).tolist() == [False, False, True, True, True, False, False, True, True]


def test_confidence_asks_for_likeness_speed_and_size() -> None:
    sure = [0.9, 1.0, 1.0, 1.0]
    cases = {tuple(sure): 1.0, (0.5, 1.0, 1.0, 1.0): 0.0, (0.9, 0.1, 1.0, 1.0): 0.0, (0.9, 1.0, 0.02, 1.0): 0.0}
    cases |= {(0.9, 1.0, 26.0, 1.0): 0.0, (0.675, 1.0, 1.0, 1.0): 0.5, (0.9, 1.0, 1.0, 0.0): 0.0}
    np.testing.assert_allclose(confidences(np.array(list(cases)).T), list(cases.values()), atol=1e-12)


@pytest.mark.parametrize("count", [1, 15, 16, 17, 700])
def test_running_means_are_the_recursion(count: int) -> None:
    values = np.random.default_rng(1).standard_normal((3, count))
    expected, mean = np.zeros_like(values), np.zeros(3)
    for at in range(count):
        mean = mean + 0.07 * (values[:, at] - mean)
        expected[:, at] = mean
    np.testing.assert_allclose(running_means(values, 0.07), expected, atol=1e-13)


def test_a_high_pass_takes_the_mean_and_keeps_the_motion() -> None:
    time_s = np.arange(0, 60, 1 / 120)
    values = np.stack([np.sin(2 * np.pi * time_s) + 40, 3 * np.cos(2 * np.pi * time_s) - 7], axis=1)
    passed = high_passed(values, 0.05, 120)
    slow, weight = values[0].copy(), 1 - np.exp(-2 * np.pi * 0.05 / 120)
    for sample, fast in zip(values, passed, strict=True):  # a filter of first order, sample by sample
        slow += weight * (sample - slow)
        np.testing.assert_allclose(fast, sample - slow, atol=1e-9)
    gain = 1 / np.hypot(1, 0.05)  # of a high-pass of first order at 20 times its cut-off
    assert np.ptp(passed[-1200:, 0]) / 2 == pytest.approx(gain, abs=0.005)
    assert np.abs(passed[-1200:].mean(axis=0)).max() < 0.01
