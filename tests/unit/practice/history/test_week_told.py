"""A week told to parents: minutes that add up, and progress only where its interval bears it."""

from dataclasses import replace
from datetime import date, datetime, timedelta

import numpy as np
import pytest

from station.core.counts import whole_minutes
from station.practice.history.trends import Measure, Verdict, trend_of
from station.practice.history.week_told import got_better, practised
from station.store.rows import SessionKind, SessionRow
from tests.unit.practice.history.students_told import Story, row, told

MONDAY = date(2026, 11, 23)
NOON = datetime(2026, 11, 23, 12)


@pytest.mark.parametrize(
    ("seconds", "minutes"), [(0.0, 0), (29.9, 0), (30.0, 1), (89.9, 1), (90.0, 2), (96.0, 2), (150.0, 3), (3600.0, 60)]
)
def test_half_a_minute_and_more_are_one(seconds: float, minutes: int) -> None:
    assert whole_minutes(seconds) == minutes


def test_what_was_practised_the_longest_first() -> None:
    first = row(80.0, 80.0, NOON)
    rows = [
        replace(first, title="Rock", played_s=130.0),
        replace(first, title="Swing", played_s=600.0),
        replace(first, title="Rock", played_s=110.0),
        replace(first, kind=SessionKind.TAKE, lesson="", title="whatever", played_s=29.0),
        replace(first, title="", lesson="waltz\x1b[2J", played_s=0.0, exam="passed"),
    ]
    found = [(one.title, one.minutes, one.times) for one in practised(rows)]
    assert found == [("Swing", 10, 1), ("Rock", 4, 2), ("Free playing", 0, 1), ("waltz [2J (exam: passed)", 0, 1)]


def days(values: list[float], field: str = "score", **others: object) -> list[SessionRow]:
    """A session on each of so many days, the last of them a Friday, with these values."""
    last = NOON + timedelta(days=4)
    rows = [row(75.0, 80.0, last - timedelta(days=len(values) - 1 - at)) for at in range(len(values))]
    changes = [{"title": "Rock", **others, field: value} for value in values]
    return [replace(each, **change) for each, change in zip(rows, changes, strict=True)]  # type: ignore[arg-type]


NOISE = np.random.default_rng(7).normal(0.0, 1.0, 12)


def test_progress_is_told_in_plain_words() -> None:
    rising = [60.0 + 2 * at for at in range(12)]
    (told,) = got_better(days([value + noise for value, noise in zip(rising, NOISE, strict=True)]), MONDAY)
    assert told.startswith("Rock: more of it comes out as it is written. Of 100 points it had ")
    first, last = (int(word) for word in told.replace(",", "").split() if word.isdigit() and word not in ("100", "12"))
    assert abs(first - 60) <= 2
    assert abs(last - 82) <= 2
    assert "12 days" in told
    assert "ms" not in told.split()
    calmer = [30.0 - 1.5 * at for at in range(12)]
    (told,) = got_better(days(calmer, "sd_ms", strokes=100), MONDAY)
    assert told.startswith(
        "Rock: the strokes come more evenly. They strayed by about 30 thousandths of a second, and by 14"
    )
    nearer = [40.0 - 3.0 * at for at in range(12)]
    (told,) = got_better(days(nearer, "mean_ms", strokes=100), MONDAY)
    assert "It was about 40 thousandths of a second late, and is about 7 thousandths of a second late now" in told


@pytest.mark.parametrize(
    "values",
    [
        [80.0 - 2 * at for at in range(12)],  # it got worse: nobody is told off
        [70.0 + each for each in NOISE],  # chance
        [60.0, 62.0, 64.0, 66.0],  # too few days
        [70.0 + 0.1 * at for at in range(12)],  # too little to speak of
    ],
)
def test_nothing_is_told_that_the_interval_does_not_bear(values: list[float]) -> None:
    assert got_better(days(values), MONDAY) == ()


def test_few_weeks_in_which_nothing_changed_tell_of_anything() -> None:
    """Each trend by itself is wrong in five weeks of a hundred; of eight lessons many a week would tell of one."""
    random, weeks = np.random.default_rng(4), 120
    with_any = with_one_by_itself = 0
    for _ in range(weeks):
        lessons = [_ending_this_week(told(Story(12), random)[0], f"lesson-{number}") for number in range(8)]
        with_any += got_better([each for rows in lessons for each in rows], MONDAY) != ()
        with_one_by_itself += any(trend_of(Measure.SCORE, rows).verdict is Verdict.BETTER for rows in lessons)
    assert with_any / weeks <= 0.10
    assert with_one_by_itself / weeks >= 0.12


def _ending_this_week(rows: list[SessionRow], lesson: str) -> list[SessionRow]:
    later = NOON + timedelta(days=2) - rows[-1].started
    return [replace(each, started=each.started + later, lesson=lesson) for each in rows]


def test_of_lessons_that_were_not_played_this_week_nothing_is_told() -> None:
    before = [
        replace(each, started=each.started - timedelta(days=7)) for each in days([60.0 + 2 * at for at in range(12)])
    ]
    assert got_better(before, MONDAY) == ()
