"""How notation writes swing: straight cells under a word, triplets where triplets say it."""

import pytest

from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.lesson_file import parse_lesson


def lesson_of(text: str) -> Lesson:
    lesson = parse_lesson(f'title = "T"\n{text}', "t", "t").lesson
    assert lesson
    return lesson


def quarters(lesson: Lesson) -> list[float]:
    """Where the strokes are written, in quarter notes."""
    return [tick / PPQ for tick in lesson.played_once.as_written.notes["tick"].tolist()]


@pytest.mark.parametrize("ratio", [1.3, 1.6, 2.5, 3.0])
def test_swung_cells_are_printed_straight(ratio: float) -> None:
    eighths = lesson_of(f'swing_ratio = {ratio}\n[grid]\nsnare = "oo -o oo --"')
    assert quarters(eighths) == [0, 0.5, 1.5, 2, 2.5]
    sixteenths = lesson_of(f'swing_ratio = {ratio}\nswing_unit = "1/16"\n[grid]\nsnare = "oooo ---o ---- -o--"')
    assert quarters(sixteenths) == [0, 0.25, 0.5, 0.75, 1.75, 3.25]


def test_a_swing_of_two_stays_in_triplets() -> None:
    lesson = lesson_of('swing_ratio = 2\n[grid]\nsnare = "o-o ooo (oo) ---"')
    assert quarters(lesson) == pytest.approx([0, 2 / 3, 1, 4 / 3, 5 / 3, 2, 2.5])


def test_each_section_is_printed_by_its_own_swing() -> None:
    straight = '[[grid]]\nname = "a"\nsnare = "oo -- -- --"\n'
    lesson = lesson_of(f'{straight}[[grid]]\nname = "b"\nswing_ratio = 1.5\nsnare = "oo -- -- --"')
    assert quarters(lesson) == [0, 0.5, 4, 4.5]
