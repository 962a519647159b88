"""What a session knows of sensors on the sticks, and what of it the student is told."""

from station.core.events import SensorLost, SensorMounted
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.practice.session.engine_state import EngineState

RIGHT = SensorMounted(0, "x-IMU3 1", Mounting(Limb.RIGHT_HAND))
UNKNOWN = SensorMounted(0, "x-IMU3 1", Mounting())


def test_of_a_sensor_whose_hand_is_known_nobody_needs_to_read() -> None:
    heard = EngineState()

    heard.handle(RIGHT)

    assert heard.sensors == {"x-IMU3 1": Limb.RIGHT_HAND}
    assert heard.notices == []


def test_where_no_hand_is_known_it_is_said_once_what_that_costs_and_what_mends_it() -> None:
    heard = EngineState()

    heard.handle(UNKNOWN)
    heard.handle(UNKNOWN)  # it is mounted anew with every capture

    (notice,) = heard.notices
    assert notice.startswith("x-IMU3 1: no hand is known to hold this stick")
    assert "mounting gesture" in notice


def test_a_sensor_that_went_away_is_told() -> None:
    heard = EngineState()

    heard.handle(RIGHT)
    heard.handle(SensorLost(1, "x-IMU3 1"))

    assert heard.sensors == {}
    assert heard.notices == ["x-IMU3 1 is gone: its stick's strokes are not told until it is back"]


def test_a_session_knows_the_sensors_of_the_one_before() -> None:
    before, heard = EngineState(), EngineState()
    before.handle(UNKNOWN)

    heard.go_on_from(before)
    heard.handle(UNKNOWN)

    assert heard.notices == []
