"""`station lesson list`: lessons by kind and of a course, with how far the student is."""

import json
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.settings import Settings, save_settings
from station.drills.library import find_lesson, lesson_rows, shipped_courses
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.reviews import Review
from station.scoring.matching.hit_windows import Level
from tests.fakes.known_students import know, one_student

TODAY = date(2026, 3, 1)
OWN = """
title = "My own"
prerequisites = ["first-beats"]
mastery = "elementary"
[[part]]
title = "The beginning"
lessons = ["rock-1", "rock-2"]
[[part]]
title = "And on"
lessons = ["disco-1"]
"""


@pytest.fixture
def sessions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Rock 1 held at elementary, rock 2 at beginner; a course of one's own."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    save_settings(Settings(sessions=str(tmp_path)))
    for name, level in (("rock-1", Level.ELEMENTARY), ("rock-2", Level.BEGINNER)):
        lesson = find_lesson(name)
        state = replace(new_item(item_of(lesson), TODAY), review=Review(TODAY, 0, None, level))
        know(one_student(tmp_path, Settings().student), state)
    (tmp_path / "courses").mkdir()
    (tmp_path / "courses" / "mine.course.toml").write_text(OWN)
    return tmp_path


def said(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["lesson", "list", *words]) == 0
    return capsys.readouterr().out


def test_every_lesson_stands_in_its_kind_in_columns(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = said(capsys)
    kinds = [row.folder for row in lesson_rows()]
    for kind in set(kinds):
        assert f"{kind} ({kinds.count(kind)})" in text
    lines = [line for line in text.splitlines() if " bpm " in line]
    assert len(lines) == len(kinds)
    assert len({line.index(" bpm ") for line in lines}) == 1
    (rock,) = [line for line in lines if line.startswith("  rock-1 ")]
    assert "✓ elementary" in rock


def test_one_kind(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = said(capsys, "--kind", "fills")
    assert text.startswith(f"fills ({[row.folder for row in lesson_rows()].count('fills')})\n")
    assert "grooves" not in text
    assert "courses" not in text


def test_courses_say_how_much_is_finished_and_what_comes_before(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Only rock 1 is held at the level for which the course asks."""
    (line,) = [line for line in said(capsys).splitlines() if line.startswith("  mine ")]
    assert "1 of   3 finished" in line
    assert line.endswith("My own; after first-beats")


def test_a_course_has_its_parts_and_numbers(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = said(capsys, "--course", "mine").splitlines()
    assert lines[:2] == [
        "My own: 1 of 3 finished; a lesson is finished when you hold it at elementary",
        "First: first-beats",
    ]
    assert [line.split()[:2] for line in lines[2:] if line] == [
        ["The", "beginning"],
        ["1", "rock-1"],
        ["2", "rock-2"],
        ["And", "on"],
        ["3", "disco-1"],
    ]


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--course", "first-baets"], "no such course; did you mean first-beats?"),
        (["--kind", "groves"], "no such kind of lessons; did you mean grooves?"),
    ],
)
def test_what_is_not_there(sessions: Path, words: list[str], fault: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lesson", "list", *words]) == 2
    assert fault in capsys.readouterr().err


def test_as_json(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = json.loads(said(capsys, "--json"))
    assert document["schema"] == "drum-station/lessons/1"
    assert [one["name"] for one in document["lessons"]] == [row.name for row in lesson_rows()]
    assert [one["name"] for one in document["courses"]] == ["mine", *(one.name for one in shipped_courses())]
    hard = {one["name"]: one["difficulty"] for one in document["lessons"]}
    assert hard["rock-1"] < hard["funk-1"] < hard["samba-1"]
    mine = json.loads(said(capsys, "--json", "--course", "mine"))
    assert [(one["name"], one["held"]) for one in mine["lessons"]] == [
        ("rock-1", "elementary"),
        ("rock-2", "beginner"),
        ("disco-1", None),
    ]
    (course,) = mine["courses"]
    assert (course["finished"], course["mastery"], course["prerequisites"]) == (1, "elementary", ["first-beats"])
    assert [part["title"] for part in course["parts"]] == ["The beginning", "And on"]


def test_the_name_of_a_lesson_that_an_own_course_brings_will_do(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = 'title = "Home"\n\n[grid]\n#          1 2 3 4\nsnare = "| o - o - |"\n'
    (sessions / "courses" / "at-home.toml").write_text(text)
    (sessions / "courses" / "mine.course.toml").write_text('title = "My own"\nlessons = ["at-home.toml"]\n')
    assert "at-home" in said(capsys, "--course", "mine")
    assert main(["lesson", "show", "at-home"]) == 0
    assert capsys.readouterr().out == text
    assert main(["lesson", "show", "at-hime"]) == 2
    assert capsys.readouterr().err.startswith("station: at-hime: no such lesson")
