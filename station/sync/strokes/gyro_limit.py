"""When a gyro is at the end of its range, told by its rates alone: any full scale may be set, and no sensor tells it.

At the end a gyro repeats one number, and never passes it. A full scale that is sold, reached again, is enough; any
other number has to stand still over samples in a row: a moving stick's rate turns round in none. A limit that is passed
after all was none.
"""

import math

from station.core.imu import Vector

FULL_SCALES_RAD_S = tuple(math.radians(each) for each in (250.0, 500.0, 1000.0, 2000.0, 4000.0))
"""Data sheets of the usual chips (ICM-42688-P, BMI270, MPU-9250), and the widest that is sold (ICM-45686)."""
UNASKED_RAD_S = math.radians(2000.0)
"""A full scale from here on is a limit at its first sample: where the gyros of all sensors that we know end at the
latest as they are delivered (PROTOCOLS.md § 1 and 2), and where few hands ever are without being beyond."""
BELOW, ABOVE = 0.998, 1.005
"""So near a full scale, or the largest rate so far, a rate is at it: calibrated to about 0.2 %; our choice."""
SAME = 1e-4
"""Two rates are one number: three steps of 16 bits, since the two ends are a step apart; our choice."""
IN_A_ROW = 3
"""A smooth peak has two samples alike at the most."""
LEAST_RAD_S = math.radians(200.0)
"""No gyro ends below (the narrowest that is sold ±125 °/s is of no use on a stick); our choice."""


class GyroLimit:
    """`is_reached` by each sample's rate in the sensor's axes, in order."""

    def __init__(self) -> None:
        self._largest = LEAST_RAD_S
        self._times = self._in_a_row = 0
        self._is_known = False

    def is_reached(self, rate: Vector) -> bool:
        """Whether a component of `rate` is at the end of the range, as far as is known by now."""
        x, y, z = rate
        size = max(x, y, z, -x, -y, -z)
        if size < self._largest * BELOW:
            self._in_a_row = 0
            return False
        if size > self._largest * (1.0 + SAME):
            self._largest, self._is_known = size, False
            self._times = self._in_a_row = 1
        elif size >= self._largest * (1.0 - SAME):
            self._times += 1
            self._in_a_row += 1
        else:
            self._in_a_row = 0
        self._is_known = self._is_known or self._in_a_row >= IN_A_ROW or self._is_full_scale(size)
        return self._is_known

    def _is_full_scale(self, size: float) -> bool:
        is_sold = any(scale * BELOW <= size <= scale * ABOVE for scale in FULL_SCALES_RAD_S)
        return is_sold and (self._times > 1 or size >= UNASKED_RAD_S * BELOW)
