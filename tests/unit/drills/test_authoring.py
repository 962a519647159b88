"""Checking files and starting a new one."""

import re
from pathlib import Path

from station.drills.authoring import NEW_LESSON, check_lessons
from station.drills.grid.tab_symbols import LETTERS, TabFamily
from station.drills.lesson_file import KEYS, parse_lesson
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


DOCS = Path(__file__).parents[3] / "docs" / "lessons.md"


def test_the_examples_of_the_manual_are_lessons() -> None:
    examples = re.findall(r"```toml\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)
    lessons = [example for example in examples if "\nlessons =" not in example]
    assert len(lessons) == 3
    for example in lessons:
        assert parse_lesson(example, "docs/lessons.md", "example").faults == []


def test_the_manual_has_every_letter_and_every_key() -> None:
    text = DOCS.read_text(encoding="utf-8")
    for key in KEYS:
        assert f"`{key}`" in text or f"`[{key}]`" in text, key
    rows = {row.split("|")[1].strip(): row for row in text.splitlines() if row.startswith("| `")}
    for line, family in (("snare", TabFamily.SNARE), ("hihat", TabFamily.HIHAT), ("kick", TabFamily.KICK)):
        for letter in LETTERS[family]:
            assert f"`{letter.lower()}`" in rows[f"`{line}`"], (line, letter)
