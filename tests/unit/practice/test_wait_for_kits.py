"""Before a session in the terminal the engine finds what was asked for, for so long and no longer."""

from dataclasses import dataclass, field

from station.core.events import DeviceFound, SensorMounted
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Command, EngineEvent, Ready
from station.practice.headless.live import wait_for_kits
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.session import Session

LOOK_NS = NS_PER_S // 10


@dataclass(eq=False)
class SlowEngine:
    """An engine, and the clock: each look takes a tenth of a second and brings what is due in the `looks`."""

    looks: list[EngineEvent] = field(default_factory=list)
    at_ns: int = 0

    def now_ns(self) -> int:
        return self.at_ns

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        self.at_ns += LOOK_NS
        return [self.looks.pop(0)] if self.looks else []

    def send(self, command: Command) -> None:
        raise AssertionError("nothing is to be sent yet")


def waited(looks: list[EngineEvent], sensors: int) -> SlowEngine:
    engine, plan = SlowEngine(looks), plan_practice(find_lesson("rock-1"), PlanOptions())
    wait_for_kits(engine, Session(plan), engine, 3.0, kits=1, sensors=sensors)
    return engine


def test_sensors_that_were_asked_for_are_waited_for_as_kits_are() -> None:
    looks: list[EngineEvent] = [Ready(None, None), DeviceFound(0, "kit"), SensorMounted(0, "stick", Mounting())]
    assert waited(list(looks), sensors=0).at_ns == 2 * LOOK_NS
    assert waited(list(looks), sensors=1).at_ns == 3 * LOOK_NS


def test_nobody_waits_long_for_a_sensor_that_does_not_come() -> None:
    assert waited([Ready(None, None), DeviceFound(0, "kit")], sensors=2).at_ns == LOOK_NS + 3 * NS_PER_S
