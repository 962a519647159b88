"""Bar lines, repeat signs, and the brackets over first and second endings. Units are staff spaces, y down.

Proportions follow SMuFL's engraving defaults for Bravura (thin line 0.16, thick 0.5, 0.4 between them), set a little
closer so that a repeat's two signs fit between the notes of a score that scrolls.
"""

from dataclasses import dataclass
from enum import IntEnum

from station.render.palette import INK
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

THIN, _THICK, _GAP = 0.16, 0.45, 0.27
_DOT_GAP, _DOT = 0.45, 0.19
_DOT_YS = (-0.5, 0.5)
REPEAT_WIDTH = _THICK + _GAP + THIN + _DOT_GAP + _DOT
"""What a repeat sign takes on its side of the line."""
_SLIM, _SLIM_DOT_X, _SLIM_DOT = 0.34, 0.47, 0.16
"""Within two thirds of a space on either side, where a bar line has a head to its right (our choice)."""
_VOLTA_HOOK, _VOLTA_LINE = 1.5, 0.13
_VOLTA_TEXT = TypeStyle(1.4, INK, Face.BOLD)


class BarLine(IntEnum):
    """What stands between two bars, or at an end; a repeat's end may meet a repeat's start."""

    PLAIN = 0
    DOUBLE = 1
    FINAL = 2
    REPEAT_START = 3
    REPEAT_END = 4
    REPEAT_BOTH = 5


def draw_bar_line(draw_list: DrawList, x: float, line: BarLine, colour: Colour = INK) -> None:
    """The bar line where one bar ends, or begins, at `x`."""
    if line is BarLine.PLAIN:
        _upright(draw_list, x, THIN, colour)
    elif line is BarLine.DOUBLE:
        _upright(draw_list, x - _GAP - THIN, THIN, colour)
        _upright(draw_list, x, THIN, colour)
    elif line is BarLine.FINAL:
        _sign(draw_list, x, -1, colour, has_dots=False)
    if line in (BarLine.REPEAT_END, BarLine.REPEAT_BOTH):
        _sign(draw_list, x, -1, colour)
    if line in (BarLine.REPEAT_START, BarLine.REPEAT_BOTH):
        _sign(draw_list, x, 1, colour)


def line_width(line: BarLine) -> float:
    """What a bar line takes to the left of its place beyond what a plain one does."""
    if line in (BarLine.REPEAT_END, BarLine.REPEAT_BOTH):
        return REPEAT_WIDTH
    if line is BarLine.FINAL:
        return _THICK + _GAP + THIN
    return _GAP + THIN if line is BarLine.DOUBLE else 0.0


def _upright(draw_list: DrawList, x: float, width: float, colour: Colour) -> None:
    draw_list.line((x, -2.0), (x, 2.0), width, colour)


def _sign(draw_list: DrawList, x: float, way: int, colour: Colour, has_dots: bool = True) -> None:
    """A thick line that ends at `x`, a thin one beside it on its right (1) or left (−1), then two dots."""
    _upright(draw_list, x + way * _THICK / 2, _THICK, colour)
    _upright(draw_list, x + way * (_THICK + _GAP + THIN / 2), THIN, colour)
    if has_dots:
        for y in _DOT_YS:
            draw_list.ellipse((x + way * (REPEAT_WIDTH - _DOT), y), (_DOT, _DOT), colour)


def draw_slim_line(draw_list: DrawList, x: float, line: BarLine, colour: Colour) -> None:
    """A bar line where time leaves no room: of a repeat sign the thick line, slimmer, and its dots, close to it."""
    if line in (BarLine.PLAIN, BarLine.DOUBLE, BarLine.FINAL):
        draw_bar_line(draw_list, x, line, colour)
        return
    _upright(draw_list, x, _SLIM, colour)
    ways = {BarLine.REPEAT_START: (1,), BarLine.REPEAT_END: (-1,), BarLine.REPEAT_BOTH: (1, -1)}[line]
    for way in ways:
        for y in _DOT_YS:
            draw_list.ellipse((x + way * _SLIM_DOT_X, y), (_SLIM_DOT, _SLIM_DOT), colour)


@dataclass(frozen=True, slots=True)
class Volta:
    """The bracket over a bar of an ending: its `text`, such as "1.", where it opens, else empty.

    `closes`: a hook ends it with the bar; the last ending stays open, for the music goes on.
    """

    text: str
    opens: bool
    closes: bool


def draw_volta(draw_list: DrawList, ends_x: tuple[float, float], y: float, volta: Volta, colour: Colour = INK) -> None:
    """The bracket of one bar from one x to another, its line at `y`; the draw list's span makes it longer."""
    left, right = ends_x
    span_s, draw_list_s = draw_list.span_s, draw_list.time_s
    draw_list.box((left, y - _VOLTA_LINE / 2), (right - left, _VOLTA_LINE), colour)
    draw_list.span_s = 0.0
    if volta.opens:
        draw_list.line((left, y), (left, y + _VOLTA_HOOK), _VOLTA_LINE, colour)
        draw_list.text(volta.text, (left + 0.5, y + _VOLTA_HOOK), _VOLTA_TEXT)
    if volta.closes:
        draw_list.time_s = draw_list_s + span_s
        draw_list.line((right, y), (right, y + _VOLTA_HOOK), _VOLTA_LINE, colour)
    draw_list.time_s, draw_list.span_s = draw_list_s, span_s
