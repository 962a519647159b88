"""The stroke: keyframes of shoulder, elbow, wrist and stick about each strike, as offsets from the contact's angles.

SMED's three keyframes, preparation, strike and rebound, are the frame (thesis § 4.2). A whip needs more: each joint
has a start, a middle and a top of its preparation, two keys on the way down, the strike, the rebound and the rest
after it, each joint at times of its own. The template is read off the one measured full stroke (`data/stroke`, Pearl
2023, doi 10.1101/2023.10.09.561270: 100 bpm, tip 56 cm high), time zero moved 5 ms before the tip's lowest sample,
where its undisturbed fall meets the head. Offsets are zero at the strike, so that neither sliders nor the body's
movement can take the tip off the drum. Seconds, radians, metres; joints in the order of `arm.Offsets`.

Where strikes are near, the preparation is squeezed first; then rebound and preparation run into one another, and
nearer still the amplitude shrinks in proportion to the gap (thesis figure 4.10).
"""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from struct import Struct

import numpy as np
from numpy.typing import NDArray

from station.motion.arm import ArmLengths, Offsets
from station.motion.splines import Curves, cubics, slopes

Array = NDArray[np.float64]

WRIST = 2
KEYS = 8
"""Keys of a joint for each strike: start, middle, top, two on the way down, strike, rebound, rest."""
_STRIKE = 5

# --- the measured stroke ----------------------------------------------------------------------------------------------

FULL_HEIGHT_M = 0.56
PEAK_RAD = np.radians([[19.2], [23.0], [33.2], [15.5]])
"""How far each joint goes in a stroke from full height."""
_BEFORE_S = np.array(
    [
        [0.540, 0.465, 0.340, 0.190, 0.090],
        [0.520, 0.390, 0.145, 0.075, 0.040],
        [0.540, 0.440, 0.103, 0.036, 0.014],
        [0.520, 0.160, 0.034, 0.020, 0.010],
    ]
)
"""Start, middle, top and two on the way down: seconds before the strike."""
_SHARE_BEFORE = np.array(
    [
        [0.00, 0.66, 1.00, 0.53, -0.04],
        [0.00, 0.07, 1.00, 0.62, 0.28],
        [0.00, 0.55, 1.00, 0.70, 0.25],
        [0.00, 0.47, 1.00, 0.88, 0.70],
    ]
)
"""The same keys' values in shares of the joint's peak (the rest's height comes on top, for the wrist)."""
_LONGEST_S = 0.540
_REBOUND_S = np.array([[0.050], [0.040], [0.046], [0.027]])
_SHARE_REBOUND = np.array([[0.0], [-0.06], [0.28], [0.76]])
_REST_S = np.array([[0.100], [0.100], [0.110], [0.085]])
"""When each joint rests again after the strike."""
_DOWN_S = 0.150
"""The whip proper: this part of the template keeps its length while the preparation is squeezed."""

# --- what changes with height and tempo: our choices, each to look as HUMANS describes --------------------------------

_STILL_BELOW_M = np.array([[0.10], [0.06], [0.0], [0.0]])
"""Taps and ghost strokes are wrist and fingers: below these heights shoulder and elbow are still."""
_GROWTH = np.array([[0.8], [0.75], [0.8], [0.65]])
"""How each joint's part grows with the height over that: distal joints are used first (Altenmüller 2020)."""
_TIME_GROWTH, _RISE_GROWTH = 0.25, 0.18
"""The times of a stroke and of its preparation grow with its height to these powers: a stroke that is twice as high is
much faster, and takes hardly longer to raise."""
_LEAST_HEIGHT_M = 1e-3
"""Even a stroke of no height takes its time, that of one of this height (our choice)."""
_REST_SHARE = 0.6
"""Between strokes that are far apart the tip rests no higher than this share of the next (our choice)."""
_FULL_GAP_S = 0.16
_FULL_GAP_HEIGHT_M = 0.15
"""A repetition in `_FULL_GAP_S` leaves room for a stroke of `_FULL_GAP_HEIGHT_M`; the time goes with its root."""
_REBOUND_IN_REST = 0.6
_SHORT_REST = 0.5
"""Where strokes are near, the rest after a stroke is shortened to this share before the preparation is."""
_LEAST_PAUSE = 0.03
"""Share of the gap that lies at least between the rest after a strike and the start of the next."""
_LONG_S = 10.0
"""The gap before the first and after the last strike."""
_SHARE_MERGED = np.array([0.0, 0.85, 1.0, 0.7, 0.25])
_MERGED_REBOUND, _MERGED_REST = 0.3, 0.5
"""Where rebound and preparation are one: a plain rise from the strike to the next top, and down."""

# --- how the splines pass each key: start, middle, top, down, down, strike, rebound, rest -----------------------------

_STRIKE_INTO = np.array([[1.0], [1.0], [0.8], [1.0]])
_STRIKE_OUT = np.array([[1.0], [1.0], [0.65], [2.35]])
"""Slopes at the strike in shares of the chords before and after it: the wrist already slows down, the stick does not,
and it leaves the head at half the speed (rebound ratio 0.51)."""
_START_TENSION, _REST_TENSION = 1.0, 1.0
_TENSION = np.zeros((4, KEYS))
_TENSION[:, 5:6] = 1 - (_STRIKE_INTO + _STRIKE_OUT) / 2
_BIAS = np.zeros((4, KEYS))
_BIAS[:, 5:6] = (_STRIKE_INTO - _STRIKE_OUT) / (_STRIKE_INTO + _STRIKE_OUT)
_CONTINUITY = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0])


def _shares_near_top() -> Array:
    """The measured stroke alone about its highest, (moments, 4): every joint in shares of its peak."""
    times = np.concatenate((-_BEFORE_S, np.zeros((4, 1)), _REBOUND_S, _REST_S), 1)
    values = np.concatenate((_SHARE_BEFORE, np.zeros((4, 1)), _SHARE_REBOUND, np.zeros((4, 1))), 1)
    tension = _TENSION.copy()
    tension[:, 0], tension[:, -1] = _START_TENSION, _REST_TENSION
    into, out = slopes(times, values, tension, np.tile(_CONTINUITY, (4, 1)), _BIAS)
    rows = cubics(times, values, into, out)
    moments = np.array([-0.24, -0.21, -0.18, -0.15, -0.12, -0.10, -0.08])
    return np.stack([Curves(times[j], rows[j, :, None]).many(moments)[0] for j in range(4)], 1)


_SHARES_NEAR_TOP = _shares_near_top()
"""Shares of the peaks (moments, 4) about the time when the tip is highest: the higher the stroke, the earlier."""
_SHARE_AT_TOP = _SHARES_NEAR_TOP[2][:, None]


@dataclass(frozen=True, slots=True)
class Sliders:
    """What a style does to the strokes, joint by stroke, (4, n) or (4, 1); 1 is as measured.

    `gain` multiplies the amplitudes, `speed` the pace, and `whip` the time between the joints' peaks.
    """

    gain: Array
    speed: Array
    whip: Array


NATURALLY = Sliders(np.ones((4, 1)), np.ones((4, 1)), np.ones((1, 1)))
"""The sliders of a natural drummer."""


def amplitudes(height_m: Array, contact_angles: Array, lengths: ArmLengths, parts: Array, turns: Array) -> Array:
    """How far each joint goes (4, n) so that the tip rises `height_m` (n,) over the contact.

    `contact_angles` (4, n) are those of upper arm, forearm, hand and stick from hanging straight down, at the contact;
    `parts` (4, 1) what the hold makes of each joint's part, 1 as measured; `turns` (n,) or (1,) as in `Contact`.
    """
    full = np.maximum(FULL_HEIGHT_M - _STILL_BELOW_M, 1e-9)
    part = np.clip((height_m - _STILL_BELOW_M) / full, 0.0, 1.5) ** _GROWTH * PEAK_RAD * parts
    scale = np.ones_like(height_m)
    for _ in range(4):  # Newton: the rise is nearly linear in the scale
        rise, slope = _rise(scale * part, contact_angles, lengths, turns)
        scale = np.clip(scale * (1 - (rise - height_m) / np.maximum(slope, 1e-3)), 0.2, 4.0)
    result: Array = scale * part
    return result


def _rise(amplitude: Array, contact_angles: Array, lengths: ArmLengths, turns: Array) -> tuple[Array, Array]:
    """How high the tip goes, (n,), and how that grows with a common factor on `amplitude` (4, n)."""
    segments = np.array([[lengths.upper], [lengths.fore], [lengths.hand], [lengths.ahead]])
    offsets = _SHARES_NEAR_TOP[..., None] * amplitude  # (moments, 4, n)
    turn = np.cumsum(offsets, axis=1)
    turn[:, 2] -= (1 - turns) * offsets[:, WRIST]
    angles = contact_angles + turn
    rise = (segments * (np.cos(contact_angles) - np.cos(angles))).sum(1)
    slope = (segments * turn * np.sin(angles)).sum(1)
    highest = np.argmax(rise, axis=0)[None]
    return np.take_along_axis(rise, highest, 0)[0], np.take_along_axis(slope, highest, 0)[0]


def rebounds(
    amplitude: Array,
    height_m: Array,
    doubled: NDArray[np.bool_],
    bounced: NDArray[np.bool_],
    levers: tuple[float, Array],
) -> Array:
    """`amplitude` (4, n), but that the stick and the fingers alone raise `doubled` and `bounced` strokes (n,).

    Between the two strokes of a double the wrist goes on down a little, so that it makes one motion of both; it stays
    where it is while a pressed stick bounces. `levers` in metres: from the fulcrum to the tip, and (n,) what
    the wrist turns.
    """
    ahead, turned = levers
    dip = np.where(doubled, np.minimum(_DIP_RAD, _DIP_SHARE * height_m / ahead), 0.0)
    stick = (height_m + dip * turned) / ahead
    zero = np.zeros_like(dip)
    result: Array = np.where(doubled | bounced, np.stack([zero, zero, -dip, stick]) / _SHARE_AT_TOP, amplitude)
    return result


_REBOUNDS_AGAIN = 0.3
"""What fingers alone have struck rebounds from so much less (our choice)."""
_DIP_RAD, _DIP_SHARE = 0.03, 0.5
"""How far the wrist goes on down within a double, and at most in shares of the second stroke's angle (our choice)."""


def top(amplitude: Array) -> Array:
    """The offsets (4, n) of strokes with `amplitude` (4, n) about where the tip is highest."""
    result: Array = amplitude * _SHARE_AT_TOP
    return result


@dataclass(frozen=True, eq=False)
class StrokePlan:
    """What the strokes of one hand need: `strike_s` (n,), rising, each from `height_m` (n,).

    `rebounds` (n,) come out of the stroke before them, moved by the fingers alone.

    `amplitude` (4, n) is what `amplitudes` and `rebounds` give, `ceiling` (4, n) what the joints' limits leave, `most`
    (n,) how often the height is the highest that has room, `lever_m` the distance from wrist to tip, and `rest_m` how
    high the tip rests.
    """

    strike_s: Array
    height_m: Array
    amplitude: Array
    rebounds: NDArray[np.bool_]
    ceiling: Array
    most: Array
    lever_m: float
    rest_m: float


_CUBIC = Struct("4d")


@dataclass(frozen=True, eq=False)
class Strokes:
    """The keyed offsets of one hand: `strike_s` (n,), `knots_s` (4, n · KEYS) and their `cubics` (4, n · KEYS, 4)."""

    strike_s: Array
    knots_s: Array
    cubics: Array

    @classmethod
    def of(cls, plan: StrokePlan, sliders: Sliders) -> "Strokes":
        """The keyframes of `plan` under `sliders`."""
        strike_s, height_m = plan.strike_s, plan.height_m
        gaps = np.concatenate(([_LONG_S], np.diff(strike_s), [_LONG_S]))
        room = gaps[:-1] / (_FULL_GAP_S * np.sqrt(np.maximum(height_m, 0.01) / _FULL_GAP_HEIGHT_M))
        own = np.where(plan.rebounds, sliders.gain[3:], sliders.gain)  # one motion of all joints
        gain = np.minimum(own * np.minimum(room, 1.0), plan.most)
        peak = np.minimum(plan.amplitude * gain, plan.ceiling)
        n = len(strike_s)
        times, merged = _times(strike_s, gaps, np.maximum(height_m * gain.mean(0), _LEAST_HEIGHT_M), sliders)
        merged[:, plan.rebounds] = 1.0
        struck = np.where(plan.rebounds, _REBOUNDS_AGAIN, 1.0) * np.maximum(peak, 0.0)
        values = _values(times, merged, (peak, struck), np.minimum(plan.rest_m, _REST_SHARE * height_m) / plan.lever_m)
        tension = np.tile(_TENSION[:, None, :], (1, n, 1))
        tension[..., 0] = _START_TENSION * (1 - merged)
        tension[..., 7] = _REST_TENSION * (1 - _merged_after(merged))
        flat = (4, n * KEYS)
        times, values = times.reshape(flat), values.reshape(flat)
        into, out = slopes(times, values, tension.reshape(flat), np.tile(_CONTINUITY, n), np.tile(_BIAS, n))
        return cls(strike_s, times, cubics(times, values, into, out))

    @cached_property
    def _fast(self) -> tuple[memoryview, list[tuple[memoryview, memoryview]]]:
        """The strikes, and of each joint the knots and cubics, as buffers: read one by one they beat arrays."""
        joints = [(k.data, c.data.cast("B")) for k, c in zip(self.knots_s, self.cubics, strict=True)]
        return self.strike_s.data, joints

    def at(self, time_s: float) -> list[float]:
        """The offsets at one instant, in `Offsets`' order."""
        strikes, joints = self._fast
        first = max((bisect_right(strikes, time_s) - 1) * KEYS + _STRIKE, 0)
        last = min(first + KEYS, len(strikes) * KEYS)
        result = []
        for knots, rows in joints:
            k = bisect_right(knots, time_s, first, last) - 1
            if k < first:
                result.append(_CUBIC.unpack_from(rows, first * _CUBIC.size)[0])
                continue
            a, b, c, d = _CUBIC.unpack_from(rows, k * _CUBIC.size)
            u = time_s - knots[k]
            result.append(((d * u + c) * u + b) * u + a)
        return result

    def many(self, time_s: Array) -> Offsets:
        """The offsets at each time."""
        return Offsets(
            *(Curves(k, c[:, None, :]).many(time_s)[0] for k, c in zip(self.knots_s, self.cubics, strict=True))
        )


def _next(per_stroke: Array) -> Array:
    """Of each stroke, the value of the stroke after it; the last is its own neighbour."""
    return np.concatenate((per_stroke[:, 1:], per_stroke[:, -1:]), 1)


def _merged_after(merged: Array) -> Array:
    """How far the rebound of each stroke is merged with what follows; nothing follows the last."""
    return np.concatenate((merged[:, 1:], np.zeros((4, 1))), 1)


def _times(strike_s: Array, gaps: Array, height_m: Array, sliders: Sliders) -> tuple[Array, Array]:
    """Times (4, n, KEYS) of all keys, and how far each preparation (4, n) is merged with the rebound before it, 0 … 1.

    `gaps` (n + 1,) before and after each strike.
    """
    before = gaps[:-1]
    pace = (np.maximum(height_m, _LEAST_HEIGHT_M) / FULL_HEIGHT_M) ** _TIME_GROWTH / sliders.speed
    rise = (height_m / FULL_HEIGHT_M) ** _RISE_GROWTH / sliders.speed
    down = np.minimum(pace, 0.5 * before / _DOWN_S)
    # what the whip leaves of the gap is shared by the rest after the last stroke and the preparation
    left = (1 - _LEAST_PAUSE) * before - _DOWN_S * down
    whole_rest = np.concatenate((np.zeros((4, 1)), (_REST_S * pace)[:, :-1]), 1)
    lacking = np.maximum(whole_rest + (_LONGEST_S - _DOWN_S) * rise - left, 0.0)
    rest_before = np.maximum(whole_rest - lacking, np.minimum(_SHORT_REST * whole_rest, 0.3 * before))
    up = np.clip((left - rest_before) / (_LONGEST_S - _DOWN_S), 0.0, rise)
    rest = np.concatenate((rest_before[:, 1:], (_REST_S * pace)[:, -1:]), 1)
    times = np.empty((4, len(strike_s), KEYS))
    together = _BEFORE_S.mean(0)
    whip, share = np.atleast_2d(sliders.whip)[..., None], _BEFORE_S[:, None, :] / together
    # what comes late is put off by shares of the time that is left, so that it never comes after the strike
    ahead = together * np.where((share < 1) & (whip > 1), share**whip, 1 + whip * (share - 1))
    falling, rising = np.minimum(ahead, _DOWN_S), np.maximum(ahead - _DOWN_S, 0.0)
    times[..., :5] = strike_s[:, None] - falling * down[..., None] - rising * up[..., None]
    times[..., 5] = strike_s
    times[..., 6] = strike_s + np.minimum(_REBOUND_S * pace, _REBOUND_IN_REST * rest)
    times[..., 7] = strike_s + rest
    return times, 1.0 - up / rise


def _values(times: Array, merged: Array, peaks: tuple[Array, Array], hold: Array) -> Array:
    """Values (4, n, KEYS) of all keys.

    `peaks` (4, n) how far the joints go before each strike, and what they rebound from; `hold` (n,) the wrist's angle
    of rest before each strike.
    """
    peak, struck = peaks
    values = np.zeros_like(times)
    m, m_after, peak_after = merged[..., None], _merged_after(merged), _next(peak)
    held = np.zeros_like(peak)
    held[WRIST] = hold * (1 - merged[WRIST])
    # merged, the joints' tops come together: each goes less far for the same height of the tip
    values[..., :5] = peak[..., None] * (
        _SHARE_BEFORE[:, None, :] * (1 - m) + _SHARE_AT_TOP[..., None] * _SHARE_MERGED * m
    )
    values[..., 1] += 0.5 * held
    together = _SHARE_AT_TOP * peak_after
    low = np.minimum(1.0, 0.35 + 0.65 * peak_after / np.maximum(peak, 1e-6))  # a down stroke keeps the stick low
    values[..., 6] = _SHARE_REBOUND * struck * low * (1 - m_after) + _MERGED_REBOUND * together * m_after
    values[..., 7] = _next(held) + _MERGED_REST * together * m_after
    # merged, the start is no key of its own but a point between the rest before it and the middle
    rest_t, rest_v = times[:, :-1, 7], values[:, :-1, 7]
    start_t, middle_t, middle_v = times[:, 1:, 0], times[:, 1:, 1], values[:, 1:, 1]
    between = rest_v + (middle_v - rest_v) * (start_t - rest_t) / np.maximum(middle_t - rest_t, 1e-6)
    values[..., 0] += held
    values[:, 1:, 0] += merged[:, 1:] * (between - values[:, 1:, 0])
    return values
