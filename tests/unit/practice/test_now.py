"""One answer to "what tempo is it" and "where are we", whatever goes on. Expected figures are counted by hand.

rock-2 has four quarters a bar; a lesson in 6/8 counts dotted quarters.
"""

from datetime import date

import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.drills.mastery.feedback_fading import Feedback
from station.engine.messages import Started
from station.practice.now.entry_now import entry_words
from station.practice.now.tempo_now import TempoNow, demonstration_tempo, session_tempo
from station.practice.now.whereabouts import Doing, Whereabouts, place_of, replay_place, whereabouts
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import PassSeries, PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise
from station.practice.session.session import Session
from tests.shipped_lesson import shipped_lessons

LESSON = find_lesson("rock-2")


def at(session: Session, plan_ns: int) -> Session:
    """The session at a time of its plan."""
    if not session.started:
        session.handle(Started(0, None))
    session.advance(plan_ns)
    return session


def test_a_tempo_is_explained_only_where_there_is_something_to_explain() -> None:
    assert TempoNow(76.0, began=76.0, target=76.3).words == ""
    assert TempoNow(76.0, began=70.0, target=100.0).words == "from 70 · target 100"
    assert TempoNow(40.0, percent=50, of=80.0).words == "50 % of 80"
    assert TempoNow(76.0, played=70.0).words == "played at 70"


def test_every_state_has_its_words() -> None:
    said = {doing: Whereabouts(doing, 3, 8, bar=2, whose="you").words for doing in Doing}
    assert said == {
        Doing.READY: "Ready",
        Doing.COUNT_IN: "Count-in to pass 3 of 8",
        Doing.DEMONSTRATION: "Demonstration",
        Doing.PASS: "Pass 3 of 8",
        Doing.PAUSED: "Paused in pass 3 of 8",
        Doing.WAITING: "Pass 3 of 8, waiting for you",
        Doing.STOPPED: "Stopped in pass 3 of 8",
        Doing.REPLAY: "Replay of bar 2: you",
        Doing.OVER: "Over",
    }
    assert Whereabouts(Doing.PASS, 3, 8, time=2, times=4).words == "Pass 3 of 8, time 2 of 4"
    assert replay_place("25 strokes").words == "Replay of your take: 25 strokes"


def test_where_the_tempo_follows_passes_are_counted_over_all_of_them_and_the_first_tempo_is_known() -> None:
    plan = plan_practice(LESSON, PlanOptions(tempo_bpm=76.0, loops=1, demonstrations=0))
    session = at(Session(plan, series=PassSeries(2, 8, 70.0)), plan.passes_start_ns + NS_PER_S)
    assert whereabouts(session).words == "Pass 3 of 8"
    tempo = session_tempo(session)
    assert (tempo.now, tempo.began, tempo.target) == pytest.approx((76.0, 70.0, LESSON.target_tempo_bpm), abs=1e-3)


def test_an_adaptation_says_which_pass_it_is() -> None:
    adaptation = Adaptation(LESSON, PlanOptions(loops=5), date(2026, 3, 1))
    series = adaptation.session(Latency()).series
    assert series == PassSeries(0, 5, adaptation.step.tempo_bpm)


def test_a_rise_tells_the_present_tempo_where_it_began_and_where_it_leads() -> None:
    plan = plan_practice(LESSON, PlanOptions(tempo_bpm=60.0, loops=4, demonstrations=0, rise=Rise(5, 1, 90)))
    bar_ns = int(plan.score.tempo_map.ns_at(plan.score.tempo_map.bar_start(2)))
    tempo = session_tempo(at(Session(plan), plan.passes_start_ns + bar_ns + NS_PER_S))
    assert (round(tempo.now, 2), tempo.words) == (70.0, "from 60 · target 90")


def test_beats_are_those_of_the_lesson() -> None:
    lesson = next(one for one in shipped_lessons() if one.beat_ticks * 2 == 3 * 107_520 and one.band is None)
    plan = plan_practice(lesson, PlanOptions(tempo_bpm=90.0, loops=1, demonstrations=0))
    tempo = session_tempo(Session(plan))
    assert tempo.now == pytest.approx(60.0 * plan.section.tempo_map.bpm_at(0) / 90.0)
    assert tempo.target is not None
    assert tempo.target * 1.5 * 90.0 / plan.section.tempo_map.bpm_at(0) == pytest.approx(lesson.target_tempo_bpm)


def test_a_slow_demonstration_tells_the_tempo_that_is_heard_and_what_it_is_of() -> None:
    tempo = demonstration_tempo(LESSON.score.tempo_map, 0, LESSON.beat_ticks, 50)
    assert tempo.now == pytest.approx(LESSON.tempo_bpm / 2, abs=1e-3)
    assert tempo.words == f"50 % of {LESSON.tempo_bpm:g}"


def test_a_pause_says_so_and_what_it_pauses_and_the_count_in_after_it_where_it_leads() -> None:
    plan = plan_practice(LESSON, PlanOptions(tempo_bpm=60.0, loops=4, demonstrations=0, rise=Rise(5, 1, 90)))
    session = at(Session(plan), plan.passes_start_ns)
    second_ns = plan.passes_start_ns + int(plan.score.tempo_map.ns_at(plan.score.tempo_map.bar_start(LESSON_BARS)))
    at(session, second_ns + NS_PER_S)
    session.handle(Hit(second_ns + NS_PER_S, Piece.SNARE, Zone.HEAD, 80))
    session.pause()
    where = whereabouts(session)
    assert (where.doing, where.words, where.halt) == (Doing.PAUSED, "Paused in pass 2 of 4", "Paused")
    session.resume()
    session.handle(Started(second_ns + 2 * NS_PER_S, None))
    session.advance(second_ns + 2 * NS_PER_S + NS_PER_S // 10)
    tempo = plan.score.tempo_map.bpm_at(plan.score.tempo_map.bar_start(LESSON_BARS))
    assert whereabouts(session).words == "Count-in to pass 2 of 4"
    assert session_tempo(session).now == pytest.approx(tempo)
    assert place_of(session) == (None, 1)
    session.advance(second_ns + 2 * NS_PER_S + round(3.5 * 60 / tempo * NS_PER_S))
    assert place_of(session) == (None, 4)


LESSON_BARS = plan_practice(LESSON, PlanOptions(loops=1)).section.bar_count


def test_a_session_that_was_ended_is_no_longer_in_a_pass() -> None:
    plan = plan_practice(LESSON, PlanOptions(loops=2, demonstrations=0))
    session = at(Session(plan), plan.passes_start_ns + NS_PER_S)
    session.pause()
    session.stop()
    where = whereabouts(session)
    assert (where.words, where.halt) == ("Stopped in pass 1 of 2", "")


def test_without_a_click_the_score_waits_and_the_tempo_is_the_student_s_own() -> None:
    plan = plan_practice(LESSON, PlanOptions(tempo_bpm=80.0, loops=2, demonstrations=0, click=None))
    session, start_ns = at(Session(plan), 0), plan.passes_start_ns
    for at_ns, note in zip(plan.score.onset_ns.tolist(), plan.score, strict=True):
        if at_ns < 8 * NS_PER_S:
            played_ns = start_ns + round(at_ns / 1.1)
            session.advance(played_ns)
            session.handle(Hit(played_ns, note.piece, note.zone, 80))
    assert whereabouts(session).doing is Doing.PASS
    tempo = session_tempo(session)
    assert tempo.now == pytest.approx(88.0, rel=0.02)
    assert tempo.words.startswith("your own tempo")
    session.advance(start_ns + 14 * NS_PER_S)
    assert whereabouts(session).halt == "Waiting for you…"


def test_who_comes_in_a_beat_late_is_told_while_they_play() -> None:
    plan = plan_practice(find_lesson("rock-fill-1"), PlanOptions(tempo_bpm=120.0, loops=2, demonstrations=0))
    session = at(Session(plan), plan.passes_start_ns)
    for at_ns, note in zip(plan.score.onset_ns.tolist(), plan.score, strict=True):
        if at_ns < 4 * NS_PER_S:
            session.handle(Hit(plan.passes_start_ns + at_ns + NS_PER_S // 2, note.piece, note.zone, 80))
    assert entry_words(session) == "You came in a beat late: your strokes count there"
    session.feedback = Feedback.NONE
    assert entry_words(session) == ""
