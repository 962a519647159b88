"""The phase tracker on the CMU walks of Boyd and Godbout 2012: what their § 4 says, and that ours is never worse.

The files may be used freely but not sold, so they are not passed on (mocap.cs.cmu.edu, NSF EIA-0196217).
"""

from pathlib import Path

import numpy as np
import pytest

from station.sync.phase.exemplars import cycles, rising_crossings_s
from station.sync.phase.periodic_model import PeriodicModel, fitted, wrapped
from station.sync.phase.phase_tracker import ADAPTIVE, PAPER, TrackerSettings, tracked
from station.sync.signals.signal import CHANNEL_SETS, Signal
from station.sync.signals.signal_files import read_signal
from tests.oracles.folder import ORACLES, oracles

pytestmark = pytest.mark.oracle
STRAIGHT = ("07_01", "07_06", "08_01", "08_04", "02_01", "16_15", "16_22", "35_01", "35_05", "35_28", "49_01")


def signal_of(path: Path) -> Signal:
    return read_signal(path).only(CHANNEL_SETS["walk"])


@pytest.fixture(scope="module")
def model() -> PeriodicModel:
    signal = signal_of(ORACLES / "mocap/amc/07/07_01.amc")
    return fitted(signal.names, cycles(signal, "rfemur_rx"))


def about(model: PeriodicModel, signal: Signal) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    moved: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = signal.values - signal.values.mean(axis=0) + model.mean
    return moved


def crossing_phases(signal: Signal, phase_rad: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
    """The phases, in turns, at which the right femur rises through its mean, after the first cycle's 0.8 s."""
    at_s = rising_crossings_s(signal.time_s, signal.values[:, 0])
    phases = wrapped(np.interp(at_s, signal.time_s, np.unwrap(phase_rad))) / (2 * np.pi)
    return [phase for phase, second in zip(phases.tolist(), at_s, strict=True) if second > 0.8]


@pytest.mark.parametrize("path", oracles("the CMU motions"))
def test_every_motion_can_be_read(path: Path) -> None:
    signal = signal_of(path)
    assert signal.rate_hz == pytest.approx(120, rel=1e-3)
    assert np.abs(signal.values).max() < 180


@pytest.mark.parametrize(
    "path", [each for each in oracles("the CMU motions") if Path(str(each.values[0])).stem in STRAIGHT]
)
def test_straight_walks_are_followed(path: Path, model: PeriodicModel) -> None:
    signal = signal_of(path)
    values = about(model, signal)
    paper, adaptive = tracked(model, values, PAPER), tracked(model, values, ADAPTIVE)
    assert 0.94 <= np.median(paper.quality) <= 1.0  # docs: median E_max 0.94 … 0.99
    for track in (paper, adaptive):
        assert np.abs(crossing_phases(signal, track.phase_rad)).max(initial=0.0) < 0.08
    assert adaptive.locked[60:].mean() > 0.95


def test_convergence_takes_at_most_three_quarters_of_a_cycle(model: PeriodicModel) -> None:
    signal = signal_of(ORACLES / "mocap/amc/07/07_01.amc")
    settled = tracked(model, about(model, signal)).phase_rad
    for start_rad in np.linspace(-np.pi, np.pi, 12, endpoint=False):
        track = tracked(model, about(model, signal), TrackerSettings(start_rad=float(start_rad)))
        off = np.flatnonzero(np.abs(wrapped(track.phase_rad - settled)) > 0.05 * 2 * np.pi)
        assert off.max(initial=0) <= 0.75 * 131  # samples of its cycle of 1.09 s


def test_both_editions_of_a_trial_have_one_phase(model: PeriodicModel) -> None:
    amc, bvh = (signal_of(ORACLES / f"mocap/{kind}/07/07_01.{kind}") for kind in ("amc", "bvh"))
    first, second = (tracked(model, about(model, each)).phase_rad for each in (amc, bvh))
    assert np.abs(wrapped(first - second))[100:].max() / (2 * np.pi) < 0.02


def test_walking_backwards_is_known(model: PeriodicModel) -> None:
    signal = signal_of(ORACLES / "mocap/amc/07/07_06.amc")
    backwards = about(model, signal)[::-1]
    assert tracked(model, backwards, ADAPTIVE).locked.mean() < 0.1
