"""Where strokes set in within a recording, to a fraction of a millisecond.

Coarsely by the rise of the energy from one millisecond to the next, then exactly by Akaike's criterion: the frame that
best divides what is before from what is after, both taken as noise of their own variance (N. Maeda, "A method for
reading and checking phase times in auto-processing system of seismic wave data", Zisin 38, 1985). Neither polarity nor
level nor clipping matters. Hum and the rumble of a stand are filtered out before, causally, lest a stroke sound sooner.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

Floats = NDArray[np.float64]

WINDOW_S = 0.001
BEFORE_WINDOWS = 20
RISE = 6.0
"""An onset has so many times the energy of the `BEFORE_WINDOWS` before it: 8 dB (our choice)."""
OVER_NOISE = 10.0
"""And so many times that of the recording's quiet half: 10 dB (our choice)."""
LOW_CUT_HZ = 400.0
"""Third order: mains hum falls by 54 dB, the attack of a stick remains (our choice)."""
DEAD_S = 0.05
"""After an onset the next one follows so late at the earliest; the rebound of a stroke is no other (our choice)."""
BACK_S, AHEAD_S = 0.010, 0.003
"""Where the exact onset is looked for, about the coarse one."""
_RINGS = 16
"""So many periods of `LOW_CUT_HZ` after a sound the filter has fallen silent."""
_EDGE = 8
"""Frames that either side of the division must have for a variance."""
_FLOOR = 1e-14
"""Variance of a perfect silence: −140 dB."""


def onsets(sound: NDArray[np.float32], rate_hz: int) -> Floats:
    """The frames at which strokes set in in one channel (n,), in order: (k,)."""
    if len(sound) == 0:
        return np.empty(0)
    sharp = without_hum(sound, rate_hz)
    return np.array([exact(sharp, frame, rate_hz) for frame in _coarse(sharp, rate_hz)])


def without_hum(sound: NDArray[np.float32], rate_hz: int) -> Floats:
    """`sound` (n,) through a causal Butterworth high-pass, by the response of its bilinear transform."""
    size = 1 << (len(sound) + round(rate_hz / LOW_CUT_HZ * _RINGS) - 1).bit_length()
    z = np.exp(2j * np.pi * np.fft.rfftfreq(size))
    u, v = (z - 1) / np.tan(np.pi * LOW_CUT_HZ / rate_hz), z + 1
    response = u**3 / (u**3 + 2 * u**2 * v + 2 * u * v**2 + v**3)
    filtered: Floats = np.fft.irfft(np.fft.rfft(np.asarray(sound, np.float64), size) * response, size)[: len(sound)]
    return filtered


def _coarse(sharp: Floats, rate_hz: int) -> list[int]:
    """The first frame of each millisecond in which the energy jumps."""
    width = max(1, round(WINDOW_S * rate_hz))
    energy = (sharp[: len(sharp) // width * width].reshape(-1, width) ** 2).mean(axis=1) + _FLOOR
    if len(energy) <= BEFORE_WINDOWS:
        return []
    before = sliding_window_view(energy, BEFORE_WINDOWS).mean(axis=1)[:-1]
    now = energy[BEFORE_WINDOWS:]
    loud = np.flatnonzero((now > RISE * before) & (now > OVER_NOISE * np.median(energy)))
    found: list[int] = []
    for window in loud + BEFORE_WINDOWS:
        if not found or (window * width - found[-1]) > DEAD_S * rate_hz:
            found.append(int(window * width))
    return found


def exact(sharp: Floats, near: int, rate_hz: int) -> float:
    """The frame about `near` that divides the quiet before a stroke from the stroke."""
    first = max(near - round(BACK_S * rate_hz), 0)
    part = sharp[first : near + round(AHEAD_S * rate_hz)]
    count = np.arange(_EDGE, len(part) - _EDGE)
    if len(count) == 0:
        return float(near)
    squares = np.cumsum(part**2)
    before = squares[count - 1] / count
    after = (squares[-1] - squares[count - 1]) / (len(part) - count)
    split = count * np.log(before + _FLOOR) + (len(part) - count) * np.log(after + _FLOOR)
    return float(first + count[int(split.argmin())])
