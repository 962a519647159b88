"""Writes the tables of keys into docs/lesson-format.md, and lays the shipped lessons out as `lesson show` does.

python -m tools.lesson_reference
"""

from pathlib import Path

from station.drills.library import find_lesson, lesson_names, lesson_path
from station.drills.writing.lesson_schema import reference_tables
from station.drills.writing.lesson_text import show

PAGE = Path(__file__).parents[1] / "docs" / "lesson-format.md"
BEGIN, END = "<!-- keys: made by python -m tools.lesson_reference -->\n", "<!-- end of keys -->"


def page_with_tables(page: str) -> str:
    """The text of the page with the tables between its two marks."""
    before, _, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    assert end, "the page has both marks"
    return f"{before}{BEGIN}\n{reference_tables()}\n\n{END}{after}"


def main() -> None:
    """Write what differs."""
    PAGE.write_text(page_with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    for name in lesson_names():
        path, text = lesson_path(name), find_lesson(name).text
        if text != show(text):
            path.write_text(show(text), encoding="utf-8")


if __name__ == "__main__":
    main()
