"""What a motion sensor on a stick measures, how it is mounted, and what is found in it: plain immutable values.

A sensor is an inertial measurement unit (IMU). Its own axes are as its decoder has them (right-handed). At rest the
acceleration is what an accelerometer reads: 1 g (`STANDARD_GRAVITY_M_S2`) *upwards*. Orientations are unit quaternions
(w, x, y, z) that turn a vector in the sensor's (or the stick's) axes into the earth's: z up, heading arbitrary.

The stick's axes: x from the butt to the tip, z away from the head that is struck while the stick lies on it, y to the
left of both.
"""

from dataclasses import dataclass
from typing import NamedTuple

from station.core.pieces import Limb

STANDARD_GRAVITY_M_S2 = 9.80665
"""BIPM, The International System of Units, 9th edition, § 2.3.4 (standard acceleration due to gravity)."""

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

NO_TURN: Quaternion = (1.0, 0.0, 0.0, 0.0)


class ImuSample(NamedTuple):
    """One sample: `at_ns` the session time at which it was measured, by the sample clock recovered from arrivals.

    `acceleration_m_s2` and `rate_rad_s` in the sensor's axes; the rate is None where the sensor sends none, the
    `orientation` (earth from sensor) where it tells none.
    """

    at_ns: int
    acceleration_m_s2: Vector
    rate_rad_s: Vector | None = None
    orientation: Quaternion | None = None


@dataclass(frozen=True, slots=True)
class Mounting:
    """Which stick a sensor sits on, and how.

    `turn` takes the sensor's axes to the stick's; `tip_m` and `butt_m` how far the sensor is from the stick's ends,
    along it; `learnt` whether the gesture has told it, or it is assumed.
    """

    limb: Limb = Limb.UNKNOWN
    turn: Quaternion = NO_TURN
    tip_m: float = 0.33
    butt_m: float = 0.076
    learnt: bool = False
