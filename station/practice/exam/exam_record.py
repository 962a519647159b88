"""What is kept of an exam and told of it: `exam.json` beside the session's report, and both as text.

Schema `drum-station/exam/1` (docs/exam.md). Which unseen pieces a student has met the history knows by these documents:
a piece that was shown once is unseen no more, and its next exam says so.
"""

import json
from pathlib import Path

from station.core.counts import counted
from station.drills.exam.exam_piece import ExamPiece, Unseen
from station.drills.exam.rubric import BANDS, Marks, Rubric
from station.practice.history.exam_words import SCHEMA, shown_total
from station.practice.history.session_files import EXAM_NAME, write_document
from station.practice.history.student_history import StudentHistory
from station.scoring.report.assessment_document import Json

_WIDTH = 10


def exam_document(piece: ExamPiece, marks: Marks | None, seen_before: bool) -> dict[str, Json]:
    """What is kept: the piece, its rubric, and the `marks`, None while it is only looked at."""
    unseen = piece.unseen
    return {
        "schema": SCHEMA,
        "lesson": piece.lesson.name,
        "title": piece.lesson.title,
        "tempo_bpm": round(piece.tempo_bpm, 3),
        "preview_s": piece.preview_s,
        "level": str(piece.rubric.level),
        "unseen": None if unseen is None else {"level": unseen.level, "seed": unseen.seed},
        "seen_before": seen_before,
        "rubric": [
            {"criterion": str(line.criterion), "worth": round(line.worth, 3), "asks": line.words}
            for line in piece.rubric.lines
        ],
        "marks": None if marks is None else _marks(marks),
    }


def _marks(marks: Marks) -> dict[str, Json]:
    return {
        "total": round(marks.total, 3),
        "band": marks.band.name,
        "lines": [
            {
                "criterion": str(mark.line.criterion),
                "worth": round(mark.line.worth, 3),
                "points": round(mark.points, 3),
                "measured": mark.words,
            }
            for mark in marks.lines
        ],
    }


def keep_exam(folder: Path, document: dict[str, Json]) -> None:
    """Write `exam.json` into the session's folder; raises `DeviceError`."""
    write_document(folder / EXAM_NAME, document)


def was_seen(whose: StudentHistory, unseen: Unseen) -> bool:
    """Whether this student has had that piece in an exam before, or looked at it."""
    wanted = {"level": unseen.level, "seed": unseen.seed}
    kept = whose.ask(lambda history, student: history.documents(student, EXAM_NAME)) or []
    return any(_unseen_of(body) == wanted for _, body in kept)


def _unseen_of(body: bytes) -> object:
    """What an exam's document says of its piece; nothing where it cannot be read."""
    try:
        document = json.loads(body)
    except (ValueError, RecursionError):
        return None
    return document.get("unseen") if isinstance(document, dict) else None


# --- in words ---------------------------------------------------------------------------------------------------------


def rubric_text(piece: ExamPiece) -> str:
    """What is asked, shown before anybody plays."""
    look = f"{look_words(piece)}\n" if piece.preview_s else ""
    return f"{piece.lesson.title}: {asked_words(piece)}\n{look}\n{_lines(piece.rubric)}\n\n{BANDS_WORDS}\n"


def asked_words(piece: ExamPiece) -> str:
    """How much is to be played, how fast, and how strictly it is judged."""
    bars = counted(piece.lesson.score.bar_count, "bar")
    return f"{bars} at {piece.beats_a_minute:g} bpm, played once, judged as {piece.rubric.level}."


def look_words(piece: ExamPiece) -> str:
    """How long it may be looked at."""
    return f"You have {piece.preview_s:g} seconds to look at it."


def _lines(rubric: Rubric) -> str:
    return "\n".join(f"{line.title:{_WIDTH}}{line.worth_words:>4}  {line.words}" for line in rubric.lines)


BANDS_WORDS = ", ".join(f"{band.name} from {band.least}" for band in BANDS if band.least)
SEEN_WORDS = "You have met this piece before: it was no unseen reading."


def marks_text(marks: Marks, seen_before: bool = False) -> str:
    """The marks, a line a criterion and the total, which is never rounded up."""
    rows = [
        f"{each.line.title:{_WIDTH}}{each.points:5.1f} of {each.line.worth_words:>4}  {each.words}"
        for each in marks.lines
    ]
    total = f"{'Together':{_WIDTH}}{shown_total(marks.total):>5} of  100  {marks.band.name}"
    known = ["", SEEN_WORDS] if seen_before else []
    return "\n".join([*rows, total, *known]) + "\n"
