"""A recording is judged alike wherever in its file it begins."""

import numpy as np
import pytest

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.summary import Summary, summarise
from station.scoring.matching.alignment import Reference
from station.scoring.report.advice import advise
from tests.fakes.played import played, varied_groove
from tests.fakes.scores import beat_and_fill, swing_ride

OFFSETS_S = (0.0, 0.007, 1.3, 2.0, 12.0, -0.2)
"""Within a lean, within a bar, a bar, six bars, and cut off at the front."""


def steady(s: np.ndarray[tuple[int], np.dtype[np.float64]]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return s


def swaying(s: np.ndarray[tuple[int], np.dtype[np.float64]]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """50 ms ahead and behind in turn, 16 s from one to the next: between a click's player and a free one."""
    return s + 0.05 * np.sin(2 * np.pi * s / 16)


def drifting(s: np.ndarray[tuple[int], np.dtype[np.float64]]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """2 % slower from the first stroke on."""
    return 1.02 * s


def assessed(score: Score, performance: Performance, start_s: float) -> Summary:
    hits = performance.hits.copy()
    hits["at_ns"] += round(start_s * NS_PER_S)
    later = Performance.from_array(hits)
    return summarise(score, later, align(score, later, clocked=False))


def take(score: Score, tempo: object, seed: int, late_ms: float = 0.0) -> Performance:
    assert callable(tempo)
    off = np.random.default_rng(seed).normal(late_ms, 14.0, len(score)) / 1000
    at_s = tempo(score.onset_s) + off
    order = np.argsort(at_s, kind="stable")
    return played(score, at_s[order], order)


def faults(summary: Summary) -> set[str]:
    """What is advised, but for a lean of the whole, which is known only on a time base that both share."""
    return {advice.fault for advice in advise(summary)} - {"late", "early"}


@pytest.mark.parametrize("score", [varied_groove(12), beat_and_fill(3), swing_ride(12)])
@pytest.mark.parametrize("tempo", [steady, swaying, drifting])
@pytest.mark.parametrize("seed", range(2))
def test_the_same_take_has_the_same_score_wherever_it_begins(score: Score, tempo: object, seed: int) -> None:
    performance = take(score, tempo, seed, late_ms=20.0)
    found = [assessed(score, performance, start_s) for start_s in OFFSETS_S]
    scores = [summary.points for summary in found if summary.points is not None]
    assert len(scores) == len(found)
    assert max(scores) - min(scores) <= 0.5
    assert all(faults(summary) == faults(found[0]) for summary in found)


def test_a_lean_of_the_whole_moves_no_score_and_is_told_on_a_shared_time_base() -> None:
    score = varied_groove(12)
    on_time, late = (assessed(score, take(score, steady, 1, late_ms), 0.0) for late_ms in (0.0, 60.0))
    assert on_time.points == pytest.approx(late.points, abs=0.1)
    assert late.alignment.reference is Reference.FILE
    assert late.timing.mean_ms == pytest.approx(60.0, abs=3.0)
    assert "late" in {advice.fault for advice in advise(late)}


@pytest.mark.parametrize("sway_ms", [10.0, 30.0, 50.0, 70.0, 150.0])
def test_slow_sway_costs_little_without_a_click_and_has_no_edge(sway_ms: float) -> None:
    """Ahead and behind in turn over 20 s, from what a click's player may sway to what only a free one does."""
    score = varied_groove(20)

    def tempo(s: np.ndarray[tuple[int], np.dtype[np.float64]]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        return s + sway_ms / 1000 * np.sin(2 * np.pi * s / 20)

    even, swayed = (assessed(score, take(score, how, 4), 0.0).points for how in (steady, tempo))
    assert even is not None
    assert swayed is not None
    assert 0 <= even - swayed + 0.5 <= 3


def test_a_player_to_a_click_is_measured_by_it_wherever_the_recording_begins() -> None:
    """Four bars of twelve 25 ms late: of the trend of the whole nothing would be left but its edges."""
    score = varied_groove(12)
    late_s = np.where((score.bar >= 4) & (score.bar < 8), 0.025, 0.0)
    for start_s in OFFSETS_S:
        summary = assessed(score, played(score, score.onset_s + late_s, np.arange(len(score))), start_s)
        off_ms = summary.alignment.asynchrony_ns / NS_PER_MS
        middle, rest = (np.median(off_ms[bars]) for bars in (late_s > 0, late_s == 0))
        assert middle - rest == pytest.approx(25.0, abs=1.0)
