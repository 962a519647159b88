"""What there is to play on: a kit, or, where one hangs in the air, sticks whose sensors are heard."""

import pytest

from station.core.clock import ManualClock
from station.core.events import DeviceFound, DeviceLost, SensorLost, SensorMounted
from station.core.imu import Mounting
from station.engine.messages import EngineEvent
from station.practice.headless.live import LiveSetup
from station.practice.session.engine_state import EngineState
from tests.fakes.stations import Line

STICK = SensorMounted(0, "x-IMU3", Mounting())


@pytest.mark.parametrize(
    ("events", "in_air", "is_played"),
    [
        ([], False, False),
        ([], True, False),
        ([DeviceFound(0, "TD-17")], False, True),
        ([STICK], False, False),
        ([STICK], True, True),
        ([STICK, SensorLost(1, "x-IMU3")], True, False),
        ([DeviceFound(0, "TD-17"), STICK, DeviceLost(1, "TD-17")], False, False),
    ],
)
def test_sticks_are_a_kit_where_one_hangs_in_the_air(events: list[EngineEvent], in_air: bool, is_played: bool) -> None:
    heard = EngineState()
    for event in events:
        heard.handle(event)
    setup = LiveSetup(Line(), ManualClock(), lambda *_: None, in_air=in_air)
    assert setup.is_played(heard) is is_played
    assert (setup.fault(heard) is None) is is_played
