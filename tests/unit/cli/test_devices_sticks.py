"""`station devices` with motion sensors: lines of the monitor, a recording from a pty, a sensor that is set up."""

import json
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.cli.command_line import main
from station.cli.device_pages.devices_monitor_sticks import SticksPage
from station.core.events import SensorMounted, SensorSamples
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay_all
from station.devices.mapping.stick_file import save_stick
from station.devices.port_watch import PortPoll
from station.devices.transport import Packet
from tests.fakes.imu_speech import ramp, ramp_index, x_imu3, x_imu3_binary


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings are read, and no sound server is joined."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("JACK_DEFAULT_SERVER", "drum-test-no-such-server")
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")


def page_of(sent: list[bytes], every_ms: int = 5) -> list[str]:
    page, lines = SticksPage(0), list[str]()
    lines += page.handle(PortPoll("WT901", [], found=True), 0)
    for index, data in enumerate(sent):
        at_ns = index * every_ms * NS_PER_MS
        lines += page.handle(PortPoll("WT901", [Packet(data, at_ns)]), at_ns)
    return lines + page.handle(PortPoll("WT901", [], lost=True), NS_PER_S)


def test_the_monitor_shows_how_a_sensor_does() -> None:
    """At rest but for a turn of 30 °/s; one of 300 was lost; the battery is told once."""
    sent = [x_imu3(each._replace(g=(0.6, 0, 0.8), degrees_per_s=(10, -20, 20))) for each in ramp(300)]
    sent[10] += x_imu3_binary("B", 0, [80, 4, 0])
    sent[150] = b""
    first, *lines, last = page_of(sent)
    assert first == "WT901 is here; listening what it speaks"
    assert " ".join(lines[-1].split()) == "1.250 WT901 x-IMU3 200.00 Hz 1 lost 1.00 g 30.0 °/s battery 80%"
    assert last == "WT901 is gone; plug it in again"
    assert len(lines) == 2  # a status comes after a second, and then four lines a second


def test_the_monitor_says_what_to_try_where_nothing_is_readable() -> None:
    _, *lines, _ = page_of([os.urandom(20) for _ in range(250)])
    assert "nothing readable comes" in lines[-1]
    assert "another baud?" in lines[-1]


@contextmanager
def playing(sensor: SerialKit) -> Iterator[None]:
    """A sensor that goes on sending, at its own pace."""
    over = threading.Event()

    def play() -> None:
        stream = count()
        while not over.wait(0.005):
            index = next(stream)
            sensor.play(x_imu3(ramp(index % 200 + 1)[-1]._replace(t_s=1 + index / 200)))

    thread = threading.Thread(target=play)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


@pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")
def test_sensors_are_recorded_and_replayed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    take, mounting = tmp_path / "take.cap", Mounting(Limb.LEFT_HAND, learnt=True)
    with SerialKit(tmp_path / "ttyUSB0") as sensor, playing(sensor):
        save_stick(mounting, sensor.device)
        assert main(["devices", "record", str(take), "--sticks", sensor.device, "--seconds", "1"]) == 0
    assert "0 hits in" in capsys.readouterr().err
    entries = list(replay_all(read_capture(take)))
    mounted = [entry for entry in entries if isinstance(entry, SensorMounted)]
    assert {(entry.device, entry.mounting) for entry in mounted} == {(sensor.device, mounting)}
    told = [ramp_index(s.acceleration_m_s2[1]) for e in entries if isinstance(e, SensorSamples) for s in e.samples]
    assert len(told) > 20
    assert told == [(told[0] + index) % 200 for index in range(len(told))]


@pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")
def test_a_sensor_is_set_up_and_kept_so_at_its_new_rate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.cli.device_pages.devices_setup_stick._BETWEEN_S", 0.0)
    with SerialKit(tmp_path / "ttyUSB0") as sensor:
        keeps_open = os.open(sensor.path, os.O_RDWR | os.O_NOCTTY)  # a line that is closed drops what nobody read
        order = ["devices", "setup-stick", f"{sensor.device}@9600", "--rate", "100", "--baud", "115200"]
        assert main(order) == 0
        assert sensor.rate() == (115_200, 115_200)
        heard = sensor.heard(30)
        os.close(keeps_open)
    assert heard.hex() == "ffaa6988b5ffaa020702ffaa030900ffaa040600ffaa6988b5ffaa000000"


def test_a_missing_sensor_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "setup-stick", "serial:/dev/no-such-port"]) == 2
    assert "no motion sensor is at 'serial:/dev/no-such-port'" in capsys.readouterr().err
    assert main(["devices", "setup-stick", "serial:/dev/no-such-port", "--rate", "33"]) == 2
    assert "expected 10, 20, 50, 100, 125 or 200" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")
def test_the_list_says_what_a_sensor_speaks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with SerialKit(tmp_path / "ttyUSB0") as sensor, playing(sensor):
        assert main(["devices", "list", "--json", "--sticks", sensor.device]) == 0
    (found,) = json.loads(capsys.readouterr().out)["sticks"]
    assert (found["device"], found["protocol"]) == (sensor.device, "x-imu3")

    with SerialKit(tmp_path / "ttyUSB0") as sensor, playing(sensor):
        assert main(["devices", "list", "--sticks", sensor.device]) == 0
    assert f"{sensor.device}  [x-IMU3, " in capsys.readouterr().out
