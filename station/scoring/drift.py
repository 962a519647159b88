"""The slow part of a row of asynchronies: where a player stands at a time, robust against single wrong pairs.

`local_trend` fits a straight line to the asynchronies around each one, weighs down those that lie far off (Tukey's
biweight, Mosteller & Tukey 1977) and fits again. The weighted sums of all windows come from running totals, so the
cost grows with the number of values and not with the width of the windows.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MAD_TO_SD = 1.4826
"""Median absolute deviation of a normal distribution times this is its standard deviation."""

_BIWEIGHT_SDS = 4.7
"""Tukey's constant: 95 % efficiency on normal data (Mosteller & Tukey 1977)."""

_ROUNDS = 3
"""Our choice: the weights no longer move after three rounds."""


def robust_sd(values: Floats) -> float | None:
    """Standard deviation (the unit of `values`) by the median absolute deviation; None of fewer than four."""
    if len(values) < 4:
        return None
    return MAD_TO_SD * float(np.median(np.abs(values - np.median(values))))


def local_trend(times: Floats, values: Floats, half_width: int, scale: float, weights: Floats | None = None) -> Floats:
    """Line fitted to the values around each time, robustly, evaluated at that time.

    `times` (n,) sorted, `values` (n,); each window reaches `half_width` values to both sides (fewer at the ends);
    `scale` is the SD of the scatter about the trend, in the unit of `values`; `weights` (n,) those of the first fit.
    """
    weights = np.ones(len(values)) if weights is None else weights
    trend = values
    centred = times - (times[0] if len(times) else 0.0)
    for _ in range(_ROUNDS):
        trend = _weighted_lines(centred, values, weights, half_width)
        off = (values - trend) / (_BIWEIGHT_SDS * scale)
        weights = np.square(np.maximum(1.0 - off * off, 0.0))
    return trend


def _weighted_lines(t: Floats, y: Floats, w: Floats, half_width: int) -> Floats:
    n = len(t)
    low = np.maximum(np.arange(n) - half_width, 0)
    high = np.minimum(np.arange(n) + half_width + 1, n)

    def window(values: Floats) -> Floats:
        total = np.concatenate(([0.0], np.cumsum(values)))
        sums: Floats = total[high] - total[low]
        return sums

    s0, s1, s2 = window(w), window(w * t), window(w * t * t)
    y0, y1 = window(w * y), window(w * t * y)
    enough = s0 > 1e-6
    mean_t = np.where(enough, s1 / np.where(enough, s0, 1.0), t)
    mean_y = np.where(enough, y0 / np.where(enough, s0, 1.0), y)
    spread = s2 - s0 * mean_t * mean_t
    slope = np.where(spread > 1e-6, (y1 - mean_t * y0) / np.where(spread > 1e-6, spread, 1.0), 0.0)
    line: Floats = mean_y + slope * (t - mean_t)
    return line
