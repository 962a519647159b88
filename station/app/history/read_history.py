"""The pages of the history, read from the database: a moment's work, done beside what goes on."""

from collections.abc import Mapping, Sequence
from datetime import date, datetime, time

from station.app.actions.history_actions import Asked, HistorySection
from station.app.history.history_shown import HistoryPages, PractisedLesson
from station.core.settings import Settings
from station.practice.history.calendar_days import WEEK, monday_of, months_of, practised_days, weeks_of
from station.practice.history.overview import WeekTable, week_table
from station.practice.history.streaks import streak_of
from station.practice.history.trends import LessonTrends, lessons_practised, trends_of
from station.store.history import History
from station.store.opening import history_of
from station.store.rows import SessionRow

WEEKS_SHOWN = 16
"""So many weeks are compared (our choice: a school term)."""


def read_pages(settings: Settings, today: date, asked: Asked) -> HistoryPages:
    """What is `asked` of the student of `settings`; raises `BadInput` and `DeviceError` as `history_of` does."""
    return pages_of(history_of(settings), settings.student, today, asked)


def pages_of(history: History, student: str, today: date, asked: Asked) -> HistoryPages:
    """What is `asked` of a student's history; raises `DeviceError`."""
    rows = history.sessions(student)
    days, lessons = practised_days(rows), lessons_practised(rows)
    week = weeks_of(days).get(monday_of(today))
    return HistoryPages(
        student=student,
        today=today,
        sessions=tuple(reversed(rows)),
        days=days,
        months=tuple(months_of(days, today)),
        streak=streak_of(days, today),
        week_s=0.0 if week is None else week.played_s,
        lessons=tuple(PractisedLesson(name, own[-1].title or name, len(own)) for name, own in lessons.items()),
        trends=_trends(lessons, asked) if asked.section is HistorySection.TRENDS else None,
        weeks=_weeks(history, student, today, asked) if asked.section is HistorySection.WEEKS else None,
        database=history.name,
    )


def _trends(lessons: Mapping[str, Sequence[SessionRow]], asked: Asked) -> LessonTrends | None:
    lesson = asked.lesson if asked.lesson in lessons else next(iter(lessons), None)
    return None if lesson is None else trends_of(lesson, lessons[lesson])


def _weeks(history: History, student: str, today: date, asked: Asked) -> WeekTable:
    since = monday_of(today) - (WEEKS_SHOWN - 1) * WEEK
    figures = history.figures(student, datetime.combine(since, time()))
    return week_table(figures, asked.part, asked.measure, today, WEEKS_SHOWN, asked.lesson_of_weeks)
