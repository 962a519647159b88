"""A capture judged again gives the judgements of the day, to the nanosecond, at any number of frames a second.

The judgements to be had again are those that the session gave while the capture was written.
"""

from pathlib import Path

import pytest

from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import Capture, read_capture
from station.devices.capture.replay import replay, transport_zeros_ns
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.messages import RecordCapture, Started
from station.music.judgement import Label
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS, Plan, PlanOptions, plan_practice
from station.practice.session.session import Session, SessionResult
from station.scoring.analysis.loudness import dynamics
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play

KIT = "TD-17"
LATENCY = Latency(3 * NS_PER_MS + 7, 11 * NS_PER_MS + 13)
STUDENT = "seed=4,bias_ms=-6,sd_ms=14,miss_pct=4,extra_pct=4,wrong_piece_pct=3"
AFTER_NS = TAIL_NS + NS_PER_S
HALF_MORE = bytes.fromhex("b9 58 40")
"""Controller 88 at 64 of 128: the next velocity is half a step more (MMA CA-031)."""


def practise(plan: Plan, capture: Path, fps: int, prefix: bytes = b"") -> Session:
    """A live session at `fps` looks a second: the engine records what a student plays, `prefix` before each piece."""
    engine, session, zero_ns, now_ns = Engine(), Session(plan, LATENCY), None, 0
    engine.advance(now_ns)
    engine.device_found(KIT, now_ns)
    for command in (RecordCapture(capture), *session.start()):
        engine.handle(command)
    due = list(play(plan.score, parse_spec(STUDENT)).midi)
    while not session.over:
        now_ns += NS_PER_S // fps
        for event in engine.advance(now_ns):
            zero_ns = event.zero_ns if isinstance(event, Started) else zero_ns
            session.handle(event)
        while zero_ns is not None and due:
            at_ns = zero_ns + LATENCY.output_ns + plan.passes_start_ns + due[0][0]
            if at_ns > now_ns:
                break
            engine.feed(KIT, prefix + due.pop(0)[1], at_ns)
        session.advance(now_ns)
    engine.handle(RecordCapture(None))
    for event in engine.advance(now_ns):
        session.handle(event)
    return session


def judge_again(plan: Plan, capture: Capture, fps: int) -> Session:
    """The capture's events handed to a new session, which is told the time `fps` times a second."""
    session = Session(plan, LATENCY)
    (zero_ns,) = transport_zeros_ns(capture)
    session.handle(Started(zero_ns))
    step_ns = NS_PER_S // fps
    now_ns = zero_ns
    for event in replay(capture):
        while now_ns + step_ns <= event.at_ns:
            now_ns += step_ns
            session.advance(now_ns)
        session.handle(event)
    session.advance(zero_ns + plan.end_ns + LATENCY.output_ns + AFTER_NS)
    return session


@pytest.mark.parametrize("lesson", ["rock-1", "single-paradiddle"])
def test_the_same_judgements_at_any_frame_rate(lesson: str, tmp_path: Path) -> None:
    plan = plan_practice(find_lesson(lesson), PlanOptions(demonstrations=0, loops=2))
    live = practise(plan, tmp_path / "take.cap", 50)
    capture = read_capture(tmp_path / "take.cap")
    assert capture.complete
    assert len(live.hits) > 20
    for fps in (1, 24, 60, 240):
        again = judge_again(plan, capture, fps)
        assert list(again.hits) == list(live.hits)
        assert dict(again.verdicts) == dict(live.verdicts)
        assert again.result().alignment.asynchrony_ns.tolist() == live.result().alignment.asynchrony_ns.tolist()
        assert again.result().alignment.hit_of_note.tolist() == live.result().alignment.hit_of_note.tolist()


def test_velocities_finer_than_whole_numbers_are_judged_alike_live_and_again(tmp_path: Path) -> None:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(demonstrations=0, loops=2))
    live = practise(plan, tmp_path / "take.cap", 50, prefix=HALF_MORE)
    again = judge_again(plan, read_capture(tmp_path / "take.cap"), 60)
    assert {verdict.velocity_error for verdict in live.verdicts.values() if verdict.label is Label.MATCH} == {0.5}
    assert dict(again.verdicts) == dict(live.verdicts)
    assert dynamics_of(again.result()) == dynamics_of(live.result()) == (0.5, 0.0)


def dynamics_of(result: SessionResult) -> tuple[float | None, float | None]:
    found = dynamics(result.score, result.performance, result.alignment)
    return found.mean_velocity_error, found.sd_velocity_error
