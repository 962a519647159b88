"""Keeps a session: the folder with its capture and report, the history, and a way out of a full disk.

Pictures need the drummer, who lives above: whoever has one draws them into the folder (`station.scenes.pictures`).
"""

import tempfile
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from station.core.disk.files import write_whole
from station.core.errors import BadInput, StationError
from station.core.settings import Settings
from station.music.formats.smf.track_writer import write_performance
from station.practice.history.begun_folder import BegunFolder
from station.practice.history.learnt import NOTHING_LEARNT, Learnt
from station.practice.history.session_files import (
    CAPTURE_NAME,
    DOCUMENT_NAME,
    PAIRS_NAME,
    TAKE_NAME,
    TEXT_NAME,
    write_document,
)
from station.practice.history.session_keeping import keep_session
from station.practice.history.student_history import StudentHistory
from station.practice.records.memory import Remembered
from station.practice.records.report.mastery_report import with_mastery
from station.practice.records.report.session_pairs import session_pairs_csv
from station.practice.records.report.session_report import report_text
from station.practice.session.session import SessionResult
from station.scoring.report.assessment_document import Json
from station.store.rows import SessionKind


@dataclass(frozen=True, slots=True)
class SessionFolder(BegunFolder):
    """One session's folder."""

    @classmethod
    def make(
        cls, wanted: Path | None, settings: Settings, name: str, kind: SessionKind = SessionKind.LESSON
    ) -> "SessionFolder":
        """One made at the start, so that a disk that refuses shows before anybody plays, and known to the history.

        `name` says what is practised, `wanted` is a folder that the user named, None for a new one of the student's.
        Raises `BadInput` or `DeviceError` where it cannot be made.
        """
        return cls.begin(wanted, settings, name, kind)

    @classmethod
    def left_over(cls, path: Path, settings: Settings) -> "SessionFolder":
        """That of a session that was cut off; raises `BadInput` where none was begun in it, or it has its report."""
        if (path / DOCUMENT_NAME).exists():
            raise BadInput(path, "", "this session has its report")
        if not (path / CAPTURE_NAME).is_file():
            raise BadInput(path, "", f"no session was begun in this folder: it holds no {CAPTURE_NAME}")
        return cls(path, StudentHistory.of(settings), is_new=False)

    @property
    def capture(self) -> Path:
        """Where the capture is kept."""
        return self.path / CAPTURE_NAME

    def write(self, result: SessionResult, document: dict[str, Json]) -> None:
        """Write the report as document, text and table; raises `DeviceError`."""
        write_document(self.path / DOCUMENT_NAME, document)
        write_whole(self.path / TEXT_NAME, report_text(document).encode())
        write_whole(self.path / PAIRS_NAME, session_pairs_csv(result).encode())

    def keep_take(self, document: dict[str, object]) -> str | None:
        """Keep a free take beside its capture and in the history; raises `DeviceError`.

        Returns None, or a line that says why the history does not have it.
        """
        write_document(self.path / TAKE_NAME, document)
        return self.keep()

    def keep(self, learnt: Learnt = NOTHING_LEARNT) -> str | None:
        """Have the history keep what was written, and what was learnt; None, or a line that says why it has not.

        Raises `DeviceError` where what was learnt can be kept nowhere.
        """
        return keep_session(self.whose, self.path, learnt)


@dataclass(frozen=True, eq=False)
class SessionRecord:
    """What a session leaves: its `result`, the report as a `document`, and the `fault` where the disk refused some.

    `unkept` says why the history does not have it yet, where it has not.
    """

    result: SessionResult
    document: dict[str, Json]
    fault: StationError | None
    unkept: str | None = None


def save(
    folder: SessionFolder, result: SessionResult, document: dict[str, Json], followed: Remembered | None = None
) -> SessionRecord:
    """Keep a session that is over; where the tempo has `followed` the student the report tells of every pass."""
    if followed is not None:
        document = with_mastery(document, followed.adaptation, followed.next_turn(), followed.other_turn())
    fault, unkept = None, None
    try:
        folder.write(result, document)
        unkept = folder.keep(NOTHING_LEARNT if followed is None else followed.learnt())
    except StationError as refused:
        fault = _rescued(refused, result, document)
    return SessionRecord(result, document, fault, unkept)


def _rescued(fault: StationError, result: SessionResult, document: dict[str, Json]) -> StationError:
    """The fault, with word of where the hits are safe: on another disk, or else in the document itself."""
    spare = Path(tempfile.gettempdir()) / f"drum-station-{datetime.now():%Y-%m-%dT%H-%M-%S-%f}.mid"
    try:
        write_performance(result.performance, spare)
    except StationError:
        document["pairs_csv"] = session_pairs_csv(result)
        return StationError(f"{fault}; no disk takes the hits: they are printed with the report")
    return StationError(f"{fault}; every hit is safe in {spare}")
