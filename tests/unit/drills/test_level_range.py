"""Which level holds for a lesson, and what comes after it."""

from dataclasses import replace
from datetime import date

import pytest

from station.drills.level_range import LevelRange
from station.drills.library import find_lesson
from station.drills.mastery.agenda import next_turn
from station.drills.mastery.next_pass import begin, new_item, next_step
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.practice_steps import PassKind, item_of
from station.drills.mastery.probes import Probes
from station.drills.mastery.reviews import Review
from station.drills.mastery.rules import Rules
from station.drills.mastery.tempo_ladder import Ladder
from station.drills.reading.lesson_file import parse_lesson
from station.scoring.matching.hit_windows import Level

DAY = date(2024, 3, 1)
BEGINNER, ELEMENTARY, INTERMEDIATE, ADVANCED, STUDIO = Level
GRID = '[grid]\nsnare = "oooo"\n'


@pytest.mark.parametrize(
    ("asked", "reached", "holds"),
    [
        (None, None, ELEMENTARY),
        (None, ADVANCED, ADVANCED),
        (BEGINNER, ADVANCED, BEGINNER),
        (STUDIO, BEGINNER, ADVANCED),  # the teacher's limit
        (None, STUDIO, ADVANCED),
    ],
)
def test_what_is_asked_for_holds_then_what_was_reached_then_what_is_suggested(
    asked: Level | None, reached: Level | None, holds: Level
) -> None:
    assert LevelRange(ELEMENTARY, ADVANCED).level(asked, reached) is holds


def test_a_student_grows_level_by_level_to_the_teachers_limit() -> None:
    assert [LevelRange(BEGINNER, ADVANCED).after(level) for level in (BEGINNER, INTERMEDIATE, ADVANCED)] == [
        ELEMENTARY,
        ADVANCED,
        ADVANCED,
    ]
    assert LevelRange(BEGINNER).after(STUDIO) is STUDIO


@pytest.mark.parametrize(
    ("difficulty", "level"), [(1, BEGINNER), (2, ELEMENTARY), (3, INTERMEDIATE), (5, INTERMEDIATE)]
)
def test_where_a_lesson_says_nothing_its_difficulty_does(difficulty: int, level: Level) -> None:
    lesson = parse_lesson(f'title = "T"\nlevel = {difficulty}\n{GRID}', "t", "t").lesson
    assert lesson is not None
    assert lesson.levels == LevelRange(level, STUDIO)


def test_narrower_levels_have_narrower_windows_and_stricter_marks() -> None:
    rules = [Rules().for_lesson(find_lesson("rock-1"), level) for level in Level]
    edges = [level.windows.edges_ms for level in Level]
    assert edges == sorted(edges, reverse=True)
    assert [each.min_right for each in rules] == sorted(each.min_right for each in rules)
    for interval_ms in (125.0, 250.0, 500.0, 1000.0):  # 16ths at 120 to quarters at 60
        limits = [each.sd_limit_ms(interval_ms) for each in rules]
        assert limits == sorted(set(limits), reverse=True)


@pytest.mark.parametrize(
    ("goals", "line", "column", "said"),
    [
        ('level = "expert"', 3, 9, "expected beginner, elementary, intermediate, advanced or studio"),
        ("level = 2", 3, 9, "expected beginner, elementary, intermediate, advanced or studio"),
        ('strictest_level = "yarg"', 3, 19, "expected beginner"),
        ('level = "studio"\nstrictest_level = "advanced"', 3, 9, "studio is stricter than the strictest_level"),
    ],
)
def test_a_level_that_cannot_be_is_told_with_its_place(goals: str, line: int, column: int, said: str) -> None:
    reading = parse_lesson(f'title = "T"\n[goals]\n{goals}\n{GRID}', "t", "t")
    assert reading.lesson is None
    (fault,) = reading.faults
    assert (fault.line, fault.column) == (line, column)
    assert said in fault.text


# --- what is known of an item at another level ------------------------------------------------------------------------

RULES = Rules()
MASTERED = replace(
    new_item(item_of(find_lesson("rock-1")), DAY),
    level=ELEMENTARY,
    ladder=Ladder(100.0),
    probes=Probes(100.0, 100.0, RULES.probes_to_be_stable),
    review=Review().mastered(DAY, ELEMENTARY, RULES),
)
SHOWN = PassResult(notes=52, right=52, sd_ms=10.0, interval_ms=375.0)
"""Clean at any level."""


def test_what_was_shown_at_a_wider_level_is_shown_again_at_a_narrower_one() -> None:
    grown = MASTERED.at_level(INTERMEDIATE)
    assert MASTERED.is_stable(RULES)
    assert not grown.is_stable(RULES)
    assert grown.is_settled(RULES), "it was mastered all the same"
    assert grown.mastery_pct == 100.0
    assert next_turn(grown, [], DAY, RULES).why != "it is not stable yet, so stay with it"


def test_a_review_is_judged_by_what_was_once_good_enough() -> None:
    assert MASTERED.review.due is not None
    due = begin(MASTERED.at_level(INTERMEDIATE), MASTERED.review.due, RULES)
    assert due.step.kind is PassKind.REVIEW
    assert "judged as elementary" in due.step.why
    after, _ = next_step(due, SHOWN, RULES)
    assert (after.review.passed, after.review.level) == (1, ELEMENTARY)
    assert after.probes.in_a_row == 0, "it shows nothing of the narrower level"
