"""The score over shipped lessons: who hammers gets next to nothing, and who plays more evenly never gets less."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.align import align
from station.scoring.analysis.summary import summarise
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.shipped_lesson import shipped_lessons

PADS = np.array(
    [Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1]
)


def points(score: Score, performance: Performance) -> float:
    found = summarise(score, performance, align(score, performance, clocked=True)).points
    assert found is not None
    return found


def struck(at_ns: NDArray[np.int64], pieces: NDArray[np.int64]) -> Performance:
    hits = np.zeros(len(at_ns), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"], hits["openness"] = at_ns, pieces, 90, np.nan
    return Performance.from_array(hits[np.argsort(at_ns, kind="stable")])


@pytest.mark.parametrize("part", range(12))
def test_hammering_scores_under_10_on_every_lesson(part: int) -> None:
    """20 strokes a second anywhere, and every pad on every 16th, through one pass of the loop."""
    for lesson in shipped_lessons(part, 12):
        score = plan_practice(lesson, PlanOptions(loops=1, demonstrations=0)).score
        rng = np.random.default_rng(7)
        count = 20 * score.length_ns // NS_PER_S
        assert points(score, struck(rng.integers(0, score.length_ns, count), rng.choice(PADS, count))) < 10, lesson.name
        grid_ns = score.tempo_map.ns_at(np.arange(0, score.end_tick, PPQ // 4))
        all_pads = struck(np.tile(grid_ns, len(PADS)), np.repeat(PADS, len(grid_ns)))
        assert points(score, all_pads) < 10, lesson.name


@pytest.mark.parametrize("name", ["rock-fill-1", "flam-tap"])
def test_a_virtual_student_who_spreads_less_never_scores_less(name: str) -> None:
    """Averaged over eight seeds."""
    score = plan_practice(find_lesson(name), PlanOptions(loops=1, demonstrations=0)).score
    means = [
        np.mean([points(score, play(score, parse_spec(f"seed={k},sd_ms={sd}")).performance) for k in range(8)])
        for sd in (40, 25, 12, 4)
    ]
    assert means == sorted(means)
    assert means[-1] > means[0]
