"""`station devices record` with a fake driver, and without any."""

import io
import sys
from pathlib import Path

import pytest

from station.cli import main
from station.core.errors import DeviceError
from station.devices.capture import read_capture
from station.devices.midi_ports import MidiDirectory
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
    monkeypatch.setattr("station.devices.midi_ports.MidiDirectory", lambda: driver)
    monkeypatch.setattr(sys, "stderr", console)
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", "20"]) == 0
    assert read_capture(tmp_path / "take.cap").complete
    assert driver.open_connections == 0
    assert "0 hits in" in console.getvalue()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_capture_that_is_not_on_the_disk_is_no_success(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("station.devices.midi_ports.MidiDirectory", FakeDriver)
    assert main(["devices", "record", "/dev/full", "--seconds", "0.01"]) == 2
    assert "No space left" in capsys.readouterr().err


@pytest.mark.parametrize("seconds", ["nan", "inf", "0", "1e300"])
def test_a_length_that_is_none_is_refused(seconds: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "record", str(tmp_path / "take.cap"), "--seconds", seconds]) == 2
    assert "no length of time" in capsys.readouterr().err
    assert not (tmp_path / "take.cap").exists()
