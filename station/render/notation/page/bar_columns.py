"""The columns of a bar: where its notes and rests stand after each other, and how far apart.

Units are staff spaces, y down. What is drawn at one moment of the score is a column; how much room it takes is measured
on its engraved shapes, band by band of the staff's height, so that a letter below may reach under a neighbour's stem.
Between columns are springs: at ease each is as long as its time asks (Gould, "Behind Bars", 2011: space grows with
duration, yet more slowly; here by the same ratio each time it doubles), and none is shorter than its neighbours allow.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ

Floats = NDArray[np.float64]

_EIGHTH, _DOUBLED = 2.9, 2**0.5
"""The room at ease of an eighth from its note to the next: four bars of them in a line of A4 (our choice), and how many
times that a value twice as long has: so a half note is given twice what an eighth is, as engravers do (Gould: 1.4)."""
_SHORTEST = PPQ // 16
"""Values below a sixty-fourth are given as much as it."""
_INSET = 1.65
"""From a bar line to the middle of the first note at the least: one space between line and head (Gould)."""
_AIR, _LINE_AIR = 0.25, 0.7
"""What neighbours leave free between them, and what stands beside a bar line."""
_NOTES_Y = (-5.3, 4.2)
"""Heads, stems and rests lie within: what stands outside, such as a tuplet's number, is no column."""
_TOP, _BAND, _BANDS = -10.0, 0.5, 44
"""The bands in which room is measured, from the highest down, and how high each is."""
_STAFF_BANDS = slice(round((-2.0 - _TOP) / _BAND), round((2.0 - _TOP) / _BAND))
_NO_TIMES: Floats = np.zeros(0)
_FORCE_STEPS = 26
"""Halvings of the interval in which the force on a line is sought: to a hundred-thousandth of a space."""


@dataclass(frozen=True, slots=True, eq=False)
class BarColumns:
    """A bar's columns: `times_s` (k,), from its start on, and the springs between them, shape (k,).

    `least` and `ease` are what lies before the next column, the last before the bar line; `inset` is from the bar line
    to the first. `is_silent`: one rest that fills the bar and stands in its middle.
    """

    times_s: Floats
    least: Floats
    ease: Floats
    inset: float
    is_silent: bool = False

    @property
    def narrowest(self) -> float:
        """The least width of the bar."""
        return self.inset + float(self.least.sum())

    def width(self, force: float) -> float:
        """The bar's width where its springs are `force` times as long as at ease."""
        return self.inset + float(np.maximum(self.least, force * self.ease).sum())

    def places(self, force: float) -> Floats:
        """Where the columns stand from the bar line, and the next bar line, shape (k + 1,)."""
        places = self.inset + np.concatenate([[0.0], np.cumsum(np.maximum(self.least, force * self.ease))])
        if self.is_silent:
            places[-2] = places[-1] / 2 + (self.inset - _INSET) / 2
        return places


def bar_columns(
    shapes: NDArray[np.void],
    length_s: float,
    ticks_at: Callable[[Floats], NDArray[np.int64]],
    beside: tuple[float, float] = (0.0, 0.0),
    also_s: Floats = _NO_TIMES,
) -> BarColumns:
    """The columns of an engraved bar `length_s` long; so much stands `beside` its notes, before and after them.

    `shapes` (n,) of `draw_list.SHAPE_DTYPE`, their times and those of `ticks_at`, which says where in the score a time
    is, from the bar's start. `also_s` (m,) are times that have a column though nothing stands there.
    """
    still = shapes[shapes["time_s"][:, 1] == 0]
    at_s, y = still["time_s"][:, 0], still["centre"][:, 1]
    within = (y > _NOTES_Y[0]) & (y < _NOTES_Y[1])
    times_s = np.unique(np.concatenate([[0.0], at_s[within], also_s.astype(np.float32)])).astype(np.float64)
    left, right = _extents(still, times_s)
    ticks = ticks_at(np.append(times_s, length_s))
    doublings = np.log2(np.maximum(np.diff(ticks), _SHORTEST) / (PPQ / 2))
    inset, least = _packed(left, right, beside)
    is_silent = len(times_s) == 2 and not np.isfinite(right[0]).any() and abs(2 * times_s[1] - length_s) < 1e-3
    return BarColumns(times_s, least, _EIGHTH * _DOUBLED**doublings, inset, is_silent)


def _extents(shapes: NDArray[np.void], times_s: Floats) -> tuple[Floats, Floats]:
    """How far each column reaches to its left and its right in each band, shape (columns, bands); −∞ where nowhere."""
    axis, half, centre = np.abs(shapes["axis"]), shapes["half"], shapes["centre"]
    edge = shapes["style"][:, 1] / 2
    across = axis[:, 0] * half[:, 0] + axis[:, 1] * half[:, 1] + edge
    upright = axis[:, 1] * half[:, 0] + axis[:, 0] * half[:, 1] + edge
    column = np.searchsorted(times_s, shapes["time_s"][:, 0] - 1e-9)
    column = np.minimum(column, len(times_s) - 1)
    stands = np.abs(times_s[column] - shapes["time_s"][:, 0]) < 1e-6
    first = np.clip(np.floor((centre[:, 1] - upright - _TOP) / _BAND), 0, _BANDS - 1).astype(int)
    last = np.clip(np.ceil((centre[:, 1] + upright - _TOP) / _BAND), 1, _BANDS).astype(int)
    counts = np.where(stands, np.maximum(last - first, 0), 0)
    row = np.repeat(np.arange(len(shapes)), counts)
    band = first[row] + np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    left = np.full((len(times_s), _BANDS), -np.inf)
    right = left.copy()
    np.maximum.at(left, (column[row], band), (across - centre[:, 0])[row])
    np.maximum.at(right, (column[row], band), (across + centre[:, 0])[row])
    return left, right


def _packed(left: Floats, right: Floats, beside: tuple[float, float]) -> tuple[float, Floats]:
    """How near to the bar line the first column stands, and each next one to the one before it, the last to the end."""
    before, after = beside
    reached = np.zeros(_BANDS)
    reached[_STAFF_BANDS] = before + _LINE_AIR - _AIR
    inset = x = max(before + _INSET, float((reached + _AIR + left[0]).max()))
    least = []
    for k in range(1, len(left)):
        reached = np.maximum(reached, x + right[k - 1])
        near = max(float((reached + _AIR + left[k]).max()), x)
        least.append(near - x)
        x = near
    reached = np.maximum(reached, x + right[-1])
    reached[_STAFF_BANDS] += _LINE_AIR + after
    least.append(max(float(reached.max()) - x, 0.0))
    return inset, np.array(least)


def force_to(bars: Sequence[BarColumns], width: float) -> float:
    """How far the springs of a line's bars are drawn out so that the bars together are `width` wide.

    Where they cannot be so narrow, 0.
    """
    least, ease = (np.concatenate(springs) for springs in zip(*((b.least, b.ease) for b in bars), strict=True))
    left = width - sum(bar.inset for bar in bars)
    low, high = 0.0, 1.0
    while np.maximum(least, high * ease).sum() < left:
        high *= 2
    for _ in range(_FORCE_STEPS):
        middle = (low + high) / 2
        low, high = (middle, high) if np.maximum(least, middle * ease).sum() < left else (low, middle)
    return high
