"""The BNO085 in its UART-RVC mode (made for robot vacuum cleaners): 100 Hz, 115,200 baud, no gyroscope.

    AA AA, index u8, yaw, pitch, roll i16 in 0.01°, acceleration x, y, z i16 in mg, 00 00 00, sum u8     little-endian

The sum is the low byte of the sum of bytes 2 to 17. Source: CEVA, BNO08X datasheet, UART-RVC (p. 21 of revision 1.17).
"""

import struct

from station.devices.imu.frame_cutter import FrameCutter
from station.devices.imu.imu_reading import Heard, Reading, acceleration_of, quaternion_of_angles

_HEADER = b"\xaa\xaa"
_FRAME = struct.Struct("<2xB6h3xB")
_G_PER_MG = 0.001
_DEGREES = 0.01


def _is_sound(frame: bytes) -> bool:
    return sum(frame[2:-1]) & 0xFF == frame[-1]


class Bno085RvcDecoder:
    """One line's state: half a frame."""

    def __init__(self) -> None:
        self._frames = FrameCutter(_HEADER, _FRAME.size, _is_sound)

    @property
    def good_bytes(self) -> int:
        """The bytes of sound frames."""
        return self._frames.good_bytes

    @property
    def bad_bytes(self) -> int:
        """The bytes that belong to none."""
        return self._frames.bad_bytes

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at `at_ns` complete."""
        heard: list[Heard] = []
        for frame in self._frames.feed(data):
            index, yaw, pitch, roll, *accelerations, _ = _FRAME.unpack(frame)
            acceleration = acceleration_of([each * _G_PER_MG for each in accelerations])
            assert acceleration is not None, "16 bits hold less than any limit"
            turn = quaternion_of_angles(roll * _DEGREES, pitch * _DEGREES, yaw * _DEGREES)
            heard.append(Reading(at_ns, acceleration, None, turn, index))
        return heard
