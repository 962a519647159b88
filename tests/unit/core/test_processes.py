"""Children that are started to ignore Ctrl-C, and what is asked of their parent meanwhile."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing import get_context

import pytest

from station.core.processes import ctrl_c_ignored


@pytest.fixture
def heard() -> Iterator[list[int]]:
    """The signals that this program has noted."""
    numbers: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: numbers.append(number))
    yield numbers
    signal.signal(signal.SIGINT, before)


def strike_oneself() -> None:
    """What a terminal does to all of its programs at Ctrl-C."""
    os.kill(os.getpid(), signal.SIGINT)


def test_a_ctrl_c_while_a_child_is_started_is_heard(heard: list[int]) -> None:
    with ctrl_c_ignored():
        strike_oneself()
    assert heard == [signal.SIGINT]


def test_a_child_does_not_end_by_ctrl_c(heard: list[int]) -> None:
    child = get_context("spawn").Process(target=strike_oneself)
    with ctrl_c_ignored():
        child.start()
    child.join()
    assert child.exitcode == 0
    strike_oneself()
    assert heard == [signal.SIGINT], "its parent hears it as before"


def test_what_a_library_prints_goes_nowhere_and_our_own_words_are_shown() -> None:
    program = (
        "import os, sys; from station.core.processes import silence_libraries; silence_libraries();"
        " os.write(2, b'CheckRes error'); print('ours', file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert ended.stderr == "ours\n"
