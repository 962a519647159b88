"""`station devices record` with a fake driver, and without any."""

import io
import sys
from itertools import count
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.cli.command_line import main
from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.midi.midi_ports import MidiDirectory
from tests.fakes.ports import FakeDriver


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings are read, and no sound server is joined."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("JACK_DEFAULT_SERVER", "drum-test-no-such-server")
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")


class ImpatientConsole(io.StringIO):
    """A console on which Ctrl-C is pressed as soon as a kit is announced."""

    def write(self, text: str) -> int:
        super().write(text)
        if "is here" in text:
            raise KeyboardInterrupt
        return len(text)


def test_without_a_driver_no_file_is_left_behind(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    try:
        MidiDirectory()
    except DeviceError:
        pass
    else:
        pytest.skip("a MIDI driver works here")
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", "1"]) == 2
    assert "no MIDI driver works" in capsys.readouterr().err
    assert not (tmp_path / "take.cap").exists()


def test_ctrl_c_at_any_moment_leaves_a_whole_capture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    console, driver = ImpatientConsole(), FakeDriver("TD-17 20:0")
    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: driver)
    monkeypatch.setattr(sys, "stderr", console)
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", "20"]) == 0
    assert read_capture(tmp_path / "take.cap").complete
    assert driver.open_connections == 0
    assert driver.left
    assert "0 hits in" in console.getvalue()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_capture_that_is_not_on_the_disk_is_no_success(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: FakeDriver("TD-17 20:0"))
    assert main(["devices", "record", "/dev/full", "--seconds", "0.01"]) == 2
    assert "No space left" in capsys.readouterr().err


@pytest.mark.parametrize("seconds", ["nan", "inf", "0", "1e300", "abc"])
def test_a_length_that_is_none_is_refused(seconds: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", seconds]) == 2
    assert "argument --seconds: expected seconds above 0" in capsys.readouterr().err
    assert not (tmp_path / "take.cap").exists()


# --- several kits, and one on a serial port --------------------------------------------------------------------------

on_linux = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")


class Player(io.StringIO):
    """A console; as soon as a kit is announced on it, the serial kit plays, and a moment later Ctrl-C is pressed."""

    def __init__(self, kit: SerialKit) -> None:
        super().__init__()
        self._kit = kit
        self._hits = 0

    def write(self, text: str) -> int:
        super().write(text)
        if f"{self._kit.device} is here" in text:
            self._kit.play(bytes.fromhex("99 26 64 26 00 24 50"))
        self._hits += "velocity" in text
        if self._hits == 2:
            raise KeyboardInterrupt
        return len(text)


@on_linux
def test_a_serial_kit_and_a_midi_kit_are_monitored_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with SerialKit(tmp_path / "ttyUSB0") as kit:
        console, driver = Player(kit), FakeDriver("TD-17 20:0")
        monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: driver)
        monkeypatch.setattr(sys, "stdout", console)
        words = ["devices", "monitor", "--kit", "td-17", "--kit", f"{kit.device}@115200", "--seconds", "20"]
        assert main(words) == 0
        assert kit.rate() == (115_200, 115_200)
    lines = console.getvalue()
    assert "TD-17 is here" in lines
    assert [line.split()[1] for line in lines.splitlines() if "velocity" in line] == ["snare", "kick"]


@on_linux
def test_a_serial_kit_is_heard_where_no_midi_driver_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def no_driver(*_: object) -> FakeDriver:
        raise DeviceError("no MIDI driver works")

    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", no_driver)
    with SerialKit(tmp_path / "ttyUSB0") as kit:
        words = ["devices", "record", str(tmp_path / "take.cap"), "--seconds", "0.05"]
        assert main([*words, "--kit", kit.device]) == 0
        assert f"{kit.device} is here" in capsys.readouterr().err
        assert main([*words, "--kit", "TD-17"]) == 2
        assert "no MIDI driver works" in capsys.readouterr().err


@on_linux
def test_a_kit_that_is_not_there_is_one_line_and_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: FakeDriver("TD-17 20:0"))
    words = ["devices", "record", str(tmp_path / "take.cap"), "--seconds", "0.01"]
    for kit in ("nothere", f"serial:{tmp_path}/ttyUSB9"):
        assert main([*words, "--kit", kit]) == 2
        waiting, fault = capsys.readouterr().err.splitlines()
        assert waiting.startswith("waiting for")
        assert fault.startswith(f"station: no port is called {kit!r}; these are there: TD-17 20:0")
    assert not (tmp_path / "take.cap").exists()


def test_a_kit_with_a_name_is_not_awaited_for_ever(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: FakeDriver("TD-17 20:0"))
    monkeypatch.setattr("station.cli.input.device_listening.NAMED_WITHIN_S", 0.01)
    assert main(["devices", "monitor", "--kit", "nothere"]) == 2
    assert "no port is called 'nothere'" in capsys.readouterr().err


@on_linux
@pytest.mark.parametrize("path", ["/etc/passwd", "/dev/null"])
def test_what_is_no_serial_port_is_said_to_be_none(path: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "monitor", "--kit", f"serial:{path}"]) == 2
    assert capsys.readouterr().err.splitlines()[1:] == [f"station: serial:{path}: this is no serial port"]


def test_a_rate_that_no_port_has_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "monitor", "--kit", "serial:/dev/ttyUSB0@fast"]) == 2
    assert "expected serial:PATH@BAUD" in capsys.readouterr().err


def test_a_machine_that_stalls_looks_at_each_kit_before_the_time_is_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whoever looks at the clock finds that a second has passed."""
    seconds = count()
    monkeypatch.setattr("station.devices.device_ports.MidiDirectory", lambda *_: FakeDriver("TD-17 20:0"))
    monkeypatch.setattr("station.cli.input.device_listening.monotonic_ns", lambda: next(seconds) * NS_PER_S)
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", "0.01"]) == 0
    assert "TD-17 is here" in capsys.readouterr().err
