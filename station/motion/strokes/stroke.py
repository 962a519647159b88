"""The stroke: keyframes of shoulder, elbow, wrist and stick about each strike, as offsets from the contact's angles.

Each is the measured stroke (`whip`) with its joints as far as `amplitudes` says. Offsets are zero at the strike, so
that neither sliders nor the body's movement can take the tip off the drum. Seconds, radians, metres; joints in the
order of `arm.Offsets`.

Where strikes are near, the preparation is squeezed and lower (`most_height_m`); then rebound and preparation run into
one another, and nearer still the amplitude shrinks in proportion to the gap (thesis figure 4.10).
"""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from struct import Struct

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import Offsets
from station.motion.kinematics.splines import SplineChannels
from station.motion.strokes.stroke_template import (
    BEFORE_S,
    DOWN_S,
    FULL_HEIGHT_M,
    KEYS,
    LONGEST_S,
    REBOUND_S,
    REST_S,
    SHARE_AT_TOP,
    SHARE_BEFORE,
    SHARE_REBOUND,
    STRIKE,
    WRIST,
    through,
)

Array = NDArray[np.float64]

_TIME_GROWTH, _RISE_GROWTH = 0.25, 0.18
"""The times of a stroke and of its preparation grow with its height to these powers: a stroke that is twice as high is
much faster, and takes hardly longer to raise."""
_LEAST_HEIGHT_M = 1e-3
"""Even a stroke of no height takes its time, that of one of this height (our choice)."""
_REST_SHARE = 0.6
"""Between strokes that are far apart the tip rests no higher than this share of the next (our choice)."""
_TAP_GAP_S, _TAP_HEIGHT_M, _TAP_WANTED_M, _GAP_GROWTH = 0.15, 0.05, 0.15, 3.0
"""At the 6–7 strokes a second that a trained hand keeps up (HUMANS: 5–7 Hz) a stroke of 15 cm comes from 5 cm, a fast
tap (3–6 cm, our choice: no published height at that rate is known). At four a second marching hands still play accents
from 12 inches: from the one to the other the height grows with this power of the time."""
_REBOUND_GAP_S = 0.17
"""A rebound has room for all of its height in this time and for less in proportion (our choice)."""
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
_REBOUNDS_AGAIN = 0.3
"""What fingers alone have struck rebounds from so much less (our choice)."""


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


@dataclass(frozen=True, eq=False)
class StrokePlan:
    """What the strokes of one hand need: `strike_s` (n,), rising, each from `height_m` (n,).

    `rebounds` (n,) come out of the stroke before them, moved by the fingers alone.

    `amplitude` (4, n) is what `amplitudes` and `rebounds` give, `ceiling` (4, n) what the joints' limits leave, `most`
    (n,) how often the height is the highest that has room, `lever_m` the distance from wrist to tip, and `rest_m` (n,)
    how high the tip rests before each.
    """

    strike_s: Array
    height_m: Array
    amplitude: Array
    rebounds: NDArray[np.bool_]
    ceiling: Array
    most: Array
    lever_m: float
    rest_m: Array


def most_height_m(gap_s: Array, wanted_m: Array) -> Array:
    """How high a stick that is wanted at `wanted_m` can rise within `gap_s` after the stroke before.

    Quicker than `_TAP_GAP_S`, where the hand is at its limit, it goes with the gap (thesis figure 4.10). Louder strokes
    are driven harder: by the root of what is wanted, so that accents still stand out.
    """
    quick = gap_s / _TAP_GAP_S
    return np.asarray(_TAP_HEIGHT_M * np.maximum(quick, quick**_GAP_GROWTH) * np.sqrt(wanted_m / _TAP_WANTED_M))


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
        own = np.where(plan.rebounds, sliders.gain[3:], sliders.gain)  # one motion of all joints
        room = most_height_m(gaps[:-1], own * height_m) / np.maximum(height_m, _LEAST_HEIGHT_M)
        room = np.where(plan.rebounds, own * gaps[:-1] / _REBOUND_GAP_S, room)  # the head has thrown these up already
        gain = np.broadcast_to(np.minimum(np.minimum(own, room), plan.most), plan.amplitude.shape)
        gain = np.where(plan.rebounds, np.minimum(gain, np.roll(gain, 1, axis=1)), gain)
        peak = np.minimum(plan.amplitude * gain, plan.ceiling)
        times, merged = _times(strike_s, gaps, np.maximum(height_m * gain.mean(0), _LEAST_HEIGHT_M), sliders)
        merged[:, plan.rebounds] = 1.0
        struck = np.where(plan.rebounds, _REBOUNDS_AGAIN, 1.0) * np.maximum(peak, 0.0)
        values = _values(times, merged, (peak, struck), np.minimum(plan.rest_m, _REST_SHARE * height_m) / plan.lever_m)
        cubics = through(times, values, merged, _merged_after(merged))  # what is merged has no tension
        return cls(strike_s, times.reshape(4, -1), cubics)

    @cached_property
    def _fast(self) -> tuple[memoryview, list[tuple[memoryview, memoryview]]]:
        """The strikes, and of each joint the knots and cubics, as buffers: read one by one they beat arrays."""
        joints = [(k.data, c.data.cast("B")) for k, c in zip(self.knots_s, self.cubics, strict=True)]
        return self.strike_s.data, joints

    def at(self, time_s: float) -> list[float]:
        """The offsets at one instant, in `Offsets`' order."""
        strikes, joints = self._fast
        first = max((bisect_right(strikes, time_s) - 1) * KEYS + STRIKE, 0)
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

    def differ(self, others: "Strokes") -> NDArray[np.bool_]:
        """Where these are not `others` of the same strikes: from each strike to the next, (n,).

        What comes before the first strike is the first one's.
        """
        keys = ((self.cubics != others.cubics).any(2) | (self.knots_s != others.knots_s)).any(0)
        found = np.asarray(np.append(keys[STRIKE:], np.zeros(STRIKE, bool)).reshape(-1, KEYS).any(1))
        found[0] |= keys[:STRIKE].any()
        return found

    def many(self, time_s: Array) -> Offsets:
        """The offsets at each time."""
        return Offsets(
            *(SplineChannels(k, c[:, None, :]).many(time_s)[0] for k, c in zip(self.knots_s, self.cubics, strict=True))
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
    down = np.minimum(pace, 0.5 * before / DOWN_S)
    # what the whip leaves of the gap is shared by the rest after the last stroke and the preparation
    left = (1 - _LEAST_PAUSE) * before - DOWN_S * down
    resting = REST_S * np.where(height_m > _LEAST_HEIGHT_M, pace, 1 / sliders.speed)  # after a wait there is no haste
    whole_rest = np.concatenate((np.zeros((4, 1)), resting[:, :-1]), 1)
    lacking = np.maximum(whole_rest + (LONGEST_S - DOWN_S) * rise - left, 0.0)
    rest_before = np.maximum(whole_rest - lacking, np.minimum(_SHORT_REST * whole_rest, 0.3 * before))
    up = np.clip((left - rest_before) / (LONGEST_S - DOWN_S), 0.0, rise)
    rest = np.concatenate((rest_before[:, 1:], resting[:, -1:]), 1)
    times = np.empty((4, len(strike_s), KEYS))
    together = BEFORE_S.mean(0)
    whip, share = np.atleast_2d(sliders.whip)[..., None], BEFORE_S[:, None, :] / together
    # what comes late is put off by shares of the time that is left, so that it never comes after the strike
    ahead = together * np.where((share < 1) & (whip > 1), share**whip, 1 + whip * (share - 1))
    falling, rising = np.minimum(ahead, DOWN_S), np.maximum(ahead - DOWN_S, 0.0)
    times[..., :5] = strike_s[:, None] - falling * down[..., None] - rising * up[..., None]
    times[..., 5] = strike_s
    times[..., 6] = strike_s + np.minimum(REBOUND_S * pace, _REBOUND_IN_REST * rest)
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
        SHARE_BEFORE[:, None, :] * (1 - m) + SHARE_AT_TOP[..., None] * _SHARE_MERGED * m
    )
    values[..., 1] += 0.5 * held
    together = SHARE_AT_TOP * peak_after
    low = np.minimum(1.0, 0.35 + 0.65 * peak_after / np.maximum(peak, 1e-6))  # a down stroke keeps the stick low
    values[..., 6] = SHARE_REBOUND * struck * low * (1 - m_after) + _MERGED_REBOUND * together * m_after
    values[..., 7] = _next(held) + _MERGED_REST * together * m_after
    # merged, the start is no key of its own but a point between the rest before it and the middle
    rest_t, rest_v = times[:, :-1, 7], values[:, :-1, 7]
    start_t, middle_t, middle_v = times[:, 1:, 0], times[:, 1:, 1], values[:, 1:, 1]
    between = rest_v + (middle_v - rest_v) * (start_t - rest_t) / np.maximum(middle_t - rest_t, 1e-6)
    values[..., 0] += held
    values[:, 1:, 0] += merged[:, 1:] * (between - values[:, 1:, 0])
    return values
