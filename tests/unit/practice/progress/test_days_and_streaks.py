"""Days, weeks and months add up; a streak counts weeks and forgives."""

from collections.abc import Iterable
from datetime import date, datetime, timedelta

from station.practice.history.kept_rows import totals
from station.practice.progress.calendar_days import months_of, practised_days, weeks_of
from station.practice.progress.streaks import streak_of, streak_words, this_week_words
from station.store.rows import SessionRow

_MONDAY = date(2026, 6, 1)  # it is one


def _played(*days: int, seconds: float = 600.0) -> list[SessionRow]:
    noon = datetime(2026, 6, 1, 12)
    return [
        SessionRow("Ada", f"{day}-{n}", noon + timedelta(days=day, minutes=n), "", title="Rock", played_s=seconds)
        for n, day in enumerate(days)
    ]


def _streak(days: Iterable[int], today: int) -> tuple[int, int]:
    found = streak_of(practised_days(_played(*days)), _MONDAY + timedelta(days=today))
    return found.weeks, found.longest


def test_a_day_adds_up_its_sessions() -> None:
    days = practised_days(_played(0, 0, 3))
    assert [(day.day.day, day.minutes, day.sessions, day.titles) for day in days.values()] == [
        (1, 20.0, 2, ("Rock",)),
        (4, 10.0, 1, ("Rock",)),
    ]


def test_a_day_of_one_short_session_counts_wherever_days_are_counted() -> None:
    """The README's own example, rock-1 played once, takes 0.8 minutes."""
    rows = _played(0, 2, 4, seconds=48.0)
    days = practised_days(rows)
    (june,) = months_of(days, date(2026, 6, 7))
    assert [june.days, totals(rows).days, weeks_of(days)[_MONDAY].days] == [3, 3, 3]
    assert streak_of(days, _MONDAY).weeks == 0
    assert streak_of(days, date(2026, 6, 7)).days == 3
    assert totals(rows).minutes == 2  # 2.4


def test_weeks_begin_on_monday() -> None:
    weeks = weeks_of(practised_days(_played(0, 6, 7)))
    assert [(week.monday.day, week.played_s, week.days) for week in weeks.values()] == [(1, 1200, 2), (8, 600, 1)]


def test_months_lie_as_in_a_calendar() -> None:
    june, may = months_of(practised_days(_played(-1, 0, 29)), date(2026, 6, 30))
    assert (june.first, june.played_s, june.days) == (date(2026, 6, 1), 1200.0, 2)
    assert [len(week) for week in june.weeks] == [7] * 5
    assert [day and day.day.day for day in june.weeks[4]] == [29, 30, None, None, None, None, None]
    assert [day and day.day.day for day in may.weeks[0]] == [None, None, None, None, 1, 2, 3]  # 1 May 2026: a Friday
    assert may.days == 1
    assert len(months_of({}, date(2026, 6, 30))) == 1


def test_two_days_make_a_week_count_whichever_they_are() -> None:
    assert _streak([0, 6, 9, 11, 14, 20], 20) == (3, 3)
    assert _streak([0, 7, 14], 20) == (0, 0)


def test_days_off_a_light_week_and_weeks_without_break_nothing() -> None:
    assert _streak([0, 4, 8, 14, 18], 20) == (2, 2)  # a week with one day between
    assert _streak([0, 4, 21, 25], 27) == (2, 2)  # two weeks without any between: holidays
    assert _streak([0, 4, 15, 22, 29], 34) == (1, 1)  # one day a week keeps it


def test_three_weeks_without_begin_a_new_one_and_the_longest_is_kept() -> None:
    days = [0, 4, 7, 11, 35, 39]
    assert _streak(days[:4], 34) == (2, 2)  # the third week is not over
    assert _streak(days[:4], 35) == (0, 2)
    assert _streak(days, 41) == (1, 2)


def test_the_running_week_breaks_nothing() -> None:
    assert _streak([0, 4], 21) == (1, 1)  # Monday after two weeks off
    assert _streak([0, 4], 27) == (1, 1)
    assert _streak([0, 4], 28) == (0, 1)


def test_days_to_come_count_for_nothing() -> None:
    assert _streak([0, 2, 4, 7, 9, 11], 6) == (1, 1)


def test_weeks_that_did_not_follow_on_one_another_are_not_said_to() -> None:
    thin = [0, 2, *range(8, 133, 7)]
    assert "row" not in streak_words(streak_of(practised_days(_played(*thin)), _MONDAY + timedelta(days=133)))


def test_the_words_are_of_what_is_there() -> None:
    streak = streak_of(practised_days(_played(0, 2, 4, 7)), _MONDAY + timedelta(days=8))
    assert streak_words(streak) == "1 week that counts"
    assert this_week_words(streak) == "This week: 1 day of practice; with 2 it counts"
    none = streak_of({}, _MONDAY)
    assert streak_words(none) == "A streak begins with the first week that has 2 days of practice"
    assert this_week_words(none) == "This week: no day of practice yet; with 2 it counts"
