"""The form of a piece, from bars that are told apart by letters; expected pages by hand."""

import pytest

from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.transcription.form_finder import found_form
from station.drills.writing.lesson_writer import write_lesson
from station.drills.writing.score_difference import score_difference
from station.music.drum_part import PartSection
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.drills.reading import WHOLE

Form = tuple[list[tuple[str, int, int]], list[str]]
"""Name, bars and times of each grid, and the names in the order in which they are played."""


def lesson_of_bars(bars: str) -> Lesson:
    """A lesson of 4/4 bars: those of one letter are the same; a capital begins with a crash, f is a fill on toms."""
    notes: list[Note] = []
    for bar, letter in enumerate(bars):
        start = bar * WHOLE
        drum = Piece.TOM_1 if letter == "f" else Piece.SNARE
        notes += [Note(start + (ord(letter.lower()) - ord("a")) * PPQ // 8, drum)]
        notes += [Note(start, Piece.CRASH_1, Zone.EDGE)] if letter.isupper() else []
    score = Score.from_notes(notes, TempoMap.constant(120), len(bars) * WHOLE)
    return Lesson("x", "x", score, loop=(0, len(bars) - 1))


def form(bars: str, *sections: tuple[str, int, int]) -> Form:
    lesson = lesson_of_bars(bars)
    found = found_form(lesson, [PartSection(*section) for section in sections])
    again = parse_lesson(write_lesson(lesson, found), "x", "x").lesson
    assert again
    assert score_difference(lesson.score, again.score) == ""
    grids = [(grid.name, grid.bars, grid.times) for grid in found.grids]
    return grids, [found.grids[i].name for i in found.order]


def test_one_bar_again_and_again_is_a_bar() -> None:
    assert form("a" * 64) == ([("", 1, 64)], [""])


def test_a_phrase_again_and_again_is_a_phrase() -> None:
    assert form("aaab" * 8) == ([("", 4, 8)], [""])


def test_two_bars_in_turn_are_two_bars() -> None:
    assert form("ab" * 6) == ([("", 2, 6)], [""])


def test_what_comes_again_is_named_again() -> None:
    assert form("aaabccdcaaab") == ([("A", 4, 1), ("B", 4, 1)], ["A", "B", "A"])


def test_played_twice_here_and_once_there_it_is_one_grid() -> None:
    assert form("aaabaaabccdcaaab") == ([("A", 4, 1), ("B", 4, 1)], ["A", "A", "B", "A"])


def test_often_here_and_once_there_it_is_one_grid() -> None:
    assert form("aaaaaaaabcbdaaaa" + "a" * 12) == ([("A", 1, 1), ("B", 4, 1)], ["A"] * 8 + ["B"] + ["A"] * 16)


def test_a_groove_of_uneven_phrases_is_written_once() -> None:
    """Fills after six bars, five and seven, which no phrase of 2, 4 or 8 bars fits."""
    grids, order = form("aaaaaaf" + "aaaaab" + "aaaaaaac")
    assert grids == [("A", 1, 1), ("fill", 1, 1), ("B", 1, 1), ("C", 1, 1)]
    assert order == ["A"] * 6 + ["fill"] + ["A"] * 5 + ["B"] + ["A"] * 7 + ["C"]


def test_a_variation_bears_the_letter_of_what_it_varies() -> None:
    """Of four bars the last differs, and the snare alone has no other line to share."""
    lesson = lesson_of_bars("aaab" + "aaac" + "defg")
    text = write_lesson(lesson, found_form(lesson, [PartSection("", i, i + 3) for i in (0, 4, 8)]))
    assert [line for line in text.splitlines() if "name" in line] == ['name = "A"', 'name = "A 2"', 'name = "B"']


def test_a_crash_opens_a_part() -> None:
    """Six bars, then a crash: phrases count from there."""
    grids, order = form("aabbcd" + "Eghh" + "ijkl")
    assert [bars for _, bars, _ in grids] in ([6, 4, 4], [4, 2, 4, 4], [2, 4, 4, 4], [6, 8], [4, 2, 8])
    assert len(order) == len(grids)


def test_a_fill_by_itself_is_called_so() -> None:
    assert form("aaaaf", ("", 0, 3), ("", 4, 4)) == ([("A", 1, 4), ("fill", 1, 1)], ["A", "fill"])


def test_the_files_names_stay() -> None:
    assert form("aabbaa", ("verse", 0, 1), ("chorus", 2, 3), ("verse", 4, 5)) == (
        [("verse", 1, 2), ("chorus", 1, 2)],
        ["verse", "chorus", "verse"],
    )


def test_two_sections_of_one_name_that_differ_have_two_names() -> None:
    assert form("abcb", ("verse", 0, 1), ("verse", 2, 3))[1] == ["verse", "verse 2"]


@pytest.mark.parametrize("name", ["a, b", "\x1b[2J", " "])
def test_names_that_no_form_can_say(name: str) -> None:
    assert form("aabb", (name, 0, 1), ("x", 2, 3))[1]


def test_where_few_lines_differ_it_is_a_variation() -> None:
    """Kick and hi-hat stay; the snare moves."""
    notes = [
        note
        for bar, at in enumerate((1, 2, 1, 3, 2, 1, 2, 3))
        for note in (
            Note(bar * WHOLE, Piece.HIHAT, Zone.BOW, openness=0.0),
            Note(bar * WHOLE, Piece.COWBELL),
            Note(bar * WHOLE + at * PPQ, Piece.SNARE),
        )
    ]
    lesson = Lesson("x", "x", Score.from_notes(notes, TempoMap.constant(120), 8 * WHOLE), loop=(0, 7))
    text = write_lesson(lesson, found_form(lesson, ()))
    assert 'like = "A"' in text
    assert text.count("hihat") == 1
    assert text.count("snare") == 2
