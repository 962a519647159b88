"""What a page needs of the session that somebody means: its capture and its report, from its folder or the history."""

import os
import shlex
from dataclasses import dataclass
from pathlib import Path

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.core.settings import Settings
from station.devices.capture.capture import Capture, parse_capture
from station.practice.history.kept_json import MOST_BYTES
from station.practice.history.session_choice import ChosenSession, choose_session, history_for
from station.practice.history.session_files import (
    BATTLE_CAPTURE_NAME,
    BATTLE_NAME,
    CAPTURE_NAME,
    DOCUMENT_NAME,
    EXAM_NAME,
    TAKE_NAME,
)
from station.practice.history.session_intake import everything_in
from station.practice.history.student_history import StudentHistory
from station.store.history import History
from station.store.rows import SessionKind


@dataclass(frozen=True, slots=True)
class SessionPlace:
    """A session as it lies there: `source` is what complaints of it begin with.

    `report` and `exam` are the bytes of its JSON files, None where it has none; `student` is whose it is in the
    history, empty where it is not there.
    """

    source: str
    capture: Capture
    report: bytes | None = None
    exam: bytes | None = None
    student: str = ""


def session_place(word: str, settings: Settings) -> SessionPlace:
    """The session that `word` means; raises `BadInput` where it is none, and says what to do with what it is."""
    history = history_for(word, StudentHistory.of(settings).open)
    if history is not None and not os.path.exists(word):  # noqa: PTH110 - no error for long names
        everything_in(history, settings.sessions_dir, settings.student)  # what was played since it was last looked at
    chosen = choose_session(history, settings.student, word)
    folder = _own_folder(chosen)
    _check_kind(chosen, folder)
    capture = parse_capture(chosen.capture_data(history), chosen.source)
    report, exam = (_file(history, chosen, folder, name) for name in (DOCUMENT_NAME, EXAM_NAME))
    student = "" if chosen.row is None else chosen.row.student
    return SessionPlace(chosen.source, capture, report, exam, student)


def _own_folder(chosen: ChosenSession) -> Path | None:
    """The session's folder; a capture that is called as a session's is lies in one."""
    if chosen.folder is not None or chosen.capture is None:
        return chosen.folder
    return chosen.capture.parent if chosen.capture.name in (CAPTURE_NAME, BATTLE_CAPTURE_NAME) else None


def _check_kind(chosen: ChosenSession, folder: Path | None) -> None:
    kind = SessionKind.LESSON if chosen.row is None else chosen.row.kind
    if folder is not None and any((folder / name).exists() for name in (BATTLE_CAPTURE_NAME, BATTLE_NAME)):
        kind = SessionKind.BATTLE
    if folder is not None and (folder / TAKE_NAME).exists():
        kind = SessionKind.TAKE
    where = shlex.quote(str(folder)) if folder is not None else "FOLDER"
    if kind is SessionKind.BATTLE:
        raise BadInput(chosen.source, "", f"is a battle; station battle --judge-again {where} tells of it")
    if kind is SessionKind.TAKE:
        command = f"station lesson import {where}/{CAPTURE_NAME} --out take.toml"
        raise BadInput(chosen.source, "", f"is free play, of which nothing was judged; {command} writes it down")


def _file(history: History | None, chosen: ChosenSession, folder: Path | None, name: str) -> bytes | None:
    """A file of a session: its folder's, else the history's."""
    if folder is not None:
        return read_regular(folder / name, MOST_BYTES) if (folder / name).exists() else None
    return None if chosen.row is None or history is None else history.document(chosen.row.id, name)
