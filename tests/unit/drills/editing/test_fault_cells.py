"""Faults of a lesson at their cells; texts by hand."""

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.grid_cursor import Cursor
from station.drills.editing.lesson_edits import LineAt, TextLine
from station.drills.editing.words.fault_cells import fault_cells
from station.drills.reading.lesson_file import parse_lesson


def _cells(text: str) -> list[Cursor]:
    return [each.at for each in fault_cells(text, parse_lesson(text, "t.toml", "t").faults)]


def test_a_letter_that_a_line_lacks_is_marked_in_its_cell() -> None:
    text = (
        'title = "T"\n\n[[grid]]\nname = "A"\nsnare = "| o-o- |"\n\n[[grid]]\nname = "B"\nsnare = "| o-o- | oo-q |"\n'
    )
    assert _cells(text) == [Cursor(1, 1, 3 * PPQ, LineAt(1, Piece.SNARE))]


def test_a_hand_without_a_stroke_is_marked_in_the_sticking_line() -> None:
    text = 'title = "T"\n\n[grid]\nsnare    = "| o-o- |"\nsticking = "| RRL- |"\n'
    assert _cells(text) == [Cursor(0, 0, PPQ, TextLine.STICKING)]


def test_what_no_hands_can_play_is_marked_where_it_is_said() -> None:
    text = 'title = "T"\n\n[grid]\nhihat = "| --x- |"\nride = "| --x- |"\nsnare = "| --o- |"\n'
    (cell,) = _cells(text)
    assert (cell.bar, cell.tick) == (0, 2 * PPQ)


def test_faults_elsewhere_and_texts_that_are_none_have_no_cell() -> None:
    assert _cells('title = "T"\ntempo_bpm = 0\n\n[grid]\nsnare = "| o-o- |"\n') == []
    assert _cells('title = "T"\n\n[grid]\nsnare = "| o-o- | (oo |"\n') == []
    assert _cells("title = ") == []
