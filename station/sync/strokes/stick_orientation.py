"""How a stick is held, from its sensor's samples: orientation without a magnetometer, gyro bias, and rest.

The gyro is integrated by VQF (Laidig & Seel 2023, doi 10.1016/j.inffus.2022.10.014), which also learns the gyro's bias
while the stick lies still. Its inclination is corrected by the accelerometer in calm moments only: a stick's contacts
go far beyond ± 16 g, so that the mean of a clipped accelerometer is no gravity (a stroke of 9 m/s loses about 3 m/s of
its sensor's change of speed; at four strokes a second that is more than 1 g).
A sensor without a gyro must tell its own orientation, which then is taken as it is; its rate is that orientation's.
The heading starts anywhere and drifts; `sync.air` knows what to do about it.
"""

import math
from itertools import pairwise
from statistics import median
from typing import NamedTuple

import numpy as np
from vqf import VQF

from station.core.imu import NO_TURN, STANDARD_GRAVITY_M_S2, ImuSample, Mounting, Quaternion, Vector
from station.core.units import NS_PER_S
from station.sync.strokes.gyro_limit import GyroLimit
from station.sync.strokes.stick_axes import Rows, between, inverse, product, rows_of, turned

FIRST_SAMPLES = 8
"""So many samples tell the rate before the first is used: VQF wants it beforehand; our choice, 80 ms at 100 Hz."""
LONGEST_GAP_S = 0.25
"""After a longer gap the orientation starts afresh: a stroke (HUMANS.md: 0.1–0.6 s) may have gone by; our choice."""
CALM_G = 0.1
"""So near 1 g is a calm stick's acceleration, as a share of g: a tilt of 6° at the most; our choice."""
CALM_RAD_S = 1.0
"""A calm stick turns more slowly: its centripetal acceleration is then under 0.4 m/s² anywhere on it; our choice."""
CALM_S = 0.05
"""Calm lasts longer: at 10 Hz, the fastest hand (Fujii 2009), acceleration passes 1 g more quickly than that."""
MISSED_SHARE = 0.3
"""What a gyro at its limit may miss, as a share of that limit: a stroke of 30 rad/s at ± 1000 °/s loses 4° in 16 ms of
the simulator's. Neither its acceleration nor the rate before tells how much: guesses were worse than none."""
MOST_MISSED_RAD = 1.0
"""More makes no difference: the inclination may be any. So it may where samples begin, perhaps in the middle of a
stroke."""
LOST_RAD = 0.05
"""A stick that may have missed more has lost its inclination; our choice: one stroke well beyond the limit."""
LOOSE_G, LOOSE_RAD_S = 1.0, 10.0
"""Then acceleration tells it in livelier moments too: so near 1 g, and turning more slowly: the way up and the top of a
stroke, without its contact."""
LOST_S = 0.8
"""And within this time instead of VQF's 3 s: by then strokes have turned it further. Time and bounds were chosen on
simulated sticks at ± 500 and ± 1000 °/s: of 368 hard strokes 8 are missed, without this 71."""
VQF_S = 3.0
"""VQF's own (Laidig & Seel 2023)."""


class StickMotion(NamedTuple):
    """The motion of a stick at a sample's time.

    `turn` earth from stick; `rate_rad_s` without its bias and `acceleration_m_s2` with gravity, where the sensor sits,
    in the stick's axes (`core.imu`); `resting` whether it has lain still for a while.
    """

    at_ns: int
    turn: Quaternion
    rate_rad_s: Vector
    acceleration_m_s2: Vector
    resting: bool
    is_derived: bool
    """Whether the rate is the orientation's, a mean since the sample before."""
    is_clipped: bool
    """Whether the gyro was at its limit."""


class StickOrientation:
    """Orientation of one stick; `feed` it every sample. The same samples give the same motion, however they come."""

    def __init__(self, mounting: Mounting) -> None:
        self._to_stick: Rows = rows_of(mounting.turn)
        self._from_stick = inverse(mounting.turn)
        self._waiting: list[ImuSample] = []
        self._filter: VQF | None = None
        self._interval_s = 0.0
        self._before: ImuSample | None = None
        self._rate = (0.0, 0.0, 0.0)
        self._bias: Vector = (0.0, 0.0, 0.0)  # VQF's, which changes with accelerations only
        self._turned, self._accelerated = np.zeros(3), np.zeros(3)  # for VQF: numpy's arrays are slow to make
        self._calm_s = 0.0
        self._limit = GyroLimit()
        self._missed_rad = MOST_MISSED_RAD
        self._is_lost = False
        self._begins = True  # until calm has told how it is held, or acceleration for long enough

    @property
    def rate_hz(self) -> float | None:
        """The sensor's rate, as its first samples tell it."""
        return 1.0 / self._interval_s if self._filter is not None else None

    def feed(self, sample: ImuSample) -> list[StickMotion]:
        """The stick's motion at `sample`, none before its rate is known, then that of all so far.

        A sample with neither rate nor orientation tells no motion; nor does one that is not later than the last.
        """
        if sample.rate_rad_s is None and sample.orientation is None:
            return []
        if self._filter is not None:
            return self._moved(sample)
        if self._waiting and sample.at_ns <= self._waiting[-1].at_ns:
            return []
        self._waiting.append(sample)
        return self._begin() if len(self._waiting) == FIRST_SAMPLES else []

    def _begin(self) -> list[StickMotion]:
        times = [sample.at_ns for sample in self._waiting]
        self._interval_s = median(b - a for a, b in pairwise(times)) / NS_PER_S
        self._filter = VQF(self._interval_s)
        waiting, self._waiting = self._waiting, []
        return [motion for sample in waiting for motion in self._moved(sample)]

    def _moved(self, sample: ImuSample) -> list[StickMotion]:
        before, vqf = self._before, self._filter
        assert vqf is not None
        dt_s = self._interval_s if before is None else (sample.at_ns - before.at_ns) / NS_PER_S
        if dt_s <= 0.0:
            return []
        if dt_s > LONGEST_GAP_S:
            vqf = self._afresh(vqf)
            before, dt_s = None, self._interval_s
        rate = sample.rate_rad_s if sample.rate_rad_s is not None else _derived(before, sample, dt_s)
        is_clipped = sample.rate_rad_s is not None and self._limit.is_reached(rate)
        if is_clipped:
            self._missed_rad = min(self._missed_rad + MISSED_SHARE * max(map(abs, rate)) * dt_s, MOST_MISSED_RAD)
        self._update(vqf, rate, sample, dt_s)
        self._before, self._rate = sample, rate
        if sample.rate_rad_s is None:
            turn, unbiased = sample.orientation or NO_TURN, rate
        else:
            (p, q, r), (a, b, c) = rate, self._bias
            turn, unbiased = vqf.getQuat6D().tolist(), (p - a, q - b, r - c)
        return [
            StickMotion(
                sample.at_ns,
                product(turn, self._from_stick),
                turned(self._to_stick, unbiased),
                turned(self._to_stick, sample.acceleration_m_s2),
                bool(vqf.getRestDetected()),
                sample.rate_rad_s is None,
                is_clipped,
            )
        ]

    def _afresh(self, before: VQF) -> VQF:
        """A filter that knows nothing but the bias of the one before."""
        self._filter, self._calm_s = VQF(self._interval_s), 0.0
        self._missed_rad, self._is_lost, self._begins = MOST_MISSED_RAD, False, True
        bias, sigma = before.getBiasEstimate()
        self._filter.setBiasEstimate(bias, sigma)
        return self._filter

    def _update(self, vqf: VQF, rate: Vector, sample: ImuSample, dt_s: float) -> None:
        """Turn by the mean rate since the sample before, also over the time of samples that were lost."""
        share = dt_s / self._interval_s
        before = self._rate if self._before is not None and sample.rate_rad_s is not None else rate
        half = 0.5 * share
        p, q, r = rate
        turned_rad_s = self._turned
        turned_rad_s[0] = half * (before[0] + p)
        turned_rad_s[1] = half * (before[1] + q)
        turned_rad_s[2] = half * (before[2] + r)
        vqf.updateGyr(turned_rad_s)
        x, y, z = sample.acceleration_m_s2
        off = abs(math.sqrt(x * x + y * y + z * z) - STANDARD_GRAVITY_M_S2)
        turning = p * p + q * q + r * r
        is_calm = off < CALM_G * STANDARD_GRAVITY_M_S2 and turning < CALM_RAD_S * CALM_RAD_S
        self._calm_s = self._calm_s + dt_s if is_calm else 0.0
        if self._begins and self._calm_s > CALM_S:
            self._missed_rad = 0.0  # VQF begins with the mean of what it is told
        if self._begins or self._missed_rad > 0.0:
            self._find_again(vqf)
        is_slow = self._is_lost and off < LOOSE_G * STANDARD_GRAVITY_M_S2 and turning < LOOSE_RAD_S * LOOSE_RAD_S
        if is_slow or self._calm_s > CALM_S:
            acceleration = self._accelerated
            acceleration[0], acceleration[1], acceleration[2] = x, y, z
            vqf.updateAcc(acceleration)
            self._bias = vqf.getBiasEstimate()[0].tolist()
            self._missed_rad *= 1.0 - min(dt_s / (LOST_S if self._is_lost else VQF_S), 1.0)

    def _find_again(self, vqf: VQF) -> None:
        """Trust acceleration more, and learn no bias of it, while the gyro has missed much; until it is made good."""
        is_lost = self._missed_rad > (LOST_RAD / 4 if self._is_lost else LOST_RAD)
        self._begins = self._begins and is_lost
        if is_lost is not self._is_lost:
            self._is_lost = is_lost
            vqf.setTauAcc(LOST_S if is_lost else VQF_S)
            vqf.setMotionBiasEstEnabled(not is_lost)


def _derived(before: ImuSample | None, sample: ImuSample, dt_s: float) -> Vector:
    if before is None or before.orientation is None or sample.orientation is None:
        return (0.0, 0.0, 0.0)
    return between(before.orientation, sample.orientation, dt_s)
