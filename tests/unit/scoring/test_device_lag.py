"""Whose a lag is, by the means of tempi and pads that are written here by hand."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.drills.library import find_lesson
from station.music.performance import Performance
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.align import align
from station.scoring.analysis.device_lag import (
    LagCause,
    LagMean,
    LagRun,
    lag_runs,
    likely_lag_ms,
    shared_lag,
)
from tests.fakes.human_takes import Added, Human, human_hits

HAT, SNARE, KICK = Piece.HIHAT, Piece.SNARE, Piece.KICK


def run(tempo_bpm: float, mean_ms: float, error_ms: float = 4.0, pads: dict[Piece, float] | None = None) -> LagRun:
    own = {HAT: mean_ms, SNARE: mean_ms, KICK: mean_ms} if pads is None else pads
    each = {pad: LagMean(24, mean, 1.5 * error_ms) for pad, mean in own.items()}
    return LagRun(tempo_bpm, LagMean(24, mean_ms, error_ms), each)


@pytest.mark.parametrize(
    ("runs", "cause"),
    [
        ([run(60, 100), run(100, 98)], LagCause.EQUIPMENT),
        ([run(60, -110), run(100, -112)], LagCause.EQUIPMENT),
        ([run(60, 12), run(100, 9)], LagCause.NONE),
        ([run(60, -28), run(100, -30)], LagCause.NONE),
        ([run(60, 100)], LagCause.THIN),
        ([run(95, 100), run(100, 100)], LagCause.THIN),
        ([run(60, 100, 20.0), run(100, 100, 20.0)], LagCause.THIN),
        ([run(60, 125), run(100, 75)], LagCause.TEMPO),
        ([run(60, 100, 4.0, {HAT: 100.0}), run(100, 100, 4.0, {HAT: 100.0})], LagCause.THIN),
        ([run(60, 60, 3.0, {HAT: 90.0, SNARE: 90.0, KICK: 0.0}), run(100, 60)], LagCause.THIN),
        (2 * [run(60, 60, 3.0, {HAT: 90.0, SNARE: 90.0, KICK: 0.0})], LagCause.PADS),
        ([run(60, 150), run(100, 135)], LagCause.EQUIPMENT),
    ],
)
def test_whose_it_is(runs: list[LagRun], cause: LagCause) -> None:
    assert shared_lag(runs).cause is cause


def test_takes_of_different_days_prove_less() -> None:
    one, other = run(60, 60, 3.0), run(90, 60, 3.0)
    assert shared_lag([one, other]).cause is LagCause.EQUIPMENT
    days = [LagRun(each.tempo_bpm, each.whole, each.pads, take) for each, take in ((one, "1"), (other, "2"))]
    assert shared_lag(days).cause is LagCause.THIN, "the stand of a player moves by 11 ms from take to take"


def test_an_earlier_day_takes_nothing_from_two_tempi_of_one_session() -> None:
    today = [LagRun(each.tempo_bpm, each.whole, each.pads, "today") for each in (run(60, 100), run(100, 98))]
    before = LagRun(80.0, LagMean(24, 88.0, 6.0), run(80, 88).pads, "before")
    alone, both = shared_lag(today), shared_lag([*today, before])
    assert alone.cause is both.cause is LagCause.EQUIPMENT
    assert alone.rise_ms is not None
    assert both.rise_ms is not None
    assert both.rise_ms[2] - both.rise_ms[1] <= alone.rise_ms[2] - alone.rise_ms[1] + 1e-9


def test_nothing_played_is_no_lag() -> None:
    assert shared_lag([]).cause is LagCause.NONE


@pytest.mark.parametrize("lesson", ["first-groove", "rock-1", "funk-sixteenths-1"])
@pytest.mark.parametrize("tempo_bpm", [60.0, 100.0, 150.0, 180.0])
@pytest.mark.parametrize("late_ms", [-40.0, 0.0, 90.0, 150.0])
def test_a_lag_is_found_and_moves_with_the_strokes(lesson: str, tempo_bpm: float, late_ms: float) -> None:
    score = plan_practice(find_lesson(lesson), PlanOptions(tempo_bpm=tempo_bpm, loops=4)).score
    human = Human(sd_ms=15.0, lean_sd_ms=2.0, stand_ms=0.0)
    performance = Performance.from_array(human_hits(score, 3, human, Added(shift_ms=late_ms)))
    likely_ms = likely_lag_ms(score, performance)
    moved = performance.shifted(-round(likely_ms * 1e6))
    found = shared_lag(lag_runs(score, align(score, moved, clocked=True), likely_ms))
    assert found.lag_ms == pytest.approx(late_ms, abs=10)
    assert found.low_ms < found.lag_ms < found.high_ms
    assert np.isclose(likely_ms, late_ms, atol=25)
