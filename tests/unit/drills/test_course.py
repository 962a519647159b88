"""Courses: what a file says, what is wrong with it, and those that ship."""

from pathlib import Path

import pytest

from station.app.toml_files import check_files
from station.core.errors import BadInput
from station.drills.course import Course, CoursePart
from station.drills.library import (
    course_prerequisites,
    courses_in,
    find_lesson,
    lesson_names,
    lesson_prerequisites,
    shipped_courses,
)
from station.drills.prerequisites import order_faults
from station.drills.writing.authoring import NEW_LESSON
from station.scoring.matching.hit_windows import Level

GOOD = """\
title = "My first month"
author = "Ada"
level = 2
about = "Twice a week."
lessons = [
  "rock-2",
  "own/mine.toml",
  "rock-1",
]
"""


PARTS = """\
title = "The first term"
mastery = "elementary"
[[part]]
title = "One limb after the other"
lessons = ["rock-1", "own/mine.toml"]
[[part]]
title = "Both feet"
lessons = ["rock-2"]
"""


def written(folder: Path, text: str, name: str = "month.course.toml") -> Path:
    (folder / "own").mkdir(exist_ok=True)
    for name_of_lesson in ("mine", "rock-3"):
        (folder / "own" / f"{name_of_lesson}.toml").write_text(NEW_LESSON)
    (folder / name).write_text(text)
    return folder / name


def test_a_course_has_its_lessons_in_their_order_those_of_files_too(tmp_path: Path) -> None:
    written(tmp_path, GOOD)
    courses, faults = courses_in(tmp_path)
    own = str(tmp_path / "own" / "mine.toml")
    assert courses == [
        Course("month", "My first month", "Twice a week.", "Ada", 2, (CoursePart("", ("rock-2", own, "rock-1")),))
    ]
    assert courses[0].lesson_names == ("rock-2", "mine", "rock-1")
    assert not faults


def test_a_course_of_parts(tmp_path: Path) -> None:
    written(tmp_path, PARTS)
    ((course,), faults) = courses_in(tmp_path)
    assert not faults
    assert [(part.title, part.lesson_names) for part in course.parts] == [
        ("One limb after the other", ("rock-1", "mine")),
        ("Both feet", ("rock-2",)),
    ]
    assert course.lesson_names == ("rock-1", "mine", "rock-2")
    assert course.mastery is Level.ELEMENTARY


@pytest.mark.parametrize(
    ("mastery", "held", "strictest", "is_finished"),
    [
        (None, None, Level.STUDIO, False),
        (None, Level.BEGINNER, Level.STUDIO, True),
        (Level.ELEMENTARY, Level.BEGINNER, Level.STUDIO, False),
        (Level.ELEMENTARY, Level.ELEMENTARY, Level.STUDIO, True),
        (Level.ELEMENTARY, Level.ADVANCED, Level.STUDIO, True),
        (Level.ELEMENTARY, Level.BEGINNER, Level.BEGINNER, True),  # its teacher asks for no more
        (Level.ELEMENTARY, None, Level.BEGINNER, False),
    ],
)
def test_when_a_lesson_of_a_course_is_finished(
    mastery: Level | None, held: Level | None, strictest: Level, is_finished: bool
) -> None:
    course = Course("c", "C", "", "", 1, (), mastery=mastery)
    assert course.is_finished(held, strictest) is is_finished


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        (GOOD.replace('"rock-2"', '"rok-2"'), 6, 3, "no such lesson: rok-2"),
        (
            GOOD.replace("mine.toml", "none.toml"),
            7,
            3,
            "no such lesson: own/none.toml; a file is named from the course's folder",
        ),
        (GOOD.replace("own/mine.toml", "month.course.toml"), 7, 3, "no such lesson: month.course.toml"),
        (GOOD.replace("own/mine.toml", "own/rock-3.toml"), 7, 3, "rock-3.toml has the name of a lesson that ships"),
        (GOOD.replace('"rock-1"', '"rock-2"'), 8, 3, "rock-2 is in the course already"),
        (GOOD.replace('title = "My first month"\n', ""), 1, 1, "title is missing"),
        (GOOD.replace("level = 2", "level = 9"), 3, 9, "from 1 to 5"),
        (GOOD.replace("about", "abuot"), 4, 1, "no such key: abuot; did you mean about"),
        ('title = "T"\nlessons = []\n', 2, 11, "the list is empty"),
        ('title = "T"\n', 1, 1, "lessons is missing"),
        ('title = "T"\nmastery = "expert"\nlessons = ["rock-1"]\n', 2, 11, "expected beginner, elementary,"),
        (
            'title = "T"\nlessons = ["rock-1"]\n[[part]]\ntitle = "A"\nlessons = ["rock-2"]\n',
            2,
            1,
            "here are parts, too",
        ),
        ('title = "T"\n[[part]]\nlessons = ["rock-2"]\n', 2, 1, "part.title is missing"),
        ('title = "T"\n[[part]]\ntitle = "A"\nlessons = []\n', 4, 11, "the list is empty"),
        (PARTS.replace('"rock-2"', '"rock-1"'), 8, 12, "rock-1 is in the course already"),
        (PARTS.replace('"rock-2"', '"rok-2"'), 8, 12, "no such lesson: rok-2"),
        ('title = "T"\nlessons = "rock-1"\n', 2, 11, "expected a list"),
        ('title = "T"\nlessons = ["rock-1"\n', 2, 20, "a list is not closed"),
    ],
)
def test_each_fault_is_told_with_its_place(tmp_path: Path, text: str, line: int, column: int, words: str) -> None:
    path = written(tmp_path, text)
    faults, count = check_files([str(path)])
    assert count == 1
    assert [(one.line, one.column) for one in faults] == [(line, column)]
    assert words in faults[0].text


def test_a_course_that_cannot_be_read_is_told_and_the_others_stay(tmp_path: Path) -> None:
    written(tmp_path, GOOD)
    bad = written(tmp_path, "title = 3", "bad.course.toml")
    courses, faults = courses_in(tmp_path)
    assert [one.name for one in courses] == ["month"]
    assert [(one.source, type(one)) for one in faults] == [(str(bad), BadInput)]


def test_who_asks_for_a_lesson_and_names_a_course_is_told_so(tmp_path: Path) -> None:
    path = written(tmp_path, GOOD)
    with pytest.raises(BadInput, match=r"month\.course\.toml: this is a course; name one of its lessons"):
        find_lesson(str(path))


def test_a_folder_that_is_not_there_has_none(tmp_path: Path) -> None:
    assert courses_in(tmp_path / "none") == ([], [])


def test_those_that_ship_begin_with_the_first_beats_and_have_shipped_lessons_alone() -> None:
    courses = shipped_courses()
    assert courses[0].name == "first-beats"
    assert "rock-1" in courses[0].parts[0].lessons, "what a newcomer meets first"
    assert [one.level for one in courses] == sorted(one.level for one in courses)
    for course in courses:
        assert course.about
        assert set(course.lessons) <= set(lesson_names())
        assert len(course.lessons) >= 8


def test_what_ships_names_nothing_before_it_that_is_not_there_and_goes_in_no_circle() -> None:
    for named, noun in ((lesson_prerequisites(), "lesson"), (course_prerequisites(), "course")):
        assert order_faults(named, named.keys(), noun) == []


def test_a_shipped_course_has_what_comes_before_a_lesson_before_it() -> None:
    before = lesson_prerequisites()
    for course in shipped_courses():
        names = course.lesson_names
        late = [
            (course.name, name, first)
            for place, name in enumerate(names)
            for first in before[name]
            if first in names[place:]
        ]
        assert late == []
