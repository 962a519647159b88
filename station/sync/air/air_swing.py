"""What two samples say of a stick's swing between them: where it points, how fast its tip is and how it is braked.

Stick's axes and the earth's as `core.imu` has them. The tip's velocity is that of turning about the sensor, |ω × x|
times the way from sensor to tip: in the air the hand's own velocity is a few tenths of it (HUMANS: hand 3.2, tip
9.4 m/s in a full stroke) and no rate tells it. Lengthwise twirling about the stick's own axis moves no tip. The tip's
acceleration is the sensor's, without gravity, and what turning adds: α × r + ω × (ω × r).
"""

from collections import deque
from math import asin, atan2, hypot, pi, remainder
from typing import NamedTuple

from station.core.imu import STANDARD_GRAVITY_M_S2, Vector
from station.core.units import NS_PER_MS, NS_PER_S
from station.sync.strokes.stick_axes import rows_of
from station.sync.strokes.stick_orientation import StickMotion

FULL_SPEED_M_S = 9.4
"""The tip of a full stroke (HUMANS: Pearl 2023)."""

SPAN_NS = 4 * NS_PER_MS
"""Over so long rates are differentiated: a stop lasts ten times as long, and a usual gyro's noise (0.1 °/s) then stands
for 0.2 m/s² at the tip (our choice)."""


class Swing(NamedTuple):
    """One stick at one instant.

    `speed_m_s` of the tip about the sensor, `down_m_s` how much of it goes down (negative: up); `jolt_m_s2` the
    magnitude of the tip's acceleration without gravity; the stick points to `heading_rad` in (−π, π]
    (counter-clockwise from above) and `elevation_rad` above the horizontal.
    """

    at_ns: int
    speed_m_s: float
    down_m_s: float
    jolt_m_s2: float
    heading_rad: float
    elevation_rad: float


class SwingReader:
    """Makes swings of the samples of one stick."""

    def __init__(self, tip_m: float) -> None:
        self._tip_m = tip_m
        self._kept: deque[StickMotion] = deque()

    def feed(self, motion: StickMotion) -> Swing | None:
        """The swing over the `SPAN_NS` up to this sample, or since the one before where that is longer ago."""
        while len(self._kept) > 1 and motion.at_ns - self._kept[1].at_ns >= SPAN_NS:
            self._kept.popleft()
        before = self._kept[0] if self._kept else motion
        is_later = motion.at_ns > before.at_ns
        self._kept.append(motion)
        return swing_between(before, motion, self._tip_m) if is_later else None


def swing_between(before: StickMotion, after: StickMotion, tip_m: float) -> Swing:
    """The swing half-way between two samples, the second later; the tip is `tip_m` from the sensor."""
    interval_ns = after.at_ns - before.at_ns
    old, new = rows_of(before.turn), rows_of(after.turn)
    up_x, up_y, up_z = _mean(old[2], new[2])
    rolling, pitching, yawing = _mean(before.rate_rad_s, after.rate_rad_s)
    ahead, aside, above = _mean(before.acceleration_m_s2, after.acceleration_m_s2)
    _, pitched, yawed = (
        (b - a) * NS_PER_S / interval_ns for a, b in zip(before.rate_rad_s, after.rate_rad_s, strict=True)
    )
    g = STANDARD_GRAVITY_M_S2
    return Swing(
        before.at_ns + interval_ns // 2,
        tip_m * hypot(pitching, yawing),
        tip_m * (up_z * pitching - up_y * yawing),
        hypot(
            ahead - g * up_x - tip_m * (pitching**2 + yawing**2),
            aside - g * up_y + tip_m * (yawed + rolling * pitching),
            above - g * up_z - tip_m * (pitched - rolling * yawing),
        ),
        atan2(old[1][0] + new[1][0], old[0][0] + new[0][0]),
        asin(min(1.0, max(-1.0, up_x))),
    )


def _mean(one: Vector, other: Vector) -> Vector:
    (a, b, c), (d, e, f) = one, other
    return (a + d) / 2.0, (b + e) / 2.0, (c + f) / 2.0


def wrapped(angle_rad: float) -> float:
    """The same angle in [−π, π]."""
    return remainder(angle_rad, 2.0 * pi)
