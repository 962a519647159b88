"""WitMotion's commands against the bytes of its documents."""

import pytest

from station.core.errors import BadInput
from station.devices.imu.witmotion_setup import ask, save, setup


def spelled(commands: list[bytes]) -> list[str]:
    return [each.hex(" ").upper() for each in commands]


def test_the_commands_are_the_maker_s() -> None:
    """REG.h: unlock 69 = B588, RSW 02 (bit n: type 50 + n), RRATE 03 (B: 200 Hz), BAUD 04 (9: 921,600), SAVE 00."""
    wanted = 1 << 0 | 1 << 1 | 1 << 2 | 1 << 9  # time, acceleration, angular rate, quaternion
    assert spelled(setup(200, 921_600)) == [
        "FF AA 69 88 B5",
        f"FF AA 02 {wanted & 255:02X} {wanted >> 8:02X}",
        "FF AA 03 0B 00",
        "FF AA 04 09 00",
    ]
    assert spelled(save()) == ["FF AA 69 88 B5", "FF AA 00 00 00"]
    assert spelled([ask(0x64)]) == ["FF AA 27 64 00"]


def test_over_bluetooth_the_rate_alone_is_set() -> None:
    assert spelled(setup(50)) == ["FF AA 69 88 B5", "FF AA 03 08 00"]


@pytest.mark.parametrize(
    ("rate_hz", "baud", "fault"), [(60, None, "10, 20, 50"), (10, 4800, "9600"), (200, 9600, "carry")]
)
def test_what_no_sensor_can_do_is_refused(rate_hz: int, baud: int | None, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        setup(rate_hz, baud)
