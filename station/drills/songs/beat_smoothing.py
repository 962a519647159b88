"""Times of beats from observations between them: the smoothest tempo that the observations bear, robustly.

The times x of the beats make least

    Σ w · (x at an observation − observed)² / sd²  +  Σ (change of rate from beat to beat)² / `RATE_SD`²,

x straight between beats, rates against written seconds: the smoother of a tempo that walks at random. Observations far
off count less (Cauchy's weights). The matrix has five diagonals; it is solved in one pass down and one up.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

RATE_SD = 0.004
"""By how much a band's tempo changes from one beat to the next (our choice: 0.8 % a bar). More follows a drummer's feel
of a few bars instead of the beat: with strokes as drummers of the Groove MIDI data set play them."""

ENDING_S, ENDING_RATE_SD = 10.0, 0.04
"""In the last seconds bands slow down: to two thirds of the tempo within two bars, by 4 to 7 % a beat (our
choice)."""

_ROUNDS = 4
"""The weights no longer move (our choice)."""


def smoothed(score_s: Floats, at: Floats, seen_s: Floats, sd_s: Floats, first: Floats) -> Floats:
    """Times in s (n,) of beats at `score_s` (n,), n ≥ 3, rising.

    Observation j of (m,) says that score time `at[j]`, within the beats, is at `seen_s[j]`, to `sd_s[j]`. `first` (n,)
    are the times to begin with.
    """
    i = np.clip(np.searchsorted(score_s, at, side="right") - 1, 0, len(score_s) - 2)
    share = (at - score_s[i]) / (score_s[i + 1] - score_s[i])
    bend = _bends(score_s)
    times = first
    for _ in range(_ROUNDS):
        off = (seen_s - (1 - share) * times[i] - share * times[i + 1]) / sd_s
        weight = 1.0 / (np.square(sd_s) * (1.0 + np.square(off / _CAUCHY)))
        bands, right = bend.copy(), np.zeros(len(score_s))
        np.add.at(bands[0], i, weight * (1 - share) ** 2)
        np.add.at(bands[0], i + 1, weight * share**2)
        np.add.at(bands[1], i, weight * share * (1 - share))
        np.add.at(right, i, weight * (1 - share) * seen_s)
        np.add.at(right, i + 1, weight * share * seen_s)
        times = solved(bands, right)
    return times


_CAUCHY = 2.385
"""Cauchy's constant: 95 % efficiency on normal data (Rey 1983)."""


def _bends(score_s: Floats) -> Floats:
    """Σ (change of rate)² / SD² as a matrix: its main diagonal and the two above it, (3, n)."""
    gaps = np.diff(score_s)
    left, right = 1.0 / gaps[:-1], 1.0 / gaps[1:]
    is_ending = score_s[1:-1] > score_s[-1] - ENDING_S
    rows = np.stack([left, -left - right, right]) / np.where(is_ending, ENDING_RATE_SD, RATE_SD)
    bands = np.zeros((3, len(score_s)))
    for a in range(3):
        for b in range(a, 3):
            bands[b - a, a : a + rows.shape[1]] += rows[a] * rows[b]
    return bands


def solved(bands: Floats, right: Floats) -> Floats:
    """X with A·x = `right` (n,), A symmetric, positive, its diagonal and the two above it in `bands` (3, n)."""
    n = len(right)
    d, a, b = [0.0] * n, [0.0] * n, [0.0] * n
    y = right.tolist()
    main, one, two = bands.tolist()
    for i in range(n):
        d[i] = main[i] - (d[i - 1] * a[i - 1] ** 2 if i else 0.0) - (d[i - 2] * b[i - 2] ** 2 if i > 1 else 0.0)
        a[i] = (one[i] - (d[i - 1] * a[i - 1] * b[i - 1] if i else 0.0)) / d[i]
        b[i] = two[i] / d[i]
        y[i] -= (a[i - 1] * y[i - 1] if i else 0.0) + (b[i - 2] * y[i - 2] if i > 1 else 0.0)
    x = [y[i] / d[i] for i in range(n)]
    for i in range(n - 2, -1, -1):
        x[i] -= a[i] * x[i + 1] + (b[i] * x[i + 2] if i + 2 < n else 0.0)
    return np.array(x)
