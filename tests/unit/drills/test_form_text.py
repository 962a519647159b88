"""The form's one line: what a teacher would write, by hand, and that it is read as it was meant."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.form_text import form_text

HEAD = 'title = "T"\ntempo_bpm = 60\nmeter = "1/4"\n'


@pytest.mark.parametrize(
    ("played", "text"),
    [
        ("AABA", "A, A, B, A"),
        ("AAAAB", "A x4, B"),
        ("AABA" * 3, "(A, A, B, A) x3"),
        ("ABCD" * 48, "(A, B, C, D) x48"),
        ("I" + "AAAB" * 8 + "O", "I, (A x3, B) x8, O"),
        ("AB" * 3, "A, B, A, B, A, B"),
        ("ABCDEFGHIJKLMNOPQ", ", ".join("ABCDEFGHIJKLMNOPQ")),
    ],
)
def test_what_comes_often_is_said_once(played: str, text: str) -> None:
    assert form_text(played) == text


@pytest.mark.parametrize("name", ["A x2", "(A", "A)", "take (2)", "Bridge ×3"])
def test_names_that_look_counted_are_written_out(name: str) -> None:
    assert form_text([name, "B", "B", "B"]) == f"{name}, B, B, B"


@given(st.lists(st.sampled_from(["A", "B", "C", "A x2", "verse 2"]), min_size=1, max_size=60))
def test_it_is_read_as_it_was_meant(played: list[str]) -> None:
    grids = "".join(f'[[grid]]\nname = "{name}"\nsnare = "o"\n' for name in dict.fromkeys(played))
    read = parse_lesson(f'{HEAD}form = "{form_text(played)}"\n{grids}', "x", "x").lesson
    assert read
    bars = [section.name for section in read.sections for _ in range(section.first_bar, section.last_bar + 1)]
    assert bars == played
