"""The lesson book of one student: today's plan, how far it is, the days before, and what returns next.

The plan is made once a day, when somebody first asks for it, and kept, so that it is the same in the window, in the
terminal and after a pause; another number of minutes makes it anew. What the day leaves undone is in no debt: the next
day's plan is made from what is remembered, and finds it again in its place.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from functools import cached_property, partial
from zlib import crc32

from station.core.settings import Settings
from station.drills.course import Course
from station.drills.daily.daily_items import Assigned, PastDay
from station.drills.daily.day_facts import DayFacts
from station.drills.daily.day_plan import daily_plan
from station.drills.lesson import Lesson
from station.drills.lesson_row import LessonRow, row_of
from station.drills.library import lesson_rows, shipped_courses
from station.practice.book.book_day import BookDay, BookFolder, one_line
from station.practice.book.day_progress import DayProgress, day_progress
from station.practice.book.practised import PractisedSession, days_practised, practised_on
from station.practice.book.teachers_words import TeacherNote, TeachersWords, teachers_words
from station.practice.history.student_history import StudentHistory
from station.practice.records.lesson_order import Progress, followed_course, is_finished
from station.practice.records.lesson_progress import progress_of
from station.practice.records.memory import remembered
from station.practice.records.teachers_wishes import item_named, own_lessons_of

HISTORY_DAYS = 14
"""So far back a plan looks (our choice: longer than any warm-up rests)."""


@dataclass(frozen=True, slots=True)
class DayPage:
    """A day as it is shown: what is kept of it, how far its plan is, its sessions, teachers' notes."""

    kept: BookDay
    progress: DayProgress
    sessions: tuple[PractisedSession, ...] = ()
    notes: tuple[TeacherNote, ...] = ()


@dataclass(frozen=True, slots=True)
class Returning:
    """What returns: a lesson, by its name and its title, and the day of its review."""

    lesson: str
    title: str
    due: date


class LessonBook:
    """The book of the student of `settings`; `notify` hears what could not be read."""

    def __init__(self, settings: Settings, notify: Callable[[str], None]) -> None:
        self._settings, self._notify = settings, notify
        self._folder = BookFolder.of(settings.sessions_dir, settings.student)

    # --- today -------------------------------------------------------------------------------------------------------

    def today(self, today: date, minutes: int | None = None) -> DayPage:
        """Today with its plan, made now where there is none for so many `minutes` (None: whatever was planned).

        Raises `BadInput` for minutes that no day has, `DeviceError` where the book can neither be read nor written.
        """
        kept = self._recall(today)
        if not kept.items or (minutes is not None and minutes != kept.minutes):
            kept = self._planned(kept, minutes)
            self._folder.keep(kept)
        return self._page(kept)

    def leave_out(self, today: date, place: int) -> DayPage:
        """Leave a block of today's plan out; raises `DeviceError`."""
        kept = self._recall(today)
        if 0 <= place < len(kept.items) and place not in kept.left_out:
            kept = replace(kept, left_out=(*kept.left_out, place))
            self._folder.keep(kept)
        return self._page(kept)

    def reflect(self, today: date, line: str) -> DayPage:
        """Keep the student's line about a day, empty takes it away; raises `DeviceError`."""
        kept = replace(self._recall(today), line=one_line(line))
        self._folder.keep(kept)
        return self._page(kept)

    def _planned(self, kept: BookDay, minutes: int | None) -> BookDay:
        facts = day_facts(self._settings, kept.day, self._past(kept.day), self._teachers.assigned)
        facts = facts if minutes is None else replace(facts, minutes=minutes)
        plan = daily_plan(facts)
        return replace(kept, minutes=facts.minutes, items=plan.items, left_out=())

    # --- the days before ---------------------------------------------------------------------------------------------

    def page(self, day: date) -> DayPage:
        """A day as it is, planned or not; raises `DeviceError`."""
        return self._page(self._recall(day))

    def days(self) -> list[date]:
        """The days of which there is anything, in order."""
        practised = days_practised(StudentHistory.of(self._settings))
        return sorted({*practised, *self._folder.days(), *(note.day for note in self._teachers.notes)})

    def returning(self) -> list[Returning]:
        """What returns and when, the nearest first."""
        states = remembered(StudentHistory.of(self._settings))
        due = sorted({(state.review.due, state.item.name) for state in states if state.review.due is not None})
        rows = _lessons(self._settings)[0] if due else {}
        return [Returning(name, rows[name].title if name in rows else name, day) for day, name in due]

    def _past(self, today: date) -> list[PastDay]:
        earliest = today - timedelta(days=HISTORY_DAYS)
        days = [day for day in self._folder.days() if earliest <= day < today]
        return [past_day(self.page(day)) for day in days]

    def _recall(self, day: date) -> BookDay:
        kept, fault = self._folder.recall(day)
        if fault is not None:
            self._notify(fault)
        return kept

    def _page(self, kept: BookDay) -> DayPage:
        sessions = practised_on(StudentHistory.of(self._settings), [kept.day])
        return DayPage(kept, day_progress(kept, sessions), tuple(sessions), self._teachers.on(kept.day))

    @cached_property
    def _teachers(self) -> TeachersWords:
        return teachers_words(self._settings, date.today(), self._notify)


def past_day(page: DayPage) -> PastDay:
    """A day as a later plan looks at it."""
    planned = tuple((item.kind, item.lesson) for item in page.kept.items)
    return PastDay(page.kept.day, planned, frozenset(session.lesson for session in page.sessions))


# --- what a plan goes by ----------------------------------------------------------------------------------------------


def day_facts(
    settings: Settings, today: date, history: Sequence[PastDay] = (), assigned: Sequence[Assigned] = ()
) -> DayFacts:
    """What is known of the student of `settings`: lessons, mastery, the course that they follow.

    Who follows none is given the first of the shipped ones that is not finished.
    """
    states = remembered(StudentHistory.of(settings))
    rows, own = _lessons(settings)
    progress = progress_of(states)
    followed = followed_course(settings)
    courses = shipped_courses() if followed is None else [followed]
    ahead = ((course, names) for course in courses if (names := _ahead(course, rows, progress)))
    course, names = next(ahead, (followed, ()))
    return DayFacts(
        today=today,
        states=states,
        lessons=rows,
        item_of=partial(item_named, own=own),
        course="" if course is None else course.title,
        course_lessons=names,
        assigned=tuple(assigned),
        history=tuple(history),
        seed=crc32(settings.student.encode("utf-8", "replace")),
    )


def _lessons(settings: Settings) -> tuple[dict[str, LessonRow], dict[str, Lesson]]:
    """What there is, the easiest first, and the student's own lessons by name."""
    own = own_lessons_of(settings)
    rows = [*lesson_rows(), *(row_of(lesson) for lesson in own.values())]
    return {row.name: row for row in sorted(rows, key=lambda row: (row.level, row.difficulty))}, own


def _ahead(course: Course, rows: Mapping[str, LessonRow], progress: Progress) -> tuple[str, ...]:
    """The lessons of a course that are not finished, in its order."""
    names = (name for name in course.lesson_names if name in rows)
    return tuple(name for name in names if not is_finished(course, name, progress, rows[name].levels))
