"""Periodic models: their basis beside scipy's normal density, fits of known curves, and their files."""

import tracemalloc
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm

from station.core.errors import BadInput
from station.sync.phase.exemplars import cycles, rising_crossings_s
from station.sync.phase.model_file import load_model, model_text, save_model
from station.sync.phase.periodic_model import MOST_CENTRES, Exemplar, PeriodicModel, centres, fitted, gaussians, wrapped
from station.sync.signals.signal import FloatArray, Signal

PHASE = np.linspace(0, 2 * np.pi, 200, endpoint=False)
RIPPLE = 3 * (np.exp(-(15**2 - 1) * (np.pi / 16) ** 2 / 2) + np.exp(-(17**2 - 1) * (np.pi / 16) ** 2 / 2)) + 0.002
"""What 16 Gaussians 2σ apart leave of 3 sin φ: its images in harmonics 15 and 17, by the transform of a Gaussian."""


def curves(phase_rad: FloatArray) -> FloatArray:
    """Two channels that no small basis holds exactly: (n, 2)."""
    return np.stack([10 + 3 * np.sin(phase_rad), -5 + np.cos(phase_rad) + np.cos(2 * phase_rad + 0.3)], axis=1)


def test_centres_lie_in_the_half_open_turn() -> None:
    assert centres(4).tolist() == pytest.approx([-np.pi / 2, 0, np.pi / 2, np.pi])
    assert wrapped(np.array([np.pi, -np.pi, 3 * np.pi, 0.5 - 2 * np.pi])).tolist() == pytest.approx(
        [np.pi, np.pi, np.pi, 0.5]
    )


def test_a_rounding_error_beyond_pi_does_not_become_minus_pi() -> None:
    beyond = np.nextafter(np.pi, 4)
    assert wrapped(np.array([beyond, -np.pi, 3 * np.pi])).min() > -np.pi


@pytest.mark.parametrize("count", [3, 4, 16, 38, 39])
def test_gaussians_are_the_normal_density_wrapped(count: int) -> None:
    apart = PHASE[:, None] - centres(count)[None, :]
    expected = sum(norm.pdf(apart + 2 * np.pi * turn, scale=np.pi / count) for turn in range(-6, 7))
    np.testing.assert_allclose(gaussians(PHASE, count), expected, rtol=1e-12, atol=1e-14)


def test_a_fit_finds_smooth_curves_again() -> None:
    model = fitted(("a", "b"), [Exemplar(curves(PHASE), PHASE)])
    np.testing.assert_allclose(model.values(PHASE), curves(PHASE), atol=RIPPLE)
    assert model.mean.tolist() == pytest.approx([10, -5])


def test_several_exemplars_are_averaged_though_people_differ_in_posture() -> None:
    low, high = Exemplar(curves(PHASE) - 4, PHASE, 1.0), Exemplar(curves(PHASE) + 6, PHASE, 1.5)
    model = fitted(("a", "b"), [low, high])
    np.testing.assert_allclose(model.values(PHASE), curves(PHASE) + 1, atol=RIPPLE)
    assert model.period_s == 1.25


def test_channels_of_different_units_count_by_their_spread() -> None:
    values = curves(PHASE) * [1000.0, 1.0]
    model = fitted(("a", "b"), [Exemplar(values, PHASE)], one_unit=False)
    np.testing.assert_allclose(model.scale, values.std(axis=0))
    np.testing.assert_allclose(model.values(PHASE)[:, 0], values[:, 0], atol=1000 * RIPPLE)
    np.testing.assert_allclose(model.zero_mean(values).std(axis=0), 1)


def test_few_samples_leave_weights_finite() -> None:
    model = fitted(("a", "b"), [Exemplar(curves(PHASE[:3]), PHASE[:3])], 64)
    assert np.abs(model.weights).max() < 100


def test_cycles_are_cut_at_rising_crossings() -> None:
    time_s = np.arange(0, 4, 0.01)
    values = np.stack([np.sin(2 * np.pi * (time_s - 0.205) / 1.25), np.cos(time_s)], axis=1)
    found = cycles(Signal(time_s, ("a", "b"), values), "a", None)
    # sin rises through 0 at 0.205, 1.455, 2.705 and 3.955 s; its mean over 3.2 cycles is near 0
    assert len(found) == 3
    assert [each.period_s for each in found] == pytest.approx([1.25] * 3, abs=1e-3)
    assert found[0].phase_rad[0] == pytest.approx(0, abs=0.1)
    assert len(found[0].values) == pytest.approx(125, abs=1)


def test_a_take_without_a_whole_cycle_is_refused() -> None:
    time_s = np.arange(0, 1, 0.01)
    with pytest.raises(BadInput, match="a: expected two zero crossings with positive slope, found 1"):
        cycles(Signal(time_s, ("a",), np.sin(2 * np.pi * time_s - 1)[:, None]), "a")


def a_model() -> PeriodicModel:
    return fitted(("a", 'b "quoted"'), [Exemplar(curves(PHASE), PHASE, 1.1)])


def test_a_file_keeps_every_bit(tmp_path: Path) -> None:
    model, path = a_model(), tmp_path / "walk.toml"
    save_model(model, path)
    loaded = load_model(path)
    assert loaded.channels == model.channels
    assert loaded.period_s == 1.1
    for kept in ("weights", "mean", "scale"):
        assert np.array_equal(getattr(loaded, kept), getattr(model, kept))


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("phase-model/1", "phase-model/9", "line 1, column 10: format: expected drum-station/phase-model/1"),
        ("period_s = 1.1", "period_s = -1", "line 2, column 12: period_s: expected a number from"),
        ("name = ", "nmae = ", "no such key: nmae"),
        ('name = "b \\"quoted\\""', 'name = "a"', "a is here twice"),
        ("weights = [\n", "weights = [\n    nan,\n", "expected a number from"),
        ("weights = [\n", "weights = [\n    1.0,\n", "weights"),
    ],
)
def test_files_with_faults(tmp_path: Path, old: str, new: str, fault: str) -> None:
    path = tmp_path / "walk.toml"
    path.write_text(model_text(a_model()).replace(old, new, 1))
    with pytest.raises(BadInput, match=fault):
        load_model(path)


def test_a_file_without_channels(tmp_path: Path) -> None:
    path = tmp_path / "walk.toml"
    path.write_text('format = "drum-station/phase-model/1"\n')
    with pytest.raises(BadInput, match="channel is missing"):
        load_model(path)


def test_the_greatest_model_needs_no_gigabyte() -> None:
    tracemalloc.start()
    try:
        gaussians(centres(MOST_CENTRES), MOST_CENTRES)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 6 * 8 * MOST_CENTRES**2


def test_a_signal_without_samples_has_no_crossings() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not len(rising_crossings_s(np.empty(0), np.empty(0)))
