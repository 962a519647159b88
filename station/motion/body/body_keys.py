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

from station.motion.body.beats import Beats, on_odd_beats
from station.motion.body.face import CHANNELS as FACE
from station.motion.body.face import face_keys
from station.motion.body.idle_motion import BREATH_M
from station.motion.body.intensity import Intensity
from station.motion.kinematics.joint_limits import FASTEST_RAD_S
from station.motion.kinematics.posture import TWIST_SHARE
from station.motion.kinematics.splines import SplineChannels, cubics, monotone_slopes
from station.motion.kinematics.wander import wander
from station.motion.style.style import Style

Array = NDArray[np.float64]

SPLINE_RUSH = 1.5
"""Between keys that lie evenly a spline is at most so much faster than the straight line."""
TWIST_WINDOW_S = 0.35
"""The torso follows the middle of what is struck within this time to each side (our choice)."""
REST_S, TURN_BACK_S = 3.5, 1.5
"""In rests of this length the torso turns back to straight ahead, within so long after the stroke (our choice)."""
SWAY_RAD, SIDE_RAD = np.radians((3.0, 2.5))
"""Sway of the back forward and sideways at the natural setting (our choice)."""
PHRASE_LEAN_RAD, PHRASE_SIDE_RAD, PHRASE_BARS = *np.radians((1.5, 2.5)), 4
"""The slow sway with the phrase, of four bars in most music for the drum set, at the natural setting (our choice)."""
FILL_RAD, CRASH_RAD = np.radians((3.5, 3.0))
"""How far the back goes into a fill, and falls onto a crash, at the natural setting (our choice)."""
BANG_LEAN_RAD, SHIMMY_RAD = np.radians((9.0, 7.0))
"""What the back has of head-banging, and how far the shoulders turn to and fro with the beat, at most (our choice)."""
RISE = 0.5
"""How much of standing up the highest rise to a crash is (our choice)."""
DRIFT, DRIFT_S = 0.25, 0.012
"""How much chance makes the sway wider and narrower, and shifts it in time (our choice: under a visible 25 ms)."""
_MOST_LEAN_RAD_S = 0.9 * FASTEST_RAD_S["torso_lean"] / SPLINE_RUSH
SHRUG_M = 0.012
"""How far the shoulders rise on the beat at the natural setting (our choice)."""

CHANNELS = ("twist", "lean", "side", "shrug", "hunch", "wing", "stand", "gaze", "breath", *FACE)


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
    intensity: Intensity


def shifted(ground: Ground, style: Style) -> Array:
    """When the body and the head reach the ground's keys: behind the beat or before it, and as chance has it."""
    bars = ground.bars
    late = style.value("lay_back_ms", bars) / 1000
    late = late + DRIFT_S * style.factor("variation", bars) * wander((style.seed, 7), 1, len(bars))[0]
    room = 0.3 * np.diff(ground.time_s).min(initial=1.0)
    return np.asarray(ground.time_s + np.clip(late, -room, room))


def keys(ground: Ground, style: Style) -> Array:
    """Values of all `CHANNELS` at the ground's keys, before any reaching, (13, 2n − 1)."""
    bars, now, times = ground.bars, ground.intensity, _key_times(ground, style)
    values = np.zeros((len(CHANNELS), len(bars)))
    forward, side = _sway(ground, style)
    drift, *phases = wander((style.seed, 8), 3, len(bars))
    drift = 1 + DRIFT * style.factor("variation", bars) * drift
    forward, side = forward * drift, side * drift
    phrase, turn = style.factor("phrase", bars), 2 * np.pi * (bars - 1) / PHRASE_BARS
    lags = [0.4 * style.factor("variation", bars) * p for p in phases]
    bang = style.value("headbang", bars) / 100
    into, breath = style.factor("fill_lean", bars), style.factor("breathing", bars)
    ceiling = np.radians(style.value("twist_deg_s", bars)) / SPLINE_RUSH
    twist = style.factor("amplitude_twist", bars) * TWIST_SHARE * ground.bearing
    twist = np.clip(twist, -1.0, 1.0) + style.value("shimmy", bars) / 100 * SHIMMY_RAD * side
    values[0] = limited(times, twist, ceiling)
    lean = np.radians(style.value("posture_deg", bars)) + style.factor("amplitude_back", bars) * SWAY_RAD * forward
    lean += into * (FILL_RAD * now.fill + CRASH_RAD * now.fall) + bang * BANG_LEAN_RAD * (forward - 0.5)
    lean += phrase * PHRASE_LEAN_RAD * np.sin(2 * turn + lags[0])
    values[1] = limited(times, lean, np.full(len(bars), _MOST_LEAN_RAD_S))
    values[2] = style.factor("amplitude_side", bars) * SIDE_RAD * side + phrase * PHRASE_SIDE_RAD * np.sin(
        turn + lags[1]
    )
    values[3] = style.factor("shrug", bars) * SHRUG_M * forward + breath * BREATH_M * now.fill  # the breath is held
    values[4] = np.radians(style.value("hunch_deg", bars))
    values[5] = np.radians(style.value("wing_deg", bars))
    values[6] = np.clip(style.value("stand", bars) + style.value("rise", bars) / 100 * RISE * now.rise, 0.0, 1.0)
    values[7] = style.factor("amplitude_gaze", bars)
    values[8] = breath * (1 - now.fill)
    values[9:] = face_keys(now, bars, style)
    return values


def _sway(ground: Ground, style: Style) -> tuple[Array, Array]:
    """How far forward, 0 … 1, and to which side, −1 … 1, the body is at each key, (2n − 1,) each."""
    half_time = ground.beats.rate_bpm > style.value("half_time_bpm", ground.bars[::2])
    down = ~half_time | on_odd_beats(ground.beats)
    count = np.arange(len(down))
    to = down * (1.0 - 2.0 * (np.where(half_time, count // 2, count) % 2))
    between = 0.5 * (half_time[:-1] & half_time[1:])
    forward, side = np.zeros(len(ground.bars)), np.zeros(len(ground.bars))
    forward[::2], side[::2] = down, to
    forward[1::2], side[1::2] = between * (down[:-1] * 1.0 + down[1:]), between * (to[:-1] + to[1:])
    return forward, side


def curves(ground: Ground, style: Style, values: Array) -> SplineChannels:
    """The splines through `values` (13, 2n − 1)."""
    return spline(_key_times(ground, style), values)


def _key_times(ground: Ground, style: Style) -> Array:
    """When the body is at the ground's keys; the back's frequency makes it fall later or earlier."""
    middles = np.arange(len(ground.time_s)) % 2 == 1
    return fallen(shifted(ground, style), middles, style.factor("frequency_back", ground.bars))


def fallen(times: Array, is_up: NDArray[np.bool_], frequency: Array) -> Array:
    """`times` (n,) of keys, those that are `up` (n,) so moved that the way down from them is quick and late or slow.

    A higher frequency than the natural waits and falls late onto the beat, a lower one falls early and settles.
    """
    share = np.where(frequency > 1, LATE_FALL * (frequency - 1), EARLY_FALL * (frequency - 1)) * is_up
    steps = np.diff(times)
    room = np.where(share > 0, np.append(steps, 0.0), np.append(0.0, steps))
    return np.asarray(times + share * room)


LATE_FALL, EARLY_FALL = 0.65, 0.5
"""At the greatest frequency the fall takes half of its natural time, at the least as much more (our choice)."""


def spline(times: Array, values: Array) -> SplineChannels:
    """Through `values` (channels, n), round and never beyond them."""
    slope = monotone_slopes(times[None], values)
    rows = cubics(times[None], values, slope, slope)
    return SplineChannels(times, np.ascontiguousarray(np.moveaxis(rows, 0, 1)))
