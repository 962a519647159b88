"""Flat shapes and text as a table of instances: made here without OpenGL, drawn by `shape_renderer`.

Coordinates are units (pixels for panels, staff spaces for notation), x right, y **down**. `time_s` anchors a shape to a
moment of the score: the printer adds (time_s − position) · pixels a second, so that a scrolling score is laid out once.
A span makes it wider by its pixels, as beams and brackets need.
Every shape is a signed distance evaluated in the fragment shader, hence smooth at every size without multisampling.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.render.text.atlas import Atlas, Glyph
from station.render.text.fonts import Face

Colour = tuple[float, float, float, float]
"""Red, green, blue as on a screen (sRGB) and opacity, each 0–1."""

SHAPE_DTYPE = np.dtype(
    [
        ("centre", np.float32, 2),
        ("half", np.float32, 2),  # half extents before turning
        ("axis", np.float32, 2),  # cosine and sine of the turn, clockwise on the screen
        ("uv", np.float32, 4),
        ("style", np.float32, 3),  # corner radius, line width (0 fills), softness of the edge; all in units
        ("time_s", np.float32, 2),  # the anchor, and how much later its far end is anchored: wider by so much
        ("kind", np.float32),
        ("colour", np.uint8, 4),  # at the top
        ("colour_2", np.uint8, 4),  # at the bottom
    ]
)


class ShapeKind(IntEnum):
    """What the fragment shader evaluates."""

    BOX = 0
    ELLIPSE = 1
    GLYPH = 2
    TRIANGLE = 3  # points along the turned x axis
    CROSS = 4


@dataclass(frozen=True, slots=True)
class TypeStyle:
    """How a line of text looks: `size` of the em in units, `align` 0 left, 0.5 centred, 1 right.

    `halo` is the colour of a soft edge round the letters, for text over pictures.
    """

    size: float
    colour: Colour
    face: Face = Face.REGULAR
    align: float = 0.0
    halo: Colour | None = None


def _bytes(colour: Colour) -> tuple[int, int, int, int]:
    r, g, b, a = colour
    return round(r * 255), round(g * 255), round(b * 255), round(a * 255)


_LEVEL = (1.0, 0.0)
_PLAIN = (0.0, 0.0, 0.0)
_HALO = (0.0, 0.07, 0.045)
"""Width and softness of a halo in em; with the letters' own edge it stays within what the atlas knows."""
_NO_UV = (0.0, 0.0, 0.0, 0.0)


class DrawList:
    """Collects shapes in drawing order, each with the present anchor: `time_s`, and `span_s` that draws it out."""

    def __init__(self, atlas: Atlas) -> None:
        self.atlas = atlas
        self.time_s = self.span_s = 0.0
        self._rows: list[tuple[object, ...]] = []

    def shapes(self) -> NDArray[np.void]:
        """Everything so far, shape (n,), dtype `SHAPE_DTYPE`."""
        return np.array(self._rows, SHAPE_DTYPE)

    def __len__(self) -> int:
        return len(self._rows)

    # --- shapes -------------------------------------------------------------------------------------------------------

    def box(
        self,
        corner: tuple[float, float],
        size: tuple[float, float],
        colour: Colour,
        colour_2: Colour | None = None,
        style: tuple[float, float, float] = _PLAIN,
    ) -> None:
        """An upright box from its top left `corner`, shaded to `colour_2` at the bottom; see `style` in the dtype."""
        half = (size[0] / 2, size[1] / 2)
        centre = (corner[0] + half[0], corner[1] + half[1])
        top = _bytes(colour)
        bottom = top if colour_2 is None else _bytes(colour_2)
        self._rows.append((centre, half, _LEVEL, _NO_UV, style, (self.time_s, self.span_s), ShapeKind.BOX, top, bottom))

    def line(self, start: tuple[float, float], end: tuple[float, float], width: float, colour: Colour) -> None:
        """A straight line with square ends."""
        dx, dy = end[0] - start[0], end[1] - start[1]
        length = float(np.hypot(dx, dy)) or 1.0
        centre = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        self._add(ShapeKind.BOX, (centre, (length / 2, width / 2)), colour, axis=(dx / length, dy / length))

    def ellipse(
        self,
        centre: tuple[float, float],
        half: tuple[float, float],
        colour: Colour,
        turn_rad: float = 0.0,
        style: tuple[float, float, float] = _PLAIN,
    ) -> None:
        """An ellipse, turned clockwise by `turn_rad`."""
        axis = (float(np.cos(turn_rad)), float(np.sin(turn_rad)))
        self._add(ShapeKind.ELLIPSE, (centre, half), colour, axis, style)

    def triangle(
        self, centre: tuple[float, float], half: tuple[float, float], colour: Colour, turn_rad: float = 0.0
    ) -> None:
        """A triangle whose tip points right, turned clockwise by `turn_rad`."""
        axis = (float(np.cos(turn_rad)), float(np.sin(turn_rad)))
        self._add(ShapeKind.TRIANGLE, (centre, half), colour, axis)

    def cross(self, centre: tuple[float, float], half: tuple[float, float], width: float, colour: Colour) -> None:
        """The two diagonals of a box, `width` thick."""
        self._add(ShapeKind.CROSS, (centre, half), colour, style=(0.0, width, 0.0))

    def sign(
        self,
        name: str,
        origin: tuple[float, float],
        colour: Colour,
        scale: float = 1.0,
        mirrored: bool = False,
    ) -> None:
        """A musical sign of `outlines.SIGNS`, `scale` units a staff space; `mirrored` stands on its head."""
        self._glyph(self.atlas.sign(name), origin, scale, colour, _PLAIN, mirrored)

    # --- text ---------------------------------------------------------------------------------------------------------

    def text(self, text: str, origin: tuple[float, float], style: TypeStyle) -> float:
        """A line of text whose baseline passes `origin`; returns its width in units."""
        width = self.width(text, style)
        left = origin[0] - style.align * width
        if style.halo is not None:
            self._letters(text, (left, origin[1]), style, style.halo, _HALO)
        self._letters(text, (left, origin[1]), style, style.colour, _PLAIN)
        return width

    def _letters(
        self, text: str, origin: tuple[float, float], style: TypeStyle, colour: Colour, edge: tuple[float, float, float]
    ) -> None:
        x = origin[0]
        for character in text:
            glyph = self.atlas.letter(character, style.face)
            self._glyph(glyph, (x, origin[1]), style.size, colour, edge)
            x += glyph.advance * style.size

    def width(self, text: str, style: TypeStyle) -> float:
        """How long a line of text will be, in units."""
        return self.atlas.text_width(text, style.face) * style.size

    def fitted(self, text: str, style: TypeStyle, width: float) -> str:
        """`text`, or as much of it with an ellipsis as `width` units hold."""
        if self.width(text, style) <= width:
            return text
        while text and self.width(text + "…", style) > width:
            text = text[:-1]
        return text.rstrip() + "…" if text else ""

    def broken(self, text: str, style: TypeStyle, width: float) -> list[str]:
        """Text broken at blanks into lines of at most `width` units; a word that is longer ends in an ellipsis."""
        lines: list[str] = [""]
        for word in text.split():
            longer = f"{lines[-1]} {word}".strip()
            if lines[-1] and self.width(longer, style) > width:
                lines.append(word)
            else:
                lines[-1] = longer
        return [self.fitted(line, style, width) for line in lines]

    def paragraph(self, text: str, origin: tuple[float, float], style: TypeStyle, width: float) -> float:
        """Broken text from its first baseline down; returns the height that it took."""
        lines = self.broken(text, style, width)
        for i, line in enumerate(lines):
            self.text(line, (origin[0], origin[1] + i * LINE_HEIGHT * style.size), style)
        return len(lines) * LINE_HEIGHT * style.size

    def _glyph(
        self,
        glyph: Glyph,
        origin: tuple[float, float],
        scale: float,
        colour: Colour,
        edge: tuple[float, float, float],
        mirrored: bool = False,
    ) -> None:
        if not glyph.half[0]:
            return
        left, top, right, bottom = glyph.uv
        way = -1.0 if mirrored else 1.0
        centre = (origin[0] + glyph.centre[0] * scale, origin[1] - glyph.centre[1] * scale * way)
        uv = (left, bottom, right, top) if mirrored else (left, top, right, bottom)
        half = (glyph.half[0] * scale, glyph.half[1] * scale)
        style = (0.0, edge[1] * scale, edge[2] * scale)
        self._add(ShapeKind.GLYPH, (centre, half), colour, style=style, uv=uv)

    def _add(
        self,
        kind: ShapeKind,
        place: tuple[tuple[float, float], tuple[float, float]],
        colour: Colour,
        axis: tuple[float, float] = _LEVEL,
        style: tuple[float, float, float] = _PLAIN,
        uv: tuple[float, float, float, float] = _NO_UV,
    ) -> None:
        """A shape at `place` (centre, half extents)."""
        shade = _bytes(colour)
        self._rows.append((*place, axis, uv, style, (self.time_s, self.span_s), kind, shade, shade))


LINE_HEIGHT = 1.3
"""Distance of two baselines in em; our choice."""
