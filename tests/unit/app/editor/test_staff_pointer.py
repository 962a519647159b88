"""What a place on the staff means: the cell that a click there writes in."""

import pytest

from station.app.editor.staff_pointer import StaffCell, StaffPointer, symbol_of
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.drills.editing.grid_cursor import Cursor, GridStep, Place, letter_at
from station.drills.editing.lesson_edits import REST, LineAt
from station.drills.editing.page_reader import page_of
from station.drills.library import lesson_names
from station.render.notation.staff import step_of
from station.scenes.draft_notation import DraftNotation
from tests.shipped_lesson import shipped_lesson

ROCK = """
title = "Rock"

[[grid]]
name = "A"
hihat = "| x-x-x-x- | x-x-x-x- |"
left_hand.snare = "| --o---o- | --o---o- |"
kick  = "| o---o--- | o---o-o- |"

[[grid]]
name = "B"
like = "A"
kick = "| o------- | o------- |"
"""
WIDTH = 60.0


def pointer_of(text: str, step: GridStep = GridStep.SIXTEENTHS) -> StaffPointer:
    notation = DraftNotation().of(text, WIDTH)
    assert notation is not None
    return StaffPointer(notation, page_of(text), step)


def pointed(pointer: StaffPointer, place: Place, piece: Piece, off: tuple[float, float] = (0.0, 0.0)) -> StaffCell:
    """The cell at a place of a piece's line of the staff, a little `off` it."""
    spot = pointer.spot(place)
    assert spot is not None
    cell = pointer.cell_at(spot[1] + off[0], spot[0].y_of(step_of(piece)) + off[1])
    assert cell is not None
    return cell


def test_a_head_is_the_stroke_of_its_line() -> None:
    cell = pointed(pointer_of(ROCK), Place(0, 1, PPQ), Piece.SNARE, (0.3, 0.2))
    assert cell.is_struck
    assert cell.cursor == Cursor(0, 1, PPQ, LineAt(0, Piece.SNARE, Limb.LEFT_HAND))


def test_an_empty_place_is_the_nearest_cell_of_the_line_that_the_grid_has() -> None:
    cell = pointed(pointer_of(ROCK), Place(0, 0, PPQ // 4), Piece.SNARE, (0.1, -0.1))
    assert not cell.is_struck
    assert cell.cursor == Cursor(0, 0, PPQ // 4, LineAt(0, Piece.SNARE, Limb.LEFT_HAND))


def test_a_piece_without_a_line_gets_one_of_its_own() -> None:
    cell = pointed(pointer_of(ROCK), Place(0, 0, 0), Piece.FLOOR_TOM_1)
    assert cell.cursor == Cursor(0, 0, 0, LineAt(0, Piece.FLOOR_TOM_1))


def test_cells_are_as_fine_as_one_writes() -> None:
    third = Place(0, 0, PPQ // 3)
    assert pointed(pointer_of(ROCK, GridStep.TRIPLETS), third, Piece.FLOOR_TOM_1).cursor.tick == PPQ // 3
    assert pointed(pointer_of(ROCK, GridStep.QUARTERS), third, Piece.FLOOR_TOM_1).cursor.tick == 0


def test_a_variation_is_written_in_its_own_grid() -> None:
    cell = pointed(pointer_of(ROCK), Place(1, 0, 0), Piece.HIHAT)
    assert cell.cursor == Cursor(1, 0, 0, LineAt(1, Piece.HIHAT))
    assert cell.is_struck


def test_beside_the_bars_is_nothing() -> None:
    pointer = pointer_of(ROCK)
    line = pointer.notation.page.places.lines[0]
    assert pointer.cell_at(line.bars[-1].right + 3.0, line.middle_y) is None
    assert pointer.cell_at(5.0, pointer.notation.page.height + 20.0) is None
    assert pointer.bar_at(line.bars[0].right - 1.0, line.middle_y) == Place(0, 0)


@pytest.mark.parametrize("part", range(3))
def test_every_head_of_shipped_lessons_is_a_letter_of_the_page(part: int) -> None:
    """Two readings of a text agree: what notation draws, and the cells that the grid shows."""
    for name in lesson_names()[part :: 3 * 8]:
        text = shipped_lesson(name).text
        pointer = pointer_of(text)
        for line in pointer.notation.page.places.lines:
            for head in line.heads:
                cell = pointer.cell_at(head.x, head.y)
                assert cell is not None, name
                assert isinstance(cell.cursor.line, LineAt)
                if cell.cursor.line.cycle is None:
                    assert letter_at(pointer.page.grids[cell.cursor.grid], cell.cursor) != REST, (name, cell)


def test_letters_have_their_heads() -> None:
    snare, hat = LineAt(0, Piece.SNARE), LineAt(0, Piece.HIHAT)
    assert symbol_of(snare, "x").articulation is Articulation.CROSS_STICK
    assert symbol_of(hat, "E").zone is Zone.EDGE
    assert symbol_of(snare, REST) == symbol_of(snare, "o")
