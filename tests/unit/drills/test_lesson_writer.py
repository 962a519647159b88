"""Written lessons, letter by letter as a teacher would write them, and read back."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_writer import note_length, write_lesson
from station.drills.writing.score_difference import score_difference
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.drills.reading import QUARTER, SIXTEENTH, TRIPLET, WHOLE, read


def grid_of(grid: str, head: str = "tempo_bpm = 60") -> list[str]:
    """The lines below [grid] that a lesson of this grid is written with."""
    text = write_lesson(read(grid, head))
    return text.split("[grid]\n")[1].splitlines()


def test_lines_are_aligned_under_the_count() -> None:
    assert grid_of('kick="o--- | ----"\nhihat="x-xxx-x- | x-x-x-xx"\nhihat_pedal = "x---|-x--"') == [
        "#                1& 2& 3& 4&   1& 2& 3& 4&",
        'hihat       = "| x- xx x- x- | x- x- x- xx |"',
        'kick        = "| o- -- -- -- | -- -- -- -- |"',
        'hihat_pedal = "| x- -- -- -- | -- x- -- -- |"',
    ]


def test_the_simplest_cells_are_chosen() -> None:
    assert grid_of('snare = "o---o---o---o---"') == ["#          1 2 3 4", 'snare = "| o o o o |"']
    assert grid_of('snare = "ooo ooo ooo ooo"')[1] == 'snare = "| ooo ooo ooo ooo |"'


def test_mixed_beats_are_written_with_parentheses() -> None:
    assert grid_of('snare = "oooo (ooo) oo-- o---"') == [
        "#          1e&a  2ta  3e&a 4e&a",
        'snare = "| oooo (ooo) oo-- o--- |"',
    ]


def test_lines_that_no_cells_suit_together_are_cut_apart() -> None:
    lines = grid_of('snare = "ooo ooo ooo ooo"\nkick = "oooo oooo oooo oooo"\ncrash = "(xxxxx) - - -"')
    assert lines == [
        "#          1e&a    2e&a 3e&a 4e&a",
        'crash = "| (xxxxx) -    -    -    |"',
        'snare = "| ooo     ooo  ooo  ooo  |"',
        'kick  = "| oooo    oooo oooo oooo |"',
    ]


def test_a_bar_like_the_one_before_it_is_a_percent() -> None:
    assert grid_of('snare = "oo-- | oo-- | oo-o"')[1] == 'snare = "| o o - - | % | o o - o |"'


def test_ornaments_go_back_to_their_letters() -> None:
    grid = 'snare    = "| fgdO ttTb ~~~r BxX- |"'
    assert grid_of(grid)[1] == grid.replace("snare    =", "snare =")


def test_hands_go_back_to_the_sticking_line() -> None:
    lines = grid_of('snare = "oo--"\nride = "-xx-"\nsticking = "LBR-"')
    assert lines[-1] == 'sticking = "| L B R - |"'


def test_hands_that_a_sticking_line_cannot_say_go_to_limb_tables() -> None:
    lines = grid_of('left_hand.hihat = "xx--"\nright_hand.snare = "oo--"')
    assert lines[1:] == ['left_hand.hihat  = "| x x - - |"', 'right_hand.snare = "| o o - - |"']


def test_swung_music_is_written_straight() -> None:
    lines = grid_of('snare = "oo -o oo --"', "swing_ratio = 2.0")
    assert lines == ["#          1& 2& 3& 4&", 'snare = "| oo -o oo -- |"']
    assert grid_of('snare = "ooo --- --- ---"', "swing_ratio = 2.0")[1] == 'snare = "| ooo --- --- --- |"'


def test_chokes_and_rolls_over_the_bar_line() -> None:
    assert grid_of('crash = "---x | #---"\nsnare = "---b | ~---"')[1:] == [
        'crash = "| - - - x | # - - - |"',
        'snare = "| - - - b | ~ - - - |"',
    ]


@pytest.mark.parametrize(
    "name",
    [
        "rock-1",
        "funk-2",
        "bossa-1",
        "six-eight-1",
        "seven-eight-1",
        "jazz-ride-1",
        "stops-1",
        "double-kick-1",
        "second-line-1",
        "quintuplet-1",
        "nine-stroke-roll",
        "multiple-bounce-roll",
        "flam-tap",
        "drag",
    ],
)
def test_the_music_of_a_lesson_is_written_and_read_alike(name: str) -> None:
    """One of each way to strike, swung and straight, in several meters."""
    lesson = find_lesson(name)
    again = parse_lesson(write_lesson(lesson), name, name).lesson
    assert again
    assert score_difference(lesson.score, again.score) == ""
    for field in ("title", "loop", "swing", "beat_ticks", "sections", "tempo_bpm", "meter"):
        assert getattr(again, field) == getattr(lesson, field)


def test_an_awkward_title_survives() -> None:
    again = parse_lesson(write_lesson(replace(read('snare = "o"'), title='A "title" \\ é')), "x", "x").lesson
    assert again
    assert again.title == 'A "title" \\ é'


SNARE = Note(0, Piece.SNARE)


@pytest.mark.parametrize(
    ("notes", "words"),
    [
        ([Note(TRIPLET // 11, Piece.SNARE)], "bar 1: strokes lie between the cells"),
        ([Note(WHOLE, Piece.SNARE, Zone.BELL)], "bar 2: no letter of the grid plays this stroke"),
        ([Note(0, Piece.SNARE, velocity=81)], "bar 1, beat 1, snare: velocity 81 became 80"),
        (
            [Note(t, Piece.SNARE, lead_ms=ms, ornament=Ornament.FLAM) for t, ms in ((0, 30), (QUARTER, 20))],
            "bar 1: a grace stroke 20 ms before its note",
        ),
        ([Note(0, Piece.SNARE, ornament=Ornament.DIDDLE)], "a diddle of one stroke"),
        ([Note(0, Piece.KICK)], "kick: limb -1 became 2"),
        ([SNARE, Note(0, Piece.TOM_1), Note(0, Piece.TOM_2)], "3 hands needed at once"),
        ([], "nothing to play"),
    ],
)
def test_what_the_grid_cannot_say_is_named(notes: list[Note], words: str) -> None:
    score = Score.from_notes(notes, TempoMap.constant(60))
    with pytest.raises(BadInput, match=words):
        write_lesson(Lesson("x", "x", score, loop=(0, score.bar_count - 1)))


def test_no_word_is_lost_between_equal_scores() -> None:
    a = Score.from_notes([SNARE, Note(SIXTEENTH, Piece.HIHAT, Zone.BOW, openness=0.0)], TempoMap.constant(60))
    b = Score.from_array(a.notes.copy(), a.tempo_map)
    assert score_difference(a, b) == ""
    rows = a.notes.copy()
    rows["openness"][1] = np.nan
    assert "openness 0.0 became nan" in score_difference(a, Score.from_array(rows, a.tempo_map))
    assert "2 strokes became 1" in score_difference(a, Score.from_array(rows[:1], a.tempo_map))
    assert "tempo" in score_difference(a, Score.from_array(rows, TempoMap.constant(61)))


def test_note_lengths() -> None:
    assert [note_length(t) for t in (QUARTER, QUARTER // 2, QUARTER * 3 // 2, WHOLE)] == ["1/4", "1/8", "3/8", "1/1"]


def test_other_graces_than_the_usual_are_written_for_the_whole_lesson() -> None:
    head = "tempo_bpm = 60\n[graces]\nflam_ms = 22.2\ndrag_ms = 40\nshare = 0.75"
    text = write_lesson(read('snare = "fdFD"', head))
    assert "[graces]\nflam_ms = 22.2\ndrag_ms = 40\nshare = 0.75\n" in text


def test_groups_of_a_meter_are_set_apart_and_counted() -> None:
    head = 'tempo_bpm = 60\nmeter = "3+2+2/8"'
    assert grid_of('hihat = "xxxxxxx"\nsnare = "---o-o-"', head) == [
        "#          123 12 12",
        'hihat = "| xxx xx xx |"',
        'snare = "| --- o- o- |"',
    ]
    assert grid_of('snare = "ooo (ooooo) oo"', head)[-1] == 'snare = "| ooo (ooooo) oo |"'


@pytest.mark.parametrize("cells", [9, 10, 11, 13, 14, 18])
def test_any_tuplet_that_drummers_count_is_written(cells: int) -> None:
    grid = f"| oooo ({'o' * cells}) oo-- o--- |"
    assert grid_of(f'snare = "{grid}"')[-1] == f'snare = "{grid}"'


def test_soft_letters_go_back_to_themselves() -> None:
    assert grid_of('snare = "| vwu- -z~~ ---- ---- |"')[-1] == 'snare = "| vwu- -z~~ ---- ---- |"'


def test_a_buzz_by_a_named_hand() -> None:
    found = read('snare = "b~"\nsticking = "R-"').score[0]
    assert (found.limb, found.articulation) == (Limb.RIGHT_HAND, Articulation.BUZZ)
