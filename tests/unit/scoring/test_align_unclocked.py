"""Alignment without a click. The truth is how the hits were made: which stroke of the score each one is."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.matching.alignment import Alignment, Reference
from tests.fakes.played import played, varied_groove, with_noise
from tests.fakes.scores import even_snare

BAR_S = 2.0
Times = NDArray[np.float64]
Rows = NDArray[np.int64]


def take(score: Score, at_s: Times, rows: Rows | None = None, sd_ms: float = 10.0) -> tuple[Performance, Rows]:
    rows = np.arange(len(score)) if rows is None else rows
    times, order = with_noise(at_s, rows, sd_ms)
    return played(score, times, order), order


def matched(alignment: Alignment) -> Rows:
    return np.where(alignment.hit_label == Label.MATCH, alignment.note_of_hit, -1)


def right_share(alignment: Alignment, truth: Rows) -> float:
    return float((matched(alignment) == truth).mean())


@pytest.mark.parametrize("start_s", [-1.5, 0.4, 60.0])
@pytest.mark.parametrize("tempo", [0.55, 0.8, 1.0, 1.3, 1.8])
def test_any_tempo_and_any_start(start_s: float, tempo: float) -> None:
    score = varied_groove(12)
    performance, truth = take(score, start_s + score.onset_s / tempo)
    assert right_share(align(score, performance, clocked=False), truth) == 1.0


@pytest.mark.parametrize("depth", [0.03, 0.08, 0.12])
def test_a_tempo_that_sways(depth: float) -> None:
    score = varied_groove(60)
    sway_s = -depth * 60 / (2 * np.pi) * (1 - np.cos(2 * np.pi * score.onset_s / 60))
    performance, truth = take(score, score.onset_s + sway_s, sd_ms=15.0)
    assert right_share(align(score, performance, clocked=False), truth) > 0.995


def test_a_tempo_that_climbs_by_a_third() -> None:
    """From 120 to 160 bpm within two minutes."""
    score = varied_groove(60)
    grid = np.linspace(0, 130, 13_001)
    at = np.concatenate(([0], np.cumsum(0.01 / (1 + grid[:-1] / 360))))
    performance, truth = take(score, np.interp(score.onset_s, grid, at))
    assert right_share(align(score, performance, clocked=False), truth) > 0.99


def passage(score: Score, first_bar: int, end_bar: int) -> Rows:
    return np.flatnonzero((score.bar >= first_bar) & (score.bar < end_bar))


def joined(score: Score, *parts: tuple[Rows, float]) -> tuple[Performance, Rows]:
    """Passages, each moved by some seconds."""
    rows = np.concatenate([part for part, _ in parts])
    at_s = np.concatenate([score.onset_s[part] + by_s for part, by_s in parts])
    return take(score, at_s, rows)


def test_skipped_bars() -> None:
    score = varied_groove(40)
    performance, truth = joined(score, (passage(score, 0, 15), 0), (passage(score, 17, 40), -2 * BAR_S))
    result = align(score, performance, clocked=False)
    assert right_share(result, truth) > 0.985
    missed = np.unique(score.bar[result.note_label == Label.MISS])
    assert {15, 16} <= set(missed.tolist()) <= {14, 15, 16, 17}


def test_a_bar_played_twice_is_paired_once() -> None:
    score = varied_groove(40)
    performance, truth = joined(score, (passage(score, 0, 20), 0), (passage(score, 19, 40), BAR_S))
    result = align(score, performance, clocked=False)
    said = matched(result)
    assert (said[said >= 0] == truth[said >= 0]).mean() > 0.99
    assert abs(result.count(Label.PLAYED_AGAIN) - len(passage(score, 19, 20))) <= 4
    assert result.count(Label.EXTRA) <= 2
    assert result.count(Label.MISS) <= 4


def test_a_stop_and_a_restart_two_bars_back_counts_the_second_attempt() -> None:
    score = varied_groove(30)
    stopped = passage(score, 0, 14)[:-5]
    again_by_s = float(score.onset_s[stopped[-1]]) + 3.3 - float(score.onset_s[passage(score, 12, 13)[0]])
    performance, truth = joined(score, (stopped, 0), (passage(score, 12, 30), again_by_s))
    result = align(score, performance, clocked=False)
    first_attempt = np.arange(len(truth)) < len(stopped)
    again = first_attempt & (score.bar[truth] >= 12)
    assert (matched(result)[~again] == truth[~again]).mean() > 0.985
    assert (result.hit_label[again] == Label.PLAYED_AGAIN).mean() > 0.9


def test_a_pause_of_any_length() -> None:
    score = varied_groove(20)
    for pause_s in (0.7, 3.37, 47.0):
        performance, truth = joined(score, (passage(score, 0, 9), 0), (passage(score, 9, 20), pause_s))
        assert right_share(align(score, performance, clocked=False), truth) > 0.985


def test_a_start_in_the_middle() -> None:
    score = varied_groove(30)
    performance, truth = joined(score, (passage(score, 11, 30), 0.7))
    assert right_share(align(score, performance, clocked=False), truth) > 0.995


def test_a_count_in_on_the_hat_is_left_alone() -> None:
    score = varied_groove(12)
    performance, _ = take(score, score.onset_s + 2.0)
    clicks = [Hit(k * NS_PER_S // 2, Piece.HIHAT, Zone.BOW, 90) for k in range(4)]
    result = align(score, Performance.from_hits([*clicks, *performance]), clocked=False)
    assert set(result.hit_label[:4].tolist()) <= {Label.EXTRA, Label.PLAYED_AGAIN}
    assert result.count(Label.MATCH) == len(score)


def test_wrong_pieces_and_strays_do_not_lead_astray() -> None:
    score = varied_groove(40)
    rng = np.random.default_rng(3)
    performance, truth = take(score, 5 + score.onset_s / 0.9)
    hits = performance.hits.copy()
    astray = rng.random(len(hits)) < 0.1
    hits["piece"][astray] = Piece.FLOOR_TOM_1
    result = align(score, Performance.from_array(hits), clocked=False)
    assert (result.hit_label[astray] == Label.WRONG_PIECE).mean() > 0.95
    assert (result.note_of_hit == truth).mean() > 0.99


@pytest.mark.parametrize(
    ("start_s", "tempo", "reference"),
    [
        (0.0, 1.0, Reference.FILE),
        (0.05, 1.0, Reference.FILE),
        (0.4, 1.0, Reference.PLAYER),
        (0.0, 0.97, Reference.PLAYER),
    ],
)
def test_what_asynchronies_are_measured_against(start_s: float, tempo: float, reference: Reference) -> None:
    score = varied_groove(20)
    performance, _ = take(score, start_s + score.onset_s / tempo)
    result = align(score, performance, clocked=False)
    assert result.reference is reference
    mean_ms = result.asynchrony_ns[result.note_label == Label.MATCH].mean() / NS_PER_MS
    assert mean_ms == pytest.approx(1000 * start_s if reference is Reference.FILE else 0.0, abs=1.5)


@pytest.mark.parametrize("tempo", [0.7, 1.0, 1.4])
def test_spread_is_in_real_milliseconds_at_any_tempo(tempo: float) -> None:
    """12 ms of noise are 12 ms, up to what the running trend takes with it (a 33-hit line: 3 %)."""
    score = varied_groove(60)
    performance, _ = take(score, 3 + score.onset_s / tempo, sd_ms=12.0)
    result = align(score, performance, clocked=False)
    sd_ms = result.asynchrony_ns[result.note_label == Label.MATCH].std() / NS_PER_MS
    assert sd_ms == pytest.approx(12.0, rel=0.08)


Edge = Callable[[Score], Performance]


@pytest.mark.parametrize(
    "edge",
    [
        lambda _: Performance.from_hits([]),
        lambda _: Performance.from_hits([Hit(0, Piece.COWBELL, Zone.HEAD, 80)]),
        lambda _: Performance.from_hits([Hit(5, Piece.SNARE, Zone.HEAD, 80)]),
        lambda _: Performance.from_hits([Hit(5, Piece.SNARE, Zone.HEAD, 80)] * 50),
        lambda s: played(s, s.onset_s[:3], np.arange(3)),
    ],
)
def test_next_to_nothing(edge: Edge) -> None:
    score = varied_groove(4)
    performance = edge(score)
    result = align(score, performance, clocked=False)
    paired = result.count(Label.MATCH) + result.count(Label.WRONG_PIECE)
    assert paired + result.count(Label.MISS) == len(score)
    assert paired + result.count(Label.EXTRA) + result.count(Label.IGNORED) == len(performance)


def test_a_score_of_one_note() -> None:
    score = varied_groove(1)
    one = Score.from_array(score.notes[:1].copy(), score.tempo_map)
    performance = played(one, np.array([7.0]), np.array([0]))
    assert align(one, performance, clocked=False).count(Label.MATCH) == 1


@pytest.mark.parametrize("seed", range(6))
def test_a_flurry_has_no_tempo_and_is_aligned_all_the_same(seed: int) -> None:
    """Eight strokes within a fifth of a second against quarters at 60 bpm: at most two of them answer notes."""
    score = even_snare(12, 1000)
    at_s = np.sort(np.random.default_rng(seed).uniform(0, 0.2, 8))
    alignment = align(score, played(score, at_s, np.arange(8)), clocked=False)
    assert alignment.count(Label.MATCH) + alignment.count(Label.EXTRA) == 8
    assert alignment.count(Label.MATCH) <= 2
