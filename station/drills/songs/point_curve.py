"""The curve through a listener's points: from score time to the sound file's, where nothing else is known.

Score time is seconds by the written tempo. A point that cannot be, for time would stand still, run back or double
beside it, is left out of the curve; it keeps its residual.
"""

from collections.abc import Sequence
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.drills.songs.band_tempo import BandPoint
from station.music.tempo import TempoMap

Floats = NDArray[np.float64]

_APART_S = 4.0
"""Points nearer together, as taps are, count as one at their middle: a tap's 25 ms would bend the tempo between two by
7 % (our choice)."""

_MOST_UNLIKE = np.log(1.25)
"""A stretch between two points whose tempo differs by more from the usual one has a wrong point (our choice: bands
slow down so far, but only at the end)."""

_LIKE = np.log(1.10)
"""Up to here a stretch may be a band's own drift; between the two a point is wrong if the rest without it are twice as
alike (our choice: a bar too many within twenty seconds makes 10 %)."""

_ALIKE = np.log(1.03)
"""From here on a point may be a beat off, if the rest without it are twice as alike: the sound has to say (our choice:
a beat too many within ten seconds makes 5 %, and bands drift by 2 to 6 in a whole song)."""

LEAST_RATE, MOST_RATE = 0.25, 4.0
"""Seconds of the file to one of the written tempo: beyond, part and sound are not of one song (our choice)."""


def point_knots(written: TempoMap, points: Sequence[BandPoint]) -> tuple[Floats, Floats]:
    """Score times and file times (k,), both rising, k ≥ 2, of the points that can be true together.

    Raises `BadInput` where there are no two such points.
    """
    if not all(isfinite(point.at_s) for point in points):
        raise BadInput("song", "points", "a time that is no number")
    if len({point.tick for point in points}) < 2:
        raise BadInput("song", "points", "a band's tempo needs points on two different beats")
    rows = sorted((float(written.seconds_at(point.tick)), point.at_s) for point in points)
    score_s, file_s = _thinned(np.array([s for s, _ in rows]), np.array([t for _, t in rows]))
    while len(score_s) > 2:
        most = float(_unlike(score_s, file_s).max())
        without = [float(_unlike(np.delete(score_s, i), np.delete(file_s, i)).max()) for i in range(len(score_s))]
        if most < _LIKE or (most < _MOST_UNLIKE and min(without) > most / 2):
            break
        score_s, file_s = (np.delete(values, int(np.argmin(without))) for values in (score_s, file_s))
    rate = float((file_s[-1] - file_s[0]) / (score_s[-1] - score_s[0]))
    if not LEAST_RATE <= rate <= MOST_RATE:
        fault = (
            "their times run backwards" if rate <= 0 else f"the band would play at {1 / rate:.3g} of the written tempo"
        )
        raise BadInput("song", "points", fault)
    return score_s, file_s


def rival_knots(knots: tuple[Floats, Floats]) -> tuple[Floats, Floats] | None:
    """The knots without the one that makes the tempo most unlike; None where none stands out."""
    score_s, file_s = knots
    if len(score_s) <= _FEWEST_KNOTS:
        return None
    without = [float(_unlike(np.delete(score_s, i), np.delete(file_s, i)).max()) for i in range(len(score_s))]
    most, odd = float(_unlike(score_s, file_s).max()), int(np.argmin(without))
    if most < _ALIKE or without[odd] > most / 2:
        return None
    return np.delete(score_s, odd), np.delete(file_s, odd)


_FEWEST_KNOTS = 3
"""Of so few nobody can say which is the odd one (our choice)."""


def through(knots: tuple[Floats, Floats], score_s: Floats) -> Floats:
    """File time of each of `score_s` (n,): straight between the knots, at the mean tempo of all beyond them."""
    at, to = knots
    rate = (to[-1] - to[0]) / (at[-1] - at[0])
    inside = np.interp(score_s, at, to)
    return np.asarray(inside + rate * (np.minimum(score_s - at[0], 0.0) + np.maximum(score_s - at[-1], 0.0)))


def _thinned(score_s: Floats, file_s: Floats) -> tuple[Floats, Floats]:
    """Points in groups of `_APART_S`, each at its median distance from its own middle; the ends in their own groups."""
    if score_s[-1] - score_s[0] < 2 * _APART_S:
        first, last = np.flatnonzero(score_s == score_s[0]), np.flatnonzero(score_s == score_s[-1])
        ends = [float(np.median(file_s[group])) for group in (first, last)]
        return score_s[[0, -1]], np.array(ends)
    group = np.floor((score_s - score_s[0]) / _APART_S).astype(np.int64)
    if len(score_s) > 2 * len(np.unique(group)):  # taps
        slope = float(np.median(np.diff(file_s) / np.maximum(np.diff(score_s), 1e-3)))
        middles = [float(np.median(score_s[group == g])) for g in np.unique(group)]
        times = [
            float(np.median(file_s[group == g] - slope * (score_s[group == g] - middle)))
            for g, middle in zip(np.unique(group), middles, strict=True)
        ]
        return np.array(middles), np.array(times)
    keep = np.concatenate([[True], np.diff(score_s) > 0])
    return score_s[keep], file_s[keep]


def _unlike(score_s: Floats, file_s: Floats) -> Floats:
    """How far, as a logarithm, the tempo of each stretch is from the usual one: (k − 1,); ∞ where time runs back."""
    rates = np.diff(file_s) / np.diff(score_s)
    usual = float(np.median(rates[rates > 0])) if (rates > 0).any() else 1.0
    unlike = np.full(len(rates), np.inf)
    unlike[rates > 0] = np.abs(np.log(rates[rates > 0] / usual))
    return unlike
