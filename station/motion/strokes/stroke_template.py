"""The measured stroke: its keyframes, read off the one full stroke that was measured, as a template for all others.

SMED's three keyframes, preparation, strike and rebound, are the frame (thesis § 4.2). A whip needs more: each joint
has a start, a middle and a top of its preparation, two keys on the way down, the strike, the rebound and the rest
after it, each joint at times of its own. The stroke is that of `data/stroke` (Pearl 2023, doi
10.1101/2023.10.09.561270: 100 bpm, tip 56 cm high), time zero moved 5 ms before the tip's lowest sample, where its
undisturbed fall meets the head. Seconds, radians, metres; joints in the order of `arm.Offsets`: shoulder, elbow, wrist
and stick.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.motion.kinematics.splines import SplineChannels, lines, power_form

Array = NDArray[np.float64]

WRIST = 2
KEYS = 8
"""Keys of a joint for each strike: start, middle, top, two on the way down, strike, rebound, rest."""
STRIKE = 5

FULL_HEIGHT_M = 0.56
PEAK_RAD = np.radians([[19.2], [23.0], [33.2], [15.5]])
"""How far each joint goes in a stroke from full height."""
BEFORE_S = np.array(
    [
        [0.540, 0.465, 0.340, 0.190, 0.090],
        [0.520, 0.390, 0.145, 0.075, 0.040],
        [0.540, 0.440, 0.103, 0.036, 0.014],
        [0.520, 0.160, 0.034, 0.020, 0.010],
    ]
)
"""Start, middle, top and two on the way down: seconds before the strike."""
SHARE_BEFORE = np.array(
    [
        [0.00, 0.66, 1.00, 0.53, -0.04],
        [0.00, 0.07, 1.00, 0.62, 0.28],
        [0.00, 0.55, 1.00, 0.70, 0.25],
        [0.00, 0.47, 1.00, 0.88, 0.70],
    ]
)
"""The same keys' values in shares of the joint's peak (the rest's height comes on top, for the wrist)."""
LONGEST_S = 0.540
REBOUND_S = np.array([[0.050], [0.040], [0.046], [0.027]])
SHARE_REBOUND = np.array([[0.0], [-0.06], [0.28], [0.76]])
REST_S = np.array([[0.100], [0.100], [0.110], [0.085]])
"""When each joint rests again after the strike."""
DOWN_S = 0.150
"""The whip proper: this part of the template keeps its length while the preparation is squeezed."""

# --- how the splines pass each key: start, middle, top, down, down, strike, rebound, rest -----------------------------

_STRIKE_INTO = np.array([[1.0], [1.0], [0.8], [1.0]])
_STRIKE_OUT = np.array([[1.0], [1.0], [0.65], [2.35]])
"""Slopes at the strike in shares of the chords before and after it: the wrist already slows down, the stick does not,
and it leaves the head at half the speed (rebound ratio 0.51)."""


def through(times_s: Array, values: Array, start: ArrayLike, rest: ArrayLike) -> Array:
    """The cubics (4, n · KEYS, 4) of Kochanek-Bartels splines through the keys of n strokes, (4, n, KEYS) each.

    Continuity is broken at the strike; `start` and `rest` (4, n) are 1 less the tension of those keys.
    """
    flat = (4, values.shape[1] * KEYS)
    steps, chords = lines(times_s.reshape(flat), values.reshape(flat))
    slopes = np.empty(flat)
    slopes[:, :1], slopes[:, -1:] = chords[:, :1], chords[:, -1:]
    slopes[:, 1:-1] = chords[:, :-1] + steps[:, :-1] / (steps[:, :-1] + steps[:, 1:]) * np.diff(chords, axis=1)
    slopes[:, ::KEYS] *= start
    slopes[:, KEYS - 1 :: KEYS] *= rest
    into = slopes.copy()
    into[:, STRIKE::KEYS] = _STRIKE_INTO * chords[:, STRIKE - 1 :: KEYS]
    slopes[:, STRIKE::KEYS] = _STRIKE_OUT * chords[:, STRIKE::KEYS]
    return power_form(values.reshape(flat), (steps, chords), into, slopes)


def _shares_near_top() -> Array:
    """The measured stroke alone about its highest, (moments, 4): every joint in shares of its peak."""
    times = np.concatenate((-BEFORE_S, np.zeros((4, 1)), REBOUND_S, REST_S), 1)
    values = np.concatenate((SHARE_BEFORE, np.zeros((4, 1)), SHARE_REBOUND, np.zeros((4, 1))), 1)
    rows = through(times[:, None], values[:, None], 0.0, 0.0)
    moments = np.array([-0.24, -0.21, -0.18, -0.15, -0.12, -0.10, -0.08])
    return np.stack([SplineChannels(times[j], rows[j, :, None]).many(moments)[0] for j in range(4)], 1)


SHARES_NEAR_TOP = _shares_near_top()
"""Shares of the peaks (moments, 4) about the time when the tip is highest: the higher the stroke, the earlier."""
SHARE_AT_TOP = SHARES_NEAR_TOP[2][:, None]
