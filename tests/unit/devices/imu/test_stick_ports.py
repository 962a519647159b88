"""Sensors' ports: how they are asked for, serial lines read in chunks, Bluetooth through a fake radio."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.device_ports import DeviceRequest
from station.devices.imu import ble_ports
from station.devices.imu.ble_ports import BleDirectory, Radio
from station.devices.port_watch import PortPoll
from station.devices.serial.serial_ports import SerialDirectory
from station.devices.stick_ports import StickWatches, parse_sticks, watch_sticks
from station.devices.transport import Packet
from tests.fakes.ble_air import WIT_WRITTEN, FakeAir, FakeSensor, until

linux = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")


def test_sticks_are_asked_for_as_kits_are() -> None:
    assert parse_sticks("") == ()
    assert parse_sticks("serial:/dev/ttyUSB0; serial:COM4@921600;ble:WT901;CP2102@9600 ") == (
        DeviceRequest("serial:/dev/ttyUSB0", 115_200),
        DeviceRequest("serial:COM4", 921_600),
        DeviceRequest("ble:WT901", 31_250),
        DeviceRequest("CP2102", 9_600),
    )
    with pytest.raises(BadInput, match="5 baud"):
        parse_sticks("serial:/dev/ttyUSB0@5")


@linux
def test_a_serial_sensor_is_read_in_chunks_at_its_rate(tmp_path: Path) -> None:
    with SerialKit(tmp_path / "ttyUSB0") as sensor:
        watches = watch_sticks(parse_sticks(f"{sensor.device}@921600"), now_ns=lambda: 7)
        (watch,) = watches.sticks
        assert watch.poll(0).found
        assert sensor.rate() == (921_600, 921_600)
        sensor.play(bytes(100))
        heard = [packet for _ in range(1) for packet in _polled(watches, 100)]
        assert b"".join(packet.data for packet in heard) == bytes(100)
        assert len(heard) < 100
        assert {packet.at_ns for packet in heard} == {7}
        watches.close()


@linux
def test_what_is_written_reaches_the_sensor(tmp_path: Path) -> None:
    with SerialKit(tmp_path / "ttyUSB0") as sensor:
        port = SerialDirectory(115_200, in_chunks=True).open(sensor.device)
        port.write(b"\xff\xaa\x03\x0b\x00")
        assert sensor.heard(5) == b"\xff\xaa\x03\x0b\x00"
        port.close()
        with pytest.raises(DeviceError, match="closed"):
            port.write(b"x")


def _polled(watches: StickWatches, count: int) -> list[Packet]:
    packets: list[Packet] = []

    def enough() -> bool:
        packets.extend(watches.sticks[0].hear().packets)
        return sum(len(packet.data) for packet in packets) >= count

    assert until(enough)
    return packets


# --- Bluetooth --------------------------------------------------------------------------------------------------------


class Watched:
    """Watches over sensors in the air, whose time is moved by hand."""

    def __init__(self, air: FakeAir, asked: str) -> None:
        self.now_ns = 0
        self.air = air
        self.watches = watch_sticks(parse_sticks(asked), None, lambda: self.now_ns, lambda: air)

    def poll_until(self, what: str, index: int = 0) -> PortPoll:
        """Poll until something is `found` or `lost`, or a `fault` is told."""
        seen: list[PortPoll] = []

        def happened() -> bool:
            self.now_ns += 10 * NS_PER_MS
            seen.append(self.watches.sticks[index].poll(self.now_ns))
            return bool(getattr(seen[-1], what))

        assert until(happened)
        return seen[-1]


@pytest.fixture
def sensor() -> FakeSensor:
    return FakeSensor("WT901BLE67")


@pytest.fixture
def watched(sensor: FakeSensor) -> Iterator[Watched]:
    one = Watched(FakeAir(FakeSensor("Headphones", "00:11:22:33:44:55"), sensor), "ble:")
    yield one
    one.watches.close()


def test_a_bluetooth_sensor_is_found_heard_lost_and_found_again(watched: Watched, sensor: FakeSensor) -> None:
    assert watched.poll_until("found").device == "WT901BLE67 ble:DE:AD:BE:EF:00:01"
    assert sensor.is_subscribed.wait(20)
    watched.now_ns += 1
    at_ns = watched.now_ns
    sensor.notify(b"U\x61 one")
    sensor.notify(b"U\x61 two")
    packets = _polled(watched.watches, 12)
    assert [(packet.data, packet.at_ns) for packet in packets] == [(b"U\x61 one", at_ns), (b"U\x61 two", at_ns)]
    sensor.switch_off()
    watched.poll_until("lost")
    watched.now_ns += 60 * NS_PER_S  # it was announced long ago, and is no more
    assert not watched.watches.sticks[0].poll(watched.now_ns).found
    sensor.is_on = True
    assert watched.poll_until("found").device == "WT901BLE67 ble:DE:AD:BE:EF:00:01"
    assert sensor.is_subscribed.wait(20)


def test_the_radio_looks_only_while_a_sensor_is_missed(watched: Watched, sensor: FakeSensor) -> None:
    watched.poll_until("found")
    assert watched.air.is_scanning

    def is_quiet() -> bool:
        watched.now_ns += 100 * NS_PER_MS
        watched.watches.sticks[0].poll(watched.now_ns)
        return not watched.air.is_scanning

    assert until(is_quiet)


def test_a_witmotion_is_asked_for_its_battery_and_can_be_set(sensor: FakeSensor) -> None:
    radio = Radio(FakeAir(sensor))
    directory = BleDirectory(radio)
    assert until(lambda: bool(directory.names()))
    port = directory.open(directory.names()[0])
    assert until(lambda: port.is_connected)
    assert until(lambda: sensor.written == [(WIT_WRITTEN, bytes.fromhex("FF AA 27 64 00"))])
    port.write(b"\xff\xaa\x03\x0b\x00")
    assert until(lambda: sensor.written[1:] == [(WIT_WRITTEN, b"\xff\xaa\x03\x0b\x00")])
    port.close()
    assert until(lambda: sensor.client is None)
    with pytest.raises(DeviceError, match="not connected"):
        port.write(b"")
    radio.close()
    radio.close()


def test_a_sensor_without_a_service_that_we_know_is_given_up() -> None:
    sensor = FakeSensor("WT-toothbrush", notifies="0000180d-0000-1000-8000-00805f9b34fb")
    watched = Watched(FakeAir(sensor), "ble:tooth")
    watched.poll_until("found")
    watched.poll_until("lost")
    watched.watches.close()


def test_two_sensors_of_one_name_are_told_apart() -> None:
    air = FakeAir(FakeSensor("WT901", "AA:00"), FakeSensor("WT901", "BB:00"))
    watched = Watched(air, "ble:bb:00; ble:aa:00")
    assert watched.poll_until("found", 0).device == "WT901 ble:BB:00"
    assert watched.poll_until("found", 1).device == "WT901 ble:AA:00"
    watched.watches.close()
    assert until(lambda: all(sensor.client is None for sensor in air.sensors))


def test_a_missing_radio_is_told_once_and_awaited() -> None:
    air = FakeAir(FakeSensor("WT901"), fault="No adapters.")
    watched = Watched(air, "ble:WT901")
    assert watched.poll_until("fault").fault == "Bluetooth cannot be used (No adapters.): is the radio on?"
    air.fault = ""
    watched.poll_until("found")
    watched.watches.close()


def test_missing_bleak_is_told_and_serial_sensors_are_heard_all_the_same() -> None:
    def missing() -> ble_ports.BleLibrary:
        raise DeviceError(ble_ports.MISSING)

    watches = watch_sticks(parse_sticks("serial:/dev/nothing; ble:WT901"), library=missing)
    assert len(watches.sticks) == 1
    assert watches.fault == "Bluetooth needs the package bleak: pip install 'drum-station[ble]'"
    watches.close()


def test_bleak_has_what_is_used() -> None:
    bleak = pytest.importorskip("bleak")
    assert ble_ports.load_bleak() is bleak
    for name in ("connect", "disconnect", "start_notify", "write_gatt_char", "services"):
        assert hasattr(bleak.BleakClient, name)
    for name in ("start", "stop"):
        assert hasattr(bleak.BleakScanner, name)
