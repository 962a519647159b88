"""A lag of equipment in the terminal: the report says it and names a command, which takes it out or leaves it in."""

from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.measured_latency import GROOVE, load_calibration
from station.core.settings import Settings, load_settings, save_settings
from station.practice.headless.virtual_session import DEVICE, practise_virtually
from station.practice.history.session_files import CAPTURE_NAME
from station.practice.lag.first_groove import first_groove
from station.simulation.student_spec import parse_spec


@pytest.fixture
def cut_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a session, 90 ms late on everything, that nobody has judged yet."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    save_settings(Settings(sessions=str(tmp_path / "sessions"), welcomed=True))
    settings = load_settings()
    folder = settings.sessions_dir / settings.student / "2026-01-31T10-00-00_first-groove"
    folder.mkdir(parents=True)
    student = parse_spec("seed=3,sd_ms=20,bias_ms=90")
    practise_virtually(first_groove(settings), student, folder / CAPTURE_NAME)
    return folder


def test_the_report_names_the_command_that_takes_it_out(cut_off: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "--recover", str(cut_off), "--no-pictures"]) == 0
    told = capsys.readouterr().out
    assert "most likely your equipment" in told
    assert "`station devices calibrate --by groove`" in told
    assert main(["devices", "calibrate", "--by", "groove", "--store"]) == 0
    stored = load_calibration().kits[DEVICE].kit
    assert stored.by == GROOVE
    assert stored.latency_ms == pytest.approx(90, abs=10)


def test_left_in_it_is_asked_no_more(cut_off: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "--recover", str(cut_off), "--no-pictures"]) == 0
    assert main(["devices", "calibrate", "--by", "groove", "--leave"]) == 0
    assert load_calibration().left == {DEVICE}
    assert load_calibration().kits == {}
    assert "counts as yours" in capsys.readouterr().err


def test_leaving_goes_with_what_was_found_while_playing(cut_off: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices", "calibrate", "--by", "tap", "--leave"]) != 0
    assert "--by groove" in capsys.readouterr().err
    assert main(["devices", "calibrate", "--by", "groove"]) != 0
    assert "no lag is open" in capsys.readouterr().err
    assert cut_off.is_dir()
