"""The body's keyframes under a style: twist, sway, bob, posture (thesis § 4.2.1, figures 4.11–4.15).

Two keys a beat: forward on the beat, upright between; in half time, where the beat is fast, forward on every other beat
from the bar's first. The twist faces what is struck, between them where both hands strike, under a ceiling of its speed
that looks ahead, so that the body turns before the stroke. Where a stroke is out of the arm's reach the trunk leans to
it. The head bobs to the beat, to every other beat or to the half beats, tilts from side to side with it, and lifts
before the music starts again after a silence.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.body.beats import Beats
from station.motion.kinematics.posture import TWIST_SHARE
from station.motion.kinematics.splines import SplineChannels, cubics, slopes
from station.motion.style.style import Style

Array = NDArray[np.float64]

SPLINE_RUSH = 1.5
"""Between keys that lie evenly a spline is at most so much faster than the straight line."""
TWIST_WINDOW_S = 0.35
"""The torso follows the middle of what is struck within this time to each side (our choice)."""
REST_S, TURN_BACK_S = 3.5, 1.5
"""In rests of this length the torso turns back to straight ahead, within so long after the stroke (our choice)."""
SWAY_RAD, SIDE_RAD, BOB_RAD, TILT_RAD = np.radians((3.0, 2.5, 9.0, 6.0))
"""Sway of the back forward and sideways, bob and tilt of the head at the natural setting (our choice)."""
LIFT = 0.5
"""Before the music starts again the head goes back by this share of a full bob (a wish of SMED's users; our choice)."""
SLOW_BOB, FAST_BOB = 0.75, 1.5
"""Under and from so many bobs a beat the head bobs on every other beat and on the half beats."""
SHRUG_M = 0.012
"""How far the shoulders rise on the beat at the natural setting (our choice)."""

CHANNELS = ("twist", "lean", "side", "shrug", "wing", "stand", "gaze", "breath")


def limited(times_s: Array, angles: Array, speed: Array) -> Array:
    """`angles` (n,) bent as little as is needed for no two to be farther apart than the `speed` (n,) there allows."""
    ramp = np.concatenate(([0.0], np.cumsum(speed[:-1] * np.diff(times_s))))
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

    `time_s`, `bars`, `bearing` and `bob`, the cofactors, at the beats and the middles, each (2n − 1,); `restart` (n,)
    the beats on which the music starts again.
    """

    beats: Beats
    time_s: Array
    bars: Array
    bearing: Array
    bob: Array
    restart: NDArray[np.bool_]


def keys(ground: Ground, style: Style) -> Array:
    """Values of all `CHANNELS` at the ground's keys, before any reaching, (8, 2n − 1)."""
    bars = ground.bars
    values = np.zeros((len(CHANNELS), len(bars)))
    forward, side = _sway(ground, style)
    twist = style.factor("amplitude_twist", bars) * TWIST_SHARE * ground.bearing
    ceiling = np.radians(style.value("twist_deg_s", bars)) / SPLINE_RUSH
    values[0] = limited(ground.time_s, np.clip(twist, -1.0, 1.0), ceiling)
    back = style.factor("amplitude_back", bars)
    values[1] = np.radians(style.value("posture_deg", bars)) + back * SWAY_RAD * forward
    values[2] = style.factor("amplitude_side", bars) * SIDE_RAD * side
    values[3] = style.factor("shrug", bars) * SHRUG_M * forward
    values[4] = np.radians(style.value("wing_deg", bars))
    values[5] = style.value("stand", bars)
    values[6] = style.factor("amplitude_gaze", bars)
    values[7] = style.factor("breathing", bars)
    return values


def _sway(ground: Ground, style: Style) -> tuple[Array, Array]:
    """How far forward, 0 … 1, and to which side, −1 … 1, the body is at each key, (2n − 1,) each."""
    half_time = ground.beats.rate_bpm > style.value("half_time_bpm", ground.bars[::2])
    down = ~half_time | _odd_beats(ground.beats)
    count = np.arange(len(down))
    to = down * (1.0 - 2.0 * (np.where(half_time, count // 2, count) % 2))
    between = 0.5 * (half_time[:-1] & half_time[1:])
    forward, side = np.zeros(len(ground.bars)), np.zeros(len(ground.bars))
    forward[::2], side[::2] = down, to
    forward[1::2], side[1::2] = between * (down[:-1] * 1.0 + down[1:]), between * (to[:-1] + to[1:])
    return forward, side


def _odd_beats(beats: Beats) -> NDArray[np.bool_]:
    """The first, third … beats of each bar, but not the last before another bar's first."""
    return np.asarray((beats.in_bar % 2 == 0) & ((beats.in_bar + 1 < beats.of_bar) | (beats.of_bar == 1)))


def curves(ground: Ground, style: Style, values: Array) -> SplineChannels:
    """The splines through `values` (8, 2n − 1); the back's frequency makes it fall later or earlier."""
    on_beat, between = sharpness(style.factor("frequency_back", ground.bars))
    steep = np.zeros(values.shape)
    steep[1, ::2], steep[1, 1::2] = on_beat[::2], between[1::2]
    return _spline(ground.time_s, values, steep)


def head_curve(ground: Ground, style: Style) -> SplineChannels:
    """The head's nod, down on the beat by the music's cofactors, and its tilt, to the right and the left in turn."""
    times, bars = _with_quarters(ground.time_s), _with_quarters(ground.bars)
    place = np.arange(len(times)) % 4  # beat, quarter, middle, quarter
    rate = style.value("bobs_per_beat", bars)
    slow, fast = rate < SLOW_BOB, rate >= FAST_BOB
    odd = np.repeat(_odd_beats(ground.beats), 4)[: len(times)]
    down = (place == 0) & (odd | ~slow) | (place == 2) & fast
    amount = style.factor("amplitude_neck", bars) * BOB_RAD
    lift = np.zeros(len(times))
    lift[2::4] = -LIFT * ground.restart[1:]
    nod = amount * np.where(down, _with_quarters(ground.bob), lift)
    halves = np.arange(len(times)) // 2
    side = down * (1.0 - 2.0 * ((halves // np.where(slow, 4, np.where(fast, 1, 2))) % 2))
    tilt = style.factor("amplitude_head_side", bars) * TILT_RAD * side
    steep = np.where(down, *sharpness(style.factor("frequency_neck", bars)))
    kept = (place == 0) | (place == 2) & (fast | ~slow | (lift < 0)) | fast
    return _spline(times[kept], np.stack([nod, tilt])[:, kept], np.stack([steep, np.zeros(len(steep))])[:, kept])


def _with_quarters(values: Array) -> Array:
    """Values at the beats and middles (n,) with the means between them, (2n − 1,)."""
    return np.insert(values, np.arange(1, len(values)), 0.5 * (values[1:] + values[:-1]))


def sharpness(frequency: Array) -> tuple[Array, Array]:
    """How steeply a movement to the beat turns on the beat and between, in shares of the chords; 0 is a round turn.

    A higher frequency than the natural falls late onto the beat and bounces, a lower one falls early and settles.
    """
    return LATE_FALL * np.maximum(frequency - 1, 0.0), EARLY_FALL * np.maximum(1 - frequency, 0.0)


LATE_FALL, EARLY_FALL = 4.0, 2.0
"""Three times the chord, which the greatest frequency nears, is the steepest that does not overshoot (our choice)."""


def _spline(times: Array, values: Array, steep: Array) -> SplineChannels:
    """Through `values` (channels, n); where `steep` is over 0 the slopes at a key are that share of its chords."""
    tension, continuity = np.where(steep > 0, 1 - steep, 0.0), np.where(steep > 0, -1.0, 0.0)
    into, out = slopes(np.broadcast_to(times, values.shape), values, tension, continuity)
    rows = cubics(times[None], values, into, out)
    return SplineChannels(times, np.ascontiguousarray(np.moveaxis(rows, 0, 1)))
