"""The fixed shapes of drum notation: heads, hi-hat signs, time signature, clef, staff lines.

Units are staff spaces, y down, 0 on the staff's middle line. Proportions follow Gould, "Behind Bars" (2011).
"""

from dataclasses import replace

from station.music.tempo import MeterChange
from station.render.notation.staff import NoteHead
from station.render.palette import INK, INK_FAINT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

STAFF_LINE = 0.10
"""Thickness of a staff line."""
_HEAD_HALF = (0.66, 0.46)
_HEAD_TURN = -0.38
_RING = 0.18
"""How thick the line round a hollow head is (our choice)."""
_SIGNATURE, _GROUPS, _WIDEST = 2.75, 2.1, 8.0
"""The letters of a time signature fill two spaces; one with groups is set smaller, the smaller the more they are."""
_FIGURE = 0.711
"""How high a figure of the typeface is, in em."""
SIGNATURE_GAP = 0.8
"""What a time signature leaves free on either side at the least."""


def draw_head(
    draw_list: DrawList, head: NoteHead, at: tuple[float, float], scale: float, is_hollow: bool = False
) -> None:
    """One note head in the score's ink; round ones may be hollow, as those of half and whole notes are."""
    if head is NoteHead.ROUND and is_hollow:
        half = ((_HEAD_HALF[0] - _RING / 2) * scale, (_HEAD_HALF[1] - _RING / 2) * scale)
        draw_list.ellipse(at, half, INK, _HEAD_TURN, (0.0, _RING * scale, 0.0))
    elif head is NoteHead.ROUND:
        draw_list.ellipse(at, (_HEAD_HALF[0] * scale, _HEAD_HALF[1] * scale), INK, _HEAD_TURN)
    elif head in (NoteHead.CROSS, NoteHead.RINGED_CROSS):
        draw_list.cross(at, (0.48 * scale, 0.44 * scale), 0.22 * scale, INK)
        if head is NoteHead.RINGED_CROSS:
            draw_list.ellipse(at, (0.78 * scale, 0.78 * scale), INK, 0.0, (0.0, 0.13, 0.0))
    else:
        draw_list.sign("head_diamond" if head is NoteHead.DIAMOND else "head_triangle", at, INK, scale)


def draw_hat_sign(draw_list: DrawList, kind: str, at: tuple[float, float]) -> None:
    """o, half open, or + in the score's ink."""
    x, y = at
    if kind == "closed":
        draw_list.line((x - 0.45, y), (x + 0.45, y), 0.16, INK)
        draw_list.line((x, y - 0.45), (x, y + 0.45), 0.16, INK)
        return
    draw_list.ellipse(at, (0.40, 0.40), INK, 0.0, (0.0, 0.15, 0.0))
    if kind == "half":
        draw_list.line((x - 0.45, y + 0.6), (x + 0.45, y - 0.6), 0.13, INK)


def time_signature(draw_list: DrawList, meter: MeterChange, left: float) -> None:
    """The beats, in their groups where the meter has them, over their unit, from `left` on."""
    beats, _, unit = str(meter).partition("/")
    x, style = left + signature_width(draw_list, meter) / 2, _signature_style(draw_list, meter)
    for text, middle in ((beats, -1.04), (unit, 0.96)):
        draw_list.text(text, (x, middle + _FIGURE / 2 * style.size), style)


def signature_width(draw_list: DrawList, meter: MeterChange) -> float:
    """How wide the time signature of `meter` is."""
    style = _signature_style(draw_list, meter)
    return max(draw_list.width(text, style) for text in str(meter).split("/"))


def _signature_style(draw_list: DrawList, meter: MeterChange) -> TypeStyle:
    style = TypeStyle(_GROUPS if meter.groups else _SIGNATURE, INK, Face.BOLD, 0.5)
    widest = draw_list.width(str(meter).partition("/")[0], style)
    return replace(style, size=style.size * min(1.0, _WIDEST / widest))


CLEF_WIDTH = 1.35


def clef(draw_list: DrawList, x: float) -> None:
    """The percussion clef: two thick strokes across the middle of the staff, `CLEF_WIDTH` wide."""
    for left in (x, x + 0.85):
        draw_list.box((left, -1.0), (0.5, 2.0), INK)


def staff_lines(draw_list: DrawList, width: float) -> None:
    """The five lines from x = 0 to `width`."""
    for k in range(-2, 3):
        draw_list.box((0.0, k - STAFF_LINE / 2), (width, STAFF_LINE), INK_FAINT)
