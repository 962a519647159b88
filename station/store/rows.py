"""What the history holds, as frozen values: a session, its figures, its judgements, a note of a teacher."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple


class SessionKind(StrEnum):
    """What was played."""

    LESSON = "lesson"
    TAKE = "take"
    """Just played: nothing was asked for."""
    BATTLE = "battle"


class SessionState(StrEnum):
    """Whether a session has its report."""

    BEGUN = "begun"
    """It runs, or was cut off."""
    KEPT = "kept"


class Part(StrEnum):
    """What figures are of."""

    LIMB = "limb"
    PIECE = "piece"


@dataclass(frozen=True, slots=True)
class SessionRow:
    """A session of `student` (by name), called `name` among theirs as its `folder` is.

    `started` is naive, by the clock on the wall; `played_s` seconds of music; `score` 0–100 and `beats_a_minute` are
    None where there are none. Of its `notes` so many were `right`; `mean_ms` and `sd_ms` of the asynchronies (early is
    negative) rest on so many `strokes`. `exam` is what it came to as an exam, in a few words. `capture_sha256` is the
    checksum of its capture, in hexadecimal digits, None where none is kept. `id` is the database's, 0 before it has it.
    Bars `first_bar` to `last_bar` (from 1) were practised, with a `click` whose `gap` is as reports write it;
    what the kit and the speakers are late by, `input_latency_ms` and `output_latency_ms`, was taken out. The tempo rose
    to `top_beats_a_minute`. All of these are None where nobody said.
    """

    student: str
    name: str
    started: datetime
    folder: str
    kind: SessionKind = SessionKind.LESSON
    state: SessionState = SessionState.KEPT
    lesson: str = ""
    title: str = ""
    device: str = ""
    played_s: float = 0.0
    complete: bool = False
    score: float | None = None
    level: str = ""
    beats_a_minute: float | None = None
    notes: int = 0
    right: int = 0
    strokes: int = 0
    mean_ms: float | None = None
    sd_ms: float | None = None
    exam: str = ""
    capture_sha256: str | None = None
    first_bar: int | None = None
    last_bar: int | None = None
    click: bool | None = None
    gap: str | None = None
    input_latency_ms: float | None = None
    output_latency_ms: float | None = None
    top_beats_a_minute: float | None = None
    id: int = 0


@dataclass(frozen=True, slots=True)
class FigureRow:
    """Figures of one limb or piece in a session; `mean_ms` and `sd_ms` of asynchronies rest on `strokes`."""

    part: Part
    name: str
    notes: int
    matched: int
    misses: int
    wrong_piece: int
    strokes: int
    mean_ms: float | None
    sd_ms: float | None


class JudgementRow(NamedTuple):
    """A line of a session's pairs.csv (docs/report.md): a note, a hit, or both; None where there is none."""

    label: str
    pass_number: int
    bar: int
    beat: float
    note_index: int | None
    note_time_s: float | None
    note_midi: int | None
    hit_index: int | None
    hit_time_s: float | None
    hit_midi: int | None
    hit_piece: str | None
    hit_zone: str | None
    hit_articulation: str | None
    hit_velocity: float | None
    hit_openness: float | None


@dataclass(frozen=True, slots=True)
class KeptSession:
    """All that is kept of a session: its row, figures, judgements, `documents` by file name, the capture's bytes."""

    row: SessionRow
    figures: tuple[FigureRow, ...] = ()
    judgements: tuple[JudgementRow, ...] = ()
    documents: Mapping[str, bytes] = field(default_factory=lambda: MappingProxyType({}))
    capture: bytes | None = None


@dataclass(frozen=True, slots=True)
class TimedFigure:
    """A figure, and when its session was begun."""

    started: datetime
    session_id: int
    lesson: str
    figure: FigureRow


@dataclass(frozen=True, slots=True)
class MasteryRow:
    """What is known of a student's bars `first_bar` to `last_bar` (from 0) of a lesson, as a JSON `document`."""

    lesson: str
    first_bar: int
    last_bar: int
    document: str


@dataclass(frozen=True, slots=True)
class TeacherNoteRow:
    """A teacher's note on a return: its ids, who wrote it and when (naive), its words; `body` is the file's bytes."""

    note: str
    assignment: str
    title: str
    teacher: str
    made: datetime
    words: str
    next: str
    body: bytes


@dataclass(frozen=True, slots=True)
class StudentRow:
    """A student: the name they go by, and when their last session was begun (None: none was)."""

    name: str
    last: datetime | None
