"""How far a student is: what the lists say of what is remembered."""

from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

from station.drills.library import find_lesson
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.probes import Probes
from station.drills.mastery.reviews import Review
from station.drills.mastery.tempo_ladder import Ladder
from station.practice.records.lesson_progress import LessonProgress
from station.practice.records.student_progress import student_progress
from station.scoring.matching.hit_windows import Level
from station.store.rows import MasteryRow
from tests.fakes.known_students import know, one_student

TODAY = date(2026, 3, 1)
LESSON = find_lesson("rock-1")


def begun() -> ItemState:
    return replace(new_item(item_of(LESSON), TODAY), probes=Probes(75.0, 85.0), ladder=Ladder(90.0))


def test_nothing_is_said_of_what_nobody_practised(tmp_path: Path) -> None:
    assert student_progress(one_student(tmp_path, "anna")) == {}


def test_a_lesson_that_was_begun_says_its_tempi(tmp_path: Path) -> None:
    know(one_student(tmp_path, "anna"), begun())
    assert student_progress(one_student(tmp_path, "anna")) == {"rock-1": LessonProgress(90.0, 85.0, None)}
    assert student_progress(one_student(tmp_path, "ben")) == {}
    assert "85 %" in student_progress(one_student(tmp_path, "anna"))["rock-1"].words(TODAY)


def test_what_is_mastered_is_asked_for_again_on_its_day(tmp_path: Path) -> None:
    due = TODAY + timedelta(days=3)
    know(one_student(tmp_path, "anna"), replace(begun(), review=Review(TODAY, 1, due, Level.ADVANCED)))
    known = student_progress(one_student(tmp_path, "anna"))["rock-1"]
    assert known.is_mastered
    assert [known.is_due(TODAY), known.is_due(due)] == [False, True]
    assert known.words(TODAY) == "Mastered at advanced; to be shown again on 4 March"


def test_the_whole_lesson_counts_before_one_of_its_bars(tmp_path: Path) -> None:
    whole = begun()
    bar = replace(whole, item=replace(whole.item, bar_notes=(8,), bar_s=(2.0,)), review=Review(TODAY, 4))
    know(one_student(tmp_path, "anna"), bar, whole)
    assert not student_progress(one_student(tmp_path, "anna"))["rock-1"].is_mastered


def test_what_cannot_be_read_is_no_progress(tmp_path: Path) -> None:
    know(one_student(tmp_path, "anna"), begun())
    one_student(tmp_path, "anna").open().remember("anna", [MasteryRow("rock-2", 0, 1, "{")])
    assert set(student_progress(one_student(tmp_path, "anna"))) == {"rock-1"}
