"""A session on equipment that nobody measured: what is left out, what is not, what is said, and what is kept of it."""

from collections.abc import Callable
from dataclasses import replace
from datetime import date
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.measured_latency import GROOVE, LOOPBACK, DeviceLatency, MeasuredLatency, StoredCalibration
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_MS, PPQ
from station.drills.library import find_lesson
from station.music.performance import Performance
from station.practice.lag.fair_judgement import FairResult, as_it_came, judged_as_told, judged_fairly
from station.practice.lag.lag_document import lag_document, runs_in
from station.practice.lag.lag_words import lag_text
from station.practice.lag.session_lag import LagAnswer, LagTarget
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise
from station.practice.session.session import SessionResult
from station.scoring.align import align
from station.scoring.analysis.device_lag import LagCause
from tests.fakes.human_takes import Added, Human, human_hits

Floats = NDArray[np.float64]
Late = Callable[[Plan], Floats | float]
OUTPUT, KIT = "Headphones", "TD-17"
NOBODY = StoredCalibration()
HUMAN = Human(sd_ms=22.0, lean_sd_ms=3.0, stand_ms=-12.0)


def first_groove() -> Plan:
    return plan_practice(find_lesson("first-groove"), PlanOptions(loops=6, rise=Rise(40, 6, 100)))


def played(plan: Plan, late: Late, seed: int = 5, output: str | None = OUTPUT) -> SessionResult:
    hits = human_hits(plan.score, seed, HUMAN, Added(shift_ms=late(plan)))
    performance = Performance.from_array(hits)
    alignment = align(plan.score, performance, clocked=True)
    return SessionResult(plan, plan.score, performance, alignment, Latency(), True, KIT, output)


def equipment(late_ms: float) -> Late:
    return lambda plan: late_ms


def share_of_the_beat(share: float) -> Late:
    def late(plan: Plan) -> Floats:
        tick, tempo_map = plan.score.notes["tick"], plan.score.tempo_map
        return share * (tempo_map.ns_at(tick + PPQ) - tempo_map.ns_at(tick)) / NS_PER_MS

    return late


def feet(late_ms: float) -> Late:
    return lambda plan: np.where(plan.score.notes["piece"] == Piece.KICK, 0.0, late_ms)


def document_of(fair: FairResult) -> dict[str, Any]:
    return practice_document(fair.result, Settings(), fair.lag)


def points_of(result: SessionResult) -> float:
    """The score with nothing left out."""
    return float(str(practice_document(result, Settings())["score"]))


@pytest.mark.parametrize("late_ms", [75.0, 100.0, 150.0, -120.0])
def test_a_lag_that_is_the_same_everywhere_is_the_equipments_and_costs_nothing(late_ms: float) -> None:
    came, on_time = played(first_groove(), equipment(late_ms)), played(first_groove(), equipment(0.0))
    fair = judged_fairly(came, NOBODY)
    assert fair.lag is not None
    assert fair.lag.found.cause is LagCause.EQUIPMENT
    assert fair.lag.answer is LagAnswer.OPEN
    assert fair.lag.found.lag_ms == pytest.approx(late_ms + HUMAN.stand_ms, abs=10)
    score, before = document_of(fair)["score"], points_of(came)
    assert score >= points_of(on_time) - 1
    assert before + 20 < score, "what it was scored as it came"


def test_nobody_is_excused_who_is_on_time() -> None:
    came = played(first_groove(), equipment(0.0))
    fair = judged_fairly(came, NOBODY)
    assert fair.result is came
    assert fair.lag is not None
    assert fair.lag.found.cause is LagCause.NONE
    assert lag_text(fair.lag) == ""


@pytest.mark.parametrize(
    ("late", "cause", "words"),
    [(share_of_the_beat(0.15), LagCause.TEMPO, "it goes with the beat"), (feet(110.0), LagCause.PADS, "kick comes")],
)
def test_what_goes_with_the_beat_or_is_one_limbs_is_a_habit_and_counts(late: Late, cause: LagCause, words: str) -> None:
    came = played(first_groove(), late)
    fair = judged_fairly(came, NOBODY)
    assert fair.result is came
    assert fair.lag is not None
    assert fair.lag.found.cause is cause
    assert words in lag_text(fair.lag)
    assert "habit" in lag_text(fair.lag)


def test_one_tempo_says_not_whose_it_is_and_another_session_does() -> None:
    rock = find_lesson("rock-1")
    slow, fast = (plan_practice(rock, PlanOptions(tempo_bpm=bpm, loops=6)) for bpm in (64.0, 112.0))
    first = judged_fairly(played(slow, equipment(140.0)), NOBODY)
    assert first.lag is not None
    assert first.lag.found.cause is LagCause.THIN
    assert first.lag.answer is LagAnswer.OPEN, "left out all the same: nobody scores 0 for headphones"
    assert "another" not in lag_text(first.lag)
    assert "faster or slower tempo" in lag_text(first.lag)
    kept = runs_in(lag_document(first.lag), "yesterday")
    second = judged_fairly(played(fast, equipment(140.0), seed=6), NOBODY, kept)
    assert second.lag is not None
    assert second.lag.found.cause is LagCause.EQUIPMENT
    assert "64 and 112 bpm" in lag_text(second.lag)


def test_a_sixteenth_late_is_no_other_sixteenth() -> None:
    plan = plan_practice(find_lesson("funk-sixteenths-1"), PlanOptions(tempo_bpm=100.0, loops=4))
    fair = judged_fairly(played(plan, equipment(150.0)), NOBODY)
    assert fair.lag is not None
    assert fair.lag.found.lag_ms == pytest.approx(150 + HUMAN.stand_ms, abs=10)
    assert document_of(fair)["counts"]["misses"] == 0


def test_it_is_kept_in_what_nobody_has_measured() -> None:
    came = played(first_groove(), equipment(120.0))
    measured = MeasuredLatency(10.0, 1.0, LOOPBACK, date(2026, 1, 1))
    groove = replace(measured, by=GROOVE)
    kit = DeviceLatency(measured)
    cases = [
        (NOBODY, LagTarget("output", OUTPUT)),
        (NOBODY.with_output(OUTPUT, groove), LagTarget("output", OUTPUT)),
        (NOBODY.with_output(OUTPUT, measured), LagTarget("kit", KIT)),
        (NOBODY.with_output(OUTPUT, measured).with_kit(KIT, kit), None),
        (replace(NOBODY, left=frozenset({OUTPUT})), None),
    ]
    for known, target in cases:
        fair = judged_fairly(came, known)
        assert fair.lag is not None
        assert fair.lag.target == target
        assert (fair.lag.answer is LagAnswer.OPEN) == (target is not None)


def test_left_in_it_counts_as_it_came() -> None:
    came = played(first_groove(), equipment(100.0))
    fair = judged_fairly(came, NOBODY)
    left = as_it_came(fair)
    assert left.lag is not None
    assert left.lag.answer is LagAnswer.LEFT
    assert np.array_equal(left.result.performance.hits["at_ns"], came.performance.hits["at_ns"])
    assert document_of(left)["score"] == points_of(came)


def test_the_report_says_it_and_which_command_takes_it_out() -> None:
    document = document_of(judged_fairly(played(first_groove(), equipment(100.0)), NOBODY))
    lag: Any = document["lag"]
    assert (lag["of"], lag["device"], lag["answer"], lag["cause"]) == ("output", OUTPUT, "open", "equipment")
    assert lag["left_out_ms"] == lag["found_ms"]
    text = report_text(document)
    assert "most likely your equipment" in text
    assert "station devices calibrate --by groove" in text


def test_a_teacher_leaves_out_what_the_students_report_left_out_and_no_more() -> None:
    came = played(first_groove(), equipment(100.0))
    fair = judged_fairly(came, NOBODY)
    assert fair.lag is not None
    assert document_of(judged_as_told(came, fair.lag.own_ms))["score"] == document_of(fair)["score"]
    for claimed_ms in (0.0, 40.0, -100.0):
        assert judged_as_told(came, claimed_ms).result is came, "the strokes do not show it"
    on_time = played(first_groove(), equipment(0.0))
    assert judged_as_told(on_time, 90.0).result is on_time


def test_without_a_click_nothing_is_asked() -> None:
    came = played(first_groove(), equipment(100.0))
    free = replace(came, alignment=align(came.score, came.performance, clocked=False))
    assert judged_fairly(free, NOBODY).lag is None
