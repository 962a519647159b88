"""The level of a student and a lesson: judged live and in the report, kept, and narrower once the lesson is held."""

from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import document_of
from station.drills.mastery.practice_steps import PassKind
from station.music.judgement import Judgement, Label
from station.practice.headless.live_text import LiveText
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.history.session_files import write_document
from station.practice.records.memory import LevelMemory, Memory, Remembered
from station.practice.records.recovery import recovered
from station.practice.records.report.mastery_report import mastery_words, with_mastery
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.session import Session
from station.scenes.result_tables import session_facts
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from tests.fakes.known_students import one_student, remember

TODAY, TOMORROW = date(2026, 3, 1), date(2026, 3, 2)
ROCK = find_lesson("rock-1")
"""First steps: it suggests beginner."""
STEADY = "sd_ms=5,seed=1"
PROBES_TWICE = PlanOptions(tempo_bpm=ROCK.target_tempo_bpm, loops=10, demonstrations=0)
"""The target tempo, pinned: the fifth pass is blind, and the tenth, and two blind ones in a row are mastery."""


def remembered(sessions: Path, options: PlanOptions, today: date = TODAY, lesson: Lesson = ROCK) -> Remembered:
    memory = Memory(one_student(sessions, "anna"), lesson.name, lesson.loop)
    return Remembered.of(lesson, options, today, memory)


def practised(options: PlanOptions, lesson: Lesson = ROCK, spec: str = STEADY) -> Adaptation:
    adaptation = Adaptation(lesson, options, TODAY)
    practise_adaptively(adaptation, parse_spec(spec))
    return adaptation


# --- growing ----------------------------------------------------------------------------------------------------------


def test_who_holds_the_lesson_blind_at_the_target_tempo_is_judged_at_the_next_level(tmp_path: Path) -> None:
    followed = remembered(tmp_path, PROBES_TWICE)
    virtual = practise_adaptively(followed.adaptation, parse_spec(STEADY))
    assert [one.step.kind for one in followed.adaptation.rounds].count(PassKind.PROBE) == 2
    said = "You hold it at beginner: judged as elementary from next time on."
    assert said in (followed.adaptation.step.notice or "")
    document = with_mastery(practice_document(virtual.result, Settings()), followed.adaptation)
    assert said in report_text(document)
    assert document["level"] == "beginner", "what was played stays judged as it was"
    told = "10 passes of bars 1–2 at 110 bpm · Mastered at beginner; asked for again on 02 March."
    assert session_facts(virtual.result, document).words.subtitle == told
    remember(followed)
    levels, fault = LevelMemory(one_student(tmp_path, "anna")).recall()
    assert (levels, fault) == ({"rock-1": Level.ELEMENTARY}, None)


def test_one_pass_before_that_nothing_is_said() -> None:
    adaptation = practised(replace(PROBES_TWICE, loops=9))
    assert not adaptation.has_grown
    assert adaptation.step.notice is None


def test_the_narrower_level_has_to_be_held_anew(tmp_path: Path) -> None:
    followed = remembered(tmp_path, PROBES_TWICE)
    practise_adaptively(followed.adaptation, parse_spec(STEADY))
    remember(followed)
    again = remembered(tmp_path, replace(PROBES_TWICE, loops=1, level=Level.ELEMENTARY), TOMORROW).adaptation
    assert again.plan.level is Level.ELEMENTARY
    assert not again.has_grown
    assert mastery_words(again.state, again.rules) == "Mastered at beginner; asked for again on 02 March."


def test_it_grows_no_further_than_the_lesson_allows() -> None:
    limited = replace(ROCK, goals=replace(ROCK.goals, strictest_level=Level.BEGINNER))
    adaptation = practised(PROBES_TWICE, limited)
    assert adaptation.state.is_stable(adaptation.rules)
    assert not adaptation.has_grown


def test_a_part_of_the_lesson_that_is_held_is_not_the_lesson() -> None:
    adaptation = practised(replace(PROBES_TWICE, bars=(1, 1)))
    assert adaptation.state.is_stable(adaptation.rules)
    assert not adaptation.has_grown


def test_a_pass_that_is_clean_for_a_beginner_is_not_for_the_studio() -> None:
    """A spread of 24 ms: strokes beyond 30 ms are not right for the studio, where 23 of 24 must be."""
    wide, narrow = (
        practised(replace(PROBES_TWICE, loops=3, level=level), spec="sd_ms=24,seed=3")
        for level in (Level.BEGINNER, Level.STUDIO)
    )
    assert "Clean" in wide.rounds[2].step.why
    assert "23 needed" in narrow.rounds[2].step.why


# --- live, in the report, and from the capture ------------------------------------------------------------------------


@pytest.mark.parametrize(("level", "mark"), [(Level.BEGINNER, "|"), (Level.ELEMENTARY, "|"), (Level.STUDIO, ">")])
def test_the_same_stroke_is_on_time_for_a_beginner_and_late_for_the_studio(level: Level, mark: str) -> None:
    """20 ms late: on time is within 30 ms for a beginner, 20 at elementary, 5 in the studio."""
    session, written = Session(plan_practice(ROCK, PlanOptions(level=level))), list[str]()
    LiveText(written.append, []).show(session, (Judgement(Label.MATCH, 0, 0, 20 * NS_PER_MS),))
    assert written == [mark]


def test_a_session_that_was_cut_off_is_judged_at_its_level(tmp_path: Path) -> None:
    plan = plan_practice(ROCK, PlanOptions(loops=1, demonstrations=0, level=Level.ADVANCED))
    practise_virtually(plan, parse_spec(STEADY), tmp_path / "session.capture")
    assert practice_document(recovered(tmp_path / "session.capture"), Settings())["level"] == "advanced"


# --- what is kept -----------------------------------------------------------------------------------------------------


def test_each_student_and_lesson_has_a_level_of_its_own(tmp_path: Path) -> None:
    anna = LevelMemory(one_student(tmp_path, "anna"))
    anna.keep("rock-1", Level.STUDIO)
    anna.keep("rock-2", Level.BEGINNER)
    anna.keep("rock-1", Level.ADVANCED)
    assert anna.recall() == ({"rock-1": Level.ADVANCED, "rock-2": Level.BEGINNER}, None)
    assert LevelMemory(one_student(tmp_path, "ben")).recall() == ({}, None)


def test_what_is_remembered_from_before_there_was_a_choice_was_intermediate(tmp_path: Path) -> None:
    document = document_of(Adaptation(ROCK, PlanOptions(), TODAY).state)
    del document["item"]["level"], document["item"]["review"]["level"]
    write_document(one_student(tmp_path, "anna").folder / "mastery" / "rock-1_1-2.json", document)
    assert LevelMemory(one_student(tmp_path, "anna")).recall() == ({"rock-1": Level.INTERMEDIATE}, None)


@pytest.mark.parametrize("text", ["{", "[]", '{"schema": "drum-station/levels/1", "levels": {"rock-1": "expert"}}'])
def test_levels_that_cannot_be_read_are_set_aside(text: str, tmp_path: Path) -> None:
    whose = one_student(tmp_path, "anna")
    file = whose.folder / "mastery" / "levels.json"
    file.parent.mkdir(parents=True)
    file.write_text(text)
    levels, fault = LevelMemory(whose).recall()
    assert levels == {}
    assert fault is not None
    assert str(file) in fault
    assert fault.endswith("levels begin anew")
    assert (whose.folder / "mastery-before-history" / "levels.json").read_text() == text
    assert LevelMemory(whose).recall() == ({}, None)
