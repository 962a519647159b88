"""How far up and down a line of music reaches at every place along it: words above it find their height here.

Units are staff spaces, y down; the line is cut into steps of a quarter of a space.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_STEP = 0.25
STAFF_EDGE = 2.0


class Skyline:
    """The upper and the lower edge of a line `width` long, at first those of the staff."""

    def __init__(self, width: float) -> None:
        self.width = width
        count = max(int(np.ceil(width / _STEP)), 1)
        self._top: Floats = np.full(count, -STAFF_EDGE)
        self._bottom: Floats = np.full(count, STAFF_EDGE)

    @property
    def top(self) -> float:
        """The highest place of the line."""
        return float(self._top.min())

    @property
    def bottom(self) -> float:
        """The lowest place of the line."""
        return float(self._bottom.max())

    def top_over(self, left: float, right: float) -> float:
        """The highest place between two places of the line."""
        return float(self._top[self._steps(left, right)].min())

    def add(self, left: float, right: float, top: float, bottom: float) -> None:
        """Something stands there."""
        steps = self._steps(left, right)
        self._top[steps] = np.minimum(self._top[steps], top)
        self._bottom[steps] = np.maximum(self._bottom[steps], bottom)

    def add_shapes(self, shapes: NDArray[np.void]) -> None:
        """Shapes (n,) of `draw_list.SHAPE_DTYPE` in their places."""
        axis, half, edge = np.abs(shapes["axis"]), shapes["half"], shapes["style"][:, 1] / 2
        x, y = shapes["centre"].T
        across = axis[:, 0] * half[:, 0] + axis[:, 1] * half[:, 1] + edge
        upright = axis[:, 1] * half[:, 0] + axis[:, 0] * half[:, 1] + edge
        first = np.clip(np.floor((x - across) / _STEP), 0, len(self._top) - 1).astype(int)
        after = np.clip(np.ceil((x + across) / _STEP), first + 1, len(self._top)).astype(int)
        counts = after - first
        row = np.repeat(np.arange(len(shapes)), counts)
        step = first[row] + np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
        np.minimum.at(self._top, step, (y - upright)[row])
        np.maximum.at(self._bottom, step, (y + upright)[row])

    def _steps(self, left: float, right: float) -> slice:
        first = min(max(int(left / _STEP), 0), len(self._top) - 1)
        return slice(first, max(int(np.ceil(right / _STEP)), first + 1))
