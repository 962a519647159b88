"""What the doctor says of settings, and of a MIDI library that does not do."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
import rtmidi

from station.app.equipment.diagnostics import check_midi_library, check_settings, check_sticks
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.core.settings import settings_path
from station.devices.mapping.stick_file import save_stick, stick_path


@pytest.mark.parametrize(
    ("line", "finding"),
    [
        ('drums = "nokit"', "nokit: no such drum kit"),
        ('sessions = "~no-such-user/x"', "no such user's home"),
        ("kti = 1", "did you mean kit?"),
    ],
)
def test_a_setting_that_means_nothing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str, finding: str
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    settings = tmp_path / "drum-station" / "settings.toml"
    settings.parent.mkdir()
    settings.write_text('kit = "TD-17"\n')
    assert check_settings().works
    settings.write_text(f"{line}\n")
    check = check_settings()
    assert not check.works
    assert finding in check.finding


def test_a_midi_library_that_was_built_without_a_driver_is_told_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(rtmidi, "get_compiled_api", lambda: [rtmidi.API_LINUX_ALSA])
    check = check_midi_library()
    assert not check.works
    assert check.finding == "rtmidi was built with alsa, without jack"
    assert "libjack-jackd2-dev" in check.remedy
    assert f"{sys.executable} -m pip install" in check.remedy


def test_the_doctor_examines_a_computer_on_which_the_midi_library_cannot_be_loaded() -> None:
    without = "import sys; sys.modules['rtmidi'] = None; from station.cli.command_line import main"
    program = f"{without}; sys.exit(main(['doctor', '--json']))"
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    checks = {check["name"]: check for check in json.loads(told.stdout)["checks"]}
    assert not checks["MIDI library"]["works"]
    assert "rtmidi cannot be loaded" in checks["MIDI library"]["finding"]
    assert checks["Python"]["works"]
    assert "pictures" in checks


def test_sensors_on_the_sticks_are_looked_at_by_settings_and_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert check_sticks().works
    assert "none" in check_sticks().finding

    settings = settings_path()
    settings.parent.mkdir(parents=True)
    settings.write_text('sticks = "serial:/dev/ttyUSB0"\n')
    assert check_sticks().finding == "serial:/dev/ttyUSB0; no stick has a file: the mounting gesture makes it"

    save_stick(Mounting(Limb.LEFT_HAND), "serial:/dev/ttyUSB0")
    assert check_sticks().finding == "serial:/dev/ttyUSB0; known: serial-dev-ttyUSB0 (left hand)"

    stick_path("serial:/dev/ttyUSB0").write_text('limb = "nose"\n')
    assert not check_sticks().works
    assert "serial-dev-ttyUSB0.toml" in check_sticks().finding

    settings.write_text("kti = 1\n")
    assert "did you mean kit?" in check_sticks().finding
