"""The staff's legend: which pieces it names, where, and in which colours."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.render.notation.screen.staff_legend import draw_legend, legend_of, spread
from station.render.palette import piece_colour
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind
from tests.unit.render.scores import rock, score_of

ATLAS = Atlas()


def test_the_legend_names_the_pieces_of_the_score_from_the_top_line_down() -> None:
    assert legend_of(rock(1), ATLAS).pieces == (Piece.HIHAT, Piece.SNARE, Piece.KICK)
    assert legend_of(score_of(), ATLAS).width == 0.0


def test_each_head_stands_on_its_line_in_its_piece_s_colour() -> None:
    """The hi-hat above the staff, G5; the snare in the third space, C5; the kick in the lowest, F4: in spaces."""
    draw_list = DrawList(ATLAS)
    legend = legend_of(rock(1), ATLAS)
    draw_legend(draw_list, legend, (-8.0, 8.0))
    shapes = draw_list.shapes()
    glyphs = shapes[shapes["kind"] == ShapeKind.GLYPH]
    heads = glyphs[glyphs["centre"][:, 0] > legend.width - 1.5]
    assert heads["centre"][:, 1].tolist() == pytest.approx([-2.5, -0.5, 1.5], abs=0.05)
    wanted = [[round(255 * part) for part in piece_colour(piece)] for piece in legend.pieces]
    assert heads["colour"].tolist() == wanted
    assert glyphs["centre"][:, 0].max() < legend.width


@pytest.mark.parametrize("heights", [[0.0, 0.1, 0.2, 4.0], [-8.0, -8.0, -8.0], [0.0], [], [7.9, 8.0]])
def test_names_keep_their_order_and_their_distance(heights: list[float]) -> None:
    found = spread(heights, 1.4, (-8.0, 8.0))
    assert len(found) == len(heights)
    assert (np.diff(found) >= 1.4 - 1e-6).all()
    assert all(-8.0 <= y <= 8.0 for y in found)


def test_more_names_than_have_room_are_spread_evenly() -> None:
    found = spread([0.0] * 20, 1.4, (-7.0, 7.0))
    assert (found[0], found[-1]) == pytest.approx((-6.3, 6.3))
    assert np.diff(found).std() == pytest.approx(0.0, abs=1e-9)
