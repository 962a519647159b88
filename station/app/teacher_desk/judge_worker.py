"""A session of a return judged again in a process of its own: a stranger's capture may cost no more than that.

The process has `MOST_MIB` of memory beyond what the program itself takes, and `LONGEST_S`; then it is ended.
"""

import multiprocessing
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
LONGEST_S = 30.0
"""Our choice: twenty times what an hour of practice takes."""
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
    """What `do` makes of session `number` at `path`, with the memory that there may be; raises `BadInput`."""
    _limit_memory()
    try:
        return do()
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
        self._until_s = time.monotonic() + LONGEST_S

    def result(self) -> Result | None:
        """What came of it, None while it goes on; raises `BadInput` and `DeviceError`, also when its time is over."""
        found = self._work.result()
        if found is None and time.monotonic() > self._until_s:
            raise BadInput(self._path, f"session {self._number}", f"takes more than {LONGEST_S:g} s to judge")
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


def _limit_memory() -> None:
    """Take no more than the limit from here on, where the system can hold a process to it and this one is a worker."""
    if multiprocessing.parent_process() is None:
        return
    with suppress(ImportError, OSError, ValueError):
        import resource

        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (used + MOST_MIB * 2**20, hard))
