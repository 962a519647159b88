"""The demonstrator in the session's pictures: what another style, lane or leading hand changes at once.

A drummer made from nothing for the demonstrated bars says where the sticks must be.
"""

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.lesson import BarCue
from station.drills.library import find_lesson
from station.drills.mastery.feedback_fading import Feedback
from station.engine.messages import Started
from station.motion.drummer import Drummer
from station.motion.sticking.hand_notes import Hands
from station.motion.style.style import Style
from station.motion.style.style_file import load_style
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.session.plan import Phase, Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.render.snapshot import Snapshot
from station.scenes.demonstrator import Demonstrator, demonstrator_of
from station.scenes.session_part import AHEAD
from station.scenes.session_scene import SessionView

PLAN = plan_practice(find_lesson("rock-2"), PlanOptions(loops=2, demonstrations=1))
LARGE = Style(amplitude_gain=90.0, amplitude_neck=90.0)
AT_S = (0.31, 0.77, 1.9)
"""Places of the demonstration, away from its first stroke."""


def tips(view: SessionView, plan: Plan, start_ns: int) -> NDArray[np.float64]:
    """Where the sticks' tips are `AT_S` after a place of the transport."""
    found = []
    for at_s in AT_S:
        now_ns = start_ns + round(at_s * NS_PER_S)
        session = Session(plan)
        session.handle(Started(0, None))
        session.advance(now_ns)
        pose = view.snapshot(session, now_ns).pose
        assert pose is not None
        found.append(pose.tip_m)
    return np.array(found)


def expected(plan: Plan, style: Style) -> NDArray[np.float64]:
    drummer = Drummer(plan.section, plan.kit, style=style)
    return np.array([drummer.pose(at_s).tip_m for at_s in AT_S])


def start_of(plan: Plan, phase: Phase, index: int = 0) -> int:
    return next(s.start_ns for s in plan.segments if s.phase is phase and s.index == index)


def test_another_style_moves_the_demonstrator_from_the_next_picture_on() -> None:
    view = SessionView(PLAN)
    start_ns = start_of(PLAN, Phase.DEMONSTRATION)
    assert tips(view, PLAN, start_ns) == pytest.approx(expected(PLAN, Style()), abs=1e-9)
    view.move_as(LARGE)
    assert tips(view, PLAN, start_ns) == pytest.approx(expected(PLAN, LARGE), abs=1e-9)
    view.move_as(Style())
    assert tips(view, PLAN, start_ns) == pytest.approx(expected(PLAN, Style()), abs=1e-9)
    assert tips(SessionView(PLAN, Demonstrator(style=LARGE)), PLAN, start_ns) == pytest.approx(expected(PLAN, LARGE))


def test_lanes_count_the_lesson_s_bars_in_every_pass_and_in_a_section() -> None:
    """Bar 2 alone is practised, twice: the lane's bar 2 is what is seen, in the second pass too."""
    lane = {"amplitude_gain": ((1.0, 10.0), (2.0, 10.0), (2.01, 95.0), (3.0, 95.0))}
    style = Style(automation=lane, variation=0.0)
    plan = plan_practice(find_lesson("rock-2"), PlanOptions(loops=2, demonstrations=1, bars=(2, 2)))
    view = SessionView(plan, Demonstrator(style=style))
    large = expected(plan, Style(amplitude_gain=95.0, variation=0.0))
    assert np.abs(large - expected(plan, Style(amplitude_gain=10.0, variation=0.0))).max() > 0.05
    demonstrated = tips(view, plan, start_of(plan, Phase.DEMONSTRATION))
    assert demonstrated == pytest.approx(large, abs=0.02)
    again = tips(view, plan, start_of(plan, Phase.PASS, 1))
    assert again[1:] == pytest.approx(large[1:], abs=0.05), "the pass before it ends in a preparation of its own"


def test_the_kit_is_the_plan_s_for_the_hand_that_leads() -> None:
    plan = plan_practice(find_lesson("rock-2"), PlanOptions(loops=1, demonstrations=1, hands=Hands.LEFT))
    even = Demonstrator(style=Style(variation=0.0))  # each hand scatters its strokes in its own way
    view = SessionView(plan, even)
    kit = view.snapshot(Session(plan), 0).kit
    assert kit.left_handed
    assert kit == PLAN.kit.mirrored
    right = tips(SessionView(PLAN, even), PLAN, start_of(PLAN, Phase.DEMONSTRATION))
    left = tips(view, plan, start_of(plan, Phase.DEMONSTRATION))
    mirrored = right[:, ::-1] * np.array([-1.0, 1.0, 1.0])
    assert left == pytest.approx(mirrored, abs=0.02)


def test_hands_that_stay_hold_what_they_held_while_sliders_move_on() -> None:
    view = SessionView(PLAN)
    for gain in (80.0, 90.0):
        view.move_as(Style(amplitude_gain=gain, grip_left="traditional", held="brush"), hands_stay=True)
        assert (view.style.amplitude_gain, view.style.grip_left, view.style.held) == (gain, "american", "stick")
    view.move_as(Style(held="brush"))
    assert view.style.held == "brush"


def test_a_style_that_is_gone_is_told_and_the_rest_is_kept() -> None:
    told: list[str] = []
    demonstrator = demonstrator_of(Settings(style="/gone/mine.toml", figure="beard", hands="left"), told.append)
    assert demonstrator.style == Style()
    assert demonstrator.figure.stature_m == 1.90
    assert len(told) == 1
    assert "mine.toml" in told[0]


# --- made ahead -------------------------------------------------------------------------------------------------------


def began(plan: Plan, now_ns: int) -> Session:
    session = Session(plan)
    session.handle(Started(0, None))
    session.advance(now_ns)
    return session


@pytest.fixture
def gate() -> Iterator[Event]:
    """Opened at the end in any case: the thread that waits for it would keep the process."""
    closed = Event()
    yield closed
    closed.set()


def test_until_a_drummer_is_made_ahead_the_one_before_sits_there_and_nobody_waits(gate: Event) -> None:
    """The thread that makes the drummer does nothing before the gate is opened."""
    before = SessionView(PLAN)
    sits = before.snapshot(Session(PLAN), 0).pose
    AHEAD.submit(gate.wait)
    try:
        view, session = SessionView(PLAN, before=before), began(PLAN, 5 * NS_PER_S)
        view.make_ahead()
        meanwhile = view.snapshot(session, 5 * NS_PER_S).pose
        shown = view.curves(session)
    finally:
        gate.set()
    assert sits is not None
    assert meanwhile is not None
    assert np.array_equal(meanwhile.row, sits.row)
    assert shown is None
    AHEAD.submit(gate.wait).result()
    assert tips(view, PLAN, start_of(PLAN, Phase.DEMONSTRATION)) == pytest.approx(expected(PLAN, Style()), abs=1e-9)


def test_a_program_that_ends_waits_for_no_drummer() -> None:
    """One that is never made would keep a program for ever whose end waits for its threads."""
    words = "from threading import Event; from station.scenes.session_part import AHEAD; AHEAD.submit(Event().wait)"
    subprocess.run([sys.executable, "-c", words], check=True, timeout=60)


def test_the_stickings_that_are_shown_are_those_of_the_drummer() -> None:
    view = SessionView(PLAN)
    shown = view.snapshot(began(PLAN, start_of(PLAN, Phase.PASS) + 1), start_of(PLAN, Phase.PASS) + 1).limbs
    assert shown is not None
    assert shown.tolist() == PLAN.score.notes["limb"].tolist()


def test_in_the_passes_the_drummer_is_where_the_student_is_and_in_a_demonstration_by_the_clock() -> None:
    view, place_s = SessionView(PLAN), 1.234
    student = Drummer(PLAN.score, PLAN.kit).pose(place_s).tip_m
    begin = {phase: start_of(PLAN, phase) for phase in (Phase.DEMONSTRATION, Phase.PASS)}
    by_clock = {phase: tips(view, PLAN, at_ns) for phase, at_ns in begin.items()}
    view.follow(place_s)
    assert tips(view, PLAN, begin[Phase.PASS]) == pytest.approx(np.array([student] * len(AT_S)), abs=1e-9)
    assert tips(view, PLAN, begin[Phase.DEMONSTRATION]) == pytest.approx(by_clock[Phase.DEMONSTRATION])
    view.follow(None)
    assert tips(view, PLAN, begin[Phase.PASS]) == pytest.approx(by_clock[Phase.PASS])


def test_the_place_in_the_passes_is_told_while_they_are_played() -> None:
    view = SessionView(PLAN)

    def place_s(at_ns: int) -> float | None:
        session = Session(PLAN)
        session.handle(Started(0, None))
        session.advance(at_ns)
        return view.pass_place_s(session)

    second = start_of(PLAN, Phase.PASS, 1)
    assert place_s(second + NS_PER_S // 2) == pytest.approx(PLAN.section.length_ns / NS_PER_S + 0.5)
    assert place_s(start_of(PLAN, Phase.DEMONSTRATION) + NS_PER_S) is None


def shown(view: SessionView, plan: Plan, at_ns: int) -> Snapshot:
    session = Session(plan)
    session.handle(Started(0, None))
    session.advance(at_ns)
    return view.snapshot(session, at_ns)


def test_the_teacher_s_words_and_view_come_with_their_bar_in_demonstrations_and_passes() -> None:
    """A bar of rock-2 at 80 beats a minute lasts three seconds."""
    cues = (BarCue(0, camera="hands"), BarCue(1, say="Ghosts low", camera="feet"))
    plan = plan_practice(replace(PLAN.lesson, cues=cues), PlanOptions(tempo_bpm=80.0, loops=1, demonstrations=1))
    view, bar_ns = SessionView(plan), 3 * NS_PER_S
    at = [(s.phase, s.start_ns) for s in plan.segments]
    assert [(s.view, s.hud.say) for s in (shown(view, plan, start + bar_ns // 2) for _, start in at)] == [
        (NamedView.HANDS, "")
    ] * 4
    for start in (start_of(plan, Phase.DEMONSTRATION), start_of(plan, Phase.PASS)):
        second = shown(view, plan, start + bar_ns * 3 // 2)
        assert (second.view, second.hud.say) == (NamedView.FEET, "Ghosts low")
    assert shown(view, plan, plan.end_ns + 1).view is None


def test_a_style_at_a_bar_moves_the_demonstrator_from_there_on() -> None:
    plan = plan_practice(replace(PLAN.lesson, cues=(BarCue(1, style="wild"),)), PlanOptions(loops=1, demonstrations=1))
    start_ns, bar_s = start_of(plan, Phase.DEMONSTRATION), plan.section.length_ns / NS_PER_S / plan.section.bar_count
    taught, plain = SessionView(plan), Drummer(plan.section, plan.kit)
    wild = plain.with_style(load_style("wild").holding_as(Style()))

    def off(drummer: Drummer, at_s: float) -> float:
        pose = shown(taught, plan, start_ns + round(at_s * NS_PER_S)).pose
        assert pose is not None
        return float(np.abs(pose.tip_m - drummer.pose(at_s).tip_m).max())

    assert max(off(plain, part * bar_s) for part in (0.3, 0.55, 0.7)) < 1e-6
    late = [part * bar_s for part in (1.55, 1.63, 1.8, 1.9)]
    assert max(off(plain, at_s) for at_s in late) > 0.02
    assert max(off(wild, at_s) for at_s in late) < 1e-3


def test_the_landing_is_counted_with_the_last_pass_and_has_the_next_bar_s_number() -> None:
    crash = Score.from_notes([Note(0, Piece.CRASH_1, Zone.EDGE)], TempoMap()).notes
    plan = plan_practice(replace(PLAN.lesson, landing=crash), PlanOptions(loops=2, demonstrations=1))
    view, last = SessionView(plan), plan.section.bar_count
    hud = shown(view, plan, plan.end_ns - NS_PER_S).hud
    assert (hud.phase, hud.bar, hud.bar_count) == ("Pass 2 of 2", last + 1, last + 1)
    numbers = shown(view, plan, plan.end_ns - NS_PER_S).bar_numbers
    assert [numbers.of(bar) for bar in range(2 * last + 1)] == [*range(1, last + 1)] * 2 + [last + 1]


def seen_at(view: SessionView, session: Session, now_ns: int) -> Snapshot:
    session.advance(now_ns)
    return view.snapshot(session, now_ns)


def test_after_the_demonstration_come_its_bars_again_and_the_page_goes_on_where_it_ended() -> None:
    session, view = Session(PLAN), SessionView(PLAN)
    session.handle(Started(0, None))
    shown = seen_at(view, session, PLAN.demonstrations_end_ns - NS_PER_S)
    assert shown.comes_again
    assert shown.before is None
    demonstrated = shown.score
    for now_ns in (PLAN.passes_start_ns - NS_PER_S, PLAN.passes_start_ns + NS_PER_S):  # counted in, played
        shown = seen_at(view, session, now_ns)
        assert shown.before is demonstrated
        assert not shown.comes_again, "the last passes of the session"
    assert seen_at(SessionView(PLAN, goes_on=True), session, PLAN.passes_start_ns + 2 * NS_PER_S).comes_again


@pytest.mark.parametrize(
    ("feedback", "words"),
    [
        (Feedback.TIMING, "Pass 1 of 2"),
        (Feedback.PADS, "Pass 1 of 2, early and late not shown"),
        (Feedback.NONE, "Pass 1 of 2, blind: no marks"),
    ],
)
def test_a_pass_without_marks_says_that_this_is_meant(feedback: Feedback, words: str) -> None:
    session, view = Session(PLAN, feedback=feedback), SessionView(PLAN)
    session.handle(Started(0, None))
    assert seen_at(view, session, PLAN.passes_start_ns - NS_PER_S).hud.phase == "Count-in to pass 1 of 2"
    assert seen_at(view, session, PLAN.passes_start_ns + NS_PER_S).hud.phase == words
