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

from station.bench.rigs.serial_kit import SerialKit
from station.devices.capture.capture import RecordKind
from station.practice.records.session_files import CAPTURE_NAME
from tests.fakes.captures import on_disk

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

KICK = bytes((0x99, 36, 90))


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
    report = tmp_path / "session"
    env = {**os.environ, "HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path / "config")}
    with SerialKit(tmp_path / "ttyUSB0") as kit:
        words = [
            "practice",
            "rock-1",
            "--no-demonstration",
            "--no-pictures",
            "--kit",
            kit.device,
            "--report",
            str(report),
        ]
        with subprocess.Popen(
            [sys.executable, "-m", "station.cli.command_line", *words],
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
    assert "(stopped early)" in out
    document = json.loads((report / "report.json").read_text())
    assert document["session"]["complete"] is False
