"""Chance as people have it: slow and quick at once, alike in every run of one seed."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_MOST_SD = 2.2
"""No number is farther out than this (our choice: one in forty)."""
_OCTAVES = 6


@lru_cache(maxsize=16)
def wander(seed: tuple[int, ...], channels: int, count: int) -> Array:
    """Numbers of mean 0 and deviation 1, (channels, count), each with a spectrum that falls as 1/f; not to be written.

    Value noise of periods 1, 2, 4 … 32: equal power in every octave. Sliders ask for the same again and again.
    """
    random = np.random.default_rng(seed)
    total = np.zeros((channels, count))
    for octave in range(_OCTAVES):
        step = 2**octave
        values = random.standard_normal((channels, count // step + 2))
        share = np.arange(step) / step
        ramp = np.array([1 - share, share]) / np.hypot(1 - share, share)
        smooth = values[:, :-1, None] * ramp[0] + values[:, 1:, None] * ramp[1]
        total += smooth.reshape(channels, -1)[:, :count]
    return np.asarray(np.clip(total / np.sqrt(_OCTAVES), -_MOST_SD, _MOST_SD))
