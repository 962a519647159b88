"""The player's tempo, against performances that were made at a known one."""

import numpy as np
import pytest

from station.music.performance import Performance
from station.scoring.align import align
from station.scoring.analysis.player_tempo import TempoCurve, tempo_curve
from tests.fakes.played import played, varied_groove, with_noise


def curve_of(at_s: np.ndarray[tuple[int], np.dtype[np.float64]]) -> TempoCurve:
    score = varied_groove(20)
    performance = played(score, at_s, np.arange(len(score)))
    return tempo_curve(score, performance, align(score, performance, clocked=False))


@pytest.mark.parametrize("tempo", [0.8, 1.0, 1.25])
def test_a_steady_tempo(tempo: float) -> None:
    """Written at 120 bpm."""
    curve = curve_of(2 + varied_groove(20).onset_s / tempo)
    assert curve.median_bpm == pytest.approx(120 * tempo, rel=1e-6)
    assert [bar.tempo_bpm for bar in curve.bars] == pytest.approx([120 * tempo] * 20, rel=1e-6)
    assert curve.drift_pct_per_minute == pytest.approx(0.0, abs=1e-4)


def test_a_tempo_that_rises_by_ten_percent_a_minute() -> None:
    """At second t of playing the pace is 1 + 0.1·t/60, so that s(t) = t + t²/1200; turned round by the root."""
    s = varied_groove(20).onset_s
    curve = curve_of(600 * (np.sqrt(1 + s / 300) - 1))
    assert curve.drift_pct_per_minute == pytest.approx(10.0, abs=0.2)


def test_the_drifts_interval_holds_the_truth_as_often_as_it_says() -> None:
    """60 takes that rise by 4 % a minute with 12 ms of noise: 95 % intervals miss six or more in one case of forty."""
    score, held = varied_groove(20), 0
    s = score.onset_s
    even = 1500 * (np.sqrt(1 + s / 750) - 1)  # t with s = t + t²/3000
    for seed in range(60):
        at_s, rows = with_noise(even, np.arange(len(score)), 12.0, seed)
        performance = played(score, at_s, rows)
        ends = tempo_curve(score, performance, align(score, performance, clocked=False)).drift_ci
        assert ends is not None
        held += ends[0] <= 4.0 <= ends[1]
    assert held >= 54


def test_too_few_bars_have_a_drift_without_interval() -> None:
    score = varied_groove(3)
    performance = played(score, score.onset_s + 1, np.arange(len(score)))
    curve = tempo_curve(score, performance, align(score, performance, clocked=False))
    assert curve.drift_pct_per_minute == pytest.approx(0.0, abs=1e-3)
    assert curve.drift_ci is None


def test_silence_has_no_tempo() -> None:
    score, silence = varied_groove(2), Performance.from_hits([])
    assert tempo_curve(score, silence, align(score, silence, clocked=False)) == TempoCurve((), None, None, None)
