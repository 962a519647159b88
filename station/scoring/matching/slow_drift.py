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
    return MAD_TO_SD * median(np.abs(values - median(values)))


def median(values: Floats) -> float:
    """The median of at least one value: `numpy.median` without its checks, which cost more than the search."""
    middle = len(values) // 2
    if len(values) % 2:
        return float(np.partition(values, middle)[middle])
    low, high = np.partition(values, (middle - 1, middle))[middle - 1 : middle + 1].tolist()
    return float((low + high) / 2)


def half_width(times_s: Floats) -> int:
    """How many values a trend takes to each side of each of `times_s` (n,), which rise."""
    length_s = float(times_s[-1] - times_s[0]) if len(times_s) else 0.0
    wide = round(_REACH_S * len(times_s) / length_s) if length_s else _MOST_WIDTH
    return min(max(wide, _LEAST_WIDTH), _MOST_WIDTH)


_REACH_S = 4.0
"""A tempo may be taken for even over so many seconds to each side: at a drift of ±12 % a minute it bends by 40 ms, most
of which a second fit takes back."""

_LEAST_WIDTH, _MOST_WIDTH = 4, 16
"""Fewer values say too little against their noise; more are never needed: a sixth of the noise is left."""


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
    """The weighted line through the window around each value, at that value's time."""
    n = len(t)
    rows = np.zeros((5, n + 2 * half_width + 1))  # nothing beyond the ends
    wt, own = w * t, slice(half_width + 1, half_width + 1 + n)
    rows[0, own], rows[1, own], rows[2, own], rows[3, own], rows[4, own] = w, wt, wt * t, w * y, wt * y
    totals = np.cumsum(rows, axis=1)
    s0, s1, s2, y0, y1 = totals[:, 2 * half_width + 1 :] - totals[:, :n]
    s0 = np.maximum(s0, _NO_WEIGHT)
    mean_t, mean_y = s1 / s0, y0 / s0
    spread = s2 - s1 * mean_t
    slope = np.where(spread > _NO_WEIGHT, (y1 - mean_t * y0) / np.maximum(spread, _NO_WEIGHT), 0.0)
    line: Floats = mean_y + slope * (t - mean_t)
    return line


_NO_WEIGHT = 1e-6
"""Less weight, or spread in s², bears no line."""
