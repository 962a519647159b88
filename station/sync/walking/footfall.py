"""When a foot comes down, from the heel's height alone: the measure against which phases are checked.

A step begins where the heel sinks into the lowest part of its range. Its *contact* is where that fall ends: the first
instant after its fastest at which the heel sinks more slowly than `SETTLED` of it. Its *low* is where the heel is
lowest while it stays down. Both are the textbook's rule for kinematic data, foot low and vertical velocity back near
nothing (O'Connor et al. 2007, Gait & Posture 25:469), and know nothing of joint angles, models and phases.
Time in seconds from the first sample, heights in metres, up positive.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.sync.signals.signal import Signal
from station.sync.walking.mocap_skeleton import SIDES, Skeleton

SMOOTHED_S = 0.04
"""The heel's height is averaged over so long before its velocity is taken (our choice: five frames at 120 Hz)."""
SETTLED = 0.1
"""A fall is over where the heel sinks at a tenth of the fall's greatest speed (our choice; a twentieth or a fifth moves
contacts by 12 and 17 ms in the median, lows not at all)."""
LOW = 0.35
"""A heel is down in the lowest 35 % of its range (O'Connor et al. 2007)."""
LEAST_RANGE_M = 0.1
"""A heel that rises less takes no step: it rises by 0.2 m in a slow walk (our choice)."""
FEWEST = 3
"""Samples that a velocity takes."""
UP = 1
"""The axis that points up in motion capture."""


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """A foot's steps in order: when the heel came down and when it was lowest, both (steps,) in seconds."""

    contact_s: NDArray[np.float64]
    low_s: NDArray[np.float64]


def footfalls(skeleton: Skeleton, signal: Signal) -> tuple[Steps, Steps]:
    """The steps of the right and of the left foot; `skeleton` has heels and moves by the channels of `signal`."""
    places = skeleton.positions(signal.names, signal.values)
    heights = [places[:, skeleton.index(f"{side}heel"), UP] for side in SIDES]
    right, left = (heel_steps(height_m, signal.rate_hz) for height_m in heights)
    return right, left


def heel_steps(height_m: NDArray[np.float64], rate_hz: float) -> Steps:
    """The steps of a heel at `height_m` (n,), `rate_hz` samples a second."""
    if len(height_m) < FEWEST or np.ptp(height_m) < LEAST_RANGE_M:
        return Steps(np.zeros(0), np.zeros(0))
    smooth = _smoothed(height_m, round(SMOOTHED_S * rate_hz))
    speed_m_s = np.gradient(smooth) * rate_hz
    is_down = smooth < smooth.min() + LOW * np.ptp(smooth)
    stances = [(begin, end) for begin, end in _runs(is_down) if begin > 0]
    contacts = [_settled(speed_m_s, begin, end) for begin, end in stances]
    found = [
        (contact, begin + int(np.argmin(smooth[begin:end])))
        for contact, (begin, end) in zip(contacts, stances, strict=True)
        if contact is not None
    ]
    contact, low = np.array(found, np.float64).reshape(-1, 2).T / rate_hz
    return Steps(contact, low)


def _settled(speed_m_s: NDArray[np.float64], begin: int, end: int) -> float | None:
    """Where, in samples, the fall ends that goes on at `begin`; None where the recording ends first."""
    rising = np.flatnonzero(speed_m_s[begin:end] >= 0)
    last = begin + int(rising[0]) if len(rising) else end
    first = begin
    while first > 0 and speed_m_s[first - 1] < 0:
        first -= 1
    fastest = first + int(np.argmin(speed_m_s[first : last + 1]))
    limit = SETTLED * speed_m_s[fastest]
    after = np.flatnonzero(speed_m_s[fastest:end] > limit)
    if not len(after):
        return None
    k = fastest + int(after[0])
    return float(k - (speed_m_s[k] - limit) / (speed_m_s[k] - speed_m_s[k - 1]))


def _smoothed(values: NDArray[np.float64], width: int) -> NDArray[np.float64]:
    """The running mean over `width` samples, made odd; the ends are continued by their own value."""
    half = width // 2
    padded = np.concatenate([np.full(half, values[0]), values, np.full(half, values[-1])])
    return np.convolve(padded, np.full(2 * half + 1, 1 / (2 * half + 1)), "valid")


def _runs(held: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Begin and end of every segment in which `held` is true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], held, [False]]).astype(np.int8)))
    return [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
