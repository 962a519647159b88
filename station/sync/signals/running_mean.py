"""Exponentially weighted means, sample by sample or of a whole signal, and the high-pass that they leave."""

from math import exp, pi

import numpy as np

from station.sync.signals.signal import FloatArray

_BLOCK = 16
"""Samples that are summed at once (our choice: 8 and 32 take as long)."""


def running_means(values: FloatArray, weight: float, before: FloatArray | float = 0.0) -> FloatArray:
    """m(k) = m(k−1) + weight (x(k) − m(k−1)) along the last axis of values (…, n ≥ 1), from the means `before` on."""
    weighted = values * weight
    weighted[..., 0] += (1 - weight) * before
    return _accumulated(weighted, 1 - weight)


def _accumulated(values: FloatArray, keep: float) -> FloatArray:
    """s(k) = keep s(k−1) + x(k) along the last axis, in blocks whose ends are accumulated in the same way."""
    *shape, count = values.shape
    blocks = -(-count // _BLOCK)
    padded = np.zeros((*shape, blocks * _BLOCK))
    padded[..., :count] = values
    ages = np.arange(_BLOCK)[None, :] - np.arange(_BLOCK)[:, None]
    sums = padded.reshape(*shape, blocks, _BLOCK) @ np.where(ages >= 0, keep ** np.maximum(ages, 0), 0.0)
    if blocks > 1:
        ends = _accumulated(sums[..., -1], keep**_BLOCK)
        sums[..., 1:, :] += ends[..., :-1, None] * keep ** np.arange(1, _BLOCK + 1)
    found: FloatArray = sums.reshape(*shape, -1)[..., :count]
    return found


def high_pass_weight(cutoff_hz: float, rate_hz: float) -> float:
    """The weight of the newest sample in the mean that a high-pass of first order takes away."""
    return 1 - exp(-2 * pi * cutoff_hz / rate_hz)


def high_passed(values: FloatArray, cutoff_hz: float, rate_hz: float) -> FloatArray:
    """A signal (n, c) without its slow part, the running mean from its first sample on: zero-mean, its first row 0."""
    from_first = values - values[:1]
    return from_first - running_means(from_first.T, high_pass_weight(cutoff_hz, rate_hz)).T
