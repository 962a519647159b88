r"""The x-IMU3's messages, text and binary, as they may stand mixed in one stream.

Source: x-io Technologies, x-IMU3 User Manual v0.11, and xioTechnologies/x-IMU3-Software (receiver.rs).

    ASCII     I,<µs>,<number>,…\r\n
    binary    0x80 + letter, µs u64, f32…, 0A; little-endian; inside, 0A is sent as DB DC and DB as DB DD
    {…}       JSON, answers to commands              ^ channel message    one of several sensors on one line

| letter | numbers |
|---|---|
| I | gyroscope x y z in °/s, accelerometer x y z in g |
| Q | quaternion w x y z, earth from sensor |
| A | roll, pitch, yaw in degrees |
| T | temperature in °C |
| B | battery in %, volts, how it charges |
| N, F | a text: a note, an error |

Other letters are read over. There is no checksum: what cannot be a measurement is damaged. Of several sensors on one
line the first is heard.
"""

import math
import struct
from collections.abc import Sequence

from station.core.imu import Quaternion
from station.devices.imu.frame_cutter import LineCutter
from station.devices.imu.imu_reading import (
    Heard,
    Reading,
    Told,
    acceleration_of,
    quaternion_of_angles,
    rate_of,
    unit_quaternion,
)

_LONGEST_LINE = 4_096
"""No message is so long: a JSON answer has about a kilobyte (our choice)."""
_HEAD = struct.Struct("<BQ")
_NUMBERS = {"I": 6, "Q": 4, "A": 3, "T": 1, "B": 3, "M": 3, "H": 3, "R": 9}
"""How many numbers follow the time, where that is known."""
_FLOATS = {count: struct.Struct(f"<{count}f") for count in {*_NUMBERS.values()}}
_BINARY_INERTIAL = 0x80 | ord("I")
_INERTIAL = struct.Struct("<BQ6f")
_CLOCK_ENDS = 2**64
"""Where the µs of a binary message end; a text holds no more."""
_FULL = 100.0


class XImu3Decoder:
    """One line's state: half a message, the orientation told last, the channel that is heard."""

    def __init__(self) -> None:
        self.good_bytes = 0
        self.bad_bytes = 0
        self._lines = LineCutter(_LONGEST_LINE)
        self._channel: int | None = None
        self._orientation: tuple[int, Quaternion] | None = None

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at `at_ns` complete."""
        heard: list[Heard] = []
        for line in self._lines.feed(data):
            found = self._message(line, at_ns)
            if found is None:
                self.bad_bytes += len(line) + 1
            else:
                self.good_bytes += len(line) + 1
                heard += found
        self.bad_bytes += self._lines.dropped_bytes
        self._lines.dropped_bytes = 0
        return heard

    def _message(self, line: bytes, at_ns: int) -> Sequence[Heard] | None:
        """What one line says, None where it is damaged."""
        first = line[0] if line else 0
        if first == _BINARY_INERTIAL and len(line) == _INERTIAL.size and b"\xdb" not in line:  # most lines, made short
            _, micros, *numbers = _INERTIAL.unpack(line)
            return self._inertial(micros, numbers, at_ns)
        if first == ord("^"):
            return self._of_channel(line, at_ns)
        if first == ord("{"):
            return () if line.rstrip().endswith(b"}") else None
        return self._binary(line, at_ns) if first & 0x80 else self._ascii(line, at_ns)

    def _of_channel(self, line: bytes, at_ns: int) -> Sequence[Heard] | None:
        if len(line) < 3 or line[2] == ord("^"):
            return None
        if self._channel is None:
            self._channel = line[1]
        return self._message(line[2:], at_ns) if line[1] == self._channel else ()

    def _binary(self, line: bytes, at_ns: int) -> Sequence[Heard] | None:
        message = _unstuffed(line)
        if message is None or len(message) < _HEAD.size:
            return None
        first, micros = _HEAD.unpack_from(message)
        letter, payload = chr(first & 0x7F), message[_HEAD.size :]
        if letter in ("N", "F"):
            return (_note(letter, payload),)
        count = _NUMBERS.get(letter)
        if count is None:
            return () if letter.isascii() and letter.isupper() and len(payload) % 4 == 0 else None
        if len(payload) != 4 * count:
            return None
        return self._numbers(letter, micros, _FLOATS[count].unpack(payload), at_ns)

    def _ascii(self, line: bytes, at_ns: int) -> Sequence[Heard] | None:
        head, *fields = line.rstrip(b"\r").split(b",")
        letter = head.decode("latin-1")
        if len(letter) != 1 or not ("A" <= letter <= "Z") or not fields:
            return None
        try:
            micros = int(fields[0])
            if letter in ("N", "F"):
                return (_note(letter, b",".join(fields[1:])),)
            numbers = [float(field) for field in fields[1:]]
        except ValueError:
            return None
        count = _NUMBERS.get(letter)
        if count is None:
            return ()
        is_whole = len(numbers) == count and 0 <= micros < _CLOCK_ENDS
        return self._numbers(letter, micros, numbers, at_ns) if is_whole else None

    def _numbers(self, letter: str, micros: int, numbers: Sequence[float], at_ns: int) -> Sequence[Heard] | None:
        if not all(map(math.isfinite, numbers)):
            return None
        match letter:
            case "I":
                return self._inertial(micros, numbers, at_ns)
            case "Q" | "A":
                turn = unit_quaternion(*numbers) if letter == "Q" else quaternion_of_angles(*numbers)
                self._orientation = None if turn is None else (micros, turn)
                return None if turn is None else ()
            case "T":
                return (Told(temperature_c=numbers[0]),)
            case "B":
                return (Told(battery=min(1.0, max(0.0, numbers[0] / _FULL))),)
            case _:
                return ()

    def _inertial(self, micros: int, numbers: Sequence[float], at_ns: int) -> Sequence[Heard] | None:
        rate, acceleration = rate_of(numbers[:3]), acceleration_of(numbers[3:])
        if rate is None or acceleration is None:
            return None
        told = self._orientation
        return (Reading(at_ns, acceleration, rate, told[1] if told and told[0] == micros else None, micros),)


def _unstuffed(line: bytes) -> bytes | None:
    """The message as it was before stuffing; None where an escape means nothing."""
    if 0xDB not in line:
        return line
    first, *rest = line.split(b"\xdb")
    if any(part[:1] not in (b"\xdc", b"\xdd") for part in rest):
        return None
    return first + b"".join((b"\n" if part[0] == 0xDC else b"\xdb") + part[1:] for part in rest)


def _note(letter: str, text: bytes) -> Told:
    said = text.decode("utf-8", "replace").strip()
    return Told(note=f"error: {said}" if letter == "F" else said)
