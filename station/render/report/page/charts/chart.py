"""What a chart is, and what all of them share: letters, an axis of milliseconds, rows with a mean and its interval.

Units are those of the chart, about a pixel on a screen; x right, y down. Early is left and late is right everywhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.render.palette import EARLY, GOOD, INK, INK_FAINT, INK_SOFT, LATE, with_opacity
from station.render.report.page.session_page import Interval
from station.render.report.page.timing_words import signed
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

WIDTH = 420.0
"""Of every chart: as wide as a telephone held upright, and half a page of paper (our choice)."""
LETTER = 13.0
LABEL = TypeStyle(LETTER, INK_SOFT)
NUMBER = TypeStyle(LETTER, INK)
HAIR = 1.0
_WHISKER, _DOT = 2.6, 4.6
ARROW = (5.0, 4.5)
"""Half sizes of the arrow of what goes on beyond an axis."""
CUT = "an arrow says that it goes on"


@dataclass(frozen=True, slots=True)
class Spot:
    """A place of a chart and what it says to who points at it: from `left`, `top` so wide and high."""

    words: str
    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True, slots=True, eq=False)
class Chart:
    """A chart under its `title`: `shapes` of `SHAPE_DTYPE`, how large they are, what they say, and its spots.

    `says` stands below the chart; empty where the chart has its figures in it. `legend` explains marks there; empty
    where they explain themselves.
    """

    title: str
    words: str
    shapes: NDArray[np.void]
    size: tuple[float, float]
    spots: tuple[Spot, ...] = ()
    legend: str = ""
    says: str = ""


@dataclass(frozen=True, slots=True)
class Axis:
    """A straight axis: `low` stands at x `left`, `high` at `right`; what lies beyond stands on its end."""

    low: float
    high: float
    left: float
    right: float

    def x(self, value: float) -> float:
        """Where a value stands."""
        share = (value - self.low) / (self.high - self.low)
        return self.left + min(max(share, 0.0), 1.0) * (self.right - self.left)


def time_colour(off_ms: float, on_time_ms: float) -> Colour:
    """The signal colour of an asynchrony."""
    return GOOD if abs(off_ms) <= on_time_ms else EARLY if off_ms < 0 else LATE


def time_axis(draw_list: DrawList, axis: Axis, top: float, bottom: float, every: float) -> None:
    """Lines at every so many milliseconds from `top` to `bottom`, numbers below, and which side is which."""
    steps = int(axis.high // every)
    for step in range(-steps, steps + 1):
        ms = step * every
        x = axis.x(ms)
        draw_list.box((x - HAIR / 2, top), (HAIR, bottom - top), INK_SOFT if not step else with_opacity(INK_FAINT, 0.5))
        at = (x, bottom + LETTER + 2)
        draw_list.text(signed(ms) if step else "0 ms", at, TypeStyle(LETTER - 1, INK_SOFT, align=0.5))


def sides(draw_list: DrawList, axis: Axis, y: float) -> None:
    """The words early and late over the ends of an axis, with arrows; as in the colours of the signals' shapes."""
    size = LETTER
    for word, x, way in (("early", axis.left, -1.0), ("late", axis.right, 1.0)):
        colour = EARLY if way < 0 else LATE
        draw_list.triangle((x + way * -5.0, y - 4.5), (5.0, 4.5), colour, 0.0 if way > 0 else np.pi)
        style = TypeStyle(size, INK, Face.BOLD, 0.0 if way < 0 else 1.0)
        draw_list.text(word, (x - way * 14.0, y), style)


def mean_mark(draw_list: DrawList, axis: Axis, y: float, mean: float, ci: Interval | None, colour: Colour) -> None:
    """A dot at the mean, and whiskers as far as its interval: with an arrow where that goes on beyond the axis."""
    if ci is not None:
        left, right = axis.x(ci[0]), axis.x(ci[1])
        draw_list.box((left, y - _WHISKER / 2), (max(right - left, 0.5), _WHISKER), INK)
        for x, is_cut, angle in ((left, ci[0] < axis.low, np.pi), (right, ci[1] > axis.high, 0.0)):
            if is_cut:
                draw_list.triangle((x, y), ARROW, INK, angle)
            else:
                draw_list.box((x - HAIR, y - 4.5), (2 * HAIR, 9.0), INK)
    draw_list.ellipse((axis.x(mean), y), (_DOT, _DOT), INK)
    draw_list.ellipse((axis.x(mean), y), (_DOT - 1.4, _DOT - 1.4), colour)


def spread_bar(draw_list: DrawList, axis: Axis, y: float, ends: Interval, colour: Colour, half: float = 6.0) -> None:
    """A soft bar between two values."""
    left, right = axis.x(ends[0]), axis.x(ends[1])
    draw_list.box((left, y - half), (right - left, 2 * half), with_opacity(colour, 0.34))


def reach_ms(furthest: Sequence[float], least: float, most: float) -> float:
    """A round number of milliseconds that holds what lies furthest, from `least` to `most`."""
    wanted = max((abs(value) for value in furthest), default=least)
    return float(min(max(20.0 * np.ceil(wanted / 20.0), least), most))
