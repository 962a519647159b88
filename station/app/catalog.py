"""What there is to practise, and how far the student is with it: lessons, courses, progress."""

from collections.abc import Callable, Mapping, Sequence

from station.app.lesson_cards import card
from station.app.room_state import LessonCard
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.drills.course import Course
from station.drills.lesson import Lesson
from station.drills.lesson_row import row_of
from station.drills.library import courses_in, find_lesson, lesson_rows, own_lessons, shipped_courses
from station.practice.history.student_history import StudentHistory
from station.practice.records.lesson_progress import LessonProgress
from station.practice.records.memory import LevelMemory
from station.practice.records.student_progress import student_progress
from station.scoring.matching.hit_windows import Level


class Catalog:
    """The lessons that ship, the user's own with those of their courses, and `first`, which the window was opened on.

    The settings of `store` say whose progress it is, `notify` hears what is wrong with a course that is left out.
    """

    def __init__(self, store: SettingsStore, first: Lesson, notify: Callable[[str], None]) -> None:
        self._store, self._first, self._notify = store, first, notify
        self._own: dict[str, Lesson] = {}
        self._cards: Sequence[LessonCard] | None = None
        self._courses: Sequence[Course] | None = None
        self._progress: tuple[str, Mapping[str, LessonProgress]] | None = None
        self._levels: tuple[str, Mapping[str, Level]] | None = None

    def first_card(self) -> LessonCard:
        """The lesson that is chosen when the window opens, which is there sooner than all others."""
        return card(row_of(self._first))

    def cards(self) -> Sequence[LessonCard]:
        """Every lesson that can be chosen, in the order in which they are shown, own ones first.

        The first call takes a moment.
        """
        if self._cards is None:
            rows = {row.name: row for row in lesson_rows()}
            self._own = own_lessons(self.courses(), self._store.now.own_lessons_dir, rows)
            rows = {name: row_of(lesson) for name, lesson in self._own.items()} | rows
            kind = rows[self._first.name].folder if self._first.name in rows else ""
            rows[self._first.name] = row_of(self._first, kind)
            self._cards = [card(row) for row in rows.values()]
        return self._cards

    def add(self, lesson: Lesson) -> LessonCard:
        """One more lesson of the user's own, in the place of one of its name; returns its card."""
        added, others = card(row_of(lesson)), [each for each in self.cards() if each.name != lesson.name]
        self._own[lesson.name] = lesson
        self._first = lesson if lesson.name == self._first.name else self._first
        self._cards = [added, *others]
        return added

    def courses(self) -> Sequence[Course]:
        """The user's own courses, then those that ship; a file that cannot be read is left out."""
        if self._courses is None:
            own, faults = courses_in(self._store.now.courses_dir)
            self._courses = (*own, *shipped_courses())
            for fault in faults:
                self._notify(str(fault))
        return self._courses

    def progress(self) -> Mapping[str, LessonProgress]:
        """How far the student is, by the names of lessons, when a session was kept last."""
        settings = self._store.now
        if self._progress is None or self._progress[0] != settings.student:
            self._progress = settings.student, student_progress(StudentHistory.of(settings))
        return self._progress[1]

    def levels(self) -> Mapping[str, Level]:
        """The level that the student chose or came to, by the names of lessons."""
        settings = self._store.now
        if self._levels is None or self._levels[0] != settings.student:
            try:
                levels, fault = self._level_memory.recall()
            except DeviceError:  # the history is away, as was said when the window was opened
                levels, fault = {}, None
            if fault is not None:
                self._notify(fault)
            self._levels = settings.student, levels
        return self._levels[1]

    def level(self, lesson: Lesson) -> Level:
        """The level that holds."""
        return lesson.levels.level(reached=self.levels().get(lesson.name))

    def judge_at(self, lesson: str, level: Level) -> None:
        """Judge a lesson at `level` from now on; raises `DeviceError`, and then all stays as it was."""
        self._level_memory.keep(lesson, level)
        self._levels = None

    @property
    def _level_memory(self) -> LevelMemory:
        return LevelMemory(StudentHistory.of(self._store.now))

    def learnt(self) -> None:
        """A session was kept: what is known of progress and levels is out of date."""
        self._progress = self._levels = None

    def lesson(self, name: str) -> Lesson:
        """The lesson of a name or a file; raises `BadInput`."""
        known = self._own | {self._first.name: self._first}
        return known.get(name) or find_lesson(name)
