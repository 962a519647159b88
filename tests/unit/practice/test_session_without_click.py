"""A session without a click: counted in, then the score, the words and the end follow the student.

Times are laid out by hand: rock-1 at 120 bpm, one bar of count-in, so that the passes start at 2 s of the transport.
"""

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Bus, Started
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.report.session_report import practice_document
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.plan import Phase, Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.simulation.student_spec import parse_spec

ZERO_NS = 5 * NS_PER_S


def planned(loops: int = 4, with_click: bool = False) -> Plan:
    options = PlanOptions(tempo_bpm=120.0, loops=loops, demonstrations=0, click=PLAIN if with_click else None)
    return plan_practice(find_lesson("rock-1"), options)


def practised(plan: Plan, pauses_s: dict[int, float], rate: float) -> tuple[Session, int]:
    """A session in which every note is struck `rate` times as fast as written, after a pause before some bars.

    Returns it as it is when the last stroke has been taken in, and the time of that stroke.
    """
    session = Session(plan)
    session.handle(Started(ZERO_NS))
    score, late_s, now_ns, bar = plan.score, 0.0, 0, -1
    for row in np.argsort(score.onset_ns, kind="stable").tolist():
        if score.bar[row] > bar:
            bar = int(score.bar[row])
            late_s += pauses_s.get(bar, 0.0)
        played_s = score.onset_s[row] / rate + late_s
        now_ns = ZERO_NS + plan.passes_start_ns + round(played_s * NS_PER_S)
        note = score[row]
        session.handle(Hit(now_ns, note.piece, note.zone, note.velocity))
        session.advance(now_ns)
    return session, now_ns


def test_nothing_clicks_after_the_count_in() -> None:
    plan = planned()
    clicks = plan.cues[plan.cues["bus"] == Bus.CLICK]
    assert len(clicks) == 4
    assert clicks["at_ns"].max() < plan.passes_start_ns


def test_a_slower_student_takes_the_score_along() -> None:
    """At 0.85 of the tempo the third pass begins at 4.7 s instead of 4 s after the first; there the score says so."""
    plan = planned()
    session, last_ns = practised(plan, {}, 0.85)
    score_ns = session.state().score_ns
    assert score_ns == pytest.approx(plan.score.onset_ns[-1], abs=0.03 * NS_PER_S)
    assert session.state().segment.index == plan.passes - 1
    assert not session.over
    session.advance(last_ns + 3 * NS_PER_S)
    assert session.over


def test_the_score_waits_while_the_student_stops() -> None:
    plan = planned()
    session, last_ns = practised(plan, {2: 45.0}, 1.0)
    assert not session.over
    session.advance(last_ns + 3 * NS_PER_S)
    result = session.result()
    assert result.complete
    document = practice_document(result, Settings())
    assert document["session"]["click"] is False  # type: ignore[index,call-overload]
    assert document["counts"]["matched"] == len(plan.score)  # type: ignore[index,call-overload]


def test_a_stop_ends_nothing_however_long() -> None:
    plan = planned()
    session = Session(plan)
    session.handle(Started(ZERO_NS))
    start_ns = ZERO_NS + plan.passes_start_ns
    for at_s in (0.0, 0.25, 0.5, 0.75):
        session.handle(Hit(start_ns + round(at_s * NS_PER_S), Piece.HIHAT, find_lesson("rock-1").score[0].zone, 80))
    session.advance(start_ns + 3600 * NS_PER_S)
    assert not session.over
    assert session.state().segment.phase is Phase.PASS


@pytest.mark.parametrize("seed", [1, 2])
def test_a_virtual_student_without_a_click_gets_its_own_counts(seed: int) -> None:
    """Its account of itself is the truth: matched and misses agree within 2 %."""
    plan = planned(loops=8)
    virtual = practise_virtually(plan, parse_spec(f"seed={seed},sd_ms=12,miss_pct=3,extra_pct=2,drift_pct=3"))
    document = practice_document(virtual.result, Settings())
    truth = virtual.student.truth_document()
    assert virtual.result.complete
    counts = document["counts"]
    assert abs(counts["matched"] - truth["counts"]["matched"]) <= 0.02 * len(plan.score)  # type: ignore[index,call-overload,operator]
