"""The tracker beside a plain account of the paper's three steps, and beside a search on a fine grid."""

import numpy as np
import pytest

from station.sync.phase.periodic_model import Exemplar, PeriodicModel, centres, fitted, wrapped
from station.sync.phase.phase_tracker import TrackerSettings, tracked
from station.sync.signals.signal import FloatArray

RNG_SEED = 5
COUNT = 16


def walk(phase_rad: FloatArray) -> FloatArray:
    """Four channels, roughly hips and knees of a walker in degrees (n, 4)."""
    hip, knee = phase_rad, 2 * phase_rad
    columns = [
        20 * np.sin(hip),
        -20 * np.sin(hip),
        15 * np.cos(hip) + 8 * np.sin(knee),
        -15 * np.cos(hip) + 8 * np.sin(knee),
    ]
    values: FloatArray = np.stack(columns, axis=1) + np.array([-15.0, -15.0, 30.0, 30.0])
    return values


@pytest.fixture(scope="module")
def model() -> PeriodicModel:
    phase = np.linspace(0, 2 * np.pi, 130, endpoint=False)
    return fitted(("rf", "lf", "rt", "lt"), [Exemplar(walk(phase), phase)], COUNT)


@pytest.fixture(scope="module")
def signal() -> FloatArray:
    """Ten seconds at 120 Hz of somebody who walks unevenly, stands a while, and walks on."""
    rng = np.random.default_rng(RNG_SEED)
    speed = np.concatenate([np.full(500, 0.06), np.zeros(200), np.full(500, 0.045)]) * (
        1 + 0.3 * rng.standard_normal(1200)
    )
    return walk(np.cumsum(speed)) + 3 * rng.standard_normal((1200, 4))


def by_the_paper(model: PeriodicModel, values: FloatArray, settings: TrackerSettings) -> tuple[FloatArray, FloatArray]:
    """§ 3.2, steps 1 to 3, as they stand there, all centres looked at."""
    mu, phi = centres(model.centre_count), settings.start_rad or 0.0
    f = model.at(mu)
    phases, qualities = [], []
    for y in values - model.mean:
        e1 = f @ y / (np.linalg.norm(f, axis=1) * np.linalg.norm(y))
        e = e1 - settings.smoothing * (wrapped(mu - (phi + settings.cadence_rad)) / (2 * np.pi)) ** 2
        j = int(np.argmax(e))
        below, here, above = e[j - 1], e[j], e[(j + 1) % len(mu)]
        a, b = (above + below) / 2 - here, (above - below) / 2
        x = -b / (2 * a)
        phi = float(wrapped(np.array(mu[j] + x * 2 * np.pi / len(mu))))
        phases.append(phi)
        qualities.append(a * x * x + b * x + here)
    return np.array(phases), np.array(qualities)


@pytest.mark.parametrize("smoothing", [0.0, 0.5, 4.0, 30.0, 100.0, 2000.0])
def test_it_is_the_paper_s(model: PeriodicModel, signal: FloatArray, smoothing: float) -> None:
    settings = TrackerSettings(smoothing=smoothing, start_rad=2.0)
    phases, qualities = by_the_paper(model, signal, settings)
    track = tracked(model, signal, settings)
    np.testing.assert_allclose(wrapped(track.phase_rad - phases), 0, atol=1e-9)
    np.testing.assert_allclose(track.quality, qualities, atol=1e-9)
    assert -np.pi < track.phase_rad.min()
    assert track.phase_rad.max() <= np.pi
    assert track.quality.max() <= 1.02  # the parabola may pass 1 by a little


@pytest.mark.parametrize("smoothing", [4.0, 100.0])
def test_the_parabola_is_near_the_maximum_of_a_fine_grid(model: PeriodicModel, smoothing: float) -> None:
    settings = TrackerSettings(smoothing=smoothing)
    values = walk(np.arange(600, dtype=np.float64) * 0.055)
    track = tracked(model, values, settings)
    grid = np.linspace(-np.pi, np.pi, 7200, endpoint=False)
    f = model.at(grid)
    f /= np.linalg.norm(f, axis=1, keepdims=True)
    previous = np.concatenate([[0.0], track.phase_rad[:-1]])
    y = model.zero_mean(values)
    y /= np.linalg.norm(y, axis=1, keepdims=True)
    e = y @ f.T - smoothing * (wrapped(grid[None, :] - (previous[:, None] + settings.cadence_rad)) / (2 * np.pi)) ** 2
    assert (
        np.abs(wrapped(grid[e.argmax(axis=1)] - track.phase_rad)).max() < 0.1
    )  # a quarter of the step: the basis ripples between centres
    np.testing.assert_allclose(e.max(axis=1), track.quality, atol=0.03)


def test_it_finds_the_phase_of_what_it_was_fitted_to(model: PeriodicModel) -> None:
    truth = 2.5 + np.arange(500, dtype=np.float64) * 0.05
    track = tracked(model, walk(truth))
    assert np.abs(wrapped(track.phase_rad - truth))[100:].max() < 0.1
    assert track.quality[100:].min() > 0.95


def test_at_rest_at_the_mean_the_phase_goes_on_by_the_cadence(model: PeriodicModel) -> None:
    track = tracked(model, np.tile(model.mean, (5, 1)), TrackerSettings(start_rad=1.0))
    assert track.phase_rad.tolist() == pytest.approx([1.05, 1.1, 1.15, 1.2, 1.25])
    assert np.abs(track.quality).max() < 0.1
