"""The lesson that a teacher starts from, and what the manual says."""

import re
from pathlib import Path

from station.drills.grid.tab_symbols import SYMBOLS, TabFamily
from station.drills.reading.lesson_fields import FIELDS
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.authoring import NEW_LESSON
from station.drills.writing.lesson_text import show


def test_the_new_lesson_is_a_lesson() -> None:
    reading = parse_lesson(NEW_LESSON, "new", "new")
    assert reading.faults == []
    assert reading.lesson
    assert reading.lesson.score.bar_count == 2
    assert show(NEW_LESSON) == NEW_LESSON


DOCS = Path(__file__).parents[3] / "docs" / "lessons.md"


def test_the_examples_of_the_manual_are_lessons() -> None:
    examples = re.findall(r"```toml\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)
    lessons = [example for example in examples if "\nlessons =" not in example]
    assert len(lessons) == 10
    for example in lessons:
        assert parse_lesson(example, "docs/lessons.md", "example").faults == []


FAULTY = """\
title = "T"
tempo_bpm = 100
form = ["groove", "fil"]

[[grid]]
name = "groove"
#                1e&a 2e&a 3e&a 4e&a
hihat       = "| x-x- x-x- x-x x-o- |"
snare       = "| ---- O--g -q-- O--- |"
[[grid]]
name = "fill"
kik         = "| o-o- ---- --o- ---- |"
[goals]
target_tempo_bpm = 90
"""


def test_the_faults_of_the_manual_are_told_so() -> None:
    text = DOCS.read_text(encoding="utf-8")
    faults = parse_lesson(FAULTY, "my-groove.toml", "my-groove").faults
    assert "\n".join(map(str, faults)) in text


def test_the_manual_has_every_letter_and_every_key() -> None:
    text = DOCS.read_text(encoding="utf-8")
    for key in FIELDS:
        assert any(f"`{name}`" in text for name in (key, f"[{key}]", f"[grid.{key}]")), key
    rows = {row.split("|")[1].strip(): row for row in text.splitlines() if row.startswith("| `")}
    for line, family in (("snare", TabFamily.SNARE), ("hihat", TabFamily.HIHAT), ("kick", TabFamily.KICK)):
        for letter in SYMBOLS[family]:
            assert f"`{letter.lower()}`" in rows[f"`{line}`"], (line, letter)
