"""The band's way through the song to about 10 ms: the best of all smooth tempo curves near the listener's points.

States are how far the band is from the points' curve and how much faster or slower it runs, step by step of about two
seconds. A step gains what the sound starts where the score says so; a change of tempo costs in proportion, and so does
passing a point. The best way through is found by dynamic programming (Viterbi 1967). Where bars are alike and a point
is a bar off, the way keeps its tempo and leaves the point aside.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Narrow = NDArray[np.float32]

GRID_S = 0.01
"""Distances from the points' curve are told apart so far."""

STEP_S = 1.8
"""A step lasts at least so long: over it half a percent of tempo is one place of the grid."""

SLOPE_STEP = 0.005
SLOPES = np.concatenate([np.arange(-40, 41) * SLOPE_STEP, np.arange(22, 82, 2) * 0.01])
"""Longer by so much than the points' curve says: ±20 % in half percents is what a band strays; up to 80 % by two, a
last bar at five ninths of the tempo, is what it slows down at the end (our choice)."""

_FROM_LEAST: Narrow = np.asarray((SLOPES - SLOPES[0]) / SLOPE_STEP, np.float32)
"""How many half percents each slope is from the first (slopes,)."""

REACH_S = 3.0
"""How far the way may be from the points' curve: a bar of 4/4 at 80 bpm (our choice; a point may be a bar off)."""

CHANGE = 0.7
"""Price of half a percent of tempo from one step to the next. A stroke that is found gains about 0.7 (our choice)."""

CHANGE_AT_END, ENDING_S = 0.12, 12.0
"""The price in the last seconds of the part, where bands slow down (our choice)."""

STRAY_SD, MOST_STRAY = 0.04, 5.0
"""What a band strays from the points' curve, and the most that a step costs which is farther off (our choice)."""

_UNLIKELY = np.minimum(0.5 * np.square(SLOPES / STRAY_SD), MOST_STRAY).astype(np.float32)[:, None]
_UNLIKELY_AT_END = np.where(SLOPES[:, None] > 0.0, 0.1 * _UNLIKELY, _UNLIKELY)

POINT_SD_S, POINT_WORTH = 0.035, 20.0
"""A point is believed to its `POINT_SD_S` (a tap's scatter and bias); one that is far off costs `POINT_WORTH`, as much
as a bar of strokes that are not found."""

_EMPTY = 0.35
"""What a strength is on average where nothing is expected (measured on the virtual band: 0.24–0.37)."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What should start when, by the points' curve.

    `at_s` (n,), `band` (n,), `weight` (n,) are the expected onsets; `point_at_s` (p,) where the curve has the ticks of
    the points, `point_s` (p,) where the points have them, `point_weight` (p,) how much each counts.
    """

    at_s: Floats
    band: NDArray[np.int64]
    weight: Floats
    point_at_s: Floats
    point_s: Floats
    point_weight: Floats


def coarse_way(step_s: Floats, evidence: Evidence, strength: Narrow) -> Floats:
    """How much later than the points' curve the band is at each of `step_s` (k + 1,), in s; k ≥ 1.

    `strength` (3, n) has columns `GRID_S` apart.
    """
    places = round(2 * REACH_S / GRID_S) + 1
    value: Narrow = np.repeat(-0.5 * CHANGE * np.abs(SLOPES / SLOPE_STEP)[:, None], places, axis=1)
    value = value.astype(np.float32)
    steps: list[tuple[Narrow, float]] = []
    pads = round((2 * REACH_S + 1.0) / GRID_S)
    padded = np.pad(strength, ((0, 0), (pads, pads)), constant_values=_EMPTY)
    for start, end in pairwise(step_s.tolist()):
        is_end = end > step_s[-1] - ENDING_S
        steps.append((value, CHANGE_AT_END if is_end else CHANGE))
        value = _changed(*steps[-1]) - (_UNLIKELY_AT_END if is_end else _UNLIKELY)
        value = _moved(value + _gain(start, end, evidence, padded, pads, places), end - start)
    return _traced(value, steps, np.diff(step_s))


def _changed(value: Narrow, price: float) -> Narrow:
    """The best value (slopes, places) of every slope after a change from any: greatest so far, from both sides."""
    paid = _FROM_LEAST[:, None] * np.float32(price)
    faster = np.maximum.accumulate(value + paid, axis=0) - paid
    slower = np.maximum.accumulate((value - paid)[::-1], axis=0)[::-1] + paid
    return np.asarray(np.maximum(faster, slower))


def _gain(start: float, end: float, evidence: Evidence, padded: Narrow, pads: int, places: int) -> Narrow:
    """What a step from `start` to `end` brings in every state: (slopes, places)."""
    gain = np.zeros((len(SLOPES), places), np.float32)
    windows = np.lib.stride_tricks.sliding_window_view(padded, places, axis=1)
    last = windows.shape[1] - 1
    first, stop = np.searchsorted(evidence.at_s, (start, end))
    for at_s, band, weight in zip(
        *(v[first:stop] for v in (evidence.at_s, evidence.band, evidence.weight)), strict=True
    ):
        shifts = np.rint((start + (at_s - start) * (1 + SLOPES) - REACH_S) / GRID_S).astype(int) + pads
        gain += np.float32(weight) * (windows[band, np.clip(shifts, 0, last)] - np.float32(_EMPTY))
    offsets = np.arange(places) * GRID_S - REACH_S
    for p in np.flatnonzero((evidence.point_at_s >= start) & (evidence.point_at_s < end)):
        at_s = evidence.point_at_s[p]
        miss = at_s + offsets[None, :] + SLOPES[:, None] * (at_s - start) - evidence.point_s[p]
        cost = np.minimum(0.5 * np.square(miss / POINT_SD_S), POINT_WORTH)
        gain -= (evidence.point_weight[p] * cost).astype(np.float32)
    return gain


def _shifts(length_s: float) -> NDArray[np.int64]:
    return np.asarray(np.rint(SLOPES * length_s / GRID_S), np.int64)


def _moved(value: Narrow, length_s: float) -> Narrow:
    """Every slope's places after a step of `length_s`; what leaves the reach is lost."""
    moved = np.full_like(value, -np.inf)
    places = value.shape[1]
    for i, shift in enumerate(_shifts(length_s).tolist()):
        if abs(shift) < places:
            moved[i, max(0, shift) : places + min(0, shift)] = value[i, max(0, -shift) : places + min(0, -shift)]
    return moved


def _traced(value: Narrow, steps: list[tuple[Narrow, float]], lengths_s: Floats) -> Floats:
    """The places of the best way, back from its end, as distances in s: (steps + 1,).

    `steps` have the values before each step, and the price of a change there.
    """
    slope, place = (int(i) for i in np.unravel_index(int(np.argmax(value)), value.shape))
    way = [place]
    for (before, price), length_s in zip(reversed(steps), lengths_s[::-1], strict=True):
        place -= int(_shifts(float(length_s))[slope])
        slope = int(np.argmax(before[:, place] - price * np.abs(_FROM_LEAST - _FROM_LEAST[slope])))
        way.append(place)
    return np.array(way[::-1]) * GRID_S - REACH_S
