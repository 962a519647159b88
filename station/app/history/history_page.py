"""The pages of the history behind the window: read beside what goes on, and a session opened from them.

The database may be a server that takes seconds to answer: an executor asks it, one question after the other, and the
newest answer is shown. A session that is opened is judged again from its capture in a process of its own.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from datetime import date
from typing import assert_never

from station.app.actions.history_actions import (
    Asked,
    HistoryAction,
    OpenKept,
    OpenPage,
    ReadAgain,
    ShowPages,
    WritePage,
)
from station.app.history.history_shown import HistoryPages, HistoryView
from station.app.history.open_kept import Opened, opened_session
from station.app.history.read_history import read_pages
from station.app.history.session_pages import SessionPages
from station.app.room_state import Stage
from station.app.settings.settings_store import SettingsStore
from station.app.worker_process import StartWork, Work
from station.core.errors import StationError

Read = Callable[..., HistoryPages]


class HistoryPage:
    """The history of the student of `store`; `reader` asks the database, `start` begins to judge a session again."""

    def __init__(self, store: SettingsStore, reader: Executor, start: StartWork, read: Read = read_pages) -> None:
        self._store, self._reader, self._start, self._read = store, reader, start, read
        self._files = SessionPages(start)
        self._asked = Asked()
        self._coming: list[Future[HistoryPages]] = []
        self._pages: HistoryPages | None = None
        self._fault = ""
        self._opening: tuple[int, Work[Opened]] | None = None
        self._opened: int | None = None
        self._known: tuple[date, str, bool] | None = None
        self._is_stale = True

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, today: date, stage: Stage) -> None:
        """Take what was read; read again where the day, the student, or what was played has changed."""
        plays, student = stage is Stage.PLAYING, self._store.now.student
        known = today, student, plays
        if known != self._known:
            is_worth_it = not plays or self._known is None
            self._known = known
            if is_worth_it:
                self._ask_anew()
        while self._coming and self._coming[0].done():
            self._take(self._coming.pop(0))

    def _take(self, read: Future[HistoryPages]) -> None:
        try:
            self._pages, self._fault, self._is_stale = read.result(), "", False
        except StationError as fault:
            self._fault = str(fault)

    def look_again(self) -> None:
        """Something was kept, or the page was closed: read again when it is seen."""
        self._known = None

    def opened(self) -> Opened | None:
        """The session that was asked for, once it is judged; None before. Raises the `StationError` that it met."""
        if self._opening is None:
            return None
        try:
            found = self._opening[1].result()
        except StationError:
            self._end_opening()
            raise
        if found is not None:
            self._end_opening()
            self._opened = found.row.id
        return found

    def page_written(self) -> str:
        """A line where the page of a session has come, else empty; raises the `StationError` that it met."""
        return self._files.advance()

    def _end_opening(self) -> None:
        if self._opening is not None:
            self._opening[1].end()
            self._opening = None

    def view(self) -> HistoryView:
        """What is shown."""
        opening = None if self._opening is None else self._opening[0]
        return HistoryView(
            self._asked, self._pages, bool(self._coming), self._fault, opening, self._opened, self._files.view()
        )

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: HistoryAction) -> None:
        """Do what the user asks; raises `DeviceError` where no process can be had, or a page is not there."""
        match action:
            case ShowPages(asked):
                self._asked = asked
                self._ask()
            case ReadAgain():
                self._ask_anew()
            case OpenKept(number):
                self._end_opening()
                self._opening = number, self._start(opened_session, number, self._store.now)
            case WritePage(number, name):
                self._files.write(number, name, self._store.now)
            case OpenPage(number):
                self._files.open(number)
            case _:
                assert_never(action)

    def begin_anew(self) -> None:
        """Another student plays: nothing of the one before is shown or opened."""
        self._end_opening()
        self._drop()
        self._asked, self._pages, self._fault, self._known = Asked(), None, "", None
        self._is_stale, self._opened = True, None

    def close(self) -> None:
        """End what is read and judged."""
        self._end_opening()
        self._files.close()
        self._drop()
        self._reader.shutdown(wait=False, cancel_futures=True)

    def _ask_anew(self) -> None:
        """Something may have changed: nothing that was read before is trusted."""
        self._is_stale = True
        self._ask()

    def _ask(self) -> None:
        """Read what is asked now; what was asked before and is not begun yet is asked no more."""
        settings, asked, before = self._store.now, self._asked, None if self._is_stale else self._pages
        today = date.today() if self._known is None else self._known[0]
        self._coming = [each for each in self._coming if not each.cancel()]
        self._coming.append(self._reader.submit(lambda: self._read(settings, today, asked, before)))

    def _drop(self) -> None:
        for each in self._coming:
            each.cancel()
        self._coming = []
