"""How far a student is with every lesson that they ever practised."""

from station.practice.history.student_history import StudentHistory
from station.practice.records.lesson_progress import LessonProgress, progress_of
from station.practice.records.memory import remembered


def student_progress(whose: StudentHistory) -> dict[str, LessonProgress]:
    """The progress of a student by the names of lessons."""
    return progress_of(remembered(whose))
