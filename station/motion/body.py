"""The body's keyframes under a style: twist, sway, bob, posture (thesis § 4.2.1, figures 4.11–4.15).

Two keys a beat: forward on the beat, upright between, or in half time where the tempo is fast. The twist faces what is
struck, between them where both hands strike, under a ceiling of its speed that looks ahead, so that the body turns
before the stroke. Where a stroke is out of the arm's reach the trunk leans to it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.beats import Beats
from station.motion.posture import TWIST_SHARE
from station.motion.splines import Curves, cubics, slopes
from station.motion.style import Style

Array = NDArray[np.float64]

TWIST_RAD_S = np.radians(90.0)
"""Ceiling of the torso's angular speed (our choice: it turns through the kit in about a second)."""
TWIST_WINDOW_S = 0.35
"""The torso follows the middle of what is struck within this time to each side (our choice)."""
REST_S, TURN_BACK_S = 3.5, 1.5
"""In rests of this length the torso turns back to straight ahead, within so long after the stroke (our choice)."""
SWAY_RAD, SIDE_RAD, BOB_RAD = np.radians((3.0, 2.5, 9.0))
"""Sway of the back forward and sideways and bob of the head at the natural setting (our choice)."""
SHRUG_M = 0.012
"""How far the shoulders rise on the beat at the natural setting (our choice)."""

CHANNELS = ("twist", "lean", "side", "shrug", "wing", "stand")


def limited(times_s: Array, angles: Array, speed: float) -> Array:
    """`angles` (n,) bent as little as is needed for no two of them to be farther apart than `speed` allows."""
    ramp = speed * times_s
    under = np.minimum(
        np.minimum.accumulate(angles - ramp) + ramp, np.minimum.accumulate((angles + ramp)[::-1])[::-1] - ramp
    )
    over = np.maximum(
        np.maximum.accumulate(angles + ramp) - ramp, np.maximum.accumulate((angles - ramp)[::-1])[::-1] + ramp
    )
    return np.asarray(0.5 * (under + over))


def mean_bearing(at_s: Array, strike_s: Array, bearing: Array) -> Array:
    """The mean bearing of what is struck around each time; between strokes it drifts from one to the next.

    `strike_s` (n,) in order; strokes at once count as one, between them (thesis § 4.2.1).
    """
    if not len(strike_s):
        return np.zeros_like(at_s)
    chord = np.cumsum(np.diff(strike_s, prepend=strike_s[0]) > 0.001)
    count = np.bincount(chord)
    times, means = np.bincount(chord, strike_s) / count, np.bincount(chord, bearing) / count
    knots, values = _with_rests(times, means)
    area = np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(knots))))

    def integral(t: Array) -> Array:
        i = np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(knots) - 2)
        u = t - knots[i]
        slope = (values[i + 1] - values[i]) / np.maximum(knots[i + 1] - knots[i], 1e-9)
        return np.asarray(area[i] + values[i] * u + 0.5 * slope * u * u)

    window = TWIST_WINDOW_S
    return (integral(at_s + window) - integral(at_s - window)) / (2 * window)


def _with_rests(times: Array, bearings: Array) -> tuple[Array, Array]:
    """The bearings with the torso straight ahead in long rests, and before the first and after the last stroke."""
    long = np.flatnonzero(np.diff(times) > REST_S)
    rests = np.concatenate((times[long] + TURN_BACK_S, times[long + 1] - TURN_BACK_S))
    ends = np.array([times[0] - 60.0, times[0] - TURN_BACK_S, times[-1] + TURN_BACK_S, times[-1] + 60.0])
    knots = np.concatenate((times, rests, ends))
    values = np.concatenate((bearings, np.zeros(len(rests) + len(ends))))
    order = np.argsort(knots, kind="stable")
    return knots[order], values[order]


@dataclass(frozen=True, eq=False)
class Ground:
    """What the body's keys stand on and no style changes: beats and middles, their bars from 1, bearings, bobs.

    `time_s`, `bars`, `bearing`, `tempo_bpm` and `bob`, the cofactors, at the beats and the middles, each (2n − 1,).
    """

    beats: Beats
    time_s: Array
    bars: Array
    bearing: Array
    tempo_bpm: Array
    bob: Array


def keys(ground: Ground, style: Style) -> Array:
    """Values of all `CHANNELS` at the ground's keys, before any reaching, (6, 2n − 1)."""
    bars = ground.bars
    values = np.zeros((len(CHANNELS), len(bars)))
    phase = np.pi * (np.arange(len(bars)) - 2 * np.argmax(ground.beats.count == 0))  # a turn of 2π each beat
    phase = np.where(ground.tempo_bpm > style.value("half_time_bpm", bars), phase / 2, phase)
    forward = 0.5 * (1 + np.cos(phase))
    twist = style.factor("amplitude_twist", bars) * TWIST_SHARE * ground.bearing
    values[0] = limited(ground.time_s, np.clip(twist, -1.0, 1.0), TWIST_RAD_S)
    back = style.factor("amplitude_back", bars)
    values[1] = np.radians(style.value("posture_deg", bars)) + back * SWAY_RAD * forward
    values[2] = style.factor("amplitude_side", bars) * SIDE_RAD * np.cos(phase / 2)
    values[3] = style.factor("shrug", bars) * SHRUG_M * forward
    values[4] = np.radians(style.value("wing_deg", bars))
    values[5] = style.value("stand", bars)
    return values


def curves(ground: Ground, style: Style, values: Array) -> Curves:
    """The splines through `values` (6, 2n − 1); the back's frequency makes its turn on the beat rounder or sharper."""
    continuity = np.zeros(values.shape)
    continuity[1, ::2] = sharpness(style.factor("frequency_back", ground.bars[::2]))
    return _spline(ground.time_s, values, continuity)


def bob_curve(ground: Ground, style: Style) -> Curves:
    """The head's bob: down on every beat, or every half beat, by the music's cofactors."""
    depth = style.factor("amplitude_neck", ground.bars) * BOB_RAD * ground.bob
    sharp = sharpness(style.factor("frequency_neck", ground.bars))
    times = ground.time_s
    if style.bobs_per_beat >= 2:  # the keys between are the quarters
        between = 0.5 * (times[1:] + times[:-1])
        times = np.insert(times, np.arange(1, len(times)), between)
        depth, sharp = (np.insert(x, np.arange(1, len(x)), 0.0) for x in (depth, sharp))
    down = (np.arange(len(times)) % 2 == 0) * depth
    return _spline(times, down[None], np.where(np.arange(len(times)) % 2 == 0, sharp, 0.0)[None])


def sharpness(frequency: Array) -> Array:
    """The continuity at the turning point: 0 natural, −1 a sharp turn at the greatest frequency, rounder below it."""
    return np.where(frequency > 1, np.maximum(1 - frequency, -0.99), 0.6 * (1 - frequency))


def _spline(times: Array, values: Array, continuity: Array) -> Curves:
    into, out = slopes(np.broadcast_to(times, values.shape), values, 0.0, continuity)
    rows = cubics(times[None], values, into, out)
    return Curves(times, np.ascontiguousarray(np.moveaxis(rows, 0, 1)))
