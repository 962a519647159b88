"""A walk made of sines, tracked and sonified: its triggers lie where its sines say."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.sync.phase.whole_recording import zero_mean
from station.sync.signals.signal import CHANNEL_SETS, Signal
from station.sync.sonification.sonified import sonified
from station.sync.sonification.trigger_table import PRESETS
from station.sync.walking.trial import gait_model

RATE_HZ, PERIOD_S = 120.0, 1.05
SECONDS = 8.0


def walk(seconds: float = SECONDS, posture: float = 0.0, cycles: np.ndarray | None = None) -> Signal:
    """Hips and knees of a walker whose right thigh passes its middle, going back, at each whole cycle."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    turn = 2 * np.pi * (time_s / PERIOD_S if cycles is None else cycles)
    hips = 25 * np.sin(turn)
    knees = [30 + 20 * np.cos(turn + side) + 9 * np.sin(2 * turn) for side in (0.6, 0.6 + np.pi)]
    return Signal(time_s, CHANNEL_SETS["walk"], np.stack([hips, -hips, *knees], axis=1) + posture)


def test_footfalls_sound_a_quarter_and_three_quarters_through() -> None:
    """φ = 0 at the rising zero crossing, hence (φ + π)/2π = .25 at three quarters of the sines' own cycle."""
    told = sonified(gait_model(walk()), walk(), PRESETS["walk"])
    late = [hit for hit in told.hits if hit.at_ns > 1.5e9 * PERIOD_S]
    in_cycle = [(hit.at_ns / 1e9 / PERIOD_S) % 1.0 for hit in late]
    expected = [0.75 if hit.piece is Piece.KICK else 0.25 for hit in late]
    assert len(late) == 12
    assert in_cycle == pytest.approx(expected, abs=0.03)


def test_another_posture_changes_nothing() -> None:
    model = gait_model(walk())
    plain, leaning = (sonified(model, walk(posture=p), PRESETS["walk"]) for p in (0.0, 17.0))
    assert [hit.at_ns for hit in leaning.hits] == pytest.approx([hit.at_ns for hit in plain.hits], abs=1000)
    assert zero_mean(model, walk(posture=17.0)).values.mean(axis=0) == pytest.approx(model.mean)


def test_walking_backwards_is_silent() -> None:
    time_s = np.arange(round(SECONDS * RATE_HZ)) / RATE_HZ
    told = sonified(gait_model(walk()), walk(cycles=-time_s / PERIOD_S), PRESETS["walk"])
    assert len(told.hits) <= 1


def test_a_missing_channel_is_named() -> None:
    model, signal = gait_model(walk()), walk().only(CHANNEL_SETS["walk"][:3])
    with pytest.raises(BadInput, match="ltibia_rx"):
        sonified(model, signal, PRESETS["walk"])
