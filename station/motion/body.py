"""The body's keyframes: torso twist, back sway, head bob, from the score's beats and strokes (thesis § 4.2.1).

Two keys a beat: forward on the beat, upright between. The twist faces the struck pieces (between them when both hands
strike), under a ceiling of its speed that looks ahead, so that the body turns before the stroke.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.splines import Curves, cubics, slopes
from station.music.score import Score

Array = NDArray[np.float64]

TWIST_RAD_S = np.radians(90.0)
"""Ceiling of the torso's angular speed (our choice: it turns through the kit in about a second)."""
TWIST_SHARE = 0.55
"""How much of the way to the struck piece the torso turns; eyes and head do the rest (our choice)."""
_TWIST_WINDOW_S = 0.5
"""The torso follows the middle of what is struck within this time to each side (our choice)."""
SWAY_RAD = np.radians(3.0)
BOB_RAD = np.radians(7.0)
"""Sway of the back and bob of the head on each beat, at the natural settings (our choice)."""

CHANNELS = ("twist", "lean", "side", "nod", "turn", "tilt")


def beat_times(score: Score, lead_in_s: float = 8.0) -> Array:
    """Times of every beat from before the score's start to after its end, and of the middles between."""
    ticks = np.array([tick for tick, _ in score.tempo_map.beats_between(0, max(score.end_tick, 1))], np.int64)
    beats = score.tempo_map.seconds_at(np.append(ticks, score.end_tick))
    step = float(beats[1] - beats[0]) if len(beats) > 1 else 0.5
    count = int(lead_in_s / step)
    last = float(beats[-1] - beats[-2]) if len(beats) > 1 else 0.5
    beats = np.concatenate((beats[0] - step * np.arange(count, 0, -1), beats, beats[-1] + last * np.arange(1, 5)))
    return beats


def limited(times_s: Array, angles: Array, speed_rad_s: float) -> Array:
    """`angles` (n,) bent as little as is needed for no two of them to be farther apart than the speed allows."""
    ramp = speed_rad_s * times_s
    under = np.minimum(
        np.minimum.accumulate(angles - ramp) + ramp, np.minimum.accumulate((angles + ramp)[::-1])[::-1] - ramp
    )
    over = np.maximum(
        np.maximum.accumulate(angles + ramp) - ramp, np.maximum.accumulate((angles - ramp)[::-1])[::-1] + ramp
    )
    middle: Array = 0.5 * (under + over)
    return middle


def facing(at_s: Array, strike_s: Array, bearing_rad: Array) -> Array:
    """The mean bearing of what is struck around each time; between strokes it drifts from one to the next."""
    if not len(strike_s):
        return np.zeros_like(at_s)
    together = np.unique(np.round(strike_s, 3), return_inverse=True)[1]
    count = np.bincount(together)
    times = np.bincount(together, strike_s) / count
    means = np.bincount(together, bearing_rad) / count
    knots = np.concatenate(([times[0] - 60.0], times, [times[-1] + 60.0]))
    values = np.concatenate((means[:1], means, means[-1:]))
    area = np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(knots))))

    def integral(t: Array) -> Array:
        i = np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(knots) - 2)
        u = t - knots[i]
        slope = (values[i + 1] - values[i]) / np.maximum(knots[i + 1] - knots[i], 1e-9)
        whole: Array = area[i] + values[i] * u + 0.5 * slope * u * u
        return whole

    mean: Array = (integral(at_s + _TWIST_WINDOW_S) - integral(at_s - _TWIST_WINDOW_S)) / (2 * _TWIST_WINDOW_S)
    return mean


def body_curves(beats_s: Array, bearing: Array, factors: tuple[float, float, float], posture_rad: float) -> Curves:
    """Keys of all `CHANNELS` at every beat and middle; `bearing` at those; `factors` of back, neck and twist."""
    back, neck, turn = factors
    times = np.sort(np.concatenate((beats_s, 0.5 * (beats_s[1:] + beats_s[:-1]))))
    on_beat = (np.arange(len(times)) % 2 == 0).astype(np.float64)
    values = np.zeros((len(CHANNELS), len(times)))
    values[0] = limited(times, TWIST_SHARE * turn * bearing, TWIST_RAD_S)
    values[1] = posture_rad + back * SWAY_RAD * on_beat
    values[3] = neck * BOB_RAD * on_beat
    values[4] = (1 - TWIST_SHARE) * 0.6 * bearing
    into, out = slopes(times, values)
    rows = cubics(np.broadcast_to(times, values.shape), values, into, out)
    return Curves(times, np.ascontiguousarray(np.moveaxis(rows, 0, 1)))
