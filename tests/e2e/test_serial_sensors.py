"""Two sensors on two serial lines, from the pty to samples: each protocol, unplugged in mid-message and back again.

The expected values are what was sent.
"""

import sys
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.clock import monotonic_ns
from station.core.events import SensorSamples
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.devices.decoders import DecoderBank
from station.devices.port_watch import PortWatch
from station.devices.stick_ports import parse_sticks, watch_sticks
from tests.fakes.ble_air import until
from tests.fakes.imu_speech import PROTOCOLS, ramp, ramp_index

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")
COUNT, RATE_HZ = 60, 400


class Listener:
    """What the bank makes of two sensors."""

    def __init__(self, watches: tuple[PortWatch, ...]) -> None:
        self._watches = watches
        self._bank = DecoderBank()
        self.told: dict[str, list[int]] = {}
        self.times_ns: list[int] = []
        self.lost = 0

    def poll(self) -> None:
        """One look at both."""
        for watch in self._watches:
            findings = watch.poll(monotonic_ns())
            if findings.found:
                self._bank.add_sensor(findings.device, Mounting())
                self.told.setdefault(findings.device, [])
            self.lost += findings.lost
            for packet in findings.packets:
                for event in self._bank.feed(findings.device, packet.data, packet.at_ns).sensed:
                    for sample in event.samples if isinstance(event, SensorSamples) else ():
                        self.told[findings.device].append(ramp_index(sample.acceleration_m_s2[1]))
                        self.times_ns.append(sample.at_ns)

    def has_told(self, device: str, indices: list[int]) -> bool:
        """Whether exactly these samples have come; looks once more."""
        self.poll()
        return self.told.get(device) == indices

    def has_lost(self) -> bool:
        """Whether a sensor has gone; looks once more."""
        self.poll()
        return self.lost == 1

    def hear(self, *sensors: SerialKit, packets: list[bytes]) -> None:
        """Have the sensors play the packets, at their pace, and listen meanwhile."""
        due_ns = monotonic_ns()
        for packet in packets:
            while monotonic_ns() < due_ns:
                self.poll()
            due_ns += NS_PER_S // RATE_HZ
            for sensor in sensors:
                sensor.play(packet)


@pytest.mark.parametrize("name", PROTOCOLS)
def test_two_sensors_are_heard_unplugged_and_heard_again(name: str, tmp_path: Path) -> None:
    packets = [PROTOCOLS[name](index, measured) for index, measured in enumerate(ramp(COUNT, RATE_HZ))]
    with SerialKit(tmp_path / "ttyUSB0") as right, SerialKit(tmp_path / "ttyUSB1") as left:
        watches = watch_sticks(parse_sticks(f"{right.device}; {left.device}@921600"))
        listener, all_of_them, begun_ns = Listener(watches.sticks), list(range(COUNT)), monotonic_ns()
        assert until(lambda: listener.has_told(right.device, []) and listener.has_told(left.device, []))
        listener.hear(right, left, packets=packets)
        assert until(lambda: listener.has_told(right.device, all_of_them))
        assert until(lambda: listener.has_told(left.device, all_of_them))
        right.play(packets[0][:7])
        right.unplug()
        assert until(listener.has_lost)
        del listener.told[right.device]
        right.plug()
        assert until(lambda: listener.has_told(right.device, []))
        listener.hear(right, packets=packets)
        assert until(lambda: listener.has_told(right.device, all_of_them))
        assert listener.told[left.device] == all_of_them
        assert begun_ns - NS_PER_S < min(listener.times_ns)
        assert max(listener.times_ns) <= monotonic_ns()
        watches.close()
