"""What comes before a lesson and after it."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from station.core.settings import Settings
from station.drills.course import Course, CoursePart
from station.drills.library import find_lesson
from station.drills.mastery.agenda import Ahead
from station.drills.mastery.practice_steps import item_of
from station.practice.records.lesson_order import (
    ahead_of,
    first_words,
    followed_course,
    is_finished,
    shipped_title,
)
from station.practice.records.lesson_progress import LessonProgress
from station.scoring.matching.hit_windows import Level

ROCK_3 = replace(find_lesson("rock-3"), prerequisites=("rock-1", "no-such", "rock-2"))
COURSE = Course(
    "c", "Beats", "", "", 1, (CoursePart("One", ("rock-1", "rock-3")), CoursePart("Two", ("rock-4", "disco-1")))
)


def mastered(names: Iterable[str], level: Level = Level.BEGINNER) -> dict[str, LessonProgress]:
    return {name: LessonProgress(100.0, 100.0, level) for name in names}


def test_who_struggles_is_sent_to_the_first_prerequisite_that_is_not_mastered_and_can_be_read() -> None:
    assert ahead_of(ROCK_3, None, mastered(["rock-1"]), struggles=True) == Ahead(item_of(find_lesson("rock-2")))
    assert ahead_of(ROCK_3, None, mastered(["rock-1", "rock-2"]), struggles=True) == Ahead()
    assert ahead_of(ROCK_3, None, {}, struggles=False) == Ahead()


def test_what_a_course_has_next_is_the_next_that_is_not_finished() -> None:
    disco = item_of(find_lesson("disco-1"))
    assert ahead_of(ROCK_3, COURSE, mastered(["rock-4"]), struggles=False) == Ahead(None, disco, "Beats")
    assert ahead_of(ROCK_3, COURSE, mastered(["rock-4", "disco-1"]), struggles=False).after is None
    assert ahead_of(find_lesson("rock-2"), COURSE, {}, struggles=False).after is None  # it has no such lesson


def test_a_course_may_ask_for_a_level() -> None:
    strict = replace(COURSE, mastery=Level.ELEMENTARY)
    assert not is_finished(strict, "rock-1", mastered(["rock-1"]))
    assert is_finished(strict, "rock-1", mastered(["rock-1"], Level.ADVANCED))
    assert not is_finished(strict, "rock-1", {})


def test_what_comes_first_is_said_with_its_title() -> None:
    lines = first_words(ROCK_3.prerequisites, mastered(["rock-2"]), shipped_title)
    assert lines == [
        f"First: {find_lesson('rock-1').title} – not yet mastered",
        "First: no-such – not yet mastered",
        f"First: {find_lesson('rock-2').title} – mastered",
    ]


def test_the_course_that_is_followed_is_the_users_own_or_a_shipped_one(tmp_path: Path) -> None:
    settings = Settings(sessions=str(tmp_path))
    assert followed_course(settings) is None
    assert followed_course(replace(settings, course="gone")) is None
    shipped = followed_course(replace(settings, course="first-beats"))
    assert shipped is not None
    assert "rock-1" in shipped.lessons
    settings.courses_dir.mkdir(parents=True)
    (settings.courses_dir / "mine.course.toml").write_text('title = "Mine"\nlessons = ["rock-2"]\n')
    own = followed_course(replace(settings, course="mine"))
    assert own is not None
    assert own.title == "Mine"
