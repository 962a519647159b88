"""What one sample says of a stick's swing: where it points, how fast its tip turns, how hard its grip end accelerates.

Stick's axes and the earth's as `core.imu` has them. The tip's velocity is that of turning about the sensor, |ω × x|
times the way from sensor to tip: in the air the hand's own velocity is a few tenths of it (HUMANS: hand 3.2, tip
9.4 m/s in a full stroke) and no sensor of rates tells it. Lengthwise twirling about the stick's own axis moves no tip.
"""

from math import asin, atan2, hypot, pi, remainder, sqrt
from typing import NamedTuple

from station.core.imu import STANDARD_GRAVITY_M_S2, Quaternion, Vector

FULL_SPEED_M_S = 9.4
"""The tip of a full stroke (HUMANS: Pearl 2023)."""


class Swing(NamedTuple):
    """One stick at one instant.

    `speed_m_s` of the tip about the sensor, `down_m_s` how much of it goes down (negative: up); `jolt_m_s2` the
    magnitude of the sensor's acceleration without gravity; the stick points to `heading_rad` in (−π, π]
    (counter-clockwise from above) and `elevation_rad` above the horizontal.
    """

    at_ns: int
    speed_m_s: float
    down_m_s: float
    jolt_m_s2: float
    heading_rad: float
    elevation_rad: float


def swing_of(at_ns: int, acceleration_m_s2: Vector, rate_rad_s: Vector, turn: Quaternion, tip_m: float) -> Swing:
    """The swing of a stick from what is measured in its own axes; `turn` earth from stick, `tip_m` sensor to tip."""
    w, x, y, z = turn
    # the third row of the rotation matrix is the vertical in the stick's axes; the first column is the stick in the earth's
    up_x, up_y, up_z = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)
    ax, ay, az = acceleration_m_s2
    g = STANDARD_GRAVITY_M_S2
    _, pitching, yawing = rate_rad_s
    return Swing(
        at_ns,
        tip_m * hypot(pitching, yawing),
        tip_m * (up_z * pitching - up_y * yawing),
        sqrt((ax - g * up_x) ** 2 + (ay - g * up_y) ** 2 + (az - g * up_z) ** 2),
        atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z)),
        asin(min(1.0, max(-1.0, up_x))),
    )


def wrapped(angle_rad: float) -> float:
    """The same angle in [−π, π]."""
    return remainder(angle_rad, 2.0 * pi)
