"""What `DrawList` collects as areas on paper, in points (1/72 inch), y down, for a printer of any fineness.

Where the screen's printer moves a shape by its time, paper asks a ruler where that time stands in the line. Ink on
paper is black; what is soft on the screen is grey, dark enough to be read on a music stand. A sheet has many areas of
few forms, so an area is an outline's number and the matrix that puts it in its place.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.render.text.atlas import Atlas, Glyph
from station.render.text.draw_list import ShapeKind
from station.render.text.truetype import Contours

Points = NDArray[np.float64]
"""A closed polygon, shape (n, 2)."""
Floats = NDArray[np.float64]

_ROUND = 40
"""Corners of an ellipse; our choice: a note head's then leave the curve by a thousandth of a millimetre."""
_SOFTEST = 0.5
"""How dark the faintest ink is (our choice: staff lines that a weak lamp shows)."""
_TURN = np.linspace(0, 2 * np.pi, _ROUND, endpoint=False)
_DISC = np.column_stack([np.cos(_TURN), np.sin(_TURN)])
_SQUARE = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
_ARROW = np.array([(1.0, 0.0), (-1.0, 1.0), (-1.0, -1.0)])
SQUARE, DISC, _ARROW_NUMBER = range(3)
"""The outlines that every atlas begins with: two units wide and high, round (0, 0)."""


@dataclass(frozen=True, slots=True, eq=False)
class Filled:
    """An area: `contours` fill by the non-zero rule; `grey` 0 is black."""

    contours: tuple[Points, ...]
    grey: float


@dataclass(frozen=True, slots=True, eq=False)
class Ink:
    """Areas in order, n of them: the `numbers` (n,) of their `outlines`, `matrices` (n, 6), `rgba` (n, 4) 0–255.

    A matrix (a, b, c, d, e, f) puts the outline's point (x, y) at (ax + cy + e, bx + dy + f), as in PDF. Colours are
    the night's, as shapes have them; black ink has the `greys` that their opacity asks for.
    """

    outlines: Sequence[tuple[Points, ...]]
    numbers: NDArray[np.int64]
    matrices: Floats
    rgba: NDArray[np.uint8]

    def __len__(self) -> int:
        return len(self.numbers)

    @property
    def greys(self) -> Floats:
        """How light each area is where all ink is black, shape (n,), 0 black."""
        return grey_of(self.rgba[:, 3] / 255)

    def __iter__(self) -> Iterator[Filled]:
        for number, matrix, grey in zip(self.numbers.tolist(), self.matrices, self.greys.tolist(), strict=True):
            turn, place = matrix[:4].reshape(2, 2), matrix[4:]
            yield Filled(tuple(contour @ turn + place for contour in self.outlines[number]), grey)

    def moved(self, down: float) -> "Ink":
        """The same areas so many points farther down."""
        return Ink(self.outlines, self.numbers, self.matrices + np.array([0, 0, 0, 0, 0, down]), self.rgba)

    @staticmethod
    def joined(parts: Sequence["Ink"]) -> "Ink":
        """All areas of `parts`, which are of one atlas; at least one part."""
        return Ink(
            parts[0].outlines,
            np.concatenate([part.numbers for part in parts]),
            np.concatenate([part.matrices for part in parts]),
            np.concatenate([part.rgba for part in parts]),
        )


class OutlineAtlas(Atlas):
    """The letters and signs without a texture: a glyph's `uv` says which outline is meant, (number, 0, number, 1)."""

    def __init__(self) -> None:
        self.outlines: list[tuple[Points, ...]] = [(_SQUARE,), (_DISC,), (_ARROW,)]
        """All outlines by their numbers; those of letters and signs lie round their glyphs' centres, y up."""
        self._upright: list[float] = [1.0] * len(self.outlines)
        self._drawn: dict[tuple[int, float, float, float], int] = {}
        super().__init__()

    def half_heights(self, numbers: NDArray[np.int64]) -> Floats:
        """Half of how high outlines are, shape (n,)."""
        return np.array(self._upright)[numbers]

    def twin(self, number: int, atlas: Atlas) -> tuple[Glyph, Glyph]:
        """The glyph here whose outline has this number, and the same letter or sign in another atlas."""
        for name, glyph in self._signs.items():
            if glyph.uv[0] == number:
                return glyph, atlas.sign(name)
        (character, face), glyph = next(item for item in self._letters.items() if item[1].uv[0] == number)
        return glyph, atlas.letter(character, face)

    def drawn(self, kind: ShapeKind, half: tuple[float, float], width: float) -> int:
        """The outline of a ring or a cross, whose line does not grow with it."""
        key = (int(kind), round(half[0], 4), round(half[1], 4), round(width, 4))
        if key not in self._drawn:
            self._drawn[key] = self._add((_ring if kind is ShapeKind.ELLIPSE else _cross)(np.array(half), width), 1.0)
        return self._drawn[key]

    def _add(self, contours: tuple[Points, ...], upright: float) -> int:
        self.outlines.append(contours)
        self._upright.append(upright)
        return len(self.outlines) - 1

    def _baked(self, contours: Contours, density: int, advance: float) -> Glyph:
        del density
        low = high = np.zeros(2)
        if contours:
            points = np.concatenate(contours)
            low, high = points.min(axis=0), points.max(axis=0)
        centre, half = (low + high) / 2, (high - low) / 2
        number = self._add(tuple(contour - centre for contour in contours), float(half[1]))
        at = (float(centre[0]), float(centre[1]))
        return Glyph((number, 0, number, 1), at, (float(half[0]), float(half[1])), advance)


def _ring(half: Floats, width: float) -> tuple[Points, ...]:
    return _DISC * (half + width / 2), (_DISC * (half - width / 2))[::-1]


def _cross(half: Floats, width: float) -> tuple[Points, ...]:
    return tuple(_stroke(-half * (1, way), half * (1, way), width) for way in (1, -1))


def _stroke(start: Points, end: Points, width: float) -> Points:
    """A thick straight stroke."""
    along = (end - start) / np.hypot(*(end - start))
    aside = np.array([-along[1], along[0]]) * width / 2
    return np.array([start + aside, end + aside, end - aside, start - aside])


@dataclass(frozen=True, slots=True)
class PaperSpot:
    """Where ink goes: its `origin` in points, points a `unit`; how many units right of it the `ruler` puts times."""

    origin: tuple[float, float]
    unit: float
    ruler: Callable[[Floats], Floats] = np.zeros_like


def placed(shapes: NDArray[np.void], ruler: Callable[[Floats], Floats]) -> NDArray[np.void]:
    """The shapes where a ruler puts their times, as wide as it makes them; time moves them no more."""
    begin_s, span_s = shapes["time_s"].astype(np.float64).T
    starts, more = ruler(begin_s), np.zeros(len(shapes))
    wide = span_s != 0
    more[wide] = (ruler(begin_s[wide] + span_s[wide]) - starts[wide]) / 2
    found = shapes.copy()
    found["centre"][:, 0] += starts + more
    found["half"][:, 0] += more
    found["time_s"] = 0.0
    return found


def filled(shapes: NDArray[np.void], atlas: OutlineAtlas, spot: PaperSpot) -> Ink:
    """The areas of `shapes`, in order, their times where the spot's ruler puts them."""
    shapes = placed(shapes, spot.ruler) if shapes["time_s"].any() else shapes
    centre, half, axis = (shapes[name].astype(np.float64) for name in ("centre", "half", "axis"))
    numbers, scale = _outlines(shapes, half, atlas)
    cosine, sine = axis.T
    across, upright = scale.T * spot.unit
    place = np.array(spot.origin) + centre * spot.unit
    matrices = np.column_stack([cosine * across, sine * across, -sine * upright, cosine * upright, place])
    seen = np.array([len(contours) > 0 for contours in atlas.outlines])[numbers]
    return Ink(atlas.outlines, numbers[seen], matrices[seen], shapes["colour"][seen])


def grey_of(opacity: Floats) -> Floats:
    """How light ink of an opacity is on paper, 0 black."""
    return (1 - _SOFTEST) * (1 - opacity)


def _outlines(shapes: NDArray[np.void], half: Floats, atlas: OutlineAtlas) -> tuple[NDArray[np.int64], Floats]:
    """The number of each shape's outline, and how much larger the shape is across and upright, shape (n, 2)."""
    kind, width, scale = shapes["kind"].astype(np.int64), shapes["style"][:, 1], half.copy()
    numbers = np.full(len(shapes), SQUARE)
    numbers[kind == ShapeKind.ELLIPSE] = DISC
    numbers[kind == ShapeKind.TRIANGLE] = _ARROW_NUMBER
    glyphs = kind == ShapeKind.GLYPH
    uv = shapes["uv"][glyphs]
    numbers[glyphs] = np.rint(uv[:, 0])
    size = half[glyphs, 1] / np.maximum(atlas.half_heights(numbers[glyphs]), 1e-9)
    scale[glyphs] = np.column_stack([size, np.where(uv[:, 1] < uv[:, 3], -size, size)])
    for i in np.flatnonzero((kind == ShapeKind.CROSS) | ((kind == ShapeKind.ELLIPSE) & (width > 0))):
        numbers[i] = atlas.drawn(ShapeKind(int(kind[i])), (float(half[i, 0]), float(half[i, 1])), float(width[i]))
        scale[i] = 1.0
    return numbers, scale
