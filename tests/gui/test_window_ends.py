"""The window when the system wants it to end: it closes as if its user had closed it."""

import json
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.gui.x_server import screen

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

WINDOW = [sys.executable, "-m", "station.cli.command_line", "--watch-seconds", "300"]


@pytest.fixture
def environment() -> Iterator[dict[str, str]]:
    yield from screen()


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_closes_the_window_in_order(end: signal.Signals, environment: dict[str, str], tmp_path: Path) -> None:
    own = {f"XDG_{kind}_HOME": str(tmp_path / kind.lower()) for kind in ("CONFIG", "DATA")}
    env = {**environment, "HOME": str(tmp_path), **own}
    with subprocess.Popen(WINDOW, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as window:
        assert window.stdout is not None
        assert "open_ns" in json.loads(window.stdout.readline())
        window.send_signal(end)
        told, fault = window.communicate(timeout=300)
    assert window.returncode == 0, fault
    assert json.loads(told)["shown_ns"]
