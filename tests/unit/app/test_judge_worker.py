"""The limits of the process that judges a stranger's capture: it is refused for what it computes, not for its wait."""

from pathlib import Path

import pytest

from station.app.teacher_desk import judge_worker
from station.app.teacher_desk.judge_worker import LimitedWork, within_limits
from station.app.worker_process import WorkerProcess
from station.core.errors import BadInput
from station.core.settings import Settings

pytest.importorskip("resource")


def _endless() -> int:
    while True:
        try:
            sum(range(1000))
        except Exception:  # as a reader that catches too much would
            continue


def _computes_for_ever(path: Path, number: int, _: Settings) -> int:
    judge_worker.LONGEST_S = 1
    return within_limits(_endless, path, number)


def _ended(work: LimitedWork[int]) -> int:
    while (found := work.result()) is None:
        pass
    return found


def test_what_computes_too_long_is_refused_by_its_own_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever waits for it would wait for ever: the process ends by itself."""
    monkeypatch.setattr(judge_worker, "LONGEST_WAIT_S", float("inf"))
    work = LimitedWork(WorkerProcess, _computes_for_ever, Path("x.drum-return"), 2, Settings())
    with pytest.raises(BadInput, match=r"x\.drum-return: session 2: takes more than 1 s to judge"):
        _ended(work)
    work.end()
