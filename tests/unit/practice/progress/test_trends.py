"""Trends hold the truth as often as they say, and claim no progress where there is none."""

from dataclasses import replace
from datetime import timedelta

import numpy as np
import pytest

from station.practice.progress.trends import (
    Measure,
    Verdict,
    lessons_practised,
    trend_of,
    trend_words,
    trends_of,
    trends_to_look_at,
)
from station.store.rows import SessionKind
from tests.unit.practice.progress.students_told import BEGIN, Story, climbing, row, slowing, told, wandering

_STUDENTS = 100
_STORIES = {
    "six days": Story(6),
    "twelve days, better": Story(12, a_day=0.4),
    "sixty days": Story(60),
    "tempo wanders": Story(20, a_day=0.2, tempo=wandering),
    "tempo climbs": Story(40, a_day=0.2, tempo=climbing),
    "ever slower": Story(25, tempo=slowing),
    "heavy tails": Story(15, is_heavy=True),
    "telephone rings": Story(20, a_day=0.2, interrupted=0.05),
    "long holiday": Story(12, holiday=40),
    "form persists": Story(30, persists=0.4),
    "days alike": Story(20, day_sd=0.5),
    "days differ much": Story(20, day_sd=12.0),
}


@pytest.mark.parametrize("name", _STORIES)
def test_intervals_hold_the_truth(name: str) -> None:
    """Days that share nothing have intervals that are a little too wide: how much they share few days do not show."""
    random = np.random.default_rng(15)
    held = false = compared = 0
    story = _STORIES[name]
    for _ in range(_STUDENTS):
        trend = trend_of(Measure.SCORE, told(story, random)[0])
        if trend.change is None:
            assert trend.verdict is Verdict.TANGLED
            continue
        assert trend.compared is not None
        days, side = trend.compared.days, trend.compared.a_side
        truth = story.a_day * float(days[-side:].mean() - days[:side].mean())
        _, low, high = trend.change
        compared += 1
        held += low <= truth <= high
        false += trend.verdict is Verdict.BETTER and truth <= 0.0
    assert compared >= _STUDENTS / 5
    assert held / compared >= 0.92
    assert false / compared <= 0.05


def test_real_progress_is_seen() -> None:
    random = np.random.default_rng(3)
    verdicts = [trend_of(Measure.SCORE, told(Story(40, a_day=0.25), random)[0]).verdict for _ in range(60)]
    assert verdicts.count(Verdict.BETTER) >= 55  # 20 points in 12 weeks, with a day's SD of 5


def test_who_looks_at_many_lessons_is_told_of_no_progress_by_chance() -> None:
    random, pages, lessons = np.random.default_rng(8), 60, 12
    surely = by_itself = 0
    for _ in range(pages):
        trends = [trend_of(Measure.SCORE, told(Story(12), random)[0], lessons) for _ in range(lessons)]
        claims = [each for each in trends if each.verdict in (Verdict.BETTER, Verdict.WORSE)]
        by_itself += bool(claims)
        surely += any(each.is_sure for each in claims)
        for each in claims:
            assert ("perhaps" in trend_words(each)) is not each.is_sure
            assert ("you look at 12 trends" in trend_words(each)) is not each.is_sure
    assert by_itself > surely
    assert surely / pages <= 0.10


def test_great_progress_is_sure_among_all_lessons() -> None:
    random = np.random.default_rng(3)
    trends = [trend_of(Measure.SCORE, told(Story(40, a_day=0.25), random)[0], 120) for _ in range(30)]
    assert sum(each.is_sure and each.verdict is Verdict.BETTER for each in trends) >= 24


def test_all_lessons_with_days_enough_are_looked_at() -> None:
    rows = [row(75.0, 80.0, BEGIN + timedelta(days=n)) for n in range(6)]
    assert trends_to_look_at({"one": rows, "two": rows, "few days": rows[1:] * 3}) == 8
    assert trends_to_look_at({"few days": rows[1:]}) == 4


def test_plain_line_through_slower_and_slower_sessions_would_claim_progress() -> None:
    """What the comparison of like with like is for: the same sessions, taken as if tempo were nothing."""
    random = np.random.default_rng(5)
    claimed = {True: 0, False: 0}
    for _ in range(60):
        sessions, _ = told(Story(60, tempo=slowing), random)
        for is_told_of_tempo in claimed:
            rows = sessions if is_told_of_tempo else [row(each.score or 0.0, 80.0, each.started) for each in sessions]
            claimed[is_told_of_tempo] += trend_of(Measure.SCORE, rows).verdict is Verdict.BETTER
    assert claimed[False] >= 25
    assert claimed[True] <= 4


def test_sessions_of_one_day_are_one_day() -> None:
    sessions = [row(50.0 + n, 80.0, BEGIN + timedelta(minutes=n)) for n in range(40)]
    trend = trend_of(Measure.SCORE, sessions)
    assert (trend.verdict, trend.days, trend.change) == (Verdict.TOO_FEW, 1, None)
    assert "cannot be told from 1 day" in trend_words(trend)


def test_a_course_is_told_by_its_first_days_and_its_last() -> None:
    """A line and a logarithm, without noise: means of the first three days of nine, and of the last three, by hand."""
    day = np.arange(9.0)
    for values, change in ((60.0 + day, 6.0), (60.0 + 10 * np.log1p(day), 14.7694)):
        rows = [row(each, 80.0, BEGIN + timedelta(days=n)) for n, each in enumerate(values.tolist())]
        trend = trend_of(Measure.SCORE, rows)
        assert trend.change is not None
        assert trend.change == pytest.approx((change,) * 3, abs=1e-3)  # 10/3·ln(7·8·9 / 1·2·3)


def test_independent_days_have_student_s_interval() -> None:
    """The mixture's part without shared form is numpy's least squares; Student's t for 6 degrees is a table's."""
    scores = [61.0, 64.0, 60.0, 65.0, 61.0, 66.0, 62.0, 67.0, 63.0]
    trend = trend_of(Measure.SCORE, [row(each, 80.0, BEGIN + timedelta(days=n)) for n, each in enumerate(scores)])
    day = np.arange(9.0)
    course = np.column_stack([np.ones(9), day, np.log1p(day)])
    told_of = course[-3:].mean(axis=0) - course[:3].mean(axis=0)
    beta, square, *_ = np.linalg.lstsq(course, np.array(scores), rcond=None)
    error = np.sqrt(square[0] / 6 * told_of @ np.linalg.inv(course.T @ course) @ told_of)
    assert trend.compared is not None
    assert trend.compared.centres[0] == pytest.approx(told_of @ beta)
    assert trend.compared.scales[0] == pytest.approx(error)


def test_a_quick_beginning_is_not_told_as_a_line() -> None:
    """Power law of practice: 30 to 20 ms in 40 days, most of it in the first ten."""
    random = np.random.default_rng(2)
    rows = [
        row(60.0, 80.0, BEGIN + timedelta(days=n), sd_ms=float(30.0 * (1 + n) ** -0.11 + random.normal(0, 0.5)))
        for n in range(40)
    ]
    trend = trend_of(Measure.SPREAD, rows)
    assert trend.change is not None
    days = 30.0 * (1.0 + np.arange(40)) ** -0.11
    assert trend.change[1] <= days[-8:].mean() - days[:8].mean() <= trend.change[2]


def test_other_bars_and_a_lag_measured_anew_are_no_progress() -> None:
    at = [BEGIN + timedelta(days=n) for n in range(30)]
    noise = np.random.default_rng(3).normal(0.0, 2.0, 30)
    bars = [
        row(60.0 + 20.0 * (n >= 12) + noise[n], 80.0, at[n], first_bar=5 if n >= 12 else 1, last_bar=8)
        for n in range(30)
    ]
    assert trend_of(Measure.SCORE, bars).verdict in (Verdict.STEADY, Verdict.UNCLEAR, Verdict.TANGLED)
    lags = [
        row(60.0, 80.0, at[n], mean_ms=float(noise[n] - (3.0 if n >= 12 else 25.0)), output_latency_ms=20.0,
            input_latency_ms=30.0 if n >= 12 else 8.0)
        for n in range(30)
    ]  # fmt: skip
    assert trend_of(Measure.LEAN, lags).verdict in (Verdict.STEADY, Verdict.UNCLEAR, Verdict.TANGLED)
    unknown = [replace(each, input_latency_ms=None) for each in lags]
    assert trend_of(Measure.LEAN, unknown).verdict is not Verdict.TANGLED


def test_tempo_and_time_together_give_no_number() -> None:
    rows = [row(60.0, 66.0 + 11.0 * n / 45, BEGIN + timedelta(days=n), sd_ms=22.0 + n % 5) for n in range(46)]
    trend = trend_of(Measure.SPREAD, rows)
    assert (trend.verdict, trend.change) == (Verdict.TANGLED, None)
    assert not any(each.isdigit() for each in trend_words(trend))


def test_one_tempo_for_ever_is_as_it_was() -> None:
    rows = [row(60.0, 80.0 + 1e-14 * n, BEGIN + timedelta(days=n)) for n in range(20)]
    assert trend_of(Measure.TEMPO, rows).verdict is Verdict.STEADY


def test_a_rising_tempo_stands_at_the_middle_of_its_way() -> None:
    rows = [row(60.0, 64.0, BEGIN + timedelta(days=n), top_beats_a_minute=100.0) for n in range(8)]
    assert {point.value for point in trend_of(Measure.TEMPO, rows).points} == {80.0}


def test_harder_level_and_another_kit_are_no_step_back() -> None:
    before = [row(80.0 + n % 2, 80.0, BEGIN + timedelta(days=n), level="easy") for n in range(10)]
    after = [row(60.0 + n % 2, 80.0, BEGIN + timedelta(days=n), level="strict") for n in range(10, 20)]
    assert trend_of(Measure.SCORE, before + after).verdict is Verdict.STEADY


def test_time_that_went_with_the_kit_cannot_be_told() -> None:
    sessions = [row(60.0, 80.0, BEGIN + timedelta(days=n), device=f"kit {n}") for n in range(8)]
    trend = trend_of(Measure.SCORE, sessions)
    assert trend.verdict is Verdict.TANGLED
    assert "changed along with time" in trend_words(trend)


def test_lean_is_better_where_it_comes_closer_to_the_beat() -> None:
    def leaning(first: float, last: float) -> Verdict:
        at = np.linspace(first, last, 12) + np.tile([0.5, -0.5], 6)
        rows = [row(60.0, 80.0, BEGIN + timedelta(days=n), mean_ms=float(each)) for n, each in enumerate(at)]
        return trend_of(Measure.LEAN, rows).verdict

    assert leaning(-25.0, -8.0) is Verdict.BETTER
    assert leaning(25.0, 8.0) is Verdict.BETTER
    assert leaning(-5.0, 20.0) is Verdict.WORSE


def test_tempo_is_told_without_praise() -> None:
    rows = [row(60.0, 60.0 + 2 * n + n % 2, BEGIN + timedelta(days=n)) for n in range(12)]
    trend = trend_of(Measure.TEMPO, rows)
    assert trend.verdict is Verdict.CHANGED
    assert "faster" in trend_words(trend)


def test_words_tell_change_and_interval_and_no_signed_zero() -> None:
    scores = [60.0, 61.0, 60.0, 61.0, 60.0, 61.0, 60.0, 61.0, 60.0, 61.0, 60.0]
    trend = trend_of(Measure.SCORE, [row(each, 80.0, BEGIN + timedelta(days=n)) for n, each in enumerate(scores)])
    assert trend.verdict is Verdict.STEADY
    assert trend_words(trend) == "Score: as it was over 11 days of practice (0 points, 95 % interval −1 to +1)"


def test_sessions_of_a_few_strokes_say_nothing() -> None:
    rows = [row(60.0, 80.0, BEGIN + timedelta(days=n), strokes=5, notes=5) for n in range(12)]
    assert all(each.verdict is Verdict.TOO_FEW and not each.points for each in trends_of("rock-1", rows).trends)


def test_lessons_come_by_their_last_day_and_takes_are_none() -> None:
    rows = [
        row(60.0, 80.0, BEGIN, lesson="old"),
        row(60.0, 80.0, BEGIN + timedelta(days=1), lesson="new"),
        row(60.0, 80.0, BEGIN + timedelta(days=2), lesson="", kind=SessionKind.TAKE),
        row(60.0, 80.0, BEGIN + timedelta(days=3), lesson="old"),
    ]
    assert {lesson: len(each) for lesson, each in lessons_practised(rows).items()} == {"old": 2, "new": 1}
    assert list(lessons_practised(rows)) == ["old", "new"]
