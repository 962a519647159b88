"""What can be asked of an exam: which piece, to begin, to be ready before the time is over, and to leave it."""

from dataclasses import dataclass

from station.drills.exam.exam_piece import Unseen


@dataclass(frozen=True, slots=True)
class ChooseExam:
    """Be examined in this unseen piece; None in the lesson that is chosen."""

    unseen: Unseen | None


@dataclass(frozen=True, slots=True)
class DrawPiece:
    """Another unseen piece of that level, drawn at random."""


@dataclass(frozen=True, slots=True)
class BeginExam:
    """Look at the piece, or play at once where nothing is to be looked at."""


@dataclass(frozen=True, slots=True)
class ReadyForExam:
    """It was looked at long enough: count in."""


@dataclass(frozen=True, slots=True)
class LeaveExam:
    """Play nothing after all, or the marks were read: what is asked again."""


ExamAction = ChooseExam | DrawPiece | BeginExam | ReadyForExam | LeaveExam
