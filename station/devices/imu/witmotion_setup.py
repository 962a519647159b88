"""Sets up a WitMotion sensor: which bytes tell it what to send, how often, how fast.

A command is `FF AA REGISTER LOW HIGH`, without checksum or answer. Settings hold for ten seconds after the lock was
opened, and over a loss of power only where they are saved.
Source: WITMOTION/WitStandardProtocol_JY901, REG.h and wit_c_sdk.c; WITMOTION/WitBluetooth_BWT901BLE5_0.
"""

import struct
from collections.abc import Mapping
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.toml.schema import either
from station.devices.imu.witmotion import ACCELERATION, FIRST_TYPE, QUATERNION, RATE, TIME

_COMMAND = struct.Struct("<2sBH")
_PREFIX = b"\xff\xaa"
_SAVE, _CONTENT, _RATE, _BAUD, _READ, _UNLOCK = 0x00, 0x02, 0x03, 0x04, 0x27, 0x69
_KEY = 0xB588
RATES: Mapping[int, int] = MappingProxyType({10: 6, 20: 7, 50: 8, 100: 9, 125: 10, 200: 11})
"""Samples a second, and the number that stands for them."""
BAUDS: Mapping[int, int] = MappingProxyType({9_600: 2, 115_200: 6, 460_800: 8, 921_600: 9})
BITS_A_FRAME = 110
"""Eleven bytes, each with a start and a stop bit."""
WANTED = (TIME, ACCELERATION, RATE, QUATERNION)
"""What the station has use for: without the time, samples can only be counted."""


def command(register: int, value: int) -> bytes:
    """The bytes that put `value` into `register`."""
    return _COMMAND.pack(_PREFIX, register, value)


_UNLOCKED = command(_UNLOCK, _KEY)


def ask(register: int) -> bytes:
    """The bytes that ask for what stands from `register` on, such as the battery's voltage."""
    return command(_READ, register)


def setup(rate_hz: int, baud: int | None = None) -> list[bytes]:
    """The commands, in order, after which a sensor sends what the station wants, `rate_hz` times a second.

    `baud` is the rate over its wire from the last of them on; None where there is no wire, for what is sent over
    Bluetooth is always the same. Each command needs a tenth of a second, and `save` keeps what they set. Raises
    `BadInput` for a rate that there is not, or that is more than the wire can carry.
    """
    _choose("rate", rate_hz, RATES)
    if baud is None:
        return [_UNLOCKED, command(_RATE, RATES[rate_hz])]
    _choose("baud", baud, BAUDS)
    if rate_hz * len(WANTED) * BITS_A_FRAME > baud:
        raise BadInput(f"{rate_hz} samples a second", "", f"{baud} baud cannot carry so many")
    content = sum(1 << kind - FIRST_TYPE for kind in WANTED)
    return [_UNLOCKED, command(_CONTENT, content), command(_RATE, RATES[rate_hz]), command(_BAUD, BAUDS[baud])]


def save() -> list[bytes]:
    """The commands that make what is set outlast a loss of power; over a wire at its new rate."""
    return [_UNLOCKED, command(_SAVE, 0)]


def _choose(what: str, value: int, table: Mapping[int, int]) -> None:
    if value not in table:
        raise BadInput(f"{what} {value}", "", f"expected {either(map(str, table))}")
