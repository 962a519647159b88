"""Keys below the wrong `[table]`: each is sent where it belongs, as docs/lesson-format.md has the tables."""

import pytest

from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import faults

GRID = '[grid]\nsnare = "oooo"\n'


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        (GRID + "passes = 4\n", 4, "passes belongs to the lesson itself; expected above the first line in brackets"),
        ("[goals]\nmax_sd_ms = 20\nloop = [1, 1]\n" + GRID, 4, "loop belongs to the lesson itself"),
        ('[hints]\nlate = "Wait."\ncount_in_bars = 2\n' + GRID, 4, "count_in_bars belongs to the lesson itself"),
        ('[landing]\nkick = "o"\nform = "A"\n' + GRID, 4, "form belongs to the lesson itself"),
        ("max_sd_ms = 20\n" + GRID, 2, "max_sd_ms belongs to the goals; expected below [goals]"),
        ("[goals]\nmax_tempo_error_pct = 2\n" + GRID, 3, "expected below [[goals.bars]]"),
        ('snare = "oooo"\n' + GRID, 2, "snare belongs to a grid; expected below [grid]"),
        ('say = "Low"\n' + GRID, 2, "say belongs to what happens at a bar; expected in the list at"),
        ("accent = 120\n" + GRID, 2, "accent belongs to the velocities; expected below [dynamics]"),
        (GRID + "flam_ms = 20\n", 4, "flam_ms belongs to the grace strokes; expected below [graces]"),
    ],
)
def test_a_key_below_the_wrong_table_is_sent_home(text: str, line: int, words: str) -> None:
    (found,) = faults('title = "T"\n' + text)
    assert (found.line, found.column) == (line, 1)
    assert words in found.text


def test_a_word_that_no_table_knows_is_not() -> None:
    (found,) = faults('title = "T"\n' + GRID + 'snarre = "oooo"\n')
    assert found.text == "no such line: snarre; did you mean snare?"


def test_what_stands_in_the_wrong_table_is_not_missing_as_well() -> None:
    (found,) = parse_lesson(f'{GRID}title = "T"\n', "test.toml", "test").faults
    assert (found.line, found.text.split(";")[0]) == (3, "title belongs to the lesson itself")
