"""The day's plan and the lesson book behind the window: read and written beside what goes on, shown as one value.

The book reads lessons and the folders of sessions, which takes a moment: an executor does it, one task after the other,
so that what was asked first is done first. Whatever it answers is the newest state of the book.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass, field, replace
from datetime import date, timedelta
from typing import assert_never

from station.app.actions.today_actions import BookAction, LeaveOutBlock, LookAtDay, PlanDay, Reflect
from station.app.room_state import Stage
from station.app.settings.settings_store import SettingsStore
from station.core.settings import Settings
from station.drills.daily.daily_items import DailyItem
from station.practice.book.day_progress import Block, BlockState
from station.practice.book.lesson_book import DayPage, LessonBook, Returning

CALENDAR_DAYS = 28
"""Four weeks (our choice)."""


@dataclass(frozen=True, slots=True)
class CalendarDay:
    """A day of the calendar: how long was played, and whether a line or a teacher's words stand there."""

    day: date
    minutes: float = 0.0
    has_words: bool = False


@dataclass(frozen=True, slots=True)
class TodayView:
    """What the page shows: `today` with its plan (None: not read yet), the day that is `looked_at` beside it.

    `calendar` has the last days in order, `returning` what returns; `reads` while something is still to come.
    """

    today: DayPage | None = None
    looked_at: DayPage | None = None
    calendar: tuple[CalendarDay, ...] = ()
    returning: tuple[Returning, ...] = ()
    reads: bool = False

    @property
    def next_item(self) -> DailyItem | None:
        """The block that comes next."""
        following = None if self.today is None else self.today.progress.next
        return None if following is None else following.item


@dataclass(frozen=True, slots=True)
class _Read:
    """What was read, and what could not be."""

    view: TodayView
    faults: tuple[str, ...] = field(default=())


_Change = Callable[[LessonBook], object]


class TodayPage:
    """The page of the student of `store`; `reader` does what takes a moment, `notify` hears what is wrong."""

    def __init__(self, store: SettingsStore, notify: Callable[[str], None], reader: Executor) -> None:
        self._store, self._notify, self._reader = store, notify, reader
        self._coming: list[Future[_Read]] = []
        self._view = TodayView()
        self._looked_at: date | None = None
        self._known: tuple[date, str, Stage] | None = None

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, today: date, stage: Stage) -> None:
        """Take what was read; look again where the day, the student or what goes on has changed.

        Raises `StationError` where the book can neither be read nor written.
        """
        known = today, self._store.now.student, stage
        if known != self._known:
            is_worth_it = self._known is None or stage is not Stage.PLAYING
            self._known = known
            if is_worth_it:
                self._ask(lambda book: book.today(today))
        while self._coming and self._coming[0].done():
            read = self._coming.pop(0).result()
            self._view = read.view
            for fault in read.faults:
                self._notify(fault)

    def view(self) -> TodayView:
        """What is shown."""
        return replace(self._view, reads=bool(self._coming))

    def block(self, place: int) -> DailyItem | None:
        """A block of today's plan; None where there is none."""
        items = () if self._view.today is None else self._view.today.kept.items
        return items[place] if 0 <= place < len(items) else None

    def block_behind(self, place: int) -> Block | None:
        """The block to play after the one at `place`; None where none is open."""
        blocks = () if self._view.today is None else self._view.today.progress.blocks
        is_open = (block for block in blocks if block.state is BlockState.OPEN and block.place != place)
        return next(is_open, None)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: BookAction) -> None:
        """Do what the user asks, as soon as the book is free."""
        today = date.today() if self._known is None else self._known[0]
        match action:
            case PlanDay(minutes):
                self._ask(lambda book: book.today(today, minutes))
            case LeaveOutBlock(place):
                self._ask(lambda book: book.leave_out(today, place))
            case Reflect(line):
                self._ask(lambda book: book.reflect(today, line))
            case LookAtDay(day):
                self._looked_at = day
                self._ask(lambda book: None)
            case _:
                assert_never(action)

    def look_again(self) -> None:
        """Something came into the history that this page has not read."""
        self._known = None

    def begin_anew(self) -> None:
        """Another student plays: nothing that is read of the one before is shown; what they wrote is kept."""
        self._coming.clear()
        self._view, self._looked_at, self._known = TodayView(), None, None

    def close(self) -> None:
        """End the reader; what it reads is dropped."""
        self._reader.shutdown(wait=False, cancel_futures=True)

    def _ask(self, change: _Change) -> None:
        settings, looked_at = self._store.now, self._looked_at
        today = date.today() if self._known is None else self._known[0]
        self._coming.append(self._reader.submit(lambda: _read(settings, today, looked_at, change)))


def _read(settings: Settings, today: date, looked_at: date | None, change: _Change) -> _Read:
    """Change the book, then read it."""
    faults: list[str] = []
    book = LessonBook(settings, faults.append)
    change(book)
    looked_at_page = None if looked_at is None else book.page(looked_at)
    view = TodayView(book.page(today), looked_at_page, _calendar(book, today), tuple(book.returning()))
    return _Read(view, tuple(faults))


def _calendar(book: LessonBook, today: date) -> tuple[CalendarDay, ...]:
    """The last days, those of which there is nothing among them."""
    first = today - timedelta(days=CALENDAR_DAYS - 1)
    pages = {day: book.page(day) for day in book.days() if first <= day <= today}
    return tuple(_calendar_day(first + timedelta(days=n), pages) for n in range(CALENDAR_DAYS))


def _calendar_day(day: date, pages: dict[date, DayPage]) -> CalendarDay:
    page = pages.get(day)
    if page is None:
        return CalendarDay(day)
    return CalendarDay(day, page.progress.minutes, bool(page.kept.line or page.notes))


def calendar_weeks(days: Sequence[CalendarDay]) -> list[tuple[CalendarDay | None, ...]]:
    """The days in rows from Monday to Sunday, None where a row has days before the first or after the last."""
    if not days:
        return []
    row: list[CalendarDay | None] = [None] * days[0].day.weekday()
    row += days
    row += [None] * (-len(row) % 7)
    return [tuple(row[at : at + 7]) for at in range(0, len(row), 7)]
