"""What one sample says of a stick's swing: where it points, how fast its tip turns, how hard its grip end accelerates.

Stick's axes and the earth's as `core.imu` has them. The tip's velocity is that of turning about the sensor, |ω × x|
times the way from sensor to tip: in the air the hand's own velocity is a few tenths of it (HUMANS: hand 3.2, tip
9.4 m/s in a full stroke) and no sensor of rates tells it. Lengthwise twirling about the stick's own axis moves no tip.
"""

from math import asin, atan2, hypot, pi, remainder
from typing import NamedTuple

from station.core.imu import STANDARD_GRAVITY_M_S2
from station.sync.strokes.stick_axes import rows_of
from station.sync.strokes.stick_orientation import StickMotion

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


def swing_of(motion: StickMotion, tip_m: float) -> Swing:
    """The swing of a stick whose tip is `tip_m` from its sensor."""
    (_, _, along_z), (_, _, left_z), (_, _, up_z) = columns = tuple(zip(*rows_of(motion.turn), strict=True))
    x, y, _ = columns[0]
    _, pitching, yawing = motion.rate_rad_s
    ahead, aside, above = motion.acceleration_m_s2
    g = STANDARD_GRAVITY_M_S2
    return Swing(
        motion.at_ns,
        tip_m * hypot(pitching, yawing),
        tip_m * (up_z * pitching - left_z * yawing),
        hypot(ahead - g * along_z, aside - g * left_z, above - g * up_z),
        atan2(y, x),
        asin(min(1.0, max(-1.0, along_z))),
    )


def wrapped(angle_rad: float) -> float:
    """The same angle in [−π, π]."""
    return remainder(angle_rad, 2.0 * pi)
