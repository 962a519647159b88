"""Speaks as motion sensors do: bytes of each protocol, packed by hand from its table, and a sensor at a pty.

Sources: WitMotion's REG.h and wit_c_sdk.c, the x-IMU3 User Manual v0.11, the BNO08X datasheet (UART-RVC), and the
description of our own CSV in `docs/sensors.md`. Nothing of the decoders under test is used.
"""

import struct
from collections.abc import Callable, Iterable
from typing import NamedTuple

Three = tuple[float, float, float]


class Measured(NamedTuple):
    """What a sensor measured: seconds by its own clock, g, °/s; quaternion w, x, y, z."""

    t_s: float
    g: Three
    degrees_per_s: Three = (0.0, 0.0, 0.0)
    turn: tuple[float, float, float, float] | None = None


# --- x-IMU3 -----------------------------------------------------------------------------------------------------------


def x_imu3_binary(letter: str, t_us: int, numbers: Iterable[float] = (), text: str = "") -> bytes:
    """One binary message: 0x80 + letter, u64 µs, f32 each; 0A and DB escaped; 0A at the end."""
    plain = struct.pack("<BQ", ord(letter) + 0x80, t_us)
    for number in numbers:
        plain += struct.pack("<f", number)
    plain += text.encode()
    return plain.replace(b"\xdb", b"\xdb\xdd").replace(b"\x0a", b"\xdb\xdc") + b"\x0a"


def x_imu3_ascii(letter: str, t_us: int, numbers: Iterable[float] = (), text: str = "") -> bytes:
    """One text message."""
    fields = [f"{number:.4f}" for number in numbers] + ([text] if text else [])
    return ",".join([letter, str(t_us), *fields]).encode() + b"\r\n"


def x_imu3(measured: Measured, binary: bool = True) -> bytes:
    """The inertial message of one measurement: gyroscope before accelerometer."""
    speak = x_imu3_binary if binary else x_imu3_ascii
    return speak("I", round(measured.t_s * 1e6), [*measured.degrees_per_s, *measured.g])


# --- WitMotion --------------------------------------------------------------------------------------------------------


def wit_frame(kind: int, payload: bytes) -> bytes:
    """A serial frame of 11 bytes: 55, type, eight bytes, low byte of the sum of all before."""
    assert len(payload) == 8
    frame = bytes([0x55, kind]) + payload
    return frame + bytes([sum(frame) % 256])


def wit_words(kind: int, *words: int) -> bytes:
    """A serial frame of four signed 16-bit numbers."""
    return wit_frame(kind, struct.pack("<hhhh", *words))


def wit_time(t_s: float, day: int = 23, hour: int = 10) -> bytes:
    """The frame of date and time: 2026-11-23, 10:00:00.000 and `t_s` seconds."""
    ms = round(t_s * 1000)
    minute, second = divmod(ms // 1000, 60)
    more_hours, minute = divmod(minute, 60)
    head = bytes([26, 11, day, hour + more_hours, minute, second])
    return wit_frame(0x50, head + struct.pack("<H", ms % 1000))


def wit_serial(measured: Measured, with_time: bool = False) -> bytes:
    """Time if wanted, acceleration and angular rate, and the quaternion where there is one."""
    x, y, z = (round(each * 32768 / 16) for each in measured.g)
    p, q, r = (round(each * 32768 / 2000) for each in measured.degrees_per_s)
    frames = wit_words(0x51, x, y, z, 2500) + wit_words(0x52, p, q, r, 2500)
    if measured.turn is not None:
        frames += wit_words(0x59, *(round(part * 32767) for part in measured.turn))
    return (wit_time(measured.t_s) if with_time else b"") + frames


def wit_ble(measured: Measured, degrees: Three = (0.0, 0.0, 0.0)) -> bytes:
    """A Bluetooth packet of 20 bytes: acceleration, angular rate, angles."""
    words = [round(each * 2048) for each in measured.g]
    words += [round(each * 32768 / 2000) for each in measured.degrees_per_s]
    words += [round(each * 32768 / 180) for each in degrees]
    return b"\x55\x61" + struct.pack("<9h", *words)


def wit_ble_reply(register: int, *words: int) -> bytes:
    """A Bluetooth answer of 20 bytes: eight numbers from `register` on."""
    return b"\x55\x71" + struct.pack("<H8h", register, *words, *[0] * (8 - len(words)))


# --- BNO085 -----------------------------------------------------------------------------------------------------------


def rvc(index: int, g: Three, yaw_pitch_roll: Three = (0.0, 0.0, 0.0)) -> bytes:
    """A frame of 19 bytes: hundredths of a degree, mg, the sum of bytes 2 to 17."""
    angles = [round(each * 100) for each in yaw_pitch_roll]
    milli = [round(each * 1000) for each in g]
    body = struct.pack("<Bhhhhhhxxx", index % 256, *angles, *milli)
    return b"\xaa\xaa" + body + bytes([sum(body) % 256])


# --- CSV --------------------------------------------------------------------------------------------------------------


def csv_line(measured: Measured, checked: bool = False) -> bytes:
    """A line of our own, with `$IMU,` and the exclusive or of what stands between $ and * where it is `checked`."""
    numbers = [*measured.g, *measured.degrees_per_s, *(measured.turn or ())]
    body = ",".join([str(round(measured.t_s * 1e6)), *(f"{number:.6f}" for number in numbers)])
    if not checked:
        return body.encode() + b"\n"
    body, check = f"IMU,{body}", 0
    for letter in body.encode():
        check ^= letter
    return f"${body}*{check:02X}\n".encode()


PROTOCOLS: dict[str, Callable[[int, Measured], bytes]] = {
    "x-imu3": lambda index, measured: x_imu3(measured),
    "x-imu3 text": lambda index, measured: x_imu3(measured, binary=False),
    "csv": lambda index, measured: csv_line(measured),
    "csv checked": lambda index, measured: csv_line(measured, checked=True),
    "bno085-rvc": lambda index, measured: rvc(index, measured.g),
    "witmotion": lambda index, measured: wit_serial(measured),
    "witmotion timed": lambda index, measured: wit_serial(measured, with_time=True),
    "witmotion-ble": lambda index, measured: wit_ble(measured),
}
"""A packet of each way to speak, from its number and what was measured; the first word names the protocol."""


def ramp(count: int, rate_hz: float = 200.0) -> list[Measured]:
    """Measurements of which no two are alike: 1 g upwards, and a y that tells the number by hundredths of a g."""
    return [
        Measured(1.0 + index / rate_hz, (0.0, index % 200 / 100.0, 1.0), (10.0, -20.0, 1.0)) for index in range(count)
    ]


def ramp_index(y_m_s2: float) -> int:
    """The number, modulo 200, that the y of one of `ramp` tells."""
    return round(y_m_s2 / 9.80665 * 100)
