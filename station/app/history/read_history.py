"""The pages of the history, read from the database: a moment's work, done beside what goes on."""

from collections.abc import Sequence
from dataclasses import replace
from datetime import date, datetime, time

from station.app.actions.history_actions import Asked, HistorySection
from station.app.history.history_shown import HistoryPages, PractisedLesson
from station.core.settings import Settings
from station.practice.progress.calendar_days import WEEK, monday_of, months_of, practised_days, weeks_of
from station.practice.progress.overview import week_table
from station.practice.progress.streaks import streak_of
from station.practice.progress.trends import LessonTrends, lessons_practised, trends_of, trends_to_look_at
from station.store.history import History
from station.store.opening import history_of
from station.store.rows import SessionRow, TimedFigure

WEEKS_SHOWN = 16
"""So many weeks are compared (our choice: a school term)."""


def read_pages(settings: Settings, today: date, asked: Asked, before: HistoryPages | None = None) -> HistoryPages:
    """What is `asked` of the student of `settings`; raises `BadInput` and `DeviceError` as `history_of` does.

    What was read `before` is not read again; None where something may have changed since.
    """
    history = history_of(settings)
    if before is None or (before.student, before.today) != (settings.student, today):
        before = _read(history, settings.student, today)
    pages = replace(before, trends=None, weeks=None)
    match asked.section:
        case HistorySection.TRENDS:
            return replace(pages, trends=_trends(pages.sessions, asked))
        case HistorySection.WEEKS:
            figures = _figures(history, pages.student, today) if pages.figures is None else pages.figures
            table = week_table(figures, asked.part, asked.measure, today, WEEKS_SHOWN, asked.lesson_of_weeks)
            return replace(pages, figures=figures, weeks=table)
        case _:
            return pages


def _read(history: History, student: str, today: date) -> HistoryPages:
    """What all pages have."""
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
        database=history.name,
    )


def _trends(rows: Sequence[SessionRow], asked: Asked) -> LessonTrends | None:
    lessons = lessons_practised(rows)
    lesson = asked.lesson if asked.lesson in lessons else next(iter(lessons), None)
    return None if lesson is None else trends_of(lesson, lessons[lesson], trends_to_look_at(lessons))


def _figures(history: History, student: str, today: date) -> tuple[TimedFigure, ...]:
    since = monday_of(today) - (WEEKS_SHOWN - 1) * WEEK
    return tuple(history.figures(student, datetime.combine(since, time())))
