"""The window when the system wants it to end: it closes as if its user had closed it."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.gui.x_server import screen

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

ENDED = """
import signal
from station.cli.window import open_window
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.session.plan import PlanOptions, plan_practice

def shown(_):
    signal.raise_signal(signal.{name})
    return True

print(open_window(Settings(), plan_practice(find_lesson("rock-1"), PlanOptions()), adapt=False, shown=shown))
"""


@pytest.fixture
def environment() -> Iterator[dict[str, str]]:
    yield from screen()


@pytest.mark.parametrize("name", ["SIGTERM", "SIGINT"])
def test_a_signal_closes_the_window_in_order(name: str, environment: dict[str, str], tmp_path: Path) -> None:
    env = {**environment, "HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path / "config")}
    done = subprocess.run(
        [sys.executable, "-c", ENDED.format(name=name)],
        env=env,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "0\n"), done.stderr
