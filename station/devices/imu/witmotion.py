"""WitMotion's sensors: frames of 11 bytes over a serial line, and packets of 20 bytes over Bluetooth.

Sources: WITMOTION/WitStandardProtocol_JY901 (REG.h, wit_c_sdk.c), WITMOTION/WitBluetooth_BWT901BLE5_0,
ElettraSciComp/witmotion_IMU_QT doc/protocol.md; numbers are little-endian.

    serial       55 TYPE d0…d7 SUM        SUM the low byte of the sum of the ten before it
    Bluetooth    55 61 nine i16           acceleration, angular rate, angles; no checksum
                 55 71 REG u16, eight i16 what was asked for

A sensor sends the frames of one measurement one after the other, in the order of their types. Which it sends is a
setting, so a measurement ends with the type that ended the one before; it counts if it has acceleration, and the
angular rate if the one before had it.
"""

import struct

from station.core.imu import Quaternion, Vector
from station.devices.imu.frame_cutter import FrameCutter
from station.devices.imu.imu_reading import (
    Heard,
    Reading,
    Told,
    acceleration_of,
    quaternion_of_angles,
    rate_of,
    unit_quaternion,
)

HEADER = b"\x55"
TIME, ACCELERATION, RATE, ANGLES, QUATERNION = 0x50, 0x51, 0x52, 0x53, 0x59
FIRST_TYPE, LAST_TYPE = 0x50, 0x5F
MEASURED, REPLY = 0x61, 0x71

_FULL = 32_768.0
_G, _DEGREES_PER_S, _DEGREES = 16.0 / _FULL, 2000.0 / _FULL, 180.0 / _FULL
"""What one step of 16 bits stands for: the protocol counts on ± 16 g, ± 2000 °/s and ± 180°, whatever range is set."""
_FRAME_SIZE, _PACKET_SIZE = 11, 20
_WORDS = struct.Struct("<2x4hx")
_TIME = struct.Struct("<2x6BHx")
_NINE = struct.Struct("<2x9h")
_REGISTER = struct.Struct("<2xHh")
_CELSIUS = 100.0
TEMPERATURE_REGISTER, BATTERY_REGISTER = 0x40, 0x64
_BATTERY = (
    (396, 1.0),
    (393, 0.9),
    (387, 0.75),
    (382, 0.6),
    (379, 0.5),
    (377, 0.4),
    (373, 0.3),
    (370, 0.2),
    (368, 0.15),
    (350, 0.1),
    (340, 0.05),
)
"""From how many hundredths of a volt on the battery is how full (WitMotion, Bluetooth 5.0 communication protocol)."""


class WitMotionDecoder:
    """One serial line's state: half a frame, the measurement that is being sent."""

    def __init__(self) -> None:
        self._frames = FrameCutter(HEADER, _FRAME_SIZE, _is_sound)
        self._group = _Group()
        self._last_type = 0  # the type that ended the measurement before
        self._had_rate = False

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
            kind = frame[1]
            if kind <= self._group.newest_type:
                heard += self._ended()
            elif self._last_type and self._group.newest_type < 0:  # what ended the one before was not its end
                self._last_type = max(kind, self._last_type)
            self._group.take(frame, at_ns)
            if kind == self._last_type:
                heard += self._ended()
        return heard

    def _ended(self) -> list[Heard]:
        """What the measurement that ends here comes to."""
        group, self._group = self._group, _Group()
        lacks_rate = self._had_rate and group.rate is None
        self._had_rate = group.rate is not None
        if group.acceleration is None or lacks_rate:
            return []
        self._last_type = group.newest_type
        return [Reading(group.at_ns, group.acceleration, group.rate, group.turn, group.ticks)]


class _Group:
    """The frames of one measurement so far."""

    def __init__(self) -> None:
        self.newest_type = -1
        self.at_ns = 0
        self.acceleration: Vector | None = None
        self.rate: Vector | None = None
        self.turn: Quaternion | None = None
        self.ticks: int | None = None

    def take(self, frame: bytes, at_ns: int) -> None:
        """Add a frame that came at `at_ns`."""
        self.newest_type, self.at_ns = frame[1], at_ns
        if frame[1] == TIME:
            self.ticks = _milliseconds(frame)
            return
        a, b, c, d = _WORDS.unpack(frame)
        match frame[1]:
            case 0x51:
                self.acceleration = acceleration_of((a * _G, b * _G, c * _G))
            case 0x52:
                self.rate = rate_of((a * _DEGREES_PER_S, b * _DEGREES_PER_S, c * _DEGREES_PER_S))
            case 0x53:
                self.turn = quaternion_of_angles(a * _DEGREES, b * _DEGREES, c * _DEGREES)
            case 0x59:  # nobody says that q0 is w, but at rest and flat it is the one near 1
                self.turn = unit_quaternion(a / _FULL, b / _FULL, c / _FULL, d / _FULL) or self.turn


def _is_sound(frame: bytes) -> bool:
    return FIRST_TYPE <= frame[1] <= LAST_TYPE and sum(frame[:-1]) & 0xFF == frame[-1]


def _milliseconds(frame: bytes) -> int:
    """The sensor's date and time as one number; every month has 31 days, for only differences within a day count."""
    year, month, day, hour, minute, second, ms = _TIME.unpack(frame)
    days = (year * 12 + month) * 31 + day
    return int((((days * 24 + hour) * 60 + minute) * 60 + second) * 1000 + ms)


class WitMotionBleDecoder:
    """One Bluetooth connection's state: half a packet, and whether it is known where packets begin."""

    def __init__(self) -> None:
        self._waiting = b""
        self._is_aligned = False
        self.good_bytes = 0
        self.bad_bytes = 0

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at `at_ns` complete."""
        stream, at = self._waiting + data, 0
        heard: list[Heard] = []
        while len(stream) - at >= _PACKET_SIZE:
            begins = _begins(stream, at)
            if begins and not self._is_aligned and len(stream) - at < _PACKET_SIZE + 2:
                break  # without a checksum only the packet behind it tells that this is one
            if begins and (self._is_aligned or _begins(stream, at + _PACKET_SIZE)):
                self._is_aligned = True
                heard += _packet(stream[at : at + _PACKET_SIZE], at_ns)
                at += _PACKET_SIZE
                self.good_bytes += _PACKET_SIZE
            else:
                self._is_aligned = False
                at += 1
                self.bad_bytes += 1
        self._waiting = stream[at:]
        return heard


def _begins(stream: bytes, at: int) -> bool:
    return stream[at] == HEADER[0] and stream[at + 1] in (MEASURED, REPLY)


def _packet(packet: bytes, at_ns: int) -> list[Heard]:
    if packet[1] == MEASURED:
        a, b, c, x, y, z, roll, pitch, yaw = _NINE.unpack(packet)
        acceleration = acceleration_of((a * _G, b * _G, c * _G))
        assert acceleration is not None, "16 bits hold less than any limit"
        rate = rate_of((x * _DEGREES_PER_S, y * _DEGREES_PER_S, z * _DEGREES_PER_S))
        turn = quaternion_of_angles(roll * _DEGREES, pitch * _DEGREES, yaw * _DEGREES)
        return [Reading(at_ns, acceleration, rate, turn)]
    register, value = _REGISTER.unpack_from(packet)
    match register:
        case 0x40:
            return [Told(temperature_c=value / _CELSIUS)]
        case 0x64:
            return [Told(battery=next((full for least, full in _BATTERY if value >= least), 0.0))]
        case _:
            return []
