"""Kochanek–Bartels splines: keyframes with tension, continuity and bias, kept as cubics.

The tangents are those of Kochanek and Bartels (SIGGRAPH 1984, equations 8 and 9), written as slopes over time. Where
keys are not evenly spaced each chord weighs by the other step, which is the slope of the parabola through the three
keys; the paper's own adjustment lets a long rest bend the short stroke beside it. Continuity −1 breaks the slope at a
key, as a stick's is at the impact (thesis § 4.3.3). Before the first and after the last key a curve holds its value.
"""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from struct import Struct

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_SHORTEST_S = 1e-6
"""Keys closer than this count as this far apart, so that merged keyframes need no case of their own."""


_CUBIC = Struct("4d")


@dataclass(frozen=True, eq=False)
class SplineChannels:
    """Channels that share their keys: `knots_s` (m,) and `cubics` (m, channels, 4), constant term first."""

    knots_s: Array
    cubics: Array

    @cached_property
    def _fast(self) -> tuple[memoryview, memoryview, int]:
        """The knots, the cubics and the bytes of a key's cubics, as buffers: read one by one they beat arrays."""
        return self.knots_s.data, np.ascontiguousarray(self.cubics).data.cast("B"), self.cubics[0].nbytes

    def at(self, time_s: float) -> list[float]:
        """Every channel at one instant."""
        knots, rows, size = self._fast
        i = bisect_right(knots, time_s) - 1
        u = time_s - knots[i] if i >= 0 else 0.0
        k = i * size if i > 0 else 0
        return [((d * u + c) * u + b) * u + a for a, b, c, d in _CUBIC.iter_unpack(rows[k : k + size])]

    def first(self, time_s: float) -> float:
        """The first channel at one instant."""
        knots, rows, size = self._fast
        i = bisect_right(knots, time_s) - 1
        if i < 0:
            return float(_CUBIC.unpack_from(rows)[0])
        a, b, c, d = _CUBIC.unpack_from(rows, i * size)
        u = time_s - knots[i]
        return float(((d * u + c) * u + b) * u + a)

    def many(self, time_s: ArrayLike) -> Array:
        """Every channel at each time, (channels, n)."""
        t = np.asarray(time_s, np.float64)
        i = np.maximum(np.searchsorted(self.knots_s, t, side="right") - 1, 0)
        u = np.maximum(t - self.knots_s[i], 0.0)[:, None]
        a, b, c, d = np.moveaxis(self.cubics[i], 2, 0)
        values: Array = (((d * u + c) * u + b) * u + a).T
        return values


def slopes(
    times_s: Array, values: Array, tension: ArrayLike = 0.0, continuity: ArrayLike = 0.0, bias: ArrayLike = 0.0
) -> tuple[Array, Array]:
    """Slopes into and out of every key, each (..., m).

    `times_s` (..., m) never falls; `values` (..., m); tension, continuity and bias −1 … 1, one for all or (..., m).
    """
    t, c, b = (np.asarray(x, np.float64) for x in (tension, continuity, bias))
    steps, chords = lines(times_s, values)
    earlier, later = np.ones(values.shape), np.ones(values.shape)
    np.divide(steps[..., :-1], steps[..., :-1] + steps[..., 1:], out=earlier[..., 1:-1])
    np.subtract(1, earlier[..., 1:-1], out=later[..., 1:-1])
    back, forth = np.zeros(values.shape), np.zeros(values.shape)
    back[..., 1:] = forth[..., :-1] = chords
    back *= (1 - t) * (1 + b)
    forth *= (1 - t) * (1 - b)
    later *= back
    earlier *= forth
    into = later + earlier
    if not c.any():
        return into, into
    turn = c * (earlier - later)
    out = into - turn
    into += turn
    broken = np.broadcast_to(c <= -1, into.shape)
    np.copyto(into, back, where=broken)
    np.copyto(out, forth, where=broken)
    return into, out


def monotone_slopes(times_s: Array, values: Array) -> Array:
    """Slopes at every key (..., m) that never overshoot: level at the turns, else the chords' weighted harmonic mean.

    Fritsch and Butland 1984 (SIAM Journal on Scientific and Statistical Computing 5(2), 300–304); level at both ends.
    """
    steps, chords = lines(times_s, values)
    before, after = chords[..., :-1], chords[..., 1:]
    first, second = 2 * steps[..., 1:] + steps[..., :-1], steps[..., 1:] + 2 * steps[..., :-1]
    result = np.zeros(values.shape)
    bottom = first * after + second * before
    on = before * after
    np.divide((first + second) * on, bottom, out=result[..., 1:-1], where=on > 0)
    return result


def cubics(times_s: Array, values: Array, into: Array, out: Array) -> Array:
    """Power form of the Hermite segments, (..., m, 4) from the key's own time on; the last holds the last value."""
    return power_form(values, lines(times_s, values), into, out)


Lines = tuple[Array, Array]
"""The straight lines between keys: how long each takes and its slope, (..., m − 1)."""


def lines(times_s: Array, values: Array) -> Lines:
    """The lines between keys at `times_s` (..., m), which never fall, with `values` (..., m)."""
    steps = np.maximum(np.diff(times_s, axis=-1), _SHORTEST_S)
    return steps, np.diff(values, axis=-1) / steps


def power_form(values: Array, between: Lines, into: Array, out: Array) -> Array:
    """`cubics` from the lines between the keys."""
    (steps, rise), leave, arrive = between, out[..., :-1], into[..., 1:]
    result = np.zeros((*values.shape, 4))
    result[..., 0] = values
    result[..., :-1, 1] = leave
    bend = leave + arrive - 2 * rise
    np.divide(rise - leave - bend, steps, out=result[..., :-1, 2])
    np.divide(bend, steps * steps, out=result[..., :-1, 3])
    return result
