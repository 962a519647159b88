"""One suite for every transport, fake and real: what the engine counts on, whatever the bytes travel through.

A rig plays known messages and can pull the plug. Expected values are what was played.
"""

import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Protocol

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.errors import DeviceError
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.hid.hid_ports import HidDirectory
from station.devices.imu.ble_ports import BleDirectory, Radio
from station.devices.midi.midi_clients import SILENT_SERVER_NS
from station.devices.midi.midi_ports import MidiDirectory
from station.devices.serial.serial_ports import SerialDirectory
from station.devices.transport import Packet, Transport
from tests.fakes.ble_air import FakeAir, FakeSensor, until
from tests.fakes.hid_devices import ROCK_BAND, FakeHid
from tests.fakes.jack_server import JackServer, jackd_is_installed, joined
from tests.fakes.kit_player import KitPlayer, Stroke
from tests.fakes.port_reader import PortReader
from tests.fakes.ports import FakeDriver

MESSAGES = [bytes.fromhex(text) for text in ("99 24 50", "b9 04 7f", "99 2a 01", "89 24 40", "a9 31 7f", "99 24 7f")]
EVERY_NS = 5 * NS_PER_MS


class Rig(Protocol):
    """A way for bytes to come in; `called` is how the device's name begins."""

    called: str

    def open(self) -> Transport: ...

    def play(self) -> list[Packet]:
        """Play MESSAGES; what was sent and when."""
        ...

    def unplug(self) -> None: ...


class FakeRig:
    """The fake driver, with the monotonic clock for its times."""

    called = "kit"

    def __init__(self) -> None:
        self._driver = FakeDriver("kit 20:0")

    def open(self) -> Transport:
        return self._driver.open("kit 20:0")

    def play(self) -> list[Packet]:
        sent = []
        for message in MESSAGES:
            sent.append(Packet(message, time.monotonic_ns()))
            self._driver.play("kit 20:0", *sent[-1])
        return sent

    def unplug(self) -> None:
        self._driver.unplug("kit 20:0")


class SerialRig:
    """A serial line that is called kit, with a module that speaks raw MIDI."""

    called = "kit"

    def __init__(self, folder: Path) -> None:
        self._kit = SerialKit(folder / "ttyUSB0")

    def open(self) -> Transport:
        return SerialDirectory(115_200).open(f"kit {self._kit.device}")

    def play(self) -> list[Packet]:
        sent = []
        for message in MESSAGES:
            for index, at_ns in enumerate(self._kit.play_at_wire_speed(message, 115_200)):
                sent.append(Packet(message[index : index + 1], at_ns))
        return sent

    def unplug(self) -> None:
        self._kit.unplug()


class BleRig:
    """A Bluetooth sensor, whose notifications carry the messages."""

    called = "kit"

    def __init__(self) -> None:
        self._sensor = FakeSensor("kit")
        self._radio = Radio(FakeAir(self._sensor))

    def open(self) -> Transport:
        directory = BleDirectory(self._radio, "kit")
        assert until(lambda: bool(directory.names()))
        port = directory.open(directory.names()[0])
        assert self._sensor.is_subscribed.wait(20)
        return port

    def play(self) -> list[Packet]:
        sent = []
        for message in MESSAGES:
            sent.append(Packet(message, time.monotonic_ns()))
            self._sensor.notify(message)
        return sent

    def unplug(self) -> None:
        self._sensor.switch_off()

    def close(self) -> None:
        self._radio.close()


class HidRig:
    """A fake hidapi with game drums; a report is whatever is sent at once."""

    called = "Rock Band drums"

    def __init__(self) -> None:
        self._api = FakeHid()
        self._api.plug("/dev/hidraw0", ROCK_BAND)

    def open(self) -> Transport:
        directory = HidDirectory(self._api)
        return directory.open(directory.names()[0])

    def play(self) -> list[Packet]:
        sent = [Packet(message, time.monotonic_ns()) for message in MESSAGES]
        self._api.send("/dev/hidraw0", *(packet.data for packet in sent))
        return sent

    def unplug(self) -> None:
        self._api.unplug("/dev/hidraw0")


class JackRig:
    """rtmidi on a real JACK server, with a kit in another process."""

    called = "kit"

    def __init__(self, server: JackServer, folder: Path) -> None:
        strokes = [Stroke(index * EVERY_NS, message) for index, message in enumerate(MESSAGES)]
        self._kit = KitPlayer(server, "kit", strokes, folder)
        self._directory = MidiDirectory("jack")

    def open(self) -> Transport:
        return self._directory.open("kit:out")

    def play(self) -> list[Packet]:
        self._kit.play(time.monotonic_ns() + 20 * NS_PER_MS)
        return [Packet(stroke.data, stroke.at_ns) for stroke in self._kit.truth()]

    def unplug(self) -> None:
        self._kit.unplug()

    def close(self) -> None:
        self._kit.unplug()
        self._directory.close()


@pytest.fixture(params=["fake", "hid", "serial", "ble", pytest.param("jack", marks=pytest.mark.jack)])
def rig(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Rig]:
    if request.param == "serial":
        if sys.platform != "linux":
            pytest.skip("ptys that speak as serial ports are Linux's")
        serial_rig = SerialRig(tmp_path)
        yield serial_rig
        serial_rig.unplug()
    elif request.param == "jack":
        jack_rig = JackRig(request.getfixturevalue("jack_server"), tmp_path)
        yield jack_rig
        jack_rig.close()
    elif request.param == "ble":
        ble_rig = BleRig()
        yield ble_rig
        ble_rig.close()
    else:
        yield HidRig() if request.param == "hid" else FakeRig()


def read_all(transport: Transport, count: int) -> list[Packet]:
    packets: list[Packet] = []

    def enough() -> bool:
        packets.extend(transport.read())
        return len(packets) >= count

    until(enough)
    return packets


def test_every_byte_comes_once_and_in_order(rig: Rig) -> None:
    transport = rig.open()
    sent = rig.play()
    assert [packet.data for packet in read_all(transport, len(sent))] == [packet.data for packet in sent]
    assert b"".join(packet.data for packet in sent) == b"".join(MESSAGES)
    assert transport.read() == []
    transport.close()


def test_times_are_session_time_and_never_go_back(rig: Rig) -> None:
    """A machine that stalls stamps late; of several tries it does so in every one only where the stamps are wrong."""
    transport = rig.open()
    typical_ns = []
    for _ in range(5):
        sent = rig.play()
        times_ns = [packet.at_ns for packet in read_all(transport, len(sent))]
        assert times_ns == sorted(times_ns)
        late_ns = [at - packet.at_ns for at, packet in zip(times_ns, sent, strict=True)]
        assert min(late_ns) > -NS_PER_MS
        assert max(times_ns) <= time.monotonic_ns()
        typical_ns.append(sorted(late_ns)[len(late_ns) // 2])
        if typical_ns[-1] < 20 * NS_PER_MS:
            break
    assert min(typical_ns) < 20 * NS_PER_MS
    transport.close()


def test_reading_never_waits(rig: Rig) -> None:
    """One that waits does so each time; a machine that stalls does not."""
    transport = rig.open()
    took_ns = []
    for _ in range(100):
        begun_ns = time.monotonic_ns()
        assert transport.read() == []
        took_ns.append(time.monotonic_ns() - begun_ns)
    assert min(took_ns) < 5 * NS_PER_MS
    transport.close()


def test_a_closed_transport_reads_as_empty_and_closes_twice(rig: Rig) -> None:
    transport = rig.open()
    transport.close()
    rig.play()
    assert transport.read() == []
    transport.close()


def test_the_name_is_the_devices_own(rig: Rig) -> None:
    transport = rig.open()
    assert transport.name.startswith(rig.called)
    assert not transport.name.endswith(":0")
    transport.close()


def test_a_device_that_is_pulled_out_is_silent_or_said_to_be_gone(rig: Rig) -> None:
    transport = rig.open()
    rig.unplug()
    with suppress(DeviceError):
        assert transport.read() == []
    transport.close()
    assert transport.read() == []


@pytest.fixture
def jack_server() -> Iterator[JackServer]:
    if not jackd_is_installed():
        pytest.skip("jackd is not installed: apt install jackd2")
    with JackServer(patient=True) as server, joined(server):
        yield server


@pytest.mark.jack
def test_jack_lists_and_forgets_a_port(jack_server: JackServer, tmp_path: Path) -> None:
    directory = MidiDirectory("jack")
    with KitPlayer(jack_server, "kit", [], tmp_path) as kit:
        assert directory.names() == ["kit:out"]
        with pytest.raises(DeviceError, match="no such port"):
            directory.open("no such port")
        kit.unplug()
        assert until(lambda: directory.names() == [])
    directory.close()


@pytest.mark.jack
def test_a_jack_server_that_ends_takes_its_ports_along(jack_server: JackServer, tmp_path: Path) -> None:
    directory = MidiDirectory("jack")
    with KitPlayer(jack_server, "kit", [], tmp_path):
        port = directory.open("kit:out")
        assert directory.names() == ["kit:out"]
        jack_server.stop()
        assert until(lambda: directory.names() == [])
        assert port.read() == []
    port.close()
    directory.close()


@pytest.mark.jack
def test_a_station_that_leaves_takes_no_kit_from_another(jack_server: JackServer, tmp_path: Path) -> None:
    leaving, staying = MidiDirectory("jack"), MidiDirectory("jack")
    with KitPlayer(jack_server, "kit", [], tmp_path):
        assert staying.names() == leaving.names() == ["kit:out"]
        leaving.close()
        assert not until(lambda: staying.names() == [], 2 * SILENT_SERVER_NS / NS_PER_S)
    staying.close()


@pytest.mark.jack
@pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed: apt install jackd2")
def test_a_held_up_reader_loses_nothing(tmp_path: Path) -> None:
    """The test's own server waits for who is late on a busy machine, or every count of hits over it were luck."""
    strokes = [Stroke(at_ns, bytes((0x99, 38, 100))) for at_ns in range(0, 100 * NS_PER_MS, 10 * NS_PER_MS)]
    with (
        JackServer(patient=True) as server,
        KitPlayer(server, "kit", strokes, tmp_path) as kit,
        PortReader(server, "kit:out") as reader,
    ):
        with reader.held_up():
            kit.play(time.monotonic_ns())
            assert len(kit.truth()) == len(strokes)
        reader.expect_messages(len(strokes))
