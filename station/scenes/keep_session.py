"""Keeps a session: the folder with its capture, report and pictures, and a way out when the disk is full."""

import tempfile
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

from station.core.errors import BadInput, StationError
from station.core.files import write_whole
from station.core.settings import Settings
from station.practice.records.session_files import (
    CAPTURE_NAME,
    DOCUMENT_NAME,
    DRUMMER_NAME,
    PAIRS_NAME,
    PICTURE_NAME,
    TAKE_NAME,
    TEXT_NAME,
    session_folder,
    write_document,
)
from station.practice.records.session_pairs import session_pairs_csv
from station.practice.records.session_report import report_text
from station.practice.session.session import SessionResult
from station.scoring.report.assessment_document import Json


class SessionFolder:
    """One session's folder, made at the start, so that a disk that refuses shows before anybody plays.

    `name` says what was practised, `wanted` is a folder that the user named, None for a new one of the student's.
    Raises `BadInput` or `DeviceError` where it cannot be made. As a context manager it takes a folder away again in
    which nothing was left.
    """

    def __init__(self, wanted: Path | None, settings: Settings, name: str) -> None:
        self._settings = settings
        self._made = wanted is None or not wanted.exists()
        if wanted is None:
            self.path = session_folder(settings.sessions_dir, settings.student, name, datetime.now())
        else:
            self.path = _made(wanted)

    @property
    def capture(self) -> Path:
        """Where the capture is kept."""
        return self.path / CAPTURE_NAME

    def __enter__(self) -> "SessionFolder":
        return self

    def __exit__(self, *_: object) -> None:
        self.discard()

    def discard(self) -> None:
        """Take the folder away again if nothing is in it."""
        if self._made and self.path.is_dir() and not any(self.path.iterdir()):
            self.path.rmdir()

    def write(self, result: SessionResult, document: dict[str, Json]) -> None:
        """Write the report as document, text and table; raises `DeviceError`."""
        write_document(self.path / DOCUMENT_NAME, document)
        write_whole(self.path / TEXT_NAME, report_text(document).encode())
        write_whole(self.path / PAIRS_NAME, session_pairs_csv(result).encode())

    def keep_take(self, document: dict[str, object]) -> None:
        """Write what is kept of a free take beside its capture; raises `DeviceError`."""
        write_document(self.path / TAKE_NAME, document)

    def draw(self, result: SessionResult, document: dict[str, Json]) -> Iterator[Path]:
        """Draw the report and the drummer, and say each that is there; raises `DeviceError`."""
        from station.render.report.report_picture import draw_report_png
        from station.scenes.demonstrator import kept_demonstrator
        from station.scenes.pictures import draw_session
        from station.scenes.result_tables import session_facts

        draw_report_png(session_facts(result, document), self.path / PICTURE_NAME)
        yield self.path / PICTURE_NAME
        who = kept_demonstrator(self._settings, lambda _: None)  # a style that is none was told when practice began
        draw_session(result, self.path / DRUMMER_NAME, who)
        yield self.path / DRUMMER_NAME


def rescued(fault: StationError, result: SessionResult, document: dict[str, Json]) -> StationError:
    """The fault, with word of where the hits are safe: on another disk, or else in the document itself."""
    from station.music.formats.smf.standard_midi import write_performance

    spare = Path(tempfile.gettempdir()) / f"drum-station-{datetime.now():%Y-%m-%dT%H-%M-%S-%f}.mid"
    try:
        write_performance(result.performance, spare)
    except StationError:
        document["pairs_csv"] = session_pairs_csv(result)
        return StationError(f"{fault}; no disk takes the hits: they are printed with the report")
    return StationError(f"{fault}; every hit is safe in {spare}")


def _made(path: Path) -> Path:
    if (path / CAPTURE_NAME).exists() or (path / DOCUMENT_NAME).exists():
        raise BadInput(path, "", "there is a session in this folder already")
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise BadInput(path, "", f"no folder can be made: {fault.strerror or fault}") from fault
    return path
