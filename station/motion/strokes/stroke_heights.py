"""Stroke heights by loudness."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

INCH_M = 0.0254
LEVELS = ((16, 1.0), (33, 2.0), (49, 3.0), (64, 4.5), (80, 6.0), (96, 9.0), (112, 12.0), (127, 15.0))
"""MIDI velocity and stick height in inches: p 49 … fff 127 (HUMANS: marching practice; the velocities are those that
notation programs play); the two below p are our choice."""

_VELOCITIES, _INCHES = (np.array(column, np.float64) for column in zip(*LEVELS, strict=True))


def stroke_height_m(velocity: ArrayLike) -> NDArray[np.float64]:
    """How high the tip rises over the head before a stroke of each velocity, 1–127."""
    return np.interp(np.asarray(velocity, np.float64), _VELOCITIES, _INCHES) * INCH_M
