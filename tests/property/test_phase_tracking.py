"""What must hold of the phase of any periodic motion: turned, scaled, doubled, or cut into pieces."""

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from station.sync.phase.periodic_model import PeriodicModel, centres, wrapped
from station.sync.phase.phase_tracker import ADAPTIVE, PAPER, PhaseTracker, TrackerSettings, tracked
from station.sync.signals.signal import FloatArray

SETTINGS = st.sampled_from([PAPER, ADAPTIVE, replace(PAPER, smoothing=5.0), replace(ADAPTIVE, lags=(0, 9))])
SEEDS = st.integers(0, 10_000)
CENTRES = st.sampled_from([5, 8, 16, 33])


def a_model(seed: int, count: int, channels: int = 3) -> PeriodicModel:
    """Smooth channels: a fundamental and an overtone each, with any phase."""
    rng = np.random.default_rng(seed)
    phase, turn = centres(count)[None, :], 2 * np.pi * rng.random((channels, 2))
    weights = np.sin(phase + turn[:, :1]) + 0.4 * np.sin(2 * phase + turn[:, 1:])
    return PeriodicModel(tuple("abcdefgh"[:channels]), weights, rng.normal(size=channels), np.ones(channels))


def a_signal(seed: int, model: PeriodicModel, length: int = 120) -> FloatArray:
    rng = np.random.default_rng(seed + 1)
    phase = np.cumsum(0.05 + 0.02 * rng.standard_normal(length)) + 6 * rng.random()
    return model.values(phase) + 0.1 * rng.standard_normal((length, len(model.channels)))


def same(first: FloatArray, second: FloatArray) -> bool:
    return bool(np.abs(wrapped(first - second)).max() < 1e-6)


@given(SEEDS, CENTRES, SETTINGS, st.integers(1, 32))
def test_a_model_turned_by_some_centres_turns_every_phase(
    seed: int, count: int, settings: TrackerSettings, steps: int
) -> None:
    model = a_model(seed, count)
    by_rad = steps * 2 * np.pi / count
    values = a_signal(seed, model)
    start = settings if settings.start_rad is None else replace(settings, start_rad=settings.start_rad + by_rad)
    turned = replace(model, weights=np.roll(model.weights, steps, axis=1))
    assert same(tracked(turned, values, start).phase_rad, tracked(model, values, settings).phase_rad + by_rad)


@given(SEEDS, CENTRES, SETTINGS, st.floats(0.01, 100))
def test_the_size_of_a_signal_changes_no_phase(seed: int, count: int, settings: TrackerSettings, size: float) -> None:
    model = a_model(seed, count)
    values = a_signal(seed, model)
    larger = (values - model.mean) * size + model.mean
    first, second = tracked(model, values, settings), tracked(model, larger, settings)
    assert same(first.phase_rad, second.phase_rad)
    np.testing.assert_allclose(first.quality, second.quality, atol=1e-6)


@given(SEEDS, CENTRES, SETTINGS)
def test_channels_that_are_there_twice_change_nothing(seed: int, count: int, settings: TrackerSettings) -> None:
    model = a_model(seed, count)
    values = a_signal(seed, model)
    twice = PeriodicModel(
        (*model.channels, *"xyz"), np.tile(model.weights, (2, 1)), np.tile(model.mean, 2), np.tile(model.scale, 2)
    )
    first, second = tracked(model, values, settings), tracked(twice, np.tile(values, (1, 2)), settings)
    assert same(first.phase_rad, second.phase_rad)
    np.testing.assert_allclose(first.confidence, second.confidence, atol=1e-6)


@given(SEEDS, CENTRES, SETTINGS)
def test_sample_by_sample_and_as_a_whole(seed: int, count: int, settings: TrackerSettings) -> None:
    model = a_model(seed, count)
    values = a_signal(seed, model)
    tracker = PhaseTracker(model, settings)
    steps = [tracker.step(list(sample)) for sample in values]
    track = tracked(model, values, settings)
    assert np.abs(wrapped(track.phase_rad - np.array([step.phase_rad for step in steps]))).max() < 1e-9
    assert all(-np.pi < step.phase_rad <= np.pi and 0 <= step.confidence <= 1 for step in steps)
    assert track.locked.tolist() == [step.locked for step in steps]


@given(SEEDS, st.sampled_from([PAPER, ADAPTIVE]))
def test_a_model_tracks_itself(seed: int, settings: TrackerSettings) -> None:
    model = a_model(seed, 16, channels=6)
    truth = 1.0 + 0.05 * np.arange(260, dtype=np.float64)
    track = tracked(model, model.values(truth), settings)
    # the step between centres: a basis of Gaussians 2σ apart ripples
    assert np.abs(wrapped(track.phase_rad - truth))[130:].max() < np.pi / 8
