"""Which stick a motion sensor sits on, and how, as a TOML file: one a device, beside the user's own kits.

    limb = "right_hand"               # left_hand, or unknown until a gesture or the strokes have told
    turn = [1.0, 0.0, 0.0, 0.0]       # w, x, y, z: from the sensor's axes to the stick's (`core.imu`)
    tip_m = 0.33                      # from the sensor to the stick's tip, along the stick
    butt_m = 0.076                    # and to its butt
    learnt = false                    # whether the mounting gesture has told it

What is not said is assumed. A fault is `BadInput` with line and column.
"""

import math
import zlib
from pathlib import Path

from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.core.imu import Mounting, Quaternion
from station.core.pieces import Limb, word
from station.core.settings import settings_path
from station.core.toml.schema import Field, Fields, Reader, choice, flag, number, read, record, row_of
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source, text_source
from station.devices.mapping.device_file import own_kit_path

_LONGEST_M = 1.0
"""No stick is longer (our choice: the longest on sale have 45 cm)."""
_LONGEST_NAME = 40
"""Letters of a sensor's name that its file is called by: with a number behind them still a kit's (`device_file`)."""
_STRAYS = 0.01
"""How far from 1 the length of a turn may be: it is written with all its digits, and people round (our choice)."""

SENSOR_PRESET = "imu"
"""Stands in a capture where a kit's preset would: this device is a motion sensor, and its file is a stick's."""
ASSUMED = Mounting()
"""For a sensor that nobody has said anything of."""


def sticks_folder() -> Path:
    """Where the files of this user's sticks live."""
    return settings_path().parent / "sticks"


def stick_path(device: str, folder: Path | None = None) -> Path:
    """The file of the sensor called `device`, whether there is one or not."""
    is_long = len(device) > _LONGEST_NAME  # what tells two sensors apart may stand at the end, as in /dev/serial/by-id
    name = f"{device[:_LONGEST_NAME]} {zlib.crc32(device.encode('utf-8', 'replace')):08x}" if is_long else device
    return own_kit_path(name, folder or sticks_folder())


def own_stick(device: str, folder: Path | None = None) -> Mounting:
    """How the sensor `device` is mounted, as far as its file says; raises `BadInput` where that is at fault."""
    path = stick_path(device, folder)
    try:
        is_there = path.exists()
    except OSError as fault:  # the folder may not be looked into
        raise BadInput(path, "", fault.strerror or str(fault)) from fault
    return read(read_source(path), STICK) if is_there else ASSUMED


def parse_stick(text: str, name: str) -> Mounting:
    """The mounting in a text that `stick_text` wrote; raises `BadInput`, which names it `name`."""
    return read(text_source(text, name), STICK)


def save_stick(mounting: Mounting, device: str, folder: Path | None = None) -> Path:
    """Keep how `device` is mounted; returns where. Raises `DeviceError` if the disk refuses."""
    path = stick_path(device, folder)
    write_whole(path, stick_text(mounting).encode())
    return path


def stick_text(mounting: Mounting) -> str:
    """The file of `mounting`; reading it gives an equal one."""
    turn = ", ".join(repr(float(part)) for part in mounting.turn)
    return (
        f'limb = "{word(mounting.limb)}"\n'
        f"turn = [{turn}]\n"
        f"tip_m = {float(mounting.tip_m)!r}\n"
        f"butt_m = {float(mounting.butt_m)!r}\n"
        f"learnt = {str(mounting.learnt).lower()}\n"
    )


# --- reading ----------------------------------------------------------------------------------------------------------

_parts = row_of([number(-1.0 - _STRAYS, 1.0 + _STRAYS)] * 4, "[w, x, y, z] of a turn")


def _turn(value: object) -> Quaternion:
    w, x, y, z = _parts(value)
    if abs(math.hypot(w, x, y, z) - 1.0) > _STRAYS:
        raise wrong("expected [w, x, y, z] of a turn, whose squares make 1")
    return w, x, y, z


_HANDS = {word(limb): limb for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.UNKNOWN)}
FIELDS: Fields = {
    "limb": Field(choice(_HANDS, "hand"), ASSUMED.limb),
    "turn": Field(_turn, ASSUMED.turn),
    "tip_m": Field(number(0.0, _LONGEST_M), ASSUMED.tip_m),
    "butt_m": Field(number(0.0, _LONGEST_M), ASSUMED.butt_m),
    "learnt": Field(flag, ASSUMED.learnt),
}
STICK: Reader[Mounting] = record(Mounting, FIELDS)
