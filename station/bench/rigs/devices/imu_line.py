"""Motion sensors that send without end: packets of each protocol, and a process that sends them down a serial line.

As a program: `python -m station.bench.rigs.devices.imu_line PATH BAUD SECONDS` plugs a pty in at PATH and waits for a
line of input; then it sends x-IMU3 packets as fast as a wire of BAUD bits a second carries them, prints how many, and
unplugs when its input ends.
"""

import struct
import sys
import time
from collections.abc import Callable
from pathlib import Path

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.imu import Vector
from station.devices.driver_clocks import BITS_A_BYTE

_TOGETHER = 16
"""Packets that are sent at once, as an adapter's buffer sends them."""


def x_imu3(index: int, t_us: int) -> bytes:
    """An inertial message of the x-IMU3, whose acceleration along x tells its number modulo 1,000, in mg."""
    return x_imu3_measured(t_us, (0.5, -200.0, 31.25), (index % 1_000 / 1_000, 0.0, 1.0))


def x_imu3_measured(t_us: int, rate_dps: Vector, acceleration_g: Vector) -> bytes:
    """An inertial message of the x-IMU3."""
    plain = struct.pack("<BQ6f", 0xC9, t_us, *rate_dps, *acceleration_g)
    return plain.replace(b"\xdb", b"\xdb\xdd").replace(b"\n", b"\xdb\xdc") + b"\n"


def csv(index: int, t_us: int) -> bytes:
    """A checked line of CSV."""
    body = f"IMU,{t_us},{index % 1_000 / 1_000:.3f},0.01234,1.00001,0.5000,-200.1250,31.2500".encode()
    check = 0
    for byte in body:
        check ^= byte
    return b"$%b*%02X\n" % (body, check)


def rvc(index: int, _: int) -> bytes:
    """A frame of the BNO085."""
    body = struct.pack("<B6h3x", index % 256, 100, -200, 300, index % 1_000, 0, 1_000)
    return b"\xaa\xaa" + body + bytes([sum(body) & 255])


def witmotion(index: int, t_us: int) -> bytes:
    """A measurement of a WitMotion: time, acceleration, rate and quaternion."""
    ms = t_us // 1_000
    time_frame = struct.pack("<8BH", 0x55, 0x50, 26, 11, 23, 10, ms // 60_000 % 60, ms // 1_000 % 60, ms % 1_000)
    words = ((0x51, index % 1_000, 0, 2_048, 0), (0x52, 100, -200, 300, 0), (0x59, 32_767, 0, 0, 0))
    frames = [time_frame, *(struct.pack("<BB4h", 0x55, *each) for each in words)]
    return b"".join(frame + bytes([sum(frame) & 255]) for frame in frames)


def witmotion_ble(index: int, _: int) -> bytes:
    """A Bluetooth packet of a WitMotion."""
    return struct.pack("<BB9h", 0x55, 0x61, index % 1_000, 0, 2_048, 100, -200, 300, 0, 0, 0)


SPEECH: dict[str, Callable[[int, int], bytes]] = {
    "x-imu3": x_imu3,
    "csv": csv,
    "bno085-rvc": rvc,
    "witmotion": witmotion,
    "witmotion-ble": witmotion_ble,
}
"""A packet of each protocol, from its number and the sensor's time in µs."""


def main(path: str, baud: str, seconds: str) -> None:
    """The program's whole life."""
    with SerialKit(Path(path)) as line:
        sys.stdin.readline()  # the station has opened the port
        print(_send(line, float(baud), float(seconds)), flush=True)  # noqa: T201 - to the process that waits for it
        sys.stdin.read()  # and has read all


def _send(line: SerialKit, baud: float, seconds: float) -> int:
    """Send as fast as the wire allows; returns how many packets."""
    begun_s, sent, due_s = time.monotonic(), 0, 0.0
    while due_s < seconds:
        chunk = b"".join(x_imu3(sent + index, round(due_s * 1e6) + index) for index in range(_TOGETHER))
        line.play(chunk)
        sent += _TOGETHER
        due_s += len(chunk) * BITS_A_BYTE / baud
        time.sleep(max(0.0, begun_s + due_s - time.monotonic()))
    return sent


if __name__ == "__main__":
    main(*sys.argv[1:])
