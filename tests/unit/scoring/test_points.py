"""The score from 0 to 100: its ends, its direction, and who tries to cheat it."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.analysis.summary import summarise
from tests.fakes.scores import beat_and_fill, double_strokes, even_snare, flams, rock_beat, swing_ride

Array = NDArray[np.generic]

SCORES = [rock_beat(4), beat_and_fill(2), double_strokes(4), flams(4), swing_ride(4), even_snare(32, 500)]
PADS = (Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.CRASH_1, Piece.RIDE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)


def points(score: Score, at_ns: Array, piece: Array, velocity: Array | int = 80) -> float:
    hits = np.zeros(len(at_ns), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"] = at_ns, piece, velocity
    performance = Performance.from_array(hits)
    result = summarise(score, performance, align(score, performance, clocked=True)).points
    assert result is not None
    return result


@pytest.mark.parametrize("score", SCORES)
def test_a_perfect_performance_scores_100(score: Score) -> None:
    assert points(score, score.onset_ns, score.notes["piece"], score.notes["velocity"]) == pytest.approx(100)


@pytest.mark.parametrize("score", SCORES)
def test_silence_scores_0(score: Score) -> None:
    assert points(score, np.zeros(0), np.zeros(0)) == 0


@pytest.mark.parametrize("score", SCORES)
@pytest.mark.parametrize("rate", [4, 8, 16, 40])
def test_random_hammering_scores_under_10(score: Score, rate: int) -> None:
    """`rate` strokes a second at random times on random pads."""
    rng = np.random.default_rng(rate)
    count = rate * score.length_ns // NS_PER_S
    assert points(score, rng.integers(0, score.length_ns, count), rng.choice(PADS, count)) < 10


@pytest.mark.parametrize("score", SCORES)
def test_hammering_all_pads_on_every_16th_scores_under_10(score: Score) -> None:
    ticks = np.arange(0, score.end_tick, 107_520 // 4)
    at = np.tile(score.tempo_map.ns_at(ticks), len(PADS))
    assert points(score, at, np.repeat(np.array(PADS), len(ticks))) < 10


def test_a_score_without_notes_has_no_points() -> None:
    empty, silence = Score.from_notes([], rock_beat(1).tempo_map), Performance.from_hits([])
    assert summarise(empty, silence, align(empty, silence, clocked=True)).points is None


@pytest.mark.parametrize("score", SCORES)
def test_less_scatter_never_scores_less(score: Score) -> None:
    """Averaged over ten seeds, the same draws scaled."""
    means = []
    for sd_ms in (40, 30, 20, 12, 6, 2):
        scores = []
        for seed in range(10):
            noise = np.random.default_rng(seed).normal(0, 1, len(score)) * sd_ms * NS_PER_MS
            scores.append(points(score, score.onset_ns + np.rint(noise).astype(np.int64), score.notes["piece"]))
        means.append(np.mean(scores))
    assert means == sorted(means)


def test_a_laid_back_snare_costs_nothing() -> None:
    """20 ms late on every snare is feel; 60 ms is not."""
    score = rock_beat(4)
    late = (score.notes["piece"] == Piece.SNARE) * NS_PER_MS
    pieces, velocity = score.notes["piece"], score.notes["velocity"]
    assert points(score, score.onset_ns + 20 * late, pieces, velocity) == pytest.approx(100)
    assert points(score, score.onset_ns + 60 * late, pieces, velocity) < 95


def test_each_fault_costs() -> None:
    score = rock_beat(4)
    at, piece = score.onset_ns, score.notes["piece"]
    full = points(score, at, piece, score.notes["velocity"])
    missed = points(score, at[:-1], piece[:-1], score.notes["velocity"][:-1])
    added = points(score, np.append(at, at[-1] + 60 * NS_PER_MS), np.append(piece, Piece.TOM_1))
    flat = points(score, at, piece, 80)
    assert max(missed, added, flat) < full


def test_a_quiet_roll_over_an_exercise_of_the_snare_scores_under_20() -> None:
    """14 strokes a second at ghost level over eighths at 120 bpm: 3.6 hits a note, precision 0.28, its square 0.08."""
    notes = [Note(k * PPQ // 2, Piece.SNARE, velocity=90) for k in range(32)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    at = np.arange(0, score.length_ns, 70 * NS_PER_MS)
    assert points(score, at, np.full(len(at), int(Piece.SNARE)), 30) < 20
