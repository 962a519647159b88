"""A page of ink as pixels, drawn without a printer or a graphics card: for the pictures of the documentation."""

import numpy as np
from numpy.typing import NDArray

from station.render.text.paper import Ink, Points

_FINE = 4
"""So many rows and columns within a pixel are looked at."""


def page_pixels(page: Ink, size: tuple[float, float], pixels_per_point: float) -> NDArray[np.uint8]:
    """The page, `size` (width, height) points, as (height, width, 3), black ink on white."""
    wide, high = (round(length * pixels_per_point) * _FINE for length in size)
    light = np.ones((high, wide), np.float32)
    for area in page:
        contours = [contour * pixels_per_point * _FINE for contour in area.contours]
        corners = np.concatenate(contours)
        left, top = np.maximum(np.floor(corners.min(axis=0)).astype(int), 0)
        right, bottom = np.minimum(np.ceil(corners.max(axis=0)).astype(int) + 1, (wide, high))
        inside = _winding([contour - (left, top) for contour in contours], (bottom - top, right - left)) != 0
        light[top:bottom, left:right][inside] = area.grey
    grey = light.reshape(high // _FINE, _FINE, wide // _FINE, _FINE).mean(axis=(1, 3))
    return np.repeat(np.rint(255 * grey).astype(np.uint8)[:, :, None], 3, axis=2)


def _winding(contours: list[Points], shape: tuple[int, int]) -> NDArray[np.int64]:
    """How often the contours run round the middle of each cell, shape (rows, columns)."""
    turns = np.zeros((shape[0], shape[1] + 1), np.int64)
    for contour in contours:
        for (x, y), (next_x, next_y) in zip(contour, np.roll(contour, -1, axis=0), strict=True):
            low, high = sorted((y, next_y))
            rows = np.arange(max(int(np.ceil(low - 0.5)), 0), min(int(np.ceil(high - 0.5)), shape[0]))
            if len(rows):
                crossing = x + (rows + 0.5 - y) / (next_y - y) * (next_x - x)
                columns = np.clip(np.ceil(crossing - 0.5), 0, shape[1]).astype(int)
                np.add.at(turns, (rows, columns), 1 if next_y > y else -1)
    return turns.cumsum(axis=1)[:, :-1]
