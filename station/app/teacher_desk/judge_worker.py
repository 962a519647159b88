"""A session of a return judged again in a process of its own: a stranger's capture may cost no more than that.

The process has `MOST_MIB` of memory beyond what the program itself takes, and computes `LONGEST_S`; then it is ended.
"""

import math
import multiprocessing
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from station.app.worker_process import StartWork, Work, WorkerProcess
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.exchange.session_figures import SessionFigures

Result = TypeVar("Result")
MOST_MIB = 300
LONGEST_S = 30
"""Of computing, so that a busy computer refuses nothing (our choice: twenty times what an hour of practice takes)."""
LONGEST_WAIT_S = 10.0 * LONGEST_S
"""By the clock, for systems that cannot hold a process to its computing (our choice: nine others as busy beside it)."""
_LOOK_AGAIN_S = 0.02


@dataclass(frozen=True, slots=True)
class Heard:
    """What the capture of a session gives, and where the student's report says otherwise, a line each."""

    figures: SessionFigures
    differences: tuple[str, ...]


def heard(path: Path, number: int, settings: Settings) -> Heard:
    """Session `number` of the return at `path`, judged in this process; raises `BadInput`."""
    from station.practice.exchange.return_file import read_return
    from station.practice.exchange.return_judging import judge_returned
    from station.practice.exchange.teacher_store import assignment_of, given

    def judged() -> Heard:
        returned = read_return(path)
        found = judge_returned(returned, number, str(path), settings, assignment_of(returned, given(settings)))
        return Heard(found.figures, found.differences)

    return within_limits(judged, path, number)


def within_limits(do: Callable[[], Result], path: Path, number: int) -> Result:
    """What `do` makes of session `number` at `path`, with the memory and time that there may be; raises `BadInput`."""
    _limit_memory()
    _limit_computing()
    try:
        return do()
    except _TimeIsOverError:
        raise _too_long(path, number) from None
    except MemoryError:
        raise BadInput(path, f"session {number}", f"takes more than {MOST_MIB} MiB to judge") from None


class LimitedWork(Generic[Result]):
    """`do` with a session of a return in a process of its own, which is ended when it has had its time.

    `start` begins it; raises `DeviceError`.
    """

    def __init__(
        self, start: StartWork, do: Callable[[Path, int, Settings], Result], path: Path, number: int, settings: Settings
    ) -> None:
        self._path, self._number = path, number
        self._work: Work[Result] = start(do, path, number, settings)
        self._until_s = time.monotonic() + LONGEST_WAIT_S

    def result(self) -> Result | None:
        """What came of it, None while it goes on; raises `BadInput` and `DeviceError`, also when its time is over."""
        found = self._work.result()
        if found is None and time.monotonic() > self._until_s:
            raise _too_long(self._path, self._number)
        return found

    def end(self) -> None:
        """End it, wherever it is."""
        self._work.end()


def hear(path: Path, number: int, settings: Settings, start: StartWork = WorkerProcess) -> Heard:
    """As `heard`, in a process with limits, waited for; raises `BadInput` and `DeviceError`."""
    work = LimitedWork(start, heard, path, number, settings)
    try:
        while (found := work.result()) is None:
            time.sleep(_LOOK_AGAIN_S)
        return found
    finally:
        work.end()


def _too_long(path: Path, number: int) -> BadInput:
    return BadInput(path, f"session {number}", f"takes more than {LONGEST_S} s to judge")


class _TimeIsOverError(BaseException):
    """So that nothing which catches an `Exception` goes on."""


def _limit_computing() -> None:
    """Raise `_TimeIsOverError` after so much computing from here on; a second later the system ends the process."""
    if multiprocessing.parent_process() is None:
        return
    with suppress(ImportError, OSError, ValueError):
        import resource

        last_s = math.ceil(time.process_time()) + LONGEST_S
        signal.signal(signal.SIGXCPU, _end_of_time)
        resource.setrlimit(resource.RLIMIT_CPU, (last_s, last_s + 1))


def _end_of_time(*_: object) -> None:
    raise _TimeIsOverError


def _limit_memory() -> None:
    """Take no more than the limit from here on, where the system can hold a process to it and this one is a worker."""
    if multiprocessing.parent_process() is None:
        return
    with suppress(ImportError, OSError, ValueError):
        import resource

        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (used + MOST_MIB * 2**20, hard))
