"""The legend of a staff: which line and head is which piece, for the pieces of one score, left of the clef.

Units are staff spaces, y down, 0 on the staff's middle line; x runs from the legend's left edge.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.music.score import Score
from station.render.notation import note_shapes
from station.render.notation.staff import PLACES, height
from station.render.palette import INK_FAINT, piece_colour
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

_LETTERS, _LINE = 1.45, 1.4
"""Size of the names, and from one to the next at the least: as large as sticking."""
_MARGIN, _GAP, _HEAD = 0.6, 0.5, 1.5
"""Left of the names, between a name and its head, and what a head takes."""
_RULE = 0.09
_DROP = 0.45
"""From a name's middle to its baseline."""


@dataclass(frozen=True, slots=True)
class Legend:
    """The pieces that are named, the highest on the staff first, and how wide their names are."""

    pieces: tuple[Piece, ...]
    width: float


def legend_of(score: Score, atlas: Atlas) -> Legend:
    """The legend of what `score` asks the player for."""
    found = [Piece(int(piece)) for piece in np.unique(score.notes["piece"])]
    pieces = tuple(sorted(found, key=lambda piece: (-PLACES[piece].step, piece)))
    draw_list = DrawList(atlas)
    widest = max((draw_list.width(piece_name(piece), _style(piece)) for piece in pieces), default=0.0)
    return Legend(pieces, _MARGIN + widest + _GAP + _HEAD if pieces else 0.0)


def draw_legend(draw_list: DrawList, legend: Legend, tops: tuple[float, float]) -> None:
    """The names one below the other, between two heights, each beside its head on the height of its notes."""
    right, head_x = legend.width - _HEAD - _GAP, legend.width - _HEAD / 2
    heights = [height(PLACES[piece].step) for piece in legend.pieces]
    for piece, head_y, y in zip(legend.pieces, heights, spread(heights, _LINE, tops), strict=True):
        draw_list.text(piece_name(piece), (right, y + _DROP), _style(piece))
        if abs(head_y - y) > _LINE / 2:
            draw_list.line((right + 0.1, y), (head_x - 0.6, head_y), _RULE, INK_FAINT)
        note_shapes.draw_head(draw_list, PLACES[piece].head, (head_x, head_y), 1.0, colour=piece_colour(piece))


def spread(heights: Sequence[float], apart: float, within: tuple[float, float]) -> list[float]:
    """Heights in the same order, at least `apart`, as near to `heights` (ascending) as a sweep down and up finds.

    Those that have no room `within` two heights stand evenly between them.
    """
    low, high = within[0] + apart / 2, within[1] - apart / 2
    if len(heights) > 1 and apart * (len(heights) - 1) > high - low:
        return [low + (high - low) * k / (len(heights) - 1) for k in range(len(heights))]
    found = [min(max(y, low), high) for y in heights]
    for _ in heights:
        for k in range(len(found) - 1):
            lacking = apart - (found[k + 1] - found[k])
            if lacking > 0:
                found[k] -= lacking / 2
                found[k + 1] += lacking / 2
        if found and found[0] < low:
            found[0] = low
        if found and found[-1] > high:
            found[-1] = high
    for k in range(1, len(found)):
        found[k] = max(found[k], found[k - 1] + apart)
    return found


def _style(piece: Piece) -> TypeStyle:
    return TypeStyle(_LETTERS, piece_colour(piece), Face.BOLD, 1.0)
