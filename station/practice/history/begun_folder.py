"""A folder in which a session or a battle is about to begin, made before anybody plays and known to the history."""

from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Self

from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.history.session_files import (
    BATTLE_CAPTURE_NAME,
    BATTLE_NAME,
    CAPTURE_NAME,
    DOCUMENT_NAME,
    TAKE_NAME,
    session_folder,
)
from station.practice.history.session_intake import was_begun
from station.practice.history.session_keeping import begin_session, forget_session
from station.practice.history.student_history import StudentHistory
from station.store.rows import SessionKind

_OF_WHAT = {
    CAPTURE_NAME: "session",
    DOCUMENT_NAME: "session",
    TAKE_NAME: "session",
    BATTLE_CAPTURE_NAME: "battle",
    BATTLE_NAME: "battle",
}


@dataclass(frozen=True, slots=True)
class BegunFolder:
    """The folder at `path`, as the history of `whose` sessions knows it.

    As a context manager it takes one that `is_new` away again if it stayed empty.
    """

    path: Path
    whose: StudentHistory
    is_new: bool

    @classmethod
    def begin(cls, wanted: Path | None, settings: Settings, name: str, kind: SessionKind) -> Self:
        """One made now; `name` says what is played, `wanted` is a folder that the user named, None for the student's.

        Raises `BadInput` for one that holds a session or a battle, and `DeviceError` where none can be made.
        """
        whose, is_new = StudentHistory.of(settings), wanted is None or not wanted.exists()
        if wanted is None:
            path = session_folder(settings.sessions_dir, settings.student, name, datetime.now())
        else:
            path = _made(wanted)
        begin_session(whose, path, kind, name if kind is SessionKind.LESSON else "")
        return cls(path, whose, is_new)

    def let_go(self) -> None:
        """Have the history forget what was never begun in it; take the folder away if nothing is in it."""
        if not was_begun(self.path):
            forget_session(self.whose, self.path)
        if self.is_new and self.path.is_dir() and not any(self.path.iterdir()):
            self.path.rmdir()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.let_go()


def _made(path: Path) -> Path:
    what = next((what for name, what in _OF_WHAT.items() if (path / name).exists()), None)
    if what is not None:
        raise BadInput(path, "", f"there is a {what} in this folder already")
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise BadInput(path, "", f"no folder can be made: {fault.strerror or fault}") from fault
    return path
