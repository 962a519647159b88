"""Raw MIDI over a serial line: a pty speaks as a home-built module. Expected times are reckoned by hand."""

import fcntl
import os
import sys
import termios
import time
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.devices.device_ports import DevicePorts, parse_device, ports_for
from station.devices.port_watch import PortWatch
from station.devices.serial.serial_ports import SerialDirectory, no_access
from station.devices.transport import Packet, Transport
from tests.fakes.ports import FakeDriver

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

SNARE_AND_KICK = bytes.fromhex("99 26 64 24 50")
BYTE_NS = 320_000
"""Of 31,250 baud: ten bits of 32 µs."""


class PatientKit(SerialKit):
    """Plays until all has arrived: the system hands bytes over in its own time, and a busy one takes long."""

    def plug(self) -> None:
        super().plug()
        self._listener = os.open(self.path, os.O_RDONLY | os.O_NOCTTY | os.O_NONBLOCK)

    def unplug(self) -> None:
        if self.path.is_symlink():
            os.close(self._listener)
        super().unplug()

    def play(self, data: bytes) -> None:
        expected = self._waiting() + len(data)
        super().play(data)
        give_up_s = time.monotonic() + 60.0
        while self._waiting() < expected and time.monotonic() < give_up_s:
            time.sleep(0.0002)

    def _waiting(self) -> int:
        return int.from_bytes(fcntl.ioctl(self._listener, termios.FIONREAD, bytes(4)), sys.byteorder)


def read_some(transport: Transport, count: int) -> list[Packet]:
    packets: list[Packet] = []
    give_up_s = time.monotonic() + 60.0
    while len(packets) < count and time.monotonic() < give_up_s:
        packets += transport.read()
        time.sleep(0.0002)
    return packets


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "ttyUSB0"


@pytest.mark.parametrize(("baud", "wish"), [(31_250, ""), (115_200, "@115200")])
def test_the_rate_is_set_in_the_kernel(path: Path, baud: int, wish: str) -> None:
    with SerialKit(path) as kit:
        chosen = parse_device(kit.device + wish)
        port = ports_for(chosen, None).open(kit.device)
        assert kit.rate() == (baud, baud)
        port.close()


def test_bytes_that_came_together_came_one_byte_time_after_the_other(path: Path) -> None:
    with PatientKit(path) as kit:
        port = SerialDirectory(asked=str(path), now_ns=lambda: 7 * NS_PER_S).open(kit.device)
        kit.play(SNARE_AND_KICK)
        expected = [7 * NS_PER_S - left * BYTE_NS for left in (4, 3, 2, 1, 0)]
        packets = port.read()
        assert [packet.at_ns for packet in packets] == expected
        assert b"".join(packet.data for packet in packets) == SNARE_AND_KICK
        port.close()


def test_what_came_later_is_never_stamped_earlier(path: Path) -> None:
    """Two bytes 0.1 ms after one: the wire says 0.22 ms before it, which cannot be."""
    reads_ns = [1_000_000, 1_100_000]
    with PatientKit(path) as kit:
        port = SerialDirectory(asked=str(path), now_ns=lambda: reads_ns[0]).open(kit.device)
        kit.play(b"\x99")
        assert [packet.at_ns for packet in port.read()] == [1_000_000]
        del reads_ns[0]
        kit.play(b"\x26\x64")
        assert [packet.at_ns for packet in port.read()] == [1_000_000, 1_100_000]
        port.close()


def test_a_port_of_its_own_path_is_listed_while_it_is_there(path: Path) -> None:
    with SerialKit(path, plugged=False) as kit:
        directory = SerialDirectory(asked=str(path))
        assert kit.device not in directory.names()
        kit.plug()
        assert kit.device in directory.names()
        kit.unplug()
        assert kit.device not in directory.names()


def test_an_unplugged_port_is_a_device_that_has_gone(path: Path) -> None:
    with SerialKit(path) as kit:
        port = SerialDirectory(asked=str(path)).open(kit.device)
        kit.unplug()
        with pytest.raises(DeviceError, match="has gone"):
            read_some(port, 1)
        port.close()
        assert port.read() == []


def test_unplugged_in_mid_message_and_back(path: Path) -> None:
    """The half message is lost with the cable; the station hears the module again within a second."""
    with PatientKit(path) as kit:
        watch = PortWatch(ports_for(parse_device(kit.device), None), kit.device)
        assert watch.poll(0).found
        kit.play(b"\x99\x26")
        assert len(watch.poll(1).packets) == 2
        kit.unplug()
        assert watch.poll(2).lost
        kit.plug()
        assert watch.poll(NS_PER_S).found
        kit.play(SNARE_AND_KICK)
        assert b"".join(packet.data for packet in watch.poll(NS_PER_S + 1).packets) == SNARE_AND_KICK
        watch.close()


def test_a_port_that_another_program_holds_is_told_once_it_lasts(path: Path) -> None:
    with SerialKit(path) as kit:
        ports = ports_for(parse_device(kit.device), None)
        other = ports.open(kit.device)
        watch = PortWatch(ports, kit.device)
        faults = [watch.poll(at_s * NS_PER_S).fault for at_s in range(4)]
        assert faults == ["", f"{kit.device}: another program has this serial port open", "", ""]
        other.close()
        assert watch.poll(5 * NS_PER_S).found
        watch.close()


def test_a_path_that_is_no_serial_port_is_said(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").touch()
    with pytest.raises(DeviceError, match="this is no serial port"):
        SerialDirectory().open(f"serial:{tmp_path / 'notes.txt'}")
    with pytest.raises(DeviceError, match="no such serial port"):
        SerialDirectory().open(f"serial:{tmp_path / 'ttyUSB7'}")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may open every port")
def test_a_port_of_others_says_what_to_do(tmp_path: Path) -> None:
    locked = tmp_path / "ttyUSB0"
    locked.touch(mode=0o000)
    with pytest.raises(DeviceError, match=r"permission denied; sudo usermod -aG \w+ \$USER, then log in again"):
        SerialDirectory().open(f"serial:{locked}")


def test_the_group_in_the_remedy_is_the_ports_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As another user would see it, whoever runs the test."""
    port = tmp_path / "ttyUSB0"
    port.touch()
    assert no_access(str(port)) is None
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert no_access(str(port)) == f"permission denied; sudo usermod -aG {port.group()} $USER, then log in again"


def test_midi_and_serial_ports_are_one_list(path: Path) -> None:
    midi = FakeDriver("TD-17 20:0")
    with SerialKit(path) as kit:
        ports = DevicePorts(midi, SerialDirectory(asked=str(path)), FakeDriver())
        assert ports.names()[0] == "TD-17 20:0"
        assert kit.device in ports.names()
        assert ports.open("TD-17 20:0").name == "TD-17"
        serial = ports.open(kit.device)
        assert serial.name == kit.device
        serial.close()
