"""The history as one student's; whoever asks goes on without an answer where it cannot be reached."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from station.core.errors import DeviceError, StationError
from station.core.settings import Settings
from station.practice.history.old_mastery import take_in_old
from station.practice.history.session_files import leads_to_another, student_folder
from station.store.patience import in_a_hurry

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

AGAIN_S = 300.0
"""So long a history that made us wait in vain is not asked (our choice: a window stands still now and then, not in
every frame)."""
_PATIENT_S = 1.0
"""What is refused sooner is no wait (our choice)."""
HURRY_S = 2.0
"""So long who practises waits for the history, in all that they ask of it at once (our choice: a window stands still
for it, and the folder has everything)."""
_left_alone: dict[str, tuple[float, str]] = {}
"""Until when each history is left alone, by the clock that only rises, and why."""
_T = TypeVar("_T")


@dataclass(frozen=True, slots=True)
class StudentHistory:
    """What the history of `settings` knows of `student`."""

    settings: Settings
    student: str

    @classmethod
    def of(cls, settings: Settings) -> "StudentHistory":
        """That of who plays by these settings."""
        return cls(settings, settings.student)

    @property
    def folder(self) -> Path:
        """Where the student's sessions lie."""
        return student_folder(self.settings.sessions_dir, self.student)

    def open(self) -> "History":
        """The history, which remembers what lay in files before; raises `BadInput`, `DeviceError`."""
        from station.store.opening import history_of  # noqa: PLC0415 - a fifth of a second that only an answer needs

        history = history_of(self.settings)
        if not leads_to_another(self.folder):
            take_in_old(history, self.folder, self.student)
        return history

    @contextmanager
    def reached(self, within_s: float | None = None) -> Iterator["History"]:
        """The history while it is asked or written to; raises `DeviceError` whatever keeps it away.

        It may make us wait `within_s` seconds in all (None: `HURRY_S`). One that did so in vain is left alone for a
        while.
        """
        key = self.settings.history
        until_s, reason = _left_alone.get(key, (0.0, ""))
        if time.monotonic() < until_s:
            raise DeviceError(reason)
        asked_s = time.monotonic()
        try:
            with in_a_hurry(HURRY_S if within_s is None else within_s):
                yield self.open()
        except StationError as fault:
            if time.monotonic() - asked_s > _PATIENT_S:
                _left_alone[key] = time.monotonic() + AGAIN_S, str(fault)
            raise DeviceError(str(fault)) from fault

    def ask(self, question: Callable[["History", str], _T]) -> _T | None:
        """The answer for this student; None where the history cannot be reached, as was said at the start."""
        with suppress(DeviceError), self.reached() as history:
            return question(history, self.student)
        return None
