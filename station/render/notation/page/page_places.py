"""Which moment and which line or space of the staff a place on a page is, and where on the page those are.

Units are staff spaces, x from the left end of the staves, y down from the page's upper edge.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.render.notation.staff import MIDDLE_LINE, PLACES, height

Floats = NDArray[np.float64]

_HEAD_REACH = (0.85, 0.5)
"""So far beside a head's middle, and above and below it, a place is still on it: a head is 1.2 spaces wide, and the
next step of the staff is half a space away (our choice)."""
_STEPS = (min(place.step for place in PLACES.values()), max(place.step for place in PLACES.values()))


@dataclass(frozen=True, slots=True, eq=False)
class BarPlace:
    """Bar number `bar` of the score from `left` to `right`.

    `ticks` (k,) from the bar's start, growing, stand at `xs` (k,); the last is the bar's end.
    """

    bar: int
    left: float
    right: float
    ticks: NDArray[np.int64]
    xs: Floats

    def x_at(self, tick: float) -> float:
        """Where a tick of the bar stands."""
        return float(np.interp(tick, self.ticks, self.xs))

    def tick_at(self, x: float) -> float:
        """The tick of the bar that stands at `x`; its first one before its first note."""
        return float(np.interp(x, self.xs, self.ticks))


@dataclass(frozen=True, slots=True)
class PageHead:
    """A head: its stroke's tick in the score and its piece, in `bar`, its middle on the page."""

    tick: int
    piece: Piece
    bar: int
    x: float
    y: float


@dataclass(frozen=True, slots=True, eq=False)
class LinePlace:
    """A line of the page: its staff's middle line, how far it reaches (`top` to `bottom`), its bars and heads."""

    middle_y: float
    top: float
    bottom: float
    bars: tuple[BarPlace, ...]
    heads: tuple[PageHead, ...]

    def bar_at(self, x: float) -> BarPlace | None:
        """The bar at `x`; clef and meter belong to the first one, nothing beyond the last."""
        return next((bar for bar in self.bars if bar.left <= x <= bar.right), None)

    def step_at(self, y: float) -> int:
        """The nearest line or space of the staff that a piece stands on; steps as in `staff`."""
        step = round(MIDDLE_LINE - 2 * (y - self.middle_y))
        return min(max(step, _STEPS[0]), _STEPS[1])

    def y_of(self, step: int) -> float:
        """Where a line or space of the staff lies."""
        return self.middle_y + height(step)

    def head_at(self, x: float, y: float) -> PageHead | None:
        """The head at a place, the nearest of several."""
        across, upright = _HEAD_REACH
        near = [h for h in self.heads if abs(h.x - x) <= across and abs(h.y - y) <= upright]
        return min(near, key=lambda h: ((h.x - x) / across) ** 2 + ((h.y - y) / upright) ** 2, default=None)


@dataclass(frozen=True, slots=True, eq=False)
class PagePlaces:
    """Every line of a page from its top down; together they cover it."""

    lines: tuple[LinePlace, ...]

    def line_at(self, y: float) -> LinePlace | None:
        """The line that `y` belongs to, the nearest one between two; None on an empty page."""
        return min(self.lines, key=lambda line: max(line.top - y, y - line.bottom), default=None)

    def bar(self, number: int) -> tuple[LinePlace, BarPlace] | None:
        """Where a bar of the score stands."""
        return next(self._bars(number), None)

    def _bars(self, number: int) -> Iterator[tuple[LinePlace, BarPlace]]:
        return ((line, bar) for line in self.lines for bar in line.bars if bar.bar == number)


def pieces_on(step: int, known: Sequence[Piece] = ()) -> tuple[Piece, ...]:
    """The pieces that stand on a line or space, those that are `known` in this music first."""
    there = [piece for piece, place in PLACES.items() if place.step == step]
    return tuple(sorted(there, key=lambda piece: piece not in known))
