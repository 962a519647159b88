"""The free strip: strokes as they were played, on the staff's lines, with the click's bars; nothing is judged.

Units are staff spaces, y down, 0 on the staff's middle line; shapes are anchored in time as the score's are.
"""

from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.render.notation import note_shapes
from station.render.notation.staff import PLACES, head_of, height, ledger_steps
from station.render.palette import BRAND, INK, INK_FAINT, with_opacity
from station.render.snapshot import Strip
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList
from station.render.text.sign_outlines import LEDGER_LINE

_LEAST, _MOST = 0.72, 1.18
"""Size of the head of the softest and of the hardest stroke (our choice: ghost and accent differ at a glance)."""


def strip_paper(atlas: Atlas, width: float, upright: tuple[float, float]) -> NDArray[np.void]:
    """The staff's lines and the line where now is, in the middle of `width`; `upright` is its top and its length."""
    draw_list = DrawList(atlas)
    note_shapes.staff_lines(draw_list, width)
    draw_list.box((width / 2 - 0.14, upright[0]), (0.28, upright[1]), with_opacity(BRAND, 0.95))
    return draw_list.shapes()


def strip_shapes(strip: Strip, window_s: tuple[float, float], atlas: Atlas) -> NDArray[np.void]:
    """Bars, beats and strokes between two times."""
    draw_list = DrawList(atlas)
    if strip.beat_s is not None:
        _beats(draw_list, strip.beat_s, strip.beats, window_s)
    hits = strip.played.hits
    first, last = np.searchsorted(hits["at_ns"], [round(1e9 * time_s) for time_s in window_s]).tolist()
    for hit in hits[first:last]:
        draw_list.time_s = float(hit["at_ns"]) / 1e9
        _stroke(draw_list, hit)
    return draw_list.shapes()


def _beats(draw_list: DrawList, beat_s: float, beats: int, window_s: tuple[float, float]) -> None:
    for beat in range(max(ceil(window_s[0] / beat_s), 0), floor(window_s[1] / beat_s) + 1):
        draw_list.time_s = beat * beat_s
        if beat % beats == 0:
            draw_list.box((-0.08, -2.0), (0.16, 4.0), INK_FAINT)
        else:
            draw_list.box((-0.05, -2.0), (0.10, 4.0), with_opacity(INK, 0.09))


def _stroke(draw_list: DrawList, hit: np.void) -> None:
    piece = Piece(int(hit["piece"]))
    for step in ledger_steps(PLACES[piece].step):
        draw_list.box((-1.0, height(step) - LEDGER_LINE / 2), (2.0, LEDGER_LINE), INK_FAINT)
    scale = _LEAST + (_MOST - _LEAST) * int(hit["velocity"]) / 127
    head = head_of(piece, Zone(int(hit["zone"])), Articulation(int(hit["articulation"])))
    note_shapes.draw_head(draw_list, head, (0.0, height(PLACES[piece].step)), scale)
