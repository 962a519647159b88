"""A week told to parents: minutes that add up, and progress only where its interval bears it."""

from dataclasses import replace
from datetime import date, datetime, timedelta

import numpy as np
import pytest

from benchmarks.history_trends import STUDENTS, look
from station.core.counts import whole_minutes
from station.practice.progress.week_told import got_better, practised
from station.store.rows import SessionKind, SessionRow
from tests.unit.practice.progress.students_told import row

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


def test_progress_is_told_once_and_in_plain_words() -> None:
    """Nine days, four of them in the week before: means of the first three and the last three are told."""
    rising = [60.0 + 3 * at for at in range(9)]
    rows = days([value + noise for value, noise in zip(rising, NOISE[:9], strict=True)])
    (told,) = got_better(rows, MONDAY)
    assert told.startswith("Rock: more of it comes out as it is written. Of 100 points it had ")
    first, last = (
        int(word) for word in told.replace(",", "").split(" (")[0].split() if word.isdigit() and word != "100"
    )
    assert abs(first - 63) <= 2
    assert abs(last - 81) <= 2
    assert told.endswith("(the first 3 days of 9 against the last 3).")
    later = [
        replace(each, started=each.started + timedelta(days=7), score=84.0 + at % 2) for at, each in enumerate(rows)
    ]
    assert got_better([*rows, *later], MONDAY + timedelta(days=7)) == ()
    calmer = [30.0 - 2.0 * at for at in range(9)]
    (told,) = got_better(days(calmer, "sd_ms", strokes=100), MONDAY)
    assert "ms" not in told.split()
    assert told.startswith(
        "Rock: the strokes come more evenly. They strayed by about 28 thousandths of a second, and by 16"
    )
    nearer = [40.0 - 4.0 * at for at in range(9)]
    (told,) = got_better(days(nearer, "mean_ms", strokes=100), MONDAY)
    assert "It was about 36 thousandths of a second late, and is about 12 thousandths of a second late now" in told


@pytest.mark.parametrize(
    "values",
    [
        [80.0 - 3 * at for at in range(9)],  # it got worse: nobody is told off
        [70.0 + each for each in NOISE[:9]],  # chance
        [60.0, 62.0, 64.0, 66.0],  # too few days
        [70.0 + 0.1 * at for at in range(9)],  # too little to speak of
    ],
)
def test_nothing_is_told_that_the_interval_does_not_bear(values: list[float]) -> None:
    assert got_better(days(values), MONDAY) == ()


def test_faster_is_no_better_by_itself() -> None:
    rows = [replace(each, beats_a_minute=70.0 + 5 * at) for at, each in enumerate(days([75.0, 74.0] * 4 + [75.0]))]
    assert got_better(rows, MONDAY) == ()


@pytest.mark.parametrize("name", ["nothing changes", "35 % worse", "nothing changes, easier bars from day 21"])
def test_nobody_is_told_what_is_not_so(name: str) -> None:
    """Weeks 6 to 20 of each student; `benchmarks/history_trends.py` has the larger table."""
    found = look(STUDENTS[name], 5, np.random.default_rng(6))
    assert found.told_ever <= 1
    assert found.impossible == 0


def test_those_who_get_much_better_are_told() -> None:
    assert look(STUDENTS["50 % better, line"], 5, np.random.default_rng(6)).told_ever >= 3


def test_of_lessons_that_were_not_played_this_week_nothing_is_told() -> None:
    before = [
        replace(each, started=each.started - timedelta(days=7)) for each in days([60.0 + 3 * at for at in range(9)])
    ]
    assert got_better(before, MONDAY) == ()
