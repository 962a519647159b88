"""The history as the window opens: what lies in folders comes in beside what goes on, and what came is shown then."""

import time
from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import dataclass

from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.settings import Settings
from station.practice.history.pending_sessions import is_all_there
from station.practice.history.student_history import AGAIN_S, StudentHistory
from station.practice.own_data.catching_up import catch_up
from station.practice.records.recovery import offer


@dataclass(frozen=True, slots=True)
class _Came:
    """How many sessions came in, and what a user should read."""

    sessions: int
    lines: tuple[str, ...]


class HistoryOpening:
    """The history of the settings of `store`, opened by `worker`; `notify` hears what a user should read.

    Where it had no answer at the end of a session it is tried again by `clock` (seconds, it only rises), and says
    nothing until it has one.
    """

    def __init__(
        self,
        store: SettingsStore,
        notify: Callable[[str], None],
        worker: Executor,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._store, self._notify, self._worker, self._clock = store, notify, worker, clock
        self._is_closed, self._is_again, self._next_s = False, False, clock() + AGAIN_S
        self._coming: Future[_Came] | None = worker.submit(self._opened, store.now)

    def advance(self) -> bool:
        """Tell what came; returns whether pages are to be read anew, as they are where sessions came."""
        if self._coming is None:
            self._try_again()
            return False
        if not self._coming.done():
            return False
        came, self._coming = self._coming.result(), None
        for line in came.lines if came.sessions or not self._is_again else ():
            self._notify(line)
        return came.sessions > 0

    def _try_again(self) -> None:
        now_s = self._clock()
        if is_all_there(StudentHistory.of(self._store.now)):
            self._next_s = now_s + AGAIN_S  # a session that ends from now on is waited for as long
        elif now_s >= self._next_s:
            self._is_again, self._next_s = True, now_s + AGAIN_S
            self._coming = self._worker.submit(self._opened, self._store.now)

    def close(self) -> None:
        """End it after the session that comes in now: the others come another day."""
        self._is_closed = True
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _opened(self, settings: Settings) -> _Came:
        lines: list[str] = []
        sessions = catch_up(settings, lines.append, self._go_on)
        return _Came(sessions, tuple(filter(None, (*lines, offer(settings)))))

    def _go_on(self, _done: int, _all: int) -> None:
        if self._is_closed:
            raise DeviceError("the window was closed")
