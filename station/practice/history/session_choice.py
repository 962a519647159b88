"""The session that a user's word means, wherever a SESSION is asked.

It is a number of `station history list`, `last` for the student's last one, a day on which they played once, the folder
of a session, or a capture. A folder or a capture that the history does not know is a session all the same, and so it is
where the history cannot be reached.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from station.core.counts import is_count
from station.core.disk.files import read_regular
from station.core.disk.utf8 import one_line
from station.core.errors import BadInput, DeviceError
from station.devices.capture.capture import MOST_BYTES
from station.practice.history.session_files import BATTLE_CAPTURE_NAME, CAPTURE_NAME
from station.practice.history.who_is_here import others_here
from station.store.rows import SessionRow

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

LAST = "last"
HELP = f"a session: its number, {LAST}, a day such as 2026-12-01, its folder or its capture"
_MOST_NAMED = 12
_SEE = "`station history list` has the numbers"


@dataclass(frozen=True, slots=True)
class ChosenSession:
    """A session: its `row`, None where the history does not know it; its `folder` and `capture`, None where gone."""

    row: SessionRow | None
    folder: Path | None
    capture: Path | None

    @property
    def source(self) -> str:
        """What complaints of it begin with."""
        if self.capture is not None:
            return str(self.capture)
        return f"session {self.row.id}" if self.row is not None else str(self.folder)

    def capture_data(self, history: History | None) -> bytes:
        """The capture's bytes: the file's, where it is gone the history's; raises `BadInput` where both are."""
        if self.capture is not None:
            return read_regular(self.capture, MOST_BYTES)
        checksum = None if self.row is None else self.row.capture_sha256
        data = None if checksum is None or history is None else history.capture(checksum)
        if data is None:
            raise BadInput(self.source, "", "its capture is kept neither in a folder nor in the history")
        return data


def history_for(word: str, open_history: Callable[[], History]) -> History | None:
    """The history; None where it cannot be reached and `word` is a folder or a file, which says itself what it is."""
    try:
        return open_history()
    except DeviceError:
        if os.path.exists(word):  # noqa: PTH110 - no error for long names
            return None
        raise


def choose_session(history: History | None, student: str, word: str) -> ChosenSession:
    """The session that `word` means, of `student` where it is `last` or a day; raises `BadInput`, `DeviceError`.

    Without a history it means a folder or a capture.
    """
    return _in_files(None, word) if history is None else _chosen(history, student, word)


def _chosen(history: History, student: str, word: str) -> ChosenSession:
    if is_count(word):
        row = history.session(int(word))
        if row is None:
            raise BadInput(word, "", f"there is no session of that number; {_SEE}")
        return _kept(row)
    if word == LAST:
        return _kept(_last(history, student))
    day = _day(word)
    return _in_files(history, word) if day is None else _kept(_only_one(history, student, day))


def _kept(row: SessionRow) -> ChosenSession:
    folder = Path(row.folder)
    is_there = row.folder != "" and folder.is_dir()
    return ChosenSession(row, folder if is_there else None, _capture_in(folder) if is_there else None)


def _last(history: History, student: str) -> SessionRow:
    rows = history.sessions(student)
    if not rows:
        raise BadInput(LAST, "", f"nothing of {one_line(student)} is kept{others_here(history, student)}")
    return rows[-1]


def _day(word: str) -> date | None:
    try:
        return date.fromisoformat(word) if len(word) == len("2026-12-01") else None
    except ValueError:
        return None


def _only_one(history: History, student: str, day: date) -> SessionRow:
    begins = datetime.combine(day, datetime.min.time())
    ends = begins + timedelta(days=1) if day < date.max else None
    rows = history.sessions(student, begins, ends)
    if not rows:
        fault = f"nothing of {one_line(student)} is kept of that day{_see(history, student)}"
        raise BadInput(day.isoformat(), "", fault)
    if len(rows) > 1:
        numbers = [str(row.id) for row in rows[:_MOST_NAMED]] + (["…"] if len(rows) > _MOST_NAMED else [])
        raise BadInput(day.isoformat(), "", f"{len(rows)} sessions are of that day, say which: {', '.join(numbers)}")
    return rows[0]


def _see(history: History, student: str) -> str:
    """Where to look: among the student's sessions, else at who is here."""
    return f"; {_SEE}" if history.latest(student, 1) else others_here(history, student) or f"; {_SEE}"


def _in_files(history: History | None, word: str) -> ChosenSession:
    path = Path(word)
    if os.path.isdir(path):  # noqa: PTH112 - no error for long names
        found = ChosenSession(_row_of(history, path), path, _capture_in(path))
        if found.row is None and found.capture is None:
            raise BadInput(word, "", f"no session is in this folder: it holds no {CAPTURE_NAME}")
        return found
    if not os.path.exists(path):  # noqa: PTH110 - likewise
        raise BadInput(word, "", f"expected {HELP}; there is no such file")
    read_regular(path, MOST_BYTES)  # a pipe is none, nor is what cannot be read
    is_sessions = _capture_in(path.parent) == path
    return ChosenSession(_row_of(history, path.parent) if is_sessions else None, None, path)


def _row_of(history: History | None, folder: Path) -> SessionRow | None:
    if history is None:
        return None
    spelled = dict.fromkeys((str(folder), str(folder.absolute()), str(folder.resolve())))
    with suppress(DeviceError):  # a folder says itself what it is
        return next((row for each in spelled if (row := history.session_in(each)) is not None), None)
    return None


def _capture_in(folder: Path) -> Path | None:
    named = (folder / name for name in (CAPTURE_NAME, BATTLE_CAPTURE_NAME))
    return next((path for path in named if path.is_file()), None)
