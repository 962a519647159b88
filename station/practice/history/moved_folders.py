"""Rows that name folders which are no longer there: moved with all sessions, or gone.

A folder of all sessions may be put on another disk, or copied to another computer; what it is called is the user's
setting. A session is found there by its own name, and its row says from then on where its files are.
"""

import os
from datetime import datetime, timedelta
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from station.practice.history.session_intake import folder_text, folders_of
from station.store.rows import SessionState

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

FORGOTTEN_AFTER = timedelta(days=30)
"""So long a session that was begun waits for its folder (our choice: a disk that is away comes back from a holiday)."""


def follow_moved(history: "History", ours: Path, student: str) -> int:
    """Have rows of a student name the folders in `ours` where those that they name are gone; how many. `DeviceError`.

    Where all is in its place that is a listing and a query, and no file is looked for.
    """
    known, moved = history.session_folders(student), dict[int, str]()
    is_folder = cache(os.path.isdir)  # of a thousand sessions that moved, one folder held all
    for name, path, _ in folders_of(ours):
        number, folder = known.get(name, (0, ""))
        there = folder_text(path)
        if number and folder != there and not (is_folder(os.path.dirname(folder)) and is_folder(folder)):  # noqa: PTH120
            moved[number] = there
    if moved:
        history.move(moved)
    return len(moved)


def forget_gone(history: "History", student: str, now: datetime) -> None:
    """Forget sessions that were begun long before `now` and whose folders are gone: nobody can judge them any more.

    Nothing is lost by it: such a row says no more than that it began, and a folder that comes back among the student's
    own is taken in anew. Raises `DeviceError`.
    """
    for row in history.sessions(student, until=now - FORGOTTEN_AFTER, state=SessionState.BEGUN):
        if not os.path.isdir(row.folder):  # noqa: PTH112 - no error for what none can be called
            history.drop_begun(student, row.name)
