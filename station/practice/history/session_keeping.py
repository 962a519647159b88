"""A session as it is told to the history: begun before anybody plays, kept at its end, forgotten if nothing was played.

Where the history cannot be reached practice goes on: the folder has everything, and is taken in on another day.
"""

from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from station.core.errors import DeviceError
from station.practice.history.kept_elsewhere import remember_elsewhere
from station.practice.history.learnt import NOTHING_LEARNT, Learnt, write_learnt
from station.practice.history.pending_sessions import forget_pending, overtake_pending, remember_pending
from station.practice.history.session_files import started_in
from station.practice.history.session_intake import folder_text, new_row, take_in
from station.practice.history.student_history import StudentHistory
from station.store.rows import SessionKind, SessionState


def begin_session(whose: StudentHistory, folder: Path, kind: SessionKind, lesson: str = "") -> None:
    """Remember that a session begins now in a folder."""
    row = new_row(whose.student, folder, started_in(folder.name) or datetime.now().replace(microsecond=0))
    with suppress(DeviceError), whose.reached() as history:
        history.begin(replace(row, kind=kind, state=SessionState.BEGUN, lesson=lesson))


def keep_session(whose: StudentHistory, folder: Path, learnt: Learnt = NOTHING_LEARNT) -> str | None:
    """Keep what a session has left in its folder, and what was learnt in it, all or nothing.

    Returns None, or a line that says why it could not be and that nothing is lost. Raises `DeviceError` where what was
    learnt can be kept nowhere.
    """
    try:
        with whose.reached() as history:
            take_in(history, whose.student, folder, learnt)
        forget_pending(whose, folder)
        overtake_pending(whose, learnt)
    except DeviceError as fault:
        remember_pending(whose, folder, learnt)
        remember_elsewhere(whose.folder, folder)
        if learnt.mastery or learnt.levels:
            write_learnt(folder, learnt)
        return f"{fault}; {folder} has all of the session, and the history takes it in another day"
    return None


def forget_session(whose: StudentHistory, folder: Path) -> None:
    """Forget a session that was begun in a folder and in which nothing was played."""
    with suppress(DeviceError), whose.reached() as history:
        row = history.session_in(folder_text(folder))
        if row is not None:
            history.drop_begun(row.student, row.name)
