"""An exam as it is sat: begun when its piece is looked at, marked when its take is over; both are kept at once."""

from dataclasses import dataclass
from pathlib import Path
from random import SystemRandom

from station.core.errors import StationError
from station.core.settings import Settings
from station.drills.exam.exam_piece import ExamPiece
from station.drills.exam.rubric import Marks
from station.practice.exam.exam_record import exam_document, keep_exam, was_seen
from station.practice.exam.exam_take import exam_marks, exam_plan
from station.practice.history.student_history import StudentHistory
from station.practice.records.save_session import SessionFolder
from station.practice.session.plan import Plan
from station.practice.session.session import SessionResult
from station.scoring.report.assessment_document import Json

MOST_SEEDS = 1_000_000
"""So many pieces a level, each as good as another; who draws one at random may type it again (our choice)."""


def drawn_seed() -> int:
    """Which unseen piece, where nobody has said it."""
    return SystemRandom().randrange(1, MOST_SEEDS)


@dataclass(frozen=True, eq=False)
class Sitting:
    """A `piece` that this student looks at from now on, its `plan`, and the `folder` that keeps the exam."""

    piece: ExamPiece
    plan: Plan
    folder: SessionFolder
    seen_before: bool

    @classmethod
    def begin(cls, piece: ExamPiece, settings: Settings, wanted: Path | None = None) -> "Sitting":
        """Keep that this student has seen it, in a folder of their own or the `wanted` one; raises `StationError`."""
        plan = exam_plan(piece, settings)
        seen = piece.unseen is not None and was_seen(StudentHistory.of(settings), piece.unseen)
        sitting = cls(piece, plan, SessionFolder.make(wanted, settings, plan.lesson.name), seen)
        try:
            sitting.keep(None)
        except StationError:
            sitting.folder.let_go()
            raise
        return sitting

    def marks(self, result: SessionResult) -> Marks:
        """The marks of its take."""
        return exam_marks(self.piece, result)

    def document(self, marks: Marks | None) -> dict[str, Json]:
        """What is kept of it; `marks` None while it is only looked at."""
        return exam_document(self.piece, marks, self.seen_before)

    def keep(self, marks: Marks | None) -> None:
        """Write `exam.json`, and have the history keep it; raises `DeviceError`."""
        keep_exam(self.folder.path, self.document(marks))
        self.folder.keep()
