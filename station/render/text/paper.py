"""What `DrawList` collects as polygons on paper: outlines in points (1/72 inch), y down, for a printer of any fineness.

Where the screen's printer moves a shape by its time, paper asks a ruler where that time stands in the line. Ink on
paper is black; what is soft on the screen is grey, dark enough to be read on a music stand.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.render.text.atlas import Atlas, Glyph
from station.render.text.draw_list import ShapeKind
from station.render.text.truetype import Contours

Points = NDArray[np.float64]
"""A closed polygon, shape (n, 2)."""

_ROUND = 40
"""Corners of an ellipse; our choice: a note head's then leave the curve by a thousandth of a millimetre."""
_SOFTEST = 0.5
"""How dark the faintest ink is (our choice: staff lines that a weak lamp shows)."""


@dataclass(frozen=True, slots=True, eq=False)
class Filled:
    """An area: `contours` fill by the non-zero rule; `grey` 0 is black."""

    contours: tuple[Points, ...]
    grey: float


class OutlineAtlas(Atlas):
    """The letters and signs without a texture: a glyph's `uv` says which outline is meant, (number, 0, number, 1)."""

    def __init__(self) -> None:
        self._outlines: list[tuple[Contours, Glyph]] = []
        super().__init__()

    def outline(self, number: int) -> tuple[Contours, Glyph]:
        """An outline by its number, and its glyph."""
        return self._outlines[number]

    def _baked(self, contours: Contours, density: int, advance: float) -> Glyph:
        del density
        low = high = np.zeros(2)
        if contours:
            points = np.concatenate(contours)
            low, high = points.min(axis=0), points.max(axis=0)
        (x, y), (wide, high_y) = (low + high) / 2, (high - low) / 2
        number = len(self._outlines)
        glyph = Glyph((number, 0, number, 1), (float(x), float(y)), (float(wide), float(high_y)), advance)
        self._outlines.append((contours, glyph))
        return glyph


@dataclass(frozen=True, slots=True)
class PaperSpot:
    """Where ink goes: its `origin` in points, points a `unit`; how many units right of it the `ruler` puts a time."""

    origin: tuple[float, float]
    unit: float
    ruler: Callable[[float], float] = lambda _: 0.0


def filled(shapes: NDArray[np.void], atlas: OutlineAtlas, spot: PaperSpot) -> Iterator[Filled]:
    """The areas of `shapes`, in order."""
    for row in shapes:
        contours = _contours(row, atlas, spot)
        if contours:
            place = np.array(spot.origin)
            grey = grey_of(int(row["colour"][3]) / 255)
            yield Filled(tuple(place + contour * spot.unit for contour in contours), grey)


def grey_of(opacity: float) -> float:
    """How light ink of an opacity is on paper, 0 black."""
    return (1 - _SOFTEST) * (1 - opacity)


def _contours(row: np.void, atlas: OutlineAtlas, spot: PaperSpot) -> list[Points]:
    """A shape's outlines in units from the spot, y down."""
    begin_s, span_s = (float(t) for t in row["time_s"])
    half, width = row["half"].astype(float), float(row["style"][1])
    centre = row["centre"] + np.array([spot.ruler(begin_s), 0.0])
    more = (spot.ruler(begin_s + span_s) - spot.ruler(begin_s)) / 2 if span_s else 0.0
    wider = np.array([more, 0.0])
    centre, half = centre + wider, half + wider
    kind = ShapeKind(int(row["kind"]))
    if kind is ShapeKind.GLYPH:
        return _glyph(row, centre, atlas)
    if kind is ShapeKind.ELLIPSE:
        outer = _turned(_ellipse(half + width / 2), row, centre)
        return [outer, _turned(_ellipse(half - width / 2)[::-1], row, centre)] if width else [outer]
    if kind is ShapeKind.CROSS:
        return [_bar(centre - half * (1, way), centre + half * (1, way), width) for way in (1, -1)]
    corners = [(1, 0), (-1, 1), (-1, -1)] if kind is ShapeKind.TRIANGLE else [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    return [_turned(np.array(corners) * half, row, centre)]


def _glyph(row: np.void, centre: Points, atlas: OutlineAtlas) -> list[Points]:
    uv = row["uv"]
    contours, glyph = atlas.outline(round(float(uv[0])))
    scale, up = float(row["half"][1]) / glyph.half[1], -1.0 if uv[1] < uv[3] else 1.0
    return [(contour - glyph.centre) * (scale, up * scale) + centre for contour in contours]


def _ellipse(half: Points) -> Points:
    turn = np.linspace(0, 2 * np.pi, _ROUND, endpoint=False)
    return np.column_stack([half[0] * np.cos(turn), half[1] * np.sin(turn)])


def _turned(points: Points, row: np.void, centre: Points) -> Points:
    cosine, sine = (float(v) for v in row["axis"])
    turned: Points = points @ np.array([[cosine, sine], [-sine, cosine]]) + centre
    return turned


def _bar(start: Points, end: Points, width: float) -> Points:
    """A thick straight stroke."""
    along = (end - start) / np.hypot(*(end - start))
    aside = np.array([-along[1], along[0]]) * width / 2
    return np.array([start + aside, end + aside, end - aside, start - aside])
