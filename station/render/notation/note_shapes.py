"""The signs of drum notation as they are drawn: heads, hi-hat signs, time signature, clef, staff lines, slurs.

Units are staff spaces, y down, 0 on the staff's middle line. Shapes and thicknesses are those of the music font
(`sign_outlines`).
"""

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

from station.music.tempo import MeterChange
from station.render.notation.head_places import HEAD_SIGNS
from station.render.notation.staff import NoteHead
from station.render.palette import INK, INK_FAINT
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.sign_outlines import SLUR_END, SLUR_MIDDLE, STAFF_LINE, sign_box

_HALF_HEADS: Mapping[NoteHead, str] = MappingProxyType(
    {
        NoteHead.ROUND: "head_half",
        NoteHead.CROSS: "head_half_cross",
        NoteHead.DIAMOND: "head_half_diamond",
        NoteHead.TRIANGLE: "head_half_triangle",
        NoteHead.RINGED_CROSS: "head_half_ringed_cross",
    }
)
"""Heads of half and of whole notes, where they differ from those of shorter ones."""
STEM_FROM: Mapping[NoteHead, tuple[float, float]] = MappingProxyType(
    {
        NoteHead.ROUND: (0.168, -0.168),
        NoteHead.SLASHED: (0.164, -0.172),
        NoteHead.CROSS: (0.444, -0.44),
        NoteHead.HEAVY_CROSS: (0.44, -0.436),
        NoteHead.ORNATE_CROSS: (0.316, -0.312),
        NoteHead.TRIANGLE: (0.5, 0.5),
    }
)
"""How far above a head's middle a stem that points up, and one that points down, begins; 0 for the others. Source:
Bravura's metadata, `stemUpSE` and `stemDownNW`."""
_FIGURES, _GROUPS, _WIDEST = 0.96, 0.75, 8.0
"""The font's 8 is a little higher than two spaces: figures so large do not touch each other. A time signature with
groups is set smaller, the smaller the more they are (our choice)."""
SIGNATURE_GAP = 0.8
"""What a time signature leaves free on either side at the least."""
_LETTER = TypeStyle(1.5, INK, Face.BOLD)
"""Capitals one space high, as the smallest figures of the staff are (our choice)."""
_SMALL_LETTER = replace(_LETTER, size=1.05)
"""As much smaller as grace notes are, a little more readable (our choice)."""
_SLUR_STEPS = 10
"""A slur is drawn in so many straight pieces: none leaves the curve by a hundredth of a space."""
_SLUR_OVERLAP = 0.2
"""Each goes on over its ends by so much of its length, which closes the wedges between them."""


def draw_head(
    draw_list: DrawList,
    head: NoteHead,
    at: tuple[float, float],
    scale: float,
    base: int = 4,
    colour: Colour = INK,
) -> None:
    """One note head with its middle at `at`, of a 1/`base` note."""
    name = "head_whole" if base == 1 and head is NoteHead.ROUND else HEAD_SIGNS[head]
    if base == 2:
        name = _HALF_HEADS.get(head, name)
    draw_list.sign(name, at, colour, scale)


def draw_brackets(draw_list: DrawList, xs: tuple[float, float], y: float, scale: float = 1.0) -> None:
    """The brackets of a ghost stroke, their middles at `xs`."""
    for name, x in zip(("bracket_left", "bracket_right"), xs, strict=True):
        draw_list.sign(name, (x, y), INK, scale)


def draw_letters(draw_list: DrawList, letters: str, at: tuple[float, float]) -> None:
    """Letters of the sticking round `at`, on its baseline; those of grace strokes, in lower case, as small capitals.

    A lower-case l of this typeface could be a capital i.
    """
    parts = [(letter.upper(), _LETTER if letter.isupper() else _SMALL_LETTER) for letter in letters]
    x = at[0] - sum(draw_list.width(letter, style) for letter, style in parts) / 2
    for letter, style in parts:
        x += draw_list.text(letter, (x, at[1]), style)


def draw_slur(draw_list: DrawList, ends: tuple[tuple[float, float], tuple[float, float]], bow: float) -> None:
    """A slur between two points, whose middle is `bow` lower (negative: higher) than they are."""
    (x0, y0), (x1, y1) = ends
    points = []
    for k in range(_SLUR_STEPS + 1):
        share = k / _SLUR_STEPS
        points.append((x0 + (x1 - x0) * share, y0 + (y1 - y0) * share + bow * 4 * share * (1 - share)))
    for k, ((ax, ay), (bx, by)) in enumerate(pairwise(points)):
        share = (k + 0.5) / _SLUR_STEPS
        width = SLUR_END + (SLUR_MIDDLE - SLUR_END) * 4 * share * (1 - share)
        over_x, over_y = (bx - ax) * _SLUR_OVERLAP, (by - ay) * _SLUR_OVERLAP
        draw_list.line((ax - over_x, ay - over_y), (bx + over_x, by + over_y), width, INK)


def time_signature(draw_list: DrawList, meter: MeterChange, left: float) -> None:
    """The beats, in their groups where the meter has them, over their unit, from `left` on."""
    beats, _, unit = str(meter).partition("/")
    width, scale = signature_width(meter), _signature_scale(meter)
    for text, middle in ((beats, -1.0), (unit, 1.0)):
        draw_figures(draw_list, text, (left + (width - figures_width(text) * scale) / 2, middle), INK, scale)


def signature_width(meter: MeterChange) -> float:
    """How wide the time signature of `meter` is."""
    return max(figures_width(text) for text in str(meter).split("/")) * _signature_scale(meter)


def _signature_scale(meter: MeterChange) -> float:
    scale = _GROUPS if meter.groups else _FIGURES
    return min(scale, _WIDEST / figures_width(str(meter).partition("/")[0]))


def draw_figures(
    draw_list: DrawList, text: str, left: tuple[float, float], colour: Colour, scale: float = 1.0, kind: str = "meter"
) -> None:
    """A row of figures (and +) of a `kind`, meter or tuplet, from `left` on."""
    x, y = left
    for name in _figures(text, kind):
        draw_list.sign(name, (x, y), colour, scale)
        x += sign_box(name).advance * scale


def figures_width(text: str, kind: str = "meter") -> float:
    """How wide a row of such figures is."""
    return sum(sign_box(name).advance for name in _figures(text, kind))


def _figures(text: str, kind: str) -> list[str]:
    return [f"{kind}_plus" if character == "+" else f"{kind}_{character}" for character in text if character != " "]


CLEF_WIDTH = sign_box("clef").width


def clef(draw_list: DrawList, x: float) -> None:
    """The percussion clef from `x` on, `CLEF_WIDTH` wide."""
    draw_list.sign("clef", (x, 0.0), INK)


def staff_lines(draw_list: DrawList, width: float) -> None:
    """The five lines from x = 0 to `width`."""
    for k in range(-2, 3):
        draw_list.box((0.0, k - STAFF_LINE / 2), (width, STAFF_LINE), INK_FAINT)
