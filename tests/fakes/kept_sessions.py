"""Sessions as the history keeps them, written down shortly."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from station.core.settings import load_settings
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME, student_folder
from station.store.history import History
from station.store.opening import history_of
from station.store.rows import FigureRow, JudgementRow, KeptSession, Part, SessionRow
from tests.fakes.captures import capture_bytes

SNARE = FigureRow(Part.PIECE, "snare", 10, 8, 1, 1, 8, -3.5, 12.0)
HIT = JudgementRow("match", 1, 2, 1.5, 0, 0.5, 38, 0, 0.512, 38, "snare", "head", "normal", 64.25, None)
MISSED = JudgementRow("miss", 1, 2, 2.0, 1, 1.0, 36, None, None, None, None, None, None, None, None)


def users_history() -> History:
    """The history of this user's settings."""
    return history_of(load_settings())


def kept(student: str, started: datetime, lesson: str = "rock-1", **others: object) -> KeptSession:
    """A session of 90 seconds with one figure, two judgements and a capture, in the student's folder."""
    name = f"{started:%Y-%m-%dT%H-%M-%S}_{lesson[:20]}"
    folder = student_folder(load_settings().sessions_dir, student) / name.replace("/", "-")
    row = SessionRow(
        student,
        name,
        started,
        str(folder),
        lesson=lesson,
        title=f"Title of {lesson}",
        device="TD-17",
        played_s=90.0,
        complete=True,
        score=81.5,
        level="beginner",
        beats_a_minute=80.0,
        notes=2,
        right=1,
        strokes=1,
        mean_ms=-2.5,
        sd_ms=15.25,
    )
    capture = capture_bytes([]) + f"{student} {started}".encode()
    documents = {DOCUMENT_NAME: f'{{"student": "{student}"}}'.encode()}
    return KeptSession(replace(row, **others), (SNARE,), (HIT, MISSED), documents, capture)  # type: ignore[arg-type]


def on_the_disk(session: KeptSession, more: Mapping[str, bytes] | None = None) -> Path:
    """Its folder, made with the capture, the documents and `more` files."""
    folder = Path(session.row.folder)
    folder.mkdir(parents=True)
    files = {CAPTURE_NAME: session.capture or b"", **session.documents, **(more or {})}
    for name, data in files.items():
        (folder / name).write_bytes(data)
    return folder
