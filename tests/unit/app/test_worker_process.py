"""Work in another process: what it finds, what it refuses, how it dies and how it is ended."""

import os
import time
from collections.abc import Callable

import pytest

from station.app.worker_process import WorkerProcess
from station.core.errors import BadInput, DeviceError

WITHIN_S = 60.0


def _pid(word: str) -> tuple[str, int]:
    return word, os.getpid()


def _refuse(name: str) -> int:
    raise BadInput(name, "line 3", "is no music")


def _die() -> int:
    os._exit(1)


def ended(work: WorkerProcess[object]) -> object:
    until = time.monotonic() + WITHIN_S
    while time.monotonic() < until:
        found = work.result()
        if found is not None:
            return found
        time.sleep(0.01)
    raise AssertionError("it has not ended")


def test_it_is_done_by_another_process() -> None:
    found = ended(WorkerProcess[object](_pid, "song"))
    assert isinstance(found, tuple)
    assert found[0] == "song"
    assert found[1] != os.getpid()


@pytest.mark.parametrize(
    ("do", "words", "fault", "said"),
    [(_refuse, ("x.mid",), BadInput, "x.mid: line 3: is no music"), (_die, (), DeviceError, "without a result")],
)
def test_what_goes_wrong_there_is_said_here(
    do: Callable[..., object], words: tuple[str, ...], fault: type[Exception], said: str
) -> None:
    with pytest.raises(fault, match=said):
        ended(WorkerProcess[object](do, *words))


def test_what_would_never_end_is_ended() -> None:
    work = WorkerProcess[object](time.sleep, 600.0)
    begun = time.monotonic()
    work.end()
    assert time.monotonic() - begun < WITHIN_S
