"""The lesson that a teacher starts from, and what the manual says."""

import re
from pathlib import Path

from station.drills.authoring import NEW_LESSON
from station.drills.grid.tab_symbols import SYMBOLS, TabFamily
from station.drills.lesson_fields import FIELDS
from station.drills.lesson_file import parse_lesson


def test_the_new_lesson_is_a_lesson() -> None:
    reading = parse_lesson(NEW_LESSON, "new", "new")
    assert reading.faults == []
    assert reading.lesson
    assert reading.lesson.score.bar_count == 2


DOCS = Path(__file__).parents[3] / "docs" / "lessons.md"


def test_the_examples_of_the_manual_are_lessons() -> None:
    examples = re.findall(r"```toml\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)
    lessons = [example for example in examples if "\nlessons =" not in example]
    assert len(lessons) == 9
    for example in lessons:
        assert parse_lesson(example, "docs/lessons.md", "example").faults == []


def test_the_manual_has_every_letter_and_every_key() -> None:
    text = DOCS.read_text(encoding="utf-8")
    for key in FIELDS:
        assert any(f"`{name}`" in text for name in (key, f"[{key}]", f"[grid.{key}]")), key
    rows = {row.split("|")[1].strip(): row for row in text.splitlines() if row.startswith("| `")}
    for line, family in (("snare", TabFamily.SNARE), ("hihat", TabFamily.HIHAT), ("kick", TabFamily.KICK)):
        for letter in SYMBOLS[family]:
            assert f"`{letter.lower()}`" in rows[f"`{line}`"], (line, letter)
