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
from station.scoring.analysis.loudness import dynamics
from station.scoring.analysis.points import Judged
from station.scoring.analysis.points import points as points_of
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.matching.hit_windows import LEVELS, Windows
from tests.fakes.scores import beat_and_fill, double_strokes, even_snare, flams, rock_beat, swing_ride

Array = NDArray[np.generic]

SCORES = [rock_beat(4), beat_and_fill(2), double_strokes(4), flams(4), swing_ride(4), even_snare(32, 500)]
PADS = (Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.CRASH_1, Piece.RIDE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)


def performed(at_ns: Array, piece: Array, velocity: Array | int) -> Performance:
    hits = np.zeros(len(at_ns), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"] = at_ns, piece, velocity
    return Performance.from_array(hits)


def points(score: Score, at_ns: Array, piece: Array, velocity: Array | int = 80) -> float:
    performance = performed(at_ns, piece, velocity)
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
            scores.append(scored(score, score.onset_ns + np.rint(noise).astype(np.int64), score.notes["piece"]))
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


# --- no cliffs --------------------------------------------------------------------------------------------------------

STEEPEST = 0.35 / 15
"""Of a full mark a ms: from 25 to 40 ms a stroke falls from 75 to 40 % (HUMANS: mild, clear fault)."""


def scored(score: Score, at_ns: Array, piece: Array, velocity: Array | int = 80) -> float:
    """The score alone, of timing and dynamics."""
    performance = performed(at_ns, piece, velocity)
    alignment = align(score, performance, clocked=True)
    nowhere = np.zeros(len(score), np.bool_)
    judged = Judged(dynamics(score, performance, alignment).off_db, nowhere, nowhere)
    result = points_of(score, alignment, judged)
    assert result is not None
    return result


def human(score: Score, seed: int, sd_ms: float = 15.0) -> Array:
    """Times (n,) in ns with an independent error a stroke."""
    off = np.random.default_rng(seed).normal(0, sd_ms, len(score)) * NS_PER_MS
    return score.onset_ns + np.rint(off).astype(np.int64)


@pytest.mark.parametrize("score", [rock_beat(3), beat_and_fill(1), swing_ride(4), even_snare(32, 500)])
@pytest.mark.parametrize("seed", range(3))
def test_a_stroke_that_moves_by_a_millisecond_moves_the_score_by_its_share(score: Score, seed: int) -> None:
    """Its own credit, and as much again for what it says of the lean and the swing that are set apart."""
    at, piece = human(score, seed), score.notes["piece"]
    before = scored(score, at, piece, score.notes["velocity"])
    for stroke in range(0, len(score), 3):
        moved = at.copy()
        moved[stroke] += NS_PER_MS
        after = scored(score, moved, piece, score.notes["velocity"])
        assert abs(after - before) <= 2 * 100 / len(score) * STEEPEST


@pytest.mark.parametrize("score", [rock_beat(4), beat_and_fill(2)])
def test_a_stroke_that_is_left_out_costs_its_share_and_never_pays(score: Score) -> None:
    """One of n, and as much for what it said of the others; better without it is nobody, however late it was."""
    at, piece, velocity = human(score, 1), score.notes["piece"], score.notes["velocity"]
    before = scored(score, at, piece, velocity)
    for stroke in range(len(score)):
        here = np.arange(len(score)) != stroke
        after = scored(score, at[here], piece[here], velocity[here])
        assert before - 200 / len(score) <= after <= before + 1e-9


@pytest.mark.parametrize("ratio", [1.34, 1.31, 1.28, 1.2, 1.1, 1.02])
def test_a_straighter_swing_costs_more_and_more_without_a_step(ratio: float) -> None:
    """A ride written 2:1, of which swing is heard from 1.3:1 on: a ratio less by 0.02 costs up to 3, never all at once.

    Two of eight strokes swing, so that all the way to 1:1 costs a quarter, over 15 such steps; the steepest costs
    twice that.
    """
    score = swing_ride(8)
    assert 0 <= swung_by(score, ratio, 2) - swung_by(score, ratio - 0.02, 2) <= 3


def swung_by(score: Score, ratio: float, seed: int) -> float:
    late_ms = np.where(score.notes["tick"] % PPQ > 0, 500.0 * (ratio / (1 + ratio) - 2 / 3), 0.0)
    at = human(score, seed, 8.0) + np.rint(late_ms * NS_PER_MS).astype(np.int64)
    return scored(score, at, score.notes["piece"])


@pytest.mark.parametrize("ratio", [1.1, 1.3])
def test_a_swing_at_the_edge_of_what_is_heard_scores_alike_whatever_the_noise(ratio: float) -> None:
    """Ten takes by one player, who holds 1.3:1, from which swing is heard, or 1.1:1, which is hardly any.

    32 swung offbeats with an SD of 8 ms know their ratio to 1.4 ms, of which each is 2.5 ms on a quarter of the
    strokes: an SD of 2 points, and ten takes lie within three of them, or of four with what else differs.
    """
    found = [swung_by(swing_ride(16), ratio, seed) for seed in range(10)]
    assert max(found) - min(found) < 10


@pytest.mark.parametrize("score", [rock_beat(4), swing_ride(4)])
def test_more_lean_never_scores_more(score: Score) -> None:
    """All strokes late against the click by the same, averaged over four players."""
    means = [
        np.mean([scored(score, human(score, seed) + late * NS_PER_MS, score.notes["piece"]) for seed in range(4)])
        for late in (0, 15, 30, 45, 60, 90)
    ]
    assert means == sorted(means, reverse=True)
    assert means[0] - means[1] < 0.5
    assert means[-1] < 60


@pytest.mark.parametrize("level", LEVELS.values())
def test_the_score_is_on_one_scale_for_all_levels(level: Windows) -> None:
    """Whoever moves up to a stricter level keeps the score."""
    score = rock_beat(4)
    performance = performed(human(score, 3), score.notes["piece"], 80)
    alignment = align(score, performance, clocked=True)
    at_level = summarise(score, performance, alignment, SummaryView(level)).points
    assert at_level == summarise(score, performance, alignment).points


def test_a_quiet_roll_over_an_exercise_of_the_snare_scores_under_20() -> None:
    """14 strokes a second at ghost level over eighths at 120 bpm: 3.6 hits a note, precision 0.28, its square 0.08."""
    notes = [Note(k * PPQ // 2, Piece.SNARE, velocity=90) for k in range(32)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    at = np.arange(0, score.length_ns, 70 * NS_PER_MS)
    assert points(score, at, np.full(len(at), int(Piece.SNARE)), 30) < 20
