"""A session that the system, the terminal or an impatient student ends: it is judged and kept each time.

The station is a process of its own, with its engine; the kit is a pty that speaks raw MIDI.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.devices.capture.capture import RecordKind
from station.practice.history.session_files import CAPTURE_NAME
from tests.fakes.captures import on_disk

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

KICK = bytes((0x99, 36, 90))


def ended_by(signals: list[signal.Signals], to_all: bool, folder: Path, *words: str) -> tuple[str, str]:
    """What a session said on both outputs that was ended after its first stroke; it is kept in `folder`/session."""
    report = folder / "session"
    env = {**os.environ, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder / "config")}
    with SerialKit(folder / "ttyUSB0") as kit:
        command = ["practice", "rock-1", "--no-demonstration", "--no-pictures", "--report", str(report)]
        with subprocess.Popen(
            [sys.executable, "-m", "station.cli.command_line", *command, "--kit", kit.device, *words],
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        ) as station:
            while not (report / CAPTURE_NAME).exists() or (report / CAPTURE_NAME).stat().st_size == 0:
                assert station.poll() is None, station.communicate()
                time.sleep(0.02)
            on_disk(report / CAPTURE_NAME, RecordKind.ZERO)
            kit.play(KICK)
            on_disk(report / CAPTURE_NAME, RecordKind.BYTES)
            for number in signals:
                (os.killpg if to_all else os.kill)(station.pid, number)
            out, err = station.communicate(timeout=60)
    assert station.returncode == 0, err
    return out, err


@pytest.mark.parametrize(
    ("signals", "to_all"),
    [
        ([signal.SIGTERM], False),
        ([signal.SIGHUP], True),  # the terminal's window was closed: all its processes are told
        ([signal.SIGINT, signal.SIGINT, signal.SIGINT], True),
    ],
)
def test_a_session_that_is_ended_by_a_signal_is_kept(
    signals: list[signal.Signals], to_all: bool, tmp_path: Path
) -> None:
    out, _ = ended_by(signals, to_all, tmp_path)
    assert "(stopped early)" in out
    document = json.loads((tmp_path / "session" / "report.json").read_text())
    assert document["session"]["complete"] is False


def test_a_live_session_is_judged_at_the_level_that_was_asked_for_and_so_is_the_next(tmp_path: Path) -> None:
    """On time is within 5 ms in the studio (docs/mastery.md)."""
    for folder, words in (("first", ["--level", "studio"]), ("second", [])):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "config" / "drum-station").mkdir(parents=True)
        settings = tmp_path / folder / "config" / "drum-station" / "settings.toml"
        settings.write_text(f'sessions = "{tmp_path / "sessions"}"\n')
        out, err = ended_by([signal.SIGTERM], False, tmp_path / folder, *words)
        assert "judged as studio: on time is within 5 ms" in err
        assert "judged as studio (stopped early)" in out
