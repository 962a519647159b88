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
    student_folder,
)
from station.store.history import History
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
_UNKEPT = re.compile("[\0\ud800-\udfff]")
"""What a folder may be called and no database holds."""
_DAMAGED = (ValueError, TypeError, KeyError, AttributeError, RecursionError, csv.Error)

Progress = Callable[[int, int], None]
"""Hears how many folders of how many are taken in."""


@dataclass(frozen=True, slots=True)
class TakenIn:
    """How many `sessions` were taken in, and the `faults` of folders that could not be."""

    sessions: int = 0
    faults: tuple[str, ...] = ()


def take_in(history: History, student: str, folder: Path) -> int | None:
    """Keep what lies in the folder of a session of `student`; its id, None where no session was begun in it.

    It takes the place of what was kept of it before. Raises `BadInput` for a report that cannot be read, `DeviceError`.
    """
    there = _folder_text(folder)
    known = history.session_in(there)
    started = started_in(folder.name)
    if known is not None:
        blank = SessionRow(known.student, known.name, known.started, there)
    elif started is not None:
        blank = SessionRow(student, kept_text(folder.name), started, there)
    else:
        began = _changed(folder)
        blank = SessionRow(student, session_name(began, folder.name), began, there)
    kept = read_session(folder, blank)
    return None if kept is None else history.keep(kept)


def everything_in(
    history: History, sessions: Path, student: str, progress: Progress = lambda _done, _all: None
) -> TakenIn:
    """Take in what the history does not know of a student's folders under the folder of all sessions.

    Each is a transaction of its own: what was taken in stays, wherever it ends. Raises `DeviceError`.
    """
    folders = _folders(student_folder(sessions, student))
    kept = history.session_names(student)
    begun = history.session_names(student, SessionState.BEGUN)
    new = [path for name, path in folders if name not in kept and (name not in begun or is_over(path))]
    taken, faults = 0, []
    for done, path in enumerate(new):
        progress(done, len(new))
        try:
            taken += take_in(history, student, path) is not None
        except BadInput as fault:
            faults.append(str(fault))
    return TakenIn(taken, tuple(faults))


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


def is_over(folder: Path) -> bool:
    """Whether a session in that folder has its report."""
    return any((folder / name).exists() for name in _OVER)


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


def _folders(student: Path) -> list[tuple[str, Path]]:
    """The folders of a student that are called as sessions are, in the order in which these began."""
    found = [path for path in _entries(student) if started_in(path.name) is not None and path.is_dir()]
    return [(kept_text(path.name), path) for path in sorted(found, key=lambda path: path.name)]


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


def _folder_text(folder: Path) -> str:
    return kept_text(str(folder.absolute()))


def _changed(folder: Path) -> datetime:
    """When a folder of no such name was written to last."""
    try:
        return datetime.fromtimestamp(round(folder.stat().st_mtime))
    except (OSError, ValueError, OverflowError):
        return datetime.fromtimestamp(0)
