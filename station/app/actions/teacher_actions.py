"""What is asked on the teacher's page and on the student's page of assignments. Sessions count from 1."""

from dataclasses import dataclass

from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import SessionVerdict


@dataclass(frozen=True, slots=True)
class OpenTake:
    """Hear and see session `number` of the return whose file is called `stem`."""

    stem: str
    number: int


@dataclass(frozen=True, slots=True)
class JudgeReturns:
    """Judge every session again from its capture, those that were not yet."""


@dataclass(frozen=True, slots=True)
class Overrule:
    """What the teacher judges otherwise in a session of the return `stem`; nothing is written yet."""

    stem: str
    verdict: SessionVerdict


@dataclass(frozen=True, slots=True)
class SayToStudent:
    """What the note on the return `stem` will say, and what to do next; nothing is written yet."""

    stem: str
    words: str
    next: str


@dataclass(frozen=True, slots=True)
class WriteNote:
    """Write the note on the return `stem` into a file; `teacher` is who says it, the user where it is empty."""

    stem: str
    out: str
    teacher: str = ""


@dataclass(frozen=True, slots=True)
class NewAssignment:
    """What is given: `lessons` by name with what is asked of each, `due` as it is typed, empty for whenever."""

    title: str
    lessons: tuple[tuple[str, LessonGoals], ...]
    teacher: str = ""
    group: str = ""
    due: str = ""
    words: str = ""


@dataclass(frozen=True, slots=True)
class Give:
    """Write an assignment into a file."""

    assignment: NewAssignment
    out: str


@dataclass(frozen=True, slots=True)
class SendReturn:
    """Write what was practised of the assignment `id` into a file for the teacher, with a line of the student's own."""

    id: str
    words: str
    out: str


@dataclass(frozen=True, slots=True)
class TakeUp:
    """Choose a lesson of an assignment, as it is called here, to practise it."""

    lesson: str


TeacherAction = OpenTake | JudgeReturns | Overrule | SayToStudent | WriteNote | Give
AssignedAction = SendReturn | TakeUp
