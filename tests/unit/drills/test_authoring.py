"""Checking files and starting a new one."""

from pathlib import Path

from station.drills.authoring import NEW_LESSON, check_lessons
from station.drills.lesson_file import parse_lesson
from station.drills.library import lessons_dir


def test_the_new_lesson_is_a_lesson() -> None:
    reading = parse_lesson(NEW_LESSON, "new", "new")
    assert reading.faults == []
    assert reading.lesson
    assert reading.lesson.score.bar_count == 2


def test_all_that_ships_is_sound() -> None:
    faults, count = check_lessons([str(lessons_dir())])
    assert faults == []
    assert count >= 24


def test_every_fault_of_every_file(tmp_path: Path) -> None:
    good, bad, broken = tmp_path / "good.toml", tmp_path / "bad.toml", tmp_path / "broken.toml"
    good.write_text(NEW_LESSON)
    bad.write_text('title = "T"\nlevel = 9\n[grid]\nsnare = "oq"\n')
    broken.write_bytes(b"title = 'T'\n\xff")
    faults, count = check_lessons([str(tmp_path), str(tmp_path / "none.toml")])
    assert count == 4
    assert [str(f).removeprefix(str(tmp_path) + "/").split(": ")[:2] for f in faults] == [
        ["bad.toml", "line 2, column 9"],
        ["bad.toml", "line 4, column 11"],
        ["broken.toml", "line 2, column 1"],
        ["none.toml", "line 1, column 1"],
    ]


def test_a_folder_without_lessons(tmp_path: Path) -> None:
    faults, count = check_lessons([str(tmp_path)])
    assert count == 0
    assert "no lesson in this folder" in faults[0].text
