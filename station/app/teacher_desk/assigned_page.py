"""The student's page of assignments behind the window: what was taken, what is done of it, notes that came, returns.

The folders are read beside what goes on by an executor.
"""

import uuid
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from datetime import UTC, date, datetime
from pathlib import Path

from station.app.actions.teacher_actions import SendReturn
from station.app.room_state import Stage
from station.app.settings.settings_store import SettingsStore
from station.app.teacher_desk.parcel_out import parcel_path
from station.core.counts import counted
from station.core.disk.files import write_whole
from station.core.settings import Settings
from station.practice.exchange.assigned_work import LessonWork, due_words, lesson_work
from station.practice.exchange.note_file import Note
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import return_bytes
from station.practice.exchange.student_return import ReturnFacts, return_of
from station.practice.exchange.student_store import TakenAssignment, find_taken, remember_return, taken_assignments


@dataclass(frozen=True, slots=True, eq=False)
class AssignedRow:
    """An assignment as the page lists it: when it is `due` in words, whether it is late, its lessons and notes."""

    one: TakenAssignment
    due: str
    is_late: bool
    lessons: tuple[LessonWork, ...]

    @property
    def notes(self) -> tuple[Note, ...]:
        """What came back, the newest first."""
        return self.one.notes[::-1]

    @property
    def sessions(self) -> int:
        """How many sessions there are to be sent."""
        return sum(work.sessions for work in self.lessons)


@dataclass(frozen=True, slots=True, eq=False)
class AssignedView:
    """What the page shows: what was taken, the newest first; `told` what was done last, or cannot be read."""

    rows: tuple[AssignedRow, ...] = ()
    reads: bool = True
    told: str = ""


def _read(settings: Settings, today: date) -> AssignedView:
    taken, faults = taken_assignments(settings)
    rows = [_row(one, settings, today) for one in reversed(taken)]
    return AssignedView(tuple(rows), False, "\n".join(map(str, faults)))


def _row(one: TakenAssignment, settings: Settings, today: date) -> AssignedRow:
    work, left = lesson_work(one, settings), one.days_left(today)
    is_late = left is not None and left < 0 and not all(each.is_done for each in work)
    return AssignedRow(one, due_words(one, today), is_late, work)


def _send(settings: Settings, action: SendReturn, path: Path) -> str:
    one = find_taken(settings, action.id)
    sent = return_of(settings, one, ReturnFacts(uuid.uuid4().hex, datetime.now(UTC), action.words))
    write_whole(path, return_bytes(sent))
    remember_return(one, sent)
    left = f" ({sent.left_out} had no room)" if sent.left_out else ""
    return f"{counted(len(sent.sessions), 'session')}{left} of {one.assignment.title} in {path}: send that file"


class AssignedPage:
    """The page of the student of `store`; `reader` does what takes a moment."""

    def __init__(self, store: SettingsStore, reader: Executor) -> None:
        self._store, self._reader = store, reader
        self._looking: Future[AssignedView] | None = None
        self._sending: Future[str] | None = None
        self._known: tuple[date, str, Stage] | None = None
        self._view = AssignedView()
        self._told = ""
        self._written: set[Path] = set()

    def look_again(self) -> None:
        """Something came: read the folders when the page is seen."""
        self._known = None

    def begin_anew(self) -> None:
        """Another student plays: nothing that is read of the one before is shown."""
        self._known, self._looking, self._view, self._told = None, None, AssignedView(), ""

    def advance(self, today: date, stage: Stage) -> None:
        """Take what was read; look again where the day, the student or what goes on has changed.

        Raises `StationError` for a return that cannot be written.
        """
        known = today, self._store.now.student, stage
        if known != self._known and self._looking is None and stage is not Stage.PLAYING:
            self._known = known
            self._looking = self._reader.submit(_read, self._store.now, today)
        if self._looking is not None and self._looking.done():
            looking, self._looking = self._looking, None
            self._view = looking.result()
        if self._sending is not None and self._sending.done():
            sending, self._sending = self._sending, None
            self._told = ""
            self._told = sending.result()

    def view(self) -> AssignedView:
        """What is shown."""
        told = self._told or self._view.told
        return AssignedView(self._view.rows, self._view.reads or self._sending is not None, told)

    def send(self, action: SendReturn) -> None:
        """Write a return; raises `BadInput` for a place that cannot be."""
        path = parcel_path(action.out, Kind.RETURN, self._written)
        self._written.add(path)
        if self._sending is None:
            self._sending = self._reader.submit(_send, self._store.now, action, path)

    def close(self) -> None:
        """End the reader; what it reads is dropped."""
        self._reader.shutdown(wait=False, cancel_futures=True)
