"""The facts of the page about a week: from the history and from what comes next, in words for parents."""

from collections.abc import Sequence
from datetime import date, timedelta

from station.core.counts import counted, whole_minutes
from station.core.disk.utf8 import one_line
from station.core.settings import Settings
from station.drills.daily.daily_items import ItemKind
from station.drills.daily.day_plan import daily_plan
from station.practice.book.book_words import day_in_words
from station.practice.book.lesson_book import LessonBook, day_facts
from station.practice.exchange.assigned_work import lesson_work
from station.practice.exchange.student_store import TakenAssignment, taken_assignments
from station.practice.history.kept_rows import totals
from station.practice.progress.calendar_days import WEEK, monday_of, practised_days
from station.practice.progress.streaks import DAYS_A_WEEK, Streak, streak_of
from station.practice.progress.week_told import (
    Practised,
    begin_of,
    end_of,
    got_better,
    practised,
)
from station.render.report.page.week_page import TeachersNote, WeekDay, WeekPage
from station.store.history import History
from station.store.rows import SessionRow, TeacherNoteRow

_MOST_TITLES, _MOST_AHEAD, _MOST_BEGUN, _MOST_NOTES = 10, 3, 2, 3
"""So many are named (our choice: the page stays one page)."""
_BEGINS = {ItemKind.GO_ON: "goes on", ItemKind.NEW: "is new to {}"}
_BETTER = (
    "Like is compared with like: the same bars at about the same speed, the first days of the last twelve weeks against"
    " the last days. Only what is hardly chance is told here, and once."
)
_NOT_YET = (
    "Nothing new can be told for sure. A change shows after weeks with the same piece; until then ups and downs are"
    " part of learning."
)
_OFF = (
    "That happens: holidays, illness and full weeks belong to learning, and what was learnt is still there. A few"
    " minutes on any day are a good beginning again."
)
_FOOT = (
    "A minute here is a minute of playing; looking, listening and pauses are not counted. Each"
    " number is rounded by itself, so that a sum may differ by a minute. Made on the family's or the"
    " school's own computer; nothing was sent anywhere."
)


def week_page(history: History, settings: Settings, day: date, today: date) -> WeekPage:
    """The page about the week that `day` lies in, of the student of `settings`; raises `DeviceError`."""
    monday = monday_of(day)
    sunday = monday + timedelta(days=6)
    student = settings.student
    everything = history.sessions(student, until=end_of(sunday))
    rows = [row for row in everything if row.started >= begin_of(monday)]
    better = got_better(everything, monday)
    now = min(today, sunday)
    return WeekPage(
        student=_begins_with(student),
        when=_when(monday, sunday),
        headline=_headline(student, rows, is_over=today > sunday),
        kind="" if rows else _OFF,
        days=_days(rows, monday, today) if rows else (),
        played=_played(practised(rows)),
        better=better,
        better_words=_BETTER if better else _NOT_YET,
        notes=tuple(_note(each) for each in history.notes(student) if monday <= each.made.date() <= sunday)[
            :_MOST_NOTES
        ],
        ahead=_ahead(settings, today) if monday <= today <= sunday else (),
        streak=_streak_words(streak_of(practised_days(everything), now)),
        foot=(_FOOT,),
    )


def _when(monday: date, sunday: date) -> str:
    return f"{day_in_words(monday)} to {day_in_words(sunday)} {sunday.year}"


def _headline(student: str, rows: Sequence[SessionRow], is_over: bool) -> str:
    name, week = _begins_with(student), "" if is_over else " so far"
    if not rows:
        return f"{name} did not play in this week{week}."
    summed = totals(rows)
    minutes = counted(summed.minutes, "minute") if summed.minutes else "less than a minute"
    return f"{name} played on {counted(summed.days, 'day')} of this week{week}, {minutes} in all."


def _begins_with(student: str) -> str:
    """The student's name as a sentence begins with it: in a capital, where it is written in small letters."""
    name = one_line(student) or "The student"
    return name[:1].upper() + name[1:]


def _days(rows: Sequence[SessionRow], monday: date, today: date) -> tuple[WeekDay, ...]:
    played = practised_days(rows)
    days = [monday + timedelta(days=n) for n in range(7)]
    return tuple(
        WeekDay(
            f"{day:%A}",
            whole_minutes(played[day].played_s) if day in played else 0,
            day in played,
            day > today and day not in played,
        )
        for day in days
    )


def _played(found: Sequence[Practised]) -> tuple[tuple[str, str], ...]:
    named, others = found[:_MOST_TITLES], found[_MOST_TITLES:]
    lines = [(one.title, _how_long(one.minutes, one.times)) for one in named]
    if others:
        minutes, times = sum(one.minutes for one in others), sum(one.times for one in others)
        lines.append((f"and {len(others)} more", _how_long(minutes, times)))
    return tuple(lines)


def _how_long(minutes: int, times: int) -> str:
    time = counted(minutes, "minute") if minutes else "less than a minute"
    return f"{time}{f', in {times} sessions' if times > 1 else ''}"


def _note(row: TeacherNoteRow) -> TeachersNote:
    said = [*row.words.splitlines(), *([f"Next: {row.next}"] if row.next else [])]
    lines = tuple(line for each in said if (line := one_line(each)))
    return TeachersNote(one_line(row.teacher) or "The teacher", day_in_words(row.made.date()), lines)


_FORGIVEN = "A week or two off in between do not break the count."


def _streak_words(streak: Streak) -> str:
    enough = f"{DAYS_A_WEEK} days at the drums"
    if not streak.weeks:
        return f"Weeks are counted from the first that has {enough}. {_FORGIVEN}"
    weeks = "one week" if streak.weeks == 1 else f"{streak.weeks} weeks"
    since = "" if streak.since is None else f" since {day_in_words(streak.since)}"
    return f"By now it is {weeks} with {enough} or more{since}. {_FORGIVEN}"


# --- what comes next --------------------------------------------------------------------------------------------------


def _ahead(settings: Settings, today: date) -> tuple[str, ...]:
    """What a teacher has asked for and is still open, then what comes again, then what the day's plan begins."""
    silent: list[str] = []
    book = LessonBook(settings, silent.append)
    asked = [line for one in taken_assignments(settings)[0] if (line := _asked(one, settings)) is not None]
    again = [f"“{one_line(each.title)}” comes again {_on(each.due, today)}." for each in book.returning()[:_MOST_AHEAD]]
    planned = book.page(today).kept.items or daily_plan(day_facts(settings, today)).items
    name = _begins_with(settings.student)
    begun = {one_line(item.title): _BEGINS[item.kind] for item in reversed(planned) if item.kind in _BEGINS}
    lines = [
        f"“{title}” {how.format(name)}."
        for title, how in reversed(begun.items())
        if not any(title in line for line in asked)
    ]
    return (*asked[-_MOST_AHEAD:], *again, *lines[:_MOST_BEGUN])


def _asked(one: TakenAssignment, settings: Settings) -> str | None:
    open_lessons = [one_line(work.asked.title) for work in lesson_work(one, settings) if not work.is_done]
    if not open_lessons:
        return None
    due = one.assignment.due
    until = "" if due is None else f", for {day_in_words(due)}"
    title, teacher = one_line(one.assignment.title), one_line(one.assignment.teacher)
    return f"“{title}”, from {teacher}{until}: {'; '.join(open_lessons)}."


def _on(due: date, today: date) -> str:
    if due <= today:
        return "next time"
    return f"on {due:%A}" if due < today + WEEK else f"on {day_in_words(due)}"
