"""What the station remembers of a student and a lesson between sessions: one small file for each.

`<sessions>/<student>/mastery/<lesson>_<bars>.json`, written whole after a session, holds the document of
`station.drills.mastery.mastery_json`; `levels.json` beside it the level of each lesson. A file that cannot be read is
set aside under another name, never written over.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from station.core.disk.file_names import folder_name
from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.course import Course
from station.drills.daily.asked import Asked
from station.drills.lesson import Lesson
from station.drills.library import shipped_courses
from station.drills.mastery.agenda import Turn, next_turn, other_turn
from station.drills.mastery.mastery_json import document_of, state_from
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.rules import DEFAULT_RULES
from station.practice.history.kept_json import kept_document, recalled
from station.practice.history.session_files import student_folder, write_document
from station.practice.records.lesson_order import ahead_of, followed_course
from station.practice.records.lesson_progress import progress_of
from station.practice.records.teachers_wishes import NO_WISHES, Wishes, wishes_of
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

FOLDER = "mastery"
LEVELS_NAME = "levels.json"
LEVELS_SCHEMA = "drum-station/levels/1"
_ITEMS = "*_*.json"


@dataclass(frozen=True, slots=True)
class Memory:
    """Where a student's mastery of one lesson is kept."""

    path: Path

    @classmethod
    def of(cls, sessions: Path, student: str, lesson: str, bars: tuple[int, int]) -> "Memory":
        """The memory of `student` for `bars` (first, last, from 0) of `lesson`, under the folder of all sessions."""
        name = f"{folder_name(lesson)}_{bars[0] + 1}-{bars[1] + 1}.json"
        return cls(student_folder(sessions, student) / FOLDER / name)

    def recall(self) -> tuple[ItemState | None, str | None]:
        """What is remembered, None where nothing is; and a line for the student where it could not be read.

        Raises `DeviceError` where the file can neither be read nor set aside.
        """
        return recalled(self.path, state_from, "mastery begins anew")

    def keep(self, state: ItemState) -> None:
        """Remember `state` from now on; raises `DeviceError`, and then what was remembered stays."""
        write_document(self.path, document_of(state))


@dataclass(frozen=True, slots=True)
class LevelMemory:
    """Where the level at which a student is judged is kept for each lesson: as they chose it, or came to it."""

    path: Path

    @classmethod
    def of(cls, sessions: Path, student: str) -> "LevelMemory":
        """That of `student`, under the folder of all sessions."""
        return cls(student_folder(sessions, student) / FOLDER / LEVELS_NAME)

    def recall(self) -> tuple[Mapping[str, Level], str | None]:
        """The level of each lesson by its name, and a line for the student where the file could not be read.

        A lesson that is remembered from before there was a choice has the level by which it was judged. Raises
        `DeviceError` where the file can neither be read nor set aside.
        """
        kept, fault = recalled(self.path, _levels_from, "levels begin anew")
        return {state.item.name: state.level for state in _all_in(self.path.parent)} | (kept or {}), fault

    def usual(self) -> Level:
        """The level of what is no lesson: the middle one of the student's lessons, of two the wider.

        It is a beginner's where there are none. What cannot be read says nothing.
        """
        try:
            kept = _levels_from(kept_document(self.path), str(self.path))
        except BadInput:
            kept = {}
        levels = {state.item.name: state.level for state in _all_in(self.path.parent)} | kept
        in_order = sorted(levels.values(), key=lambda level: level.rank)
        return in_order[(len(in_order) - 1) // 2] if in_order else Level.BEGINNER

    def keep(self, lesson: str, level: Level) -> None:
        """Judge `lesson` at `level` from now on; raises `DeviceError`, and then all stays as it was."""
        kept, _ = recalled(self.path, _levels_from, "levels begin anew")
        write_document(self.path, {"schema": LEVELS_SCHEMA, "levels": {**(kept or {}), lesson: level}})


def _levels_from(document: object, source: str) -> dict[str, Level]:
    """The levels in a document; raises `BadInput` that names `source`, the place and the fault."""
    if not isinstance(document, dict) or document.get("schema") != LEVELS_SCHEMA:
        raise BadInput(source, "schema", f"is not {LEVELS_SCHEMA}")
    levels = document.get("levels")
    if not isinstance(levels, dict):
        raise BadInput(source, "levels", "is no table")
    for lesson, level in levels.items():
        if level not in list(OUR_LEVELS):
            raise BadInput(source, f"levels.{lesson}", f"{level!r} is no level")
    return {lesson: OUR_LEVELS[level] for lesson, level in levels.items()}


@dataclass(frozen=True, eq=False)
class Remembered:
    """Practice that follows a student, `memory` where it is remembered (None: nowhere), `fault` a line for the user.

    `course` is the one that they follow, None where they follow none; `wishes` are their teachers'.
    """

    adaptation: Adaptation
    memory: Memory | None = None
    fault: str | None = None
    course: Course | None = None
    wishes: Wishes = NO_WISHES

    @classmethod
    def of(
        cls,
        lesson: Lesson,
        options: PlanOptions,
        today: date,
        memory: Memory | None,
        course: Course | None = None,
        wishes: Wishes = NO_WISHES,
    ) -> "Remembered":
        """Practice of `lesson` from what `memory` holds; raises `BadInput` and `DeviceError` as its parts do."""
        known, fault = memory.recall() if memory is not None else (None, None)
        return cls(Adaptation(lesson, options, today, known), memory, fault, course, wishes)

    def next_turn(self) -> Turn | None:
        """What the student should practise next of all that is remembered; None where nothing is.

        A file that cannot be read is reported when its own lesson is practised.
        """
        if self.memory is None:
            return None
        here = self.adaptation.state
        known = _all_in(self.memory.path.parent)
        others = [state for state in known if (state.item.name, state.item.bars) != (here.item.name, here.item.bars)]
        followed = self.adaptation
        asked = self.wishes.next([here, *others], followed.today, followed.rules)
        ahead = ahead_of(followed.lesson, self.course, progress_of([*others, here]), followed.struggles, asked)
        return next_turn(here, others, followed.today, followed.rules, ahead)

    def other_turn(self) -> Turn | None:
        """Another lesson that the student may turn to; None where nothing is remembered, or there is none."""
        if self.memory is None:
            return None
        here = self.adaptation
        known = _all_in(self.memory.path.parent)
        asked = self.wishes.next(known, here.today, here.rules)
        return _other(here.lesson, self.course, known, here.today, asked)

    def keep(self) -> None:
        """Remember what was learnt; raises `DeviceError`."""
        if self.memory is None:
            return
        self.memory.keep(self.adaptation.state)
        if self.adaptation.has_grown:
            levels = LevelMemory(self.memory.path.with_name(LEVELS_NAME))
            levels.keep(self.adaptation.lesson.name, self.adaptation.next_level)


def following_lesson(settings: Settings, lesson: Lesson, today: date) -> Turn | None:
    """The lesson to turn to after `lesson`: due, asked for, next in the course, or begun; None where there is none.

    Who follows no course goes on in the first that ships with the lesson.
    """
    known = remembered(settings.sessions_dir, settings.student)
    asked = wishes_of(settings, today).next(known, today, DEFAULT_RULES)
    return _other(lesson, followed_course(settings), known, today, asked)


def _other(
    lesson: Lesson, course: Course | None, known: Sequence[ItemState], today: date, asked: Asked | None
) -> Turn | None:
    asked = None if asked is not None and asked.item.name == lesson.name else asked
    ahead = ahead_of(lesson, _course_with(lesson, course), progress_of(known), struggles=False, asked=asked)
    return other_turn([state for state in known if state.item.name != lesson.name], today, ahead=ahead)


def _course_with(lesson: Lesson, followed: Course | None) -> Course | None:
    """The course that is followed, where it has the lesson, else the first that ships and has it."""
    if followed is not None and lesson.name in followed.lesson_names:
        return followed
    return next((course for course in shipped_courses() if lesson.name in course.lesson_names), None)


def remembered(sessions: Path, student: str) -> list[ItemState]:
    """All that is remembered of `student` under the folder of all sessions; what cannot be read is left out."""
    return _all_in(student_folder(sessions, student) / FOLDER)


def _all_in(folder: Path) -> list[ItemState]:
    return [state for path in sorted(folder.glob(_ITEMS)) if (state := _known(path)) is not None]


def _known(path: Path) -> ItemState | None:
    try:
        return state_from(kept_document(path), str(path))
    except BadInput:
        return None
