"""How far a student is with every lesson that they ever practised."""

from pathlib import Path

from station.practice.records.lesson_progress import LessonProgress, progress_of
from station.practice.records.memory import remembered


def student_progress(sessions: Path, student: str) -> dict[str, LessonProgress]:
    """The progress of `student`, under the folder of all sessions, by the names of lessons."""
    return progress_of(remembered(sessions, student))
