"""A recording of a real WitMotion over Bluetooth, from the hazer project, beside what it measured and an old reckoning.

The sensor lay still for the length of its few packets; its bytes are those of `hexdump -C`-like lines.
"""

import re
from math import hypot
from pathlib import Path

import pytest

from station.core.imu import STANDARD_GRAVITY_M_S2
from station.devices.imu.detect_protocol import DetectingDecoder
from station.devices.imu.imu_reading import Reading, Told
from station.devices.imu.witmotion import WitMotionBleDecoder
from tests.oracles.folder import oracles

pytestmark = pytest.mark.oracle

_LINE = re.compile(r"^[0-9a-f]+: ([0-9a-f ]+?)\s*\|", re.MULTILINE)


def bytes_of(dump: str) -> bytes:
    """The bytes of a dump: offset, hexadecimal digits in groups, then letters."""
    return b"".join(bytes.fromhex(digits) for digits in _LINE.findall(dump))


@pytest.mark.parametrize("path", oracles("a WitMotion's packets"))
def test_a_sensor_at_rest_measures_one_g_and_hardly_turns(path: Path) -> None:
    stream = bytes_of(path.read_text())
    decoder = WitMotionBleDecoder()
    heard = decoder.feed(stream, 0)
    readings = [each for each in heard if isinstance(each, Reading)]
    assert len(readings) >= 10
    assert decoder.bad_bytes < 20
    for reading in readings:
        assert hypot(*reading.acceleration_m_s2) == pytest.approx(STANDARD_GRAVITY_M_S2, rel=0.05)
        assert reading.rate_rad_s is not None
        assert hypot(*reading.rate_rad_s) < 0.05
        assert reading.orientation is not None
    told = [each.temperature_c for each in heard if isinstance(each, Told) and each.temperature_c is not None]
    assert all(10.0 < celsius < 40.0 for celsius in told)
    assert told


@pytest.mark.parametrize("path", oracles("a WitMotion's packets"))
def test_its_angles_agree_with_its_gravity(path: Path) -> None:
    """At rest the acceleration points up: turned into the earth's axes it is (0, 0, 1 g), but for its calibration."""
    for each in WitMotionBleDecoder().feed(bytes_of(path.read_text()), 0):
        if isinstance(each, Reading):
            assert each.orientation is not None
            w, x, y, z = each.orientation
            ax, ay, az = each.acceleration_m_s2
            up = 2 * (x * z - w * y) * ax + 2 * (y * z + w * x) * ay + (1 - 2 * (x * x + y * y)) * az
            assert up == pytest.approx(STANDARD_GRAVITY_M_S2, rel=0.05)


@pytest.mark.parametrize("path", oracles("a WitMotion's packets"))
def test_its_protocol_is_found_out(path: Path) -> None:
    decoder = DetectingDecoder()
    decoder.feed(bytes_of(path.read_text()), 0)
    assert decoder.protocol is not None
    assert decoder.protocol.name == "witmotion-ble"
