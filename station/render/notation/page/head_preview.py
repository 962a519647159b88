"""A head where none is yet: what a click would write."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.render.notation.head_places import HEAD_SIGNS, half_width
from station.render.notation.staff import head_of, ledger_steps, step_of
from station.render.palette import BRAND
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, DrawList
from station.render.text.sign_outlines import LEDGER_LINE, LEDGER_OUT


def head_preview(
    piece: Piece, struck: tuple[Zone, Articulation], at: tuple[float, float], atlas: Atlas, colour: Colour = BRAND
) -> NDArray[np.void]:
    """The head of a stroke on `piece`, its middle `at` a place of the page, with the short lines that it needs."""
    draw_list, (x, y) = DrawList(atlas), at
    head, step = head_of(piece, *struck), step_of(piece)
    half = half_width(head) + LEDGER_OUT
    for line in ledger_steps(step):
        off = y + (step - line) / 2
        draw_list.line((x - half, off), (x + half, off), LEDGER_LINE, colour)
    draw_list.sign(HEAD_SIGNS[head], at, colour)
    return draw_list.shapes()
