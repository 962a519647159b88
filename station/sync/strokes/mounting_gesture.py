"""How each sensor sits on its stick, found from ten seconds: lie still on the drum, tap with the right, then the left.

1. Both sticks lie on the head for two seconds: gravity says which way is away from the head (the stick's z).
2. Four taps with the right stick, then four with the left: a tap turns the stick about the axis to its left (y), and
   only one sense of that axis makes a tap fall fast and stop at once.
3. The stick itself (x) is across both. The stick that taps first is the right one.
What was not shown is not guessed: such a sensor keeps the usual mounting, and a sentence says what was missing. How far
the sensor is from the tip no gesture tells: it is as it was.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample, Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.sync.strokes.stick_axes import between, turn_of
from station.sync.strokes.stroke_detector import StrokeDetector

Array = NDArray[np.float64]

STILL_S = 1.0
"""Still for so long is lying: a hand that holds a stick trembles (8–12 Hz); our choice, half of what is asked for."""
STILL_RAD_S, STILL_G = 0.1, 0.05
"""Rates stay so near their own mean, and acceleration so near 1 g, while a stick lies; a tenth of the slowest fall."""
MOVING_RAD_S = 1.0
"""From here on a stick taps rather than lies: 0.3 m/s at the tip."""
LEAST_TAPS = 3
"""Fewer taps show no axis: one of four may be lost."""
LEAST_SHARE = 0.7
"""So much of all turning is about one axis in a clean tap; a stick that is waved about turns about two or three (a
third to a half each); our choice."""
LEAST_LEAN = 0.87
"""Sine of the angle between the taps' axis and the vertical: over 60°, a tap is up and down; our choice."""
APART_S = 0.15
"""The first taps of two sticks come this far apart, or nobody knows which began; our choice: a flam is under 40 ms."""


@dataclass(frozen=True, slots=True)
class GestureResult:
    """Each device's `mountings`, `learnt` where the gesture showed them, and `faults`: what it did not show."""

    mountings: Mapping[str, Mounting]
    faults: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Shown:
    mounting: Mounting
    first_tap_ns: int


def learn_mounting(samples: Mapping[str, Sequence[ImuSample]], before: Mapping[str, Mounting]) -> GestureResult:
    """The mounting of each device from all that it measured while the gesture was made.

    `before` says how they were mounted as far as is known; a device that is not in it has the usual mounting.
    """
    faults, shown = [], {}
    for device, measured in samples.items():
        found = _shown(measured, before.get(device, Mounting()))
        if isinstance(found, str):
            faults.append(f"{device}: {found}")
        else:
            shown[device] = found
    order = sorted(shown, key=lambda device: shown[device].first_tap_ns)
    limbs = dict.fromkeys(order, Limb.UNKNOWN)
    if len(order) == 1:
        faults.append("only one stick tapped: which hand holds it is not known")
    elif len(order) == 2:
        apart_s = (shown[order[1]].first_tap_ns - shown[order[0]].first_tap_ns) / NS_PER_S
        if apart_s >= APART_S:
            limbs = {order[0]: Limb.RIGHT_HAND, order[1]: Limb.LEFT_HAND}
        else:
            faults.append("both sticks began to tap at once: which is the right one is not known")
    elif len(order) > 2:
        faults.append(f"{len(order)} sticks tapped: two hands hold two")
    mountings = {device: before.get(device, Mounting()) for device in samples}
    mountings |= {device: replace(one.mounting, limb=limbs[device]) for device, one in shown.items()}
    return GestureResult(mountings, tuple(faults))


def _shown(samples: Sequence[ImuSample], before: Mounting) -> "_Shown | str":
    """The mounting without its hand, and the first tap; or what was missing."""
    told = [sample for sample in samples if sample.rate_rad_s is not None or sample.orientation is not None]
    if len(told) < 2:
        return "it tells neither turning nor orientation"
    time_s, acceleration, rate = _arrays(told)
    still = _lying(time_s, acceleration, rate)
    if still is None:
        return f"it did not lie still for {STILL_S:g} s"
    up = acceleration[still].mean(0)
    up /= np.linalg.norm(up)
    turning = rate - rate[still].mean(0)
    moving = turning[np.linalg.norm(turning, axis=1) > MOVING_RAD_S]
    if len(moving) < LEAST_TAPS:
        return "it was not tapped"
    sizes, axes = np.linalg.eigh(moving.T @ moving)
    if sizes[-1] < LEAST_SHARE * sizes.sum():
        return "it was waved about more than tapped"
    across = axes[:, -1] - (axes[:, -1] @ up) * up
    if np.linalg.norm(across) < LEAST_LEAN:
        return "it was swung sideways, not tapped up and down"
    return _tapped(told, up, across / np.linalg.norm(across), before)


def _tapped(samples: Sequence[ImuSample], up: Array, across: Array, before: Mounting) -> "_Shown | str":
    """The sense of the axis in which taps fall and stop, and the first of them."""
    found = []
    for left in (across, -across):
        mounting = replace(before, turn=turn_of([np.cross(left, up).tolist(), left.tolist(), up.tolist()]), learnt=True)
        detector = StrokeDetector("", mounting)
        found.append((mounting, [stroke for sample in samples for stroke in detector.feed(sample)]))
    mounting, taps = max(found, key=lambda one: len(one[1]))
    if len(taps) < LEAST_TAPS or len(found[0][1]) == len(found[1][1]):
        return f"fewer than {LEAST_TAPS} taps were felt"
    return _Shown(mounting, taps[0].at_ns)


def _arrays(samples: Sequence[ImuSample]) -> tuple[Array, Array, Array]:
    """Times (n,) s, accelerations (n, 3) m/s² and rates (n, 3) rad/s; a rate that is not told is the orientation's."""
    time_s = np.array([(sample.at_ns - samples[0].at_ns) / NS_PER_S for sample in samples])
    acceleration = np.array([sample.acceleration_m_s2 for sample in samples])
    rates = [(0.0, 0.0, 0.0) if samples[0].rate_rad_s is None else samples[0].rate_rad_s]
    for before, sample in pairwise(samples):
        rate = sample.rate_rad_s
        if rate is None:
            assert before.orientation is not None
            assert sample.orientation is not None
            rate = between(before.orientation, sample.orientation, (sample.at_ns - before.at_ns) / NS_PER_S)
        rates.append(rate)
    return time_s, acceleration, np.array(rates)


def _lying(time_s: Array, acceleration: Array, rate: Array) -> NDArray[np.int64] | None:
    """Indices of the first time in which the stick lies, None where it never does."""
    size = np.linalg.norm(acceleration, axis=1)
    mean = np.median(rate[: max(len(rate) // 4, 1)], axis=0)  # the gyro's bias: the gesture begins at rest
    is_still = (np.linalg.norm(rate - mean, axis=1) < STILL_RAD_S) & (
        np.abs(size - STANDARD_GRAVITY_M_S2) < STILL_G * STANDARD_GRAVITY_M_S2
    )
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_still, [False]]).astype(np.int8)))
    runs = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if time_s[b - 1] - time_s[a] >= STILL_S]
    if not runs:
        return None
    return np.arange(*runs[0])
