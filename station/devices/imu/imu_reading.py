"""What a decoder makes of a sensor's bytes, and how its units become ours.

Times in bytes are the device's own; `sample_clock` turns them into session time.
"""

import math
from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple, Protocol

from station.core.imu import STANDARD_GRAVITY_M_S2, Quaternion, Vector

RAD_PER_DEGREE = math.pi / 180.0

_MOST_G = 1_000.0
_MOST_DEGREES_PER_S = 50_000.0
"""What no sensor measures (our choice: several times the widest ranges on sale, ± 200 g and ± 4000 °/s): more than
that was damaged on its way, and protocols without a checksum have no other sign of it."""


class Ticks(Enum):
    """What a protocol says of the time of a sample."""

    MICROSECONDS = "the device's clock in µs"
    MILLISECONDS = "the device's clock in ms"
    INDEX_OF_256 = "a counter of samples that runs from 0 to 255"
    NOTHING = "nothing: samples can only be counted"


class Reading(NamedTuple):
    """One measurement, complete at session time `at_ns`.

    Acceleration in m/s², `rate_rad_s` None where the sensor sends none, `orientation` earth from sensor (w, x, y, z);
    `ticks` what the device says of the time, in the protocol's `Ticks`, None where this one came without.
    """

    at_ns: int
    acceleration_m_s2: Vector
    rate_rad_s: Vector | None = None
    orientation: Quaternion | None = None
    ticks: int | None = None


class Told(NamedTuple):
    """What a sensor tells of itself: `battery` 0 … 1; None, and an empty `note`, where it does not."""

    battery: float | None = None
    temperature_c: float | None = None
    note: str = ""


Heard = Reading | Told


class ImuDecoder(Protocol):
    """Bytes to readings, whatever the chunks; damaged bytes cost what they belong to, and nothing after it.

    `good_bytes` counts the bytes of sound messages, `bad_bytes` those that belong to none.
    """

    @property
    def good_bytes(self) -> int:
        """So many so far."""
        ...

    @property
    def bad_bytes(self) -> int:
        """So many so far."""
        ...

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at session time `at_ns` complete."""
        ...


def acceleration_of(in_g: Sequence[float]) -> Vector | None:
    """Three accelerations in g as m/s²; None for what no sensor measures."""
    x, y, z = in_g
    if not (abs(x) < _MOST_G and abs(y) < _MOST_G and abs(z) < _MOST_G):  # NaN is not less either
        return None
    return x * STANDARD_GRAVITY_M_S2, y * STANDARD_GRAVITY_M_S2, z * STANDARD_GRAVITY_M_S2


def rate_of(in_degrees_per_s: Sequence[float]) -> Vector | None:
    """Three angular rates in °/s as rad/s; None for what no sensor measures."""
    x, y, z = in_degrees_per_s
    if not (abs(x) < _MOST_DEGREES_PER_S and abs(y) < _MOST_DEGREES_PER_S and abs(z) < _MOST_DEGREES_PER_S):
        return None
    return x * RAD_PER_DEGREE, y * RAD_PER_DEGREE, z * RAD_PER_DEGREE


def unit_quaternion(w: float, x: float, y: float, z: float) -> Quaternion | None:
    """The rotation that four numbers stand for; None where they are no quaternion of length 1, give or take a tenth."""
    length = math.sqrt(w * w + x * x + y * y + z * z) if math.isfinite(w + x + y + z) else 0.0
    if not 0.9 < length < 1.1:  # our choice: 16 bits a number round to 1e-4
        return None
    return w / length, x / length, y / length, z / length


def quaternion_of_angles(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Earth from sensor, for angles in degrees: turned about z by yaw, then about the new y, then about the new x.

    The aerospace order z, y', x'', in which all the protocols here give their angles.
    """
    half = RAD_PER_DEGREE / 2.0
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(a * half), math.sin(a * half)) for a in (roll, pitch, yaw))
    return (
        cx * cy * cz + sx * sy * sz,
        sx * cy * cz - cx * sy * sz,
        cx * sy * cz + sx * cy * sz,
        cx * cy * sz - sx * sy * cz,
    )
