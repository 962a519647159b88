"""How notation writes swing: straight cells under a mark, triplets in a bar that has triplets besides."""

import pytest

from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson


def lesson_of(text: str) -> Lesson:
    lesson = parse_lesson(f'title = "T"\n{text}', "t", "t").lesson
    assert lesson
    return lesson


def quarters(lesson: Lesson) -> list[float]:
    """Where the strokes are written, in quarter notes."""
    return [tick / PPQ for tick in lesson.played_once.as_written.notes["tick"].tolist()]


@pytest.mark.parametrize("ratio", [1.3, 1.6, 2.0, 2.5, 3.0])
def test_swung_cells_are_printed_straight(ratio: float) -> None:
    eighths = lesson_of(f'swing_ratio = {ratio}\n[grid]\nsnare = "oo -o oo --"')
    assert quarters(eighths) == [0, 0.5, 1.5, 2, 2.5]
    sixteenths = lesson_of(f'swing_ratio = {ratio}\nswing_unit = "1/16"\n[grid]\nsnare = "oooo ---o ---- -o--"')
    assert quarters(sixteenths) == [0, 0.25, 0.5, 0.75, 1.75, 3.25]


def test_a_swing_of_two_is_triplets_only_in_a_bar_that_has_triplets() -> None:
    lesson = lesson_of('swing_ratio = 2\n[grid]\nsnare = "oo (ooo) oo -- | oo -- -- --"')
    assert quarters(lesson) == pytest.approx([0, 2 / 3, 1, 4 / 3, 5 / 3, 2, 8 / 3, 4, 4.5])


def test_triplets_of_another_line_count_too() -> None:
    lesson = lesson_of('swing_ratio = 2\n[grid]\nhihat = "xx xx xx xx"\nsnare = "--- ooo --- ---"')
    assert sorted(set(quarters(lesson))) == pytest.approx([0, 2 / 3, 1, 4 / 3, 5 / 3, 2, 8 / 3, 3, 11 / 3])


def test_another_ratio_is_never_spelled_in_notes() -> None:
    """At 3:1 the late eighth would be a dotted eighth and a sixteenth: it stays straight beside triplets."""
    lesson = lesson_of('swing_ratio = 3\n[grid]\nsnare = "oo (ooo) -- --"')
    assert quarters(lesson) == pytest.approx([0, 1 / 2, 1, 4 / 3, 5 / 3])


def test_each_section_is_printed_by_its_own_swing() -> None:
    straight = '[[grid]]\nname = "a"\nsnare = "oo -- -- --"\n'
    lesson = lesson_of(f'{straight}[[grid]]\nname = "b"\nswing_ratio = 1.5\nsnare = "oo -- -- --"')
    assert quarters(lesson) == [0, 0.5, 4, 4.5]


def test_strokes_sound_where_swing_has_them_and_know_where_they_are_written() -> None:
    """At 3:1 the second eighth lies three quarters into the beat: a quarter of it later than it is written."""
    notes = lesson_of('swing_ratio = 3\n[grid]\nsnare = "oo (oo) -- --"').score.notes
    assert [(row["tick"] / PPQ, row["swing_ticks"] / PPQ) for row in notes] == [(0, 0), (0.75, 0.25), (1, 0), (1.5, 0)]


def test_a_loop_of_swung_bars_keeps_them() -> None:
    score = lesson_of('swing_ratio = 1.5\n[grid]\nsnare = "oo -- -- -- | -o -- -- --"').score
    looped = score.bars(1, 1).repeated(2).at_speed(1.2)
    assert (looped.as_written.notes["tick"] / PPQ).tolist() == [0.5, 4.5]
    assert (looped.notes["tick"] / PPQ).tolist() == pytest.approx([0.6, 4.6], abs=1e-4)
