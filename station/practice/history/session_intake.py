"""How a session comes into the history: from the folder that it left, whenever that is found.

A session that has just ended comes in this way, and so does one from before there was a history, one that was cut off,
and one that was kept while the database could not be reached. It is known by its student and its folder's name, so that
twice is once. What is damaged is left out: a folder whose report cannot be read is named, and stays as it is.
"""

import csv
import json
import os
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING
from zlib import crc32

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.practice.history.intake_rows import (
    battle_row,
    exam_row,
    figure_rows,
    judgement_rows,
    lesson_row,
    take_row,
)
from station.practice.history.kept_elsewhere import forget_elsewhere, sessions_elsewhere
from station.practice.history.learnt import NOTHING_LEARNT, Learnt, learnt_in
from station.practice.history.session_files import (
    BATTLE_CAPTURE_NAME,
    BATTLE_NAME,
    CAPTURE_NAME,
    DOCUMENT_NAME,
    EXAM_NAME,
    PAIRS_NAME,
    TAKE_NAME,
    session_name,
    started_in,
    student_folders,
)
from station.store.rows import JudgementRow, KeptSession, SessionKind, SessionRow, SessionState

MOST_CAPTURE_BYTES = 64 * 2**20
"""A longer capture stays in its folder alone (our choice: hours of strokes are a few megabytes)."""
MOST_DOCUMENT_BYTES = 30_000_000
"""A report of an hour has a few (our choice): more is nobody's report."""
_DOCUMENTS = (DOCUMENT_NAME, EXAM_NAME, TAKE_NAME, BATTLE_NAME, PAIRS_NAME)
_OVER = (DOCUMENT_NAME, TAKE_NAME, BATTLE_NAME)
"""One of them is in the folder of a session that is over."""
_BEGUN = (CAPTURE_NAME, BATTLE_CAPTURE_NAME, EXAM_NAME)
"""One of them is in the folder of a session that was begun."""
if TYPE_CHECKING:  # with a library that takes longer to load than a folder is read
    from station.store.history import History

_UNKEPT = re.compile("[\0\ud800-\udfff]")
"""What a folder may be called and no database holds."""
_DAMAGED = (ValueError, TypeError, LookupError, AttributeError, RecursionError, csv.Error)

Progress = Callable[[int, int], None]
"""Hears how many folders of how many are taken in."""


@dataclass(frozen=True, slots=True)
class TakenIn:
    """How many `sessions` were taken in, and the `faults` of folders that could not be."""

    sessions: int = 0
    faults: tuple[str, ...] = ()


def take_in(history: "History", student: str, folder: Path, learnt: Learnt = NOTHING_LEARNT) -> int | None:
    """Keep what lies in the folder of a session of `student`, and what was learnt in it; its id.

    It takes the place of what was kept of it before. None where no session was begun in the folder. Raises `BadInput`
    for a report that cannot be read, `DeviceError`.
    """
    kept = read_session(folder, blank_row(history, student, folder))
    return None if kept is None else history.keep(kept, learnt.mastery, learnt.levels)


def blank_row(history: "History", student: str, folder: Path) -> SessionRow:
    """The row of a session in a folder as far as it is known before anything is read; raises `DeviceError`."""
    known = history.session_in(folder_text(folder))
    if known is not None:
        return _blank(known)
    return new_row(student, folder, started_in(folder.name) or _changed(folder))


def new_row(student: str, folder: Path, started: datetime) -> SessionRow:
    """The row of a session that nobody knows yet: named as its folder, which may lie anywhere."""
    there, name = folder_text(folder), kept_text(folder.name)
    if started_in(folder.name) is None:
        name = f"{session_name(started, folder.name)}-{crc32(there.encode()):08x}"
    return SessionRow(student, name, started, there)


def everything_in(
    history: "History", sessions: Path, student: str, progress: Progress = lambda _done, _all: None
) -> TakenIn:
    """Take in what the history does not know of a student's folders under the folder of all sessions.

    Each is a transaction of its own: what was taken in stays, wherever it ends. Raises `DeviceError`.
    """
    came = list[Path]()
    all_ours = student_folders(sessions, student)
    new = _new_folders(history, all_ours, student)
    taken, faults = 0, []
    for done, (path, blank) in enumerate(new):
        progress(done, len(new))
        try:
            kept = read_session(path, blank)
        except BadInput as fault:
            faults.append(str(fault))
            continue
        if kept is not None:
            learnt = _still_news(history, kept.row, learnt_in(path))
            history.keep(kept, learnt.mastery, learnt.levels)
            taken += 1
            came.append(path)
    for ours in all_ours:
        forget_elsewhere(ours, came)
    return TakenIn(taken, tuple(faults))


def _new_folders(history: "History", all_ours: list[Path], student: str) -> list[tuple[Path, SessionRow]]:
    """Those of which the history knows nothing, and those of begun sessions that are over, wherever they lie."""
    kept = history.session_names(student)
    begun = {row.name: row for row in history.sessions(student, state=SessionState.BEGUN)}
    found: list[tuple[Path, SessionRow]] = []
    for name, path, started in (each for ours in all_ours for each in folders_of(ours)):
        row = begun.pop(name, None)
        if name not in kept and (row is None or is_over(path)):
            found.append((path, new_row(student, path, started)))
    elsewhere = ((Path(row.folder), row) for row in begun.values())
    found += [(path, _blank(row)) for path, row in elsewhere if is_over(path)]
    listed = [
        path
        for ours in all_ours
        for path in sessions_elsewhere(ours)
        if is_over(path) and path not in (each for each, _ in found)
    ]
    return [*found, *((path, blank_row(history, student, path)) for path in listed)]


def _blank(row: SessionRow) -> SessionRow:
    return SessionRow(row.student, row.name, row.started, row.folder)


def _still_news(history: "History", row: SessionRow, learnt: Learnt) -> Learnt:
    """What was learnt while the history was away, but for what has been learnt since, or better."""
    later = {each.lesson for each in learnt.mastery if _has_later(history, row, each.lesson)}
    known = later if learnt.on_top else {each.lesson for each in history.mastery(row.student)}
    judged = later if learnt.on_top else set(history.levels(row.student))
    mastery = tuple(each for each in learnt.mastery if each.lesson not in known)
    return Learnt(mastery, {lesson: level for lesson, level in learnt.levels.items() if lesson not in judged})


def _has_later(history: "History", row: SessionRow, lesson: str) -> bool:
    return any(each.started > row.started for each in history.latest(row.student, 1, lesson=lesson))


def read_session(folder: Path, blank: SessionRow) -> KeptSession | None:
    """What lies in the folder of a session, with its row as `blank` begins it; None where no session was begun.

    A session that lacks its report is a begun one. Raises `BadInput` for a report that cannot be read.
    """
    names = {path.name for path in _entries(folder)}
    if not names & {*_OVER, *_BEGUN}:
        return None
    documents = {name: data for name in _DOCUMENTS if name in names and (data := _bytes(folder / name)) is not None}
    exam = _json(documents.get(EXAM_NAME))
    over = next((name for name in _OVER if name in names), None)
    if over is None:
        return KeptSession(_begun_row(blank, names, exam), documents=documents)
    document = _json(documents.get(over))
    if not isinstance(document, dict):
        raise BadInput(folder / over, "", "is no report of ours: the session is not taken into the history")
    try:
        row, figures = _row(over, replace(blank, state=SessionState.KEPT), document, exam), figure_rows(document)
    except _DAMAGED:
        raise BadInput(folder / over, "", "is damaged: the session is not taken into the history") from None
    capture = _bytes(folder / (BATTLE_CAPTURE_NAME if over == BATTLE_NAME else CAPTURE_NAME), MOST_CAPTURE_BYTES)
    return KeptSession(row, figures, _judgements(documents.get(PAIRS_NAME)), documents, capture)


def was_begun(folder: Path) -> bool:
    """Whether a session was begun in that folder."""
    return _holds(folder, (*_BEGUN, *_OVER))


def is_over(folder: Path) -> bool:
    """Whether a session in that folder has its report."""
    return _holds(folder, _OVER)


def _holds(folder: Path, names: Iterable[str]) -> bool:
    return any(os.path.exists(folder / name) for name in names)  # noqa: PTH110 - no error for what none can be called


def kept_text(text: str) -> str:
    """A name or a path as every database holds it."""
    return _UNKEPT.sub("\ufffd", text)


def _begun_row(blank: SessionRow, names: Iterable[str], exam: object) -> SessionRow:
    kind = SessionKind.BATTLE if BATTLE_CAPTURE_NAME in names else SessionKind.LESSON
    begun = replace(blank, state=SessionState.BEGUN, kind=kind)
    try:
        return exam_row(begun, exam) if isinstance(exam, dict) else begun
    except _DAMAGED:
        return begun


def _row(over: str, blank: SessionRow, document: Mapping[str, object], exam: object) -> SessionRow:
    if over == DOCUMENT_NAME:
        return lesson_row(blank, document, exam)
    return (take_row if over == TAKE_NAME else battle_row)(blank, document)


def _judgements(table: bytes | None) -> tuple[JudgementRow, ...]:
    try:
        return () if table is None else judgement_rows(table.decode("utf-8"))
    except _DAMAGED:
        return ()


# --- files ------------------------------------------------------------------------------------------------------------


def folders_of(student: Path) -> list[tuple[str, Path, datetime]]:
    """The folders of a student that are called as sessions are, in the order in which these began."""
    found = ((path, started_in(path.name)) for path in sorted(_entries(student), key=lambda path: path.name))
    return [(kept_text(path.name), path, began) for path, began in found if began is not None]


def _entries(folder: Path) -> list[Path]:
    try:
        return [Path(each.path) for each in os.scandir(folder)]
    except OSError:
        return []


def _bytes(path: Path, most: int = MOST_DOCUMENT_BYTES) -> bytes | None:
    try:
        return read_regular(path, most)
    except BadInput:
        return None


def _json(data: bytes | None) -> object:
    try:
        return None if data is None else json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError):
        return None


def folder_text(folder: Path) -> str:
    """Where a session's files lie, as its row says it."""
    return kept_text(str(folder.absolute()))


def _changed(folder: Path) -> datetime:
    """When a folder of no such name was written to last."""
    try:
        return datetime.fromtimestamp(round(folder.stat().st_mtime))
    except (OSError, ValueError, OverflowError):
        return datetime.fromtimestamp(0)
