"""`station devices setup-stick PORT`: sets a WitMotion sensor to what the station has use for, and keeps it there."""

import time
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from station.cli.console import say
from station.cli.options.option_fields import argument, option, whole_number

if TYPE_CHECKING:
    from station.devices.device_ports import DeviceRequest

_BETWEEN_S = 0.2
"""So long a sensor is given for a command (our choice: WitMotion's own program waits 100 ms)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SetupStickOptions:
    """Which sensor, and what it is to do."""

    port: str = argument("PORT", "a WitMotion sensor: serial:PATH[@BAUD] as it is set now, or ble:NAME", str)
    rate: int = option("HZ", "samples a second: 10, 20, 50, 100, 125 or 200 (200)", whole_number, 200)
    baud: int | None = option("BAUD", "its rate over a wire from then on (as it is)", whole_number, None)


def run(options: SetupStickOptions) -> int:
    """Set the sensor, then keep it so, over a wire at its new rate."""
    from station.devices.imu.ble_ports import BLE
    from station.devices.imu.witmotion_setup import save, setup
    from station.devices.stick_ports import parse_stick

    request = parse_stick(options.port)
    baud = None if request.part.startswith(BLE) else (options.baud or request.baud)
    _send(request, setup(options.rate, baud))
    _send(request if baud is None else replace(request, baud=baud), save())
    at = "" if baud is None else f"@{baud}"
    say(f"told to send {options.rate} samples a second; see devices monitor --sticks {request.part}{at}")
    return 0


def _send(request: "DeviceRequest", commands: Iterable[bytes]) -> None:
    from station.devices.stick_ports import opened_stick

    with opened_stick(request) as port:
        for each in commands:
            port.write(each)
            time.sleep(_BETWEEN_S)
