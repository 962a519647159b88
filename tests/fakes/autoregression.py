"""Rows of values that hang together, by scipy's filter: what intervals are tried on."""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Floats = NDArray[np.float64]


def autoregression(rows: int, slots: int, rho: float, seed: int) -> Floats:
    """`rows` stationary rows of `slots` values with mean 0, SD 1 and a lag-1 correlation of `rho`."""
    noise = np.random.default_rng(seed).normal(0, 1, (rows, slots))
    noise[:, 1:] *= (1 - rho * rho) ** 0.5
    values: Floats = lfilter([1.0], [1.0, -rho], noise, axis=1)
    return values
