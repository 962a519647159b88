"""Students of whom the history knows something, written down shortly."""

from dataclasses import replace
from pathlib import Path

from station.core.settings import Settings
from station.drills.mastery.mastery_state import ItemState
from station.practice.history.old_mastery import mastery_row
from station.practice.history.session_intake import everything_in
from station.practice.history.student_history import StudentHistory
from station.practice.records.memory import Remembered


def one_student(sessions: Path, name: str) -> StudentHistory:
    """A student whose folder lies under `sessions`, in the history of this test."""
    return StudentHistory(replace(Settings(), sessions=str(sessions), student=name), name)


def know(whose: StudentHistory, *states: ItemState) -> None:
    """Have the history know it."""
    whose.open().remember(whose.student, map(mastery_row, states))


def remember(followed: Remembered) -> None:
    """Keep what was learnt, as the end of its session does."""
    assert followed.memory is not None
    whose, learnt = followed.memory.whose, followed.learnt()
    whose.open().remember(whose.student, learnt.mastery, learnt.levels)


def take_all_in(whose: StudentHistory) -> None:
    """Have the history know what lies in the student's folders."""
    everything_in(whose.open(), whose.settings.sessions_dir, whose.student)
