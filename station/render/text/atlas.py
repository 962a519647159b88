"""One texture that holds every letter and musical sign as a signed distance field, each made when first needed.

A texel tells how far its centre is from the outline, in texels, positive inside, clipped at `SPREAD`; the shader turns
that into clean edges at every size. Source: Green, "Improved Alpha-Tested Magnification for Vector Textures and
Special Effects", SIGGRAPH 2007.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.render.text import sign_outlines
from station.render.text.fonts import Face, font
from station.render.text.truetype import Contours

ATLAS_SIZE = 1024
SPREAD = 5
"""Texels on each side of an outline that know their distance; our choice, wide enough for letters at half size."""
_TEXELS_PER_EM = 44
_TEXELS_PER_SPACE = 22
_TALLEST = 138
"""No sign takes more texels in height; two shelves of it are kept free for the musical signs."""
_UNKNOWN = "?"


@dataclass(frozen=True, slots=True)
class Glyph:
    """Where a sign lies in the atlas (`uv` left, top, right, bottom, 0–1) and what it covers.

    `centre` and `half` (x, y; y up) are the box in em or staff spaces from the origin, `advance` the step to the next.
    A blank has `half` (0, 0).
    """

    uv: tuple[float, float, float, float]
    centre: tuple[float, float]
    half: tuple[float, float]
    advance: float


class Atlas:
    """Signs by name, packed into shelves. `pixels` (size, size) uint8 is the texture, `version` grows as it fills."""

    def __init__(self) -> None:
        self.pixels: NDArray[np.uint8] = np.zeros((ATLAS_SIZE, ATLAS_SIZE), np.uint8)
        self.version = 0
        self._letters: dict[tuple[str, Face], Glyph] = {}
        self._signs: dict[str, Glyph] = {}
        self._x = self._y = self._shelf = 0
        self._full = False
        for face in Face:
            self.letter(_UNKNOWN, face)

    def letter(self, character: str, face: Face) -> Glyph:
        """The glyph of `character`, in em."""
        found = self._letters.get((character, face))
        if found is None:
            found = self._letters[character, face] = self._new_letter(character, face)
        return found

    def _new_letter(self, character: str, face: Face) -> Glyph:
        """Letters that the font lacks, or that came after the texture was full, share one sign."""
        if character != _UNKNOWN and (self._full or not font(face).has(character)):
            return self.letter(_UNKNOWN, face)
        outline = font(face).outline(character)
        return self._baked(outline.contours, _TEXELS_PER_EM, outline.advance)

    def sign(self, name: str) -> Glyph:
        """The glyph of the musical sign `name`, in staff spaces."""
        found = self._signs.get(name)
        if found is None:
            found = self._signs[name] = self._baked(sign_outlines.sign(name), _TEXELS_PER_SPACE, 0.0)
        return found

    def text_width(self, text: str, face: Face) -> float:
        """The length of a line of text in em."""
        return sum(self.letter(c, face).advance for c in text)

    def _baked(self, contours: Contours, density: int, advance: float) -> Glyph:
        if not contours:
            return Glyph((0, 0, 0, 0), (0, 0), (0, 0), advance)
        points = np.concatenate(contours) * density
        low = np.floor(points.min(axis=0)) - SPREAD
        size = np.ceil(points.max(axis=0)).astype(int) + SPREAD - low.astype(int)
        field = distance_field([c * density - low for c in contours], int(size[0]), int(size[1]))
        x, y = self._place(int(size[0]), int(size[1]))
        texels = np.clip(np.rint(127.5 * (1 + field / SPREAD)), 0, 255).astype(np.uint8)
        self.pixels[y : y + size[1], x : x + size[0]] = texels[::-1]
        self.version += 1
        uv = (x / ATLAS_SIZE, y / ATLAS_SIZE, (x + size[0]) / ATLAS_SIZE, (y + size[1]) / ATLAS_SIZE)
        centre, half = (low + size / 2) / density, size / 2 / density
        return Glyph(uv, (float(centre[0]), float(centre[1])), (float(half[0]), float(half[1])), advance)

    def _place(self, width: int, height: int) -> tuple[int, int]:
        """The top left corner of a free box."""
        if self._x + width > ATLAS_SIZE:
            self._x, self._y, self._shelf = 0, self._y + self._shelf, 0
        place = self._x, self._y
        self._x, self._shelf = self._x + width, max(self._shelf, height)
        self._full = self._y + 2 * _TALLEST > ATLAS_SIZE
        return place


def distance_field(contours: list[NDArray[np.float64]], width: int, height: int) -> NDArray[np.float32]:
    """Signed distance (height, width) of each texel's centre to polygons in texels, y up, positive inside."""
    a = np.concatenate(contours).astype(np.float32)
    b = np.concatenate([np.roll(c, -1, axis=0) for c in contours]).astype(np.float32)
    x = np.arange(width, dtype=np.float32)[:, None] + np.float32(0.5)
    y = np.arange(height, dtype=np.float32)[:, None, None] + np.float32(0.5)
    to_x, to_y, edge = x - a[:, 0], y - a[:, 1], b - a
    length = np.maximum(np.sum(edge**2, axis=1), np.float32(1e-9))
    along = np.clip((to_x * edge[:, 0] + to_y * edge[:, 1]) / length, 0, 1)
    nearest = ((to_x - along * edge[:, 0]) ** 2 + (to_y - along * edge[:, 1]) ** 2).min(axis=2)
    inside = _winding(to_x, y[:, :, 0], a, b) != 0
    return np.asarray(np.where(inside, np.sqrt(nearest), -np.sqrt(nearest)), np.float32)


def _winding(
    to_x: NDArray[np.float32], y: NDArray[np.float32], a: NDArray[np.float32], b: NDArray[np.float32]
) -> NDArray[np.int32]:
    """How often the polygons run round each point: edges crossed to its right, upward less downward."""
    way = (a[:, 1] <= y).astype(np.int32) - (b[:, 1] <= y).astype(np.int32)  # (height, edges)
    rows, edges = np.nonzero(way)
    (ax, ay), (bx, by) = a[edges].T, b[edges].T
    crossing = (bx - ax) * (y[rows, 0] - ay) / (by - ay)  # where the edge meets the row, from a
    total = np.zeros((len(y), len(to_x)), np.int32)
    np.add.at(total, rows, (crossing[:, None] > to_x[:, edges].T) * way[rows, edges][:, None])
    return total
