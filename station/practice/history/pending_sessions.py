"""What was kept in folders alone since this program began: the history could not be reached at the session's end.

Until it is taken in, what was learnt in such a session is known from here to whoever asks in this program: the next
step, the next lesson, the lesson played again.
"""

from collections.abc import Mapping
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from station.practice.history.learnt import Learnt
from station.practice.history.session_intake import folder_text
from station.practice.history.student_history import StudentHistory
from station.store.rows import MasteryRow, SessionState

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

_turn = Lock()
"""A window asks while its thread takes folders in."""
_of: dict[tuple[str, Path], dict[Path, Learnt]] = {}
"""By a history and a student's folder: sessions in the order in which they ended, and what was learnt in each."""


def is_all_there(whose: StudentHistory) -> bool:
    """Whether the history has all that this program has kept of the student."""
    return not _of.get(_key(whose))


def remember_pending(whose: StudentHistory, folder: Path, learnt: Learnt) -> None:
    """The history has not what lies in that folder yet, nor what was learnt there."""
    with _turn:
        waiting = _of.setdefault(_key(whose), {})
        waiting.pop(folder, None)
        waiting[folder] = learnt


def forget_arrived(whose: StudentHistory, history: "History") -> None:
    """Of what has come into the history by now, that is asked; raises `DeviceError`."""
    for folder in list(_of.get(_key(whose), {})):
        row = history.session_in(folder_text(folder))
        if row is not None and row.state is SessionState.KEPT:
            forget_pending(whose, folder)


def forget_pending(whose: StudentHistory, folder: Path) -> None:
    """The history has what lies in that folder."""
    with _turn:
        _of.get(_key(whose), {}).pop(folder, None)


def overtake_pending(whose: StudentHistory, learnt: Learnt) -> None:
    """The history knows later than what has not arrived of these bars and lessons."""
    later = {(row.lesson, row.first_bar, row.last_bar) for row in learnt.mastery}
    with _turn:
        waiting = _of.get(_key(whose), {})
        for folder, before in waiting.items():
            rows = tuple(row for row in before.mastery if (row.lesson, row.first_bar, row.last_bar) not in later)
            levels = {lesson: level for lesson, level in before.levels.items() if lesson not in learnt.levels}
            waiting[folder] = Learnt(rows, levels, before.on_top)


def pending_mastery(whose: StudentHistory) -> dict[tuple[str, int, int], tuple[MasteryRow, bool]]:
    """What was learnt last of bars of lessons, and whether on top of what was known (`Learnt.on_top`)."""
    with _turn:
        all_learnt = list(_of.get(_key(whose), {}).values())
    return {
        (row.lesson, row.first_bar, row.last_bar): (row, learnt.on_top)
        for learnt in all_learnt
        for row in learnt.mastery
    }


def pending_levels(whose: StudentHistory) -> Mapping[str, str]:
    """The levels of lessons that were come to last."""
    with _turn:
        all_learnt = list(_of.get(_key(whose), {}).values())
    return {lesson: level for learnt in all_learnt for lesson, level in learnt.levels.items()}


def mastery_known(whose: StudentHistory) -> list[MasteryRow]:
    """All that is known of a student's lessons, by name and bars, whether or not the history has it yet."""
    kept = whose.ask(lambda history, student: history.mastery(student)) or []
    rows = {(row.lesson, row.first_bar, row.last_bar): row for row in kept}
    rows |= {key: row for key, (row, _) in pending_mastery(whose).items()}
    return [rows[key] for key in sorted(rows)]


def _key(whose: StudentHistory) -> tuple[str, Path]:
    return whose.settings.history, whose.folder
