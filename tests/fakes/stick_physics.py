"""A stick that turns about a fulcrum in one plane, and what a sensor on it would measure: hand-made test signals.

Planar rigid-body kinematics, integrated at 20 kHz. The angle is the stick's above the horizontal; the fulcrum moves up
and down as told. Contacts are half-sine pulses of angular acceleration. Knows nothing of `station.sync`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample

FINE_HZ = 20_000
FULCRUM_FROM_TIP_M, SENSOR_BEHIND_FULCRUM_M = 0.27, 0.06

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stroke:
    """From rest at `height_rad` the stick falls within `fall_s`, touches for `contact_s`, rebounds and is caught."""

    height_rad: float = 0.6
    fall_s: float = 0.08
    contact_s: float = 0.004
    rebound: float = 0.4


def strokes_by_angle(strokes: Sequence[Stroke], rest_s: float = 0.5) -> tuple[Array, list[float], list[float]]:
    """Angle (n,) rad at `FINE_HZ`; each contact's onset in seconds; the rate just before it in rad/s.

    The stick is at rest at the first height; each fall is a constant angular acceleration, after each contact the stick
    rises and slows down evenly to the next height, where it stands.
    """
    step = 1 / FINE_HZ
    angle, onsets, rates = [np.full(int(rest_s * FINE_HZ), strokes[0].height_rad)], [], []
    for index, stroke in enumerate(strokes):
        fall = np.arange(1, int(stroke.fall_s * FINE_HZ) + 1) * step
        before = 2 * stroke.height_rad / stroke.fall_s
        angle.append(stroke.height_rad * (1 - (fall / stroke.fall_s) ** 2))
        onsets.append(sum(map(len, angle)) * step)
        rates.append(before)
        touch = np.arange(1, int(stroke.contact_s * FINE_HZ) + 1) * step
        change = before * (1 + stroke.rebound)
        rate = -before + change * (1 - np.cos(np.pi * touch / stroke.contact_s)) / 2
        angle.append(angle[-1][-1] + np.cumsum(rate) * step)
        start, goal = float(angle[-1][-1]), strokes[min(index + 1, len(strokes) - 1)].height_rad
        up = before * stroke.rebound
        if up > 0:
            last = 2 * abs(goal - start) / up
            rise = np.arange(1, int(last * FINE_HZ) + 1) * step
            angle.append(start + up * rise - up / (2 * last) * rise**2)
        else:
            last = 0.3
            rise = np.arange(1, int(last * FINE_HZ) + 1) * step
            angle.append(start + (goal - start) * (1 - np.cos(np.pi * rise / last)) / 2)
        angle.append(np.full(int(0.05 * FINE_HZ), angle[-1][-1]))
    return np.concatenate(angle), onsets, rates


def moved_slowly(start_rad: float, goal_rad: float, within_s: float) -> Array:
    """From one angle to another with a hand's minimum jerk (Flash & Hogan 1985)."""
    share = np.linspace(0, 1, round(within_s * FINE_HZ))
    return np.asarray(start_rad + (goal_rad - start_rad) * (10 * share**3 - 15 * share**4 + 6 * share**5))


@dataclass(frozen=True)
class Sensor:
    """How a sensor measures: `rate_hz`, ranges, noise (standard deviations), bias, and whether it is band-limited."""

    rate_hz: float = 1000.0
    range_m_s2: float = 16 * STANDARD_GRAVITY_M_S2
    range_rad_s: float = float(np.radians(2000))
    noise_m_s2: float = 0.03
    noise_rad_s: float = 0.003
    bias_rad_s: tuple[float, float, float] = (0.0, 0.0, 0.0)
    limits_band: bool = True
    seed: int = 1
    rows: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))
    """Sensor's axes from the stick's."""


def measured(angle: Array, sensor: Sensor, fulcrum_up_m: Array | None = None) -> list[ImuSample]:
    """The samples of a `sensor` on a stick at `angle` (n,) rad, its fulcrum at `fulcrum_up_m` (n,) over the floor."""
    step = 1 / FINE_HZ
    up = np.zeros_like(angle) if fulcrum_up_m is None else fulcrum_up_m
    behind = SENSOR_BEHIND_FULCRUM_M
    place = np.stack([-behind * np.cos(angle), up - behind * np.sin(angle)], 1)
    force = np.gradient(np.gradient(place, step, axis=0), step, axis=0) + np.array([0.0, STANDARD_GRAVITY_M_S2])
    along = force[:, 0] * np.cos(angle) + force[:, 1] * np.sin(angle)
    above = -force[:, 0] * np.sin(angle) + force[:, 1] * np.cos(angle)
    zero = np.zeros_like(angle)
    accelerations, rates = np.stack([along, zero, above], 1), np.stack([zero, -np.gradient(angle, step), zero], 1)
    every = FINE_HZ / sensor.rate_hz
    if sensor.limits_band:  # a mean over one sample, its delay taken away
        width = max(int(every), 1)
        box = np.ones(width) / width
        accelerations, rates = (
            np.stack([np.convolve(np.pad(c, width, "edge"), box, "same")[width:-width] for c in x.T], 1)
            for x in (accelerations, rates)
        )
    picks = np.round(np.arange(0, len(angle) - 1, every)).astype(int)
    random = np.random.default_rng(sensor.seed)
    accelerations = accelerations[picks] + random.normal(0, sensor.noise_m_s2, (len(picks), 3))
    rates = rates[picks] + random.normal(0, sensor.noise_rad_s, (len(picks), 3)) + sensor.bias_rad_s
    accelerations = np.clip(accelerations @ sensor.rows.T, -sensor.range_m_s2, sensor.range_m_s2)
    rates = np.clip(rates @ sensor.rows.T, -sensor.range_rad_s, sensor.range_rad_s)
    return [
        ImuSample(round(k * 1e9 / FINE_HZ), tuple(a), tuple(w))
        for k, a, w in zip(picks.tolist(), accelerations.tolist(), rates.tolist(), strict=True)
    ]
