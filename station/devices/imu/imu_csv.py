"""Our own line for home-built sensors: a microcontroller prints it, a person reads it.

    t_us,ax,ay,az,gx,gy,gz[,qw,qx,qy,qz]      in µs of the device's own clock, g, °/s; the quaternion earth from sensor
    $IMU,t_us,ax,…*HH                         the same, HH the exclusive or of the bytes between $ and * in hexadecimal
    # …                                       a comment, such as the names of the columns

Lines end with a line feed, or carriage return and line feed. Plain lines have no checksum: what cannot be a measurement
is damaged. Once checked lines have come, plain ones count as damaged.
"""

import re

from station.devices.imu.frame_cutter import LineCutter
from station.devices.imu.imu_reading import Heard, Reading, acceleration_of, rate_of, unit_quaternion

_LONGEST_LINE = 512
"""Eleven numbers of 20 letters, twice over (our choice)."""
_HEADING = b"t_us,"
_CHECKED = b"$IMU,"
_PLAIN = re.compile(rb"\d{1,19}(?:,[-+.0-9eE]{1,24}){6}(?:(?:,[-+.0-9eE]{1,24}){4})?")


class ImuCsvDecoder:
    """One line's state: half a line, and whether its lines are checked."""

    def __init__(self) -> None:
        self.good_bytes = 0
        self.bad_bytes = 0
        self._lines = LineCutter(_LONGEST_LINE)
        self._is_checked = False

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at `at_ns` complete."""
        heard: list[Heard] = []
        for line in self._lines.feed(data):
            text = line.rstrip(b"\r")
            reading = self._reading(text, at_ns)
            if reading is not None:
                heard.append(reading)
                self.good_bytes += len(line) + 1
            elif text and not text.startswith((b"#", _HEADING)):
                self.bad_bytes += len(line) + 1
        self.bad_bytes += self._lines.dropped_bytes
        self._lines.dropped_bytes = 0
        return heard

    def _reading(self, text: bytes, at_ns: int) -> Reading | None:
        if text.startswith(_CHECKED):
            fields = _checked(text)
            self._is_checked = self._is_checked or fields is not None
        else:
            fields = None if self._is_checked else text
        if fields is None or _PLAIN.fullmatch(fields) is None:
            return None
        try:
            first, *rest = fields.split(b",")
            numbers = [float(field) for field in rest]
        except ValueError:  # signs and dots that make no number
            return None
        acceleration, rate = acceleration_of(numbers[:3]), rate_of(numbers[3:6])
        turn = unit_quaternion(*numbers[6:]) if len(numbers) > 6 else None
        if acceleration is None or rate is None or (len(numbers) > 6 and turn is None):
            return None
        return Reading(at_ns, acceleration, rate, turn, int(first))


def _checked(text: bytes) -> bytes | None:
    """What stands between `$IMU,` and `*`, None where the checksum is another."""
    body, star, stated = text[1:].rpartition(b"*")
    check = 0
    for byte in body:
        check ^= byte
    return body[len(_CHECKED) - 1 :] if star and stated.upper() == b"%02X" % check else None
