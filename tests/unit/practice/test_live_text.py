"""What the terminal shows of a session as it is played, whatever the student does.

Students skip a bar, begin anew, come in at the middle or stop; the strokes are laid out in bars of the lesson's score.
"""

from dataclasses import replace

import pytest

from station.core.events import Hit, SensorLost, SensorMounted
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.lesson import BarCue
from station.drills.library import find_lesson
from station.engine.messages import Started
from station.music.judgement import Judgement, Label
from station.practice.headless.live_text import LEGEND, LiveText, mark_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.scoring.matching.hit_windows import DEFAULT_LEVEL
from tests.fakes.journeys import Leg, Slips, travel

PLAN = plan_practice(find_lesson("rock-fill-1"), PlanOptions(loops=2, demonstrations=0))
BARS = PLAN.score.bar_count
LOOK_NS = NS_PER_S // 20
JOURNEYS = {
    "skips a bar": [Leg(0, 2), Leg(3, BARS)],
    "skips half": [Leg(0, 1), Leg(4, BARS)],
    "begins anew": [Leg(0, 3), Leg(0, BARS - 3)],
    "begins anew after a pause": [Leg(0, 2.5), Leg(0, BARS - 3, pause_s=1.0)],
    "comes in at the middle": [Leg(BARS / 2, BARS)],
    "comes in at the middle of a bar": [Leg(1.5, BARS)],
    "stops and comes back": [Leg(0, 2), Leg(2, BARS, pause_s=4.0)],
}


def told(plan: Plan, legs: list[Leg], seed: int) -> tuple[str, set[Label]]:
    """What the terminal has written when all was played, and the labels that were judged."""
    session, written, labels = Session(plan), list[str](), set[Label]()
    text = LiveText(written.append, ["two kicks"])
    session.handle(Started(0))
    strokes = travel(plan.score, legs, seed, Slips()).strokes
    hits = iter([s.hit for s in strokes])
    hit: Hit | None = next(hits)
    for now_ns in range(0, plan.end_ns + 3 * NS_PER_S, LOOK_NS):
        judged: tuple[Judgement, ...] = ()
        while hit is not None and hit.at_ns + plan.passes_start_ns <= now_ns:
            at_ns = hit.at_ns + plan.passes_start_ns
            judged += session.handle(Hit(at_ns, hit.piece, hit.zone, hit.velocity))
            hit = next(hits, None)
        judged += session.advance(now_ns)
        labels |= {verdict.label for verdict in judged}
        text.show(session, judged)
    return "".join(written), labels


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", JOURNEYS)
def test_whatever_the_student_does_is_shown(name: str, seed: int) -> None:
    words, _ = told(PLAN, JOURNEYS[name], seed)
    assert "Pass 2 of 2" in words


def test_the_students_here_have_verdicts_taken_back() -> None:
    labels = set().union(*(told(PLAN, legs, 0)[1] for legs in JOURNEYS.values()))
    assert Label.PENDING in labels


@pytest.mark.parametrize("label", Label)
def test_every_label_has_its_mark_and_the_legend_has_every_mark(label: Label) -> None:
    mark = mark_of(Judgement(label, 0, 0), DEFAULT_LEVEL)
    assert len(mark) == (label not in (Label.IGNORED, Label.PLAYED_AGAIN))
    assert mark in LEGEND


@pytest.mark.parametrize(("late_ms", "mark"), [(-60, "<"), (0, "|"), (60, ">")])
def test_a_right_note_leans(late_ms: int, mark: str) -> None:
    assert mark_of(Judgement(Label.MATCH, 0, 0, late_ms * NS_PER_MS), DEFAULT_LEVEL) == mark


def test_sensors_on_the_sticks_are_named_as_they_come() -> None:
    session, written = Session(PLAN), list[str]()
    text = LiveText(written.append, ["two kicks"])

    for device, limb in (("x-IMU3 1", Limb.RIGHT_HAND), ("x-IMU3 2", Limb.UNKNOWN)):
        session.handle(SensorMounted(0, device, Mounting(limb)))
        text.show(session, ())
        text.show(session, ())
    session.handle(SensorLost(0, "x-IMU3 1"))
    text.show(session, ())
    session.handle(SensorMounted(0, "x-IMU3 1", Mounting(Limb.RIGHT_HAND)))
    text.show(session, ())

    words = "".join(written)
    assert words.count("x-IMU3 1 is here, on the stick in the right hand") == 2
    assert words.count("x-IMU3 2 is here") == 1
    assert words.endswith("back\nx-IMU3 1 is here, on the stick in the right hand")


def test_the_teacher_s_words_are_told_once_as_their_bar_comes() -> None:
    cues = (BarCue(0, say="Ghosts low"), BarCue(3, say="Now the fill"))
    plan = plan_practice(replace(PLAN.lesson, cues=cues), PlanOptions(loops=1, demonstrations=0))
    session, written = Session(plan), list[str]()
    text = LiveText(written.append, ["two kicks"])
    session.handle(Started(0))
    for now_ns in range(0, plan.end_ns, NS_PER_S // 4):
        session.advance(now_ns)
        text.show(session, ())
    words = "".join(written)
    assert words.count("Ghosts low") == words.count("Now the fill") == 1
    assert words.index("Count-in") < words.index("Ghosts low") < words.index("Now the fill")
