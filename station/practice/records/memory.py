"""What the station remembers of a student and a lesson between sessions: mastery and levels, in the history alone.

A row for some bars of a lesson holds the document of `station.drills.mastery.mastery_json`. One that cannot be read, as
a newer station's may be, is set aside in the student's folder before another takes its place.
"""

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import date

from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput, DeviceError, StationError
from station.core.settings import Settings
from station.drills.course import Course
from station.drills.daily.asked import Asked
from station.drills.lesson import Lesson
from station.drills.library import shipped_courses
from station.drills.mastery.agenda import Turn, next_turn, other_turn
from station.drills.mastery.mastery_json import state_from
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.rules import DEFAULT_RULES
from station.practice.history.learnt import NOTHING_LEARNT, Learnt
from station.practice.history.old_mastery import mastery_row, untold_faults
from station.practice.history.pending_sessions import mastery_known, overtake_pending, pending_levels, pending_mastery
from station.practice.history.student_history import StudentHistory
from station.practice.records.lesson_order import ahead_of, followed_course
from station.practice.records.lesson_progress import progress_of
from station.practice.records.teachers_wishes import NO_WISHES, Wishes, wishes_of
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions
from station.scoring.matching.hit_windows import OUR_LEVELS, Level
from station.store.rows import MasteryRow

UNREAD = "mastery-unread"
"""The folder of documents that could not be read, in the student's."""


@dataclass(frozen=True, slots=True)
class Memory:
    """A student's mastery of `bars` (first, last, from 0) of a lesson."""

    whose: StudentHistory
    lesson: str
    bars: tuple[int, int]

    def recall(self) -> tuple[ItemState | None, str | None]:
        """What is remembered, None where nothing is; and a line for the student where it could not be read.

        Raises `DeviceError` where the history cannot be reached, or what cannot be read cannot be set aside.
        """
        faults: list[str] = []
        row, _ = pending_mastery(self.whose).get((self.lesson, *self.bars), (None, True))
        if row is None:
            with self.whose.reached() as history:
                rows = history.mastery(self.whose.student, self.lesson)
                faults = untold_faults(history, self.whose.folder)
            row = next((each for each in rows if (each.first_bar, each.last_bar) == self.bars), None)
        if row is None:
            return None, "; ".join(faults) or None
        try:
            return _state(row), "; ".join(faults) or None
        except BadInput as fault:
            return None, "; ".join([*faults, f"{fault}; {self._set_aside(row)}, mastery begins anew"])

    @property
    def is_on_top(self) -> bool:
        """Whether what is recalled rests on all that was known before, as far as anybody can say."""
        return pending_mastery(self.whose).get((self.lesson, *self.bars), (None, True))[1]

    def _set_aside(self, row: MasteryRow) -> str:
        bars = f"{row.first_bar + 1}-{row.last_bar + 1}"
        path = self.whose.folder / UNREAD / f"{folder_name(row.lesson)}_{bars}_{date.today()}.json"
        write_whole(path, row.document.encode("utf-8", "backslashreplace"))
        return f"it is kept as {path}"


@dataclass(frozen=True, slots=True)
class LevelMemory:
    """The level at which a student is judged in each lesson: as they chose it, or came to it."""

    whose: StudentHistory

    def recall(self) -> tuple[Mapping[str, Level], str | None]:
        """The level of each lesson by its name, and a line for the student where something could not be read.

        A lesson that is remembered from before there was a choice has the level by which it was judged. Raises
        `DeviceError` where the history cannot be reached.
        """
        pending, since = pending_mastery(self.whose), pending_levels(self.whose)
        kept: Mapping[str, str] = {}
        rows, faults = list[MasteryRow](), list[str]()
        try:
            with self.whose.reached() as history:
                kept, rows = history.levels(self.whose.student), history.mastery(self.whose.student)
                faults = untold_faults(history, self.whose.folder)
        except DeviceError:
            if not pending and not since:
                raise
        levels = {state.item.name: state.level for state in _states([*rows, *(row for row, _ in pending.values())])}
        levels |= {lesson: OUR_LEVELS[level] for lesson, level in {**kept, **since}.items() if level in OUR_LEVELS}
        return levels, "; ".join(faults) or None

    def usual(self) -> Level:
        """The level of what is no lesson: the middle one of the student's lessons, of two the wider.

        It is a beginner's where there are none. What cannot be read says nothing.
        """
        try:
            levels, _ = self.recall()
        except StationError:
            levels = {}
        in_order = sorted(levels.values(), key=lambda level: level.rank)
        return in_order[(len(in_order) - 1) // 2] if in_order else Level.BEGINNER

    def keep(self, lesson: str, level: Level) -> None:
        """Judge `lesson` at `level` from now on; raises `DeviceError`, and then all stays as it was."""
        with self.whose.reached() as history:
            history.remember(self.whose.student, levels={lesson: level.value})
        overtake_pending(self.whose, Learnt(levels={lesson: level.value}))


@dataclass(frozen=True, eq=False)
class Remembered:
    """Practice that follows a student, `memory` where it is remembered (None: nowhere), `fault` a line for the user.

    `is_known`: it could be asked what was remembered; else what is learnt here is on top of nothing. `course` is the
    one that they follow, None where they follow none; `wishes` are their teachers'.
    """

    adaptation: Adaptation
    memory: Memory | None = None
    fault: str | None = None
    course: Course | None = None
    wishes: Wishes = NO_WISHES
    is_known: bool = True

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
        """Practice of `lesson` from what `memory` holds; raises `BadInput` and `DeviceError` as its parts do.

        Where the history cannot be reached it begins anew, which is its `fault`.
        """
        known, fault, is_known = None, None, True
        try:
            if memory is not None:
                is_known = memory.is_on_top
                known, fault = memory.recall()
        except DeviceError:  # why is said when a program opens the history
            fault, is_known = "what you have learnt cannot be asked for today: mastery begins anew", False
        return cls(Adaptation(lesson, options, today, known), memory, fault, course, wishes, is_known)

    def next_turn(self) -> Turn | None:
        """What the student should practise next of all that is remembered; None where nothing is."""
        if self.memory is None:
            return None
        here = self.adaptation.state
        known = remembered(self.memory.whose)
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
        known = remembered(self.memory.whose)
        asked = self.wishes.next(known, here.today, here.rules)
        return _other(here.lesson, self.course, known, here.today, asked)

    def learnt(self) -> Learnt:
        """What was learnt, to be kept with the session; nothing where nothing is remembered."""
        if self.memory is None:
            return NOTHING_LEARNT
        lesson, level = self.adaptation.lesson.name, self.adaptation.next_level
        levels = {lesson: level.value} if self.adaptation.has_grown else {}
        return Learnt((mastery_row(self.adaptation.state),), levels, self.is_known)


def following_lesson(settings: Settings, lesson: Lesson, today: date) -> Turn | None:
    """The lesson to turn to after `lesson`: due, asked for, next in the course, or begun; None where there is none.

    Who follows no course goes on in the first that ships with the lesson.
    """
    known = remembered(StudentHistory.of(settings))
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


def remembered(whose: StudentHistory) -> list[ItemState]:
    """All that is remembered of a student, by lesson and bars; what cannot be read is left out."""
    return _states(mastery_known(whose))


def _states(rows: Sequence[MasteryRow]) -> list[ItemState]:
    found = []
    for row in rows:
        with suppress(BadInput):
            found.append(_state(row))
    return found


def _state(row: MasteryRow) -> ItemState:
    try:
        document = json.loads(row.document)
    except (ValueError, RecursionError):
        document = None
    return state_from(document, f"mastery of {row.lesson}")
