"""Weeks by limb and piece: days are the units, and intervals hold the truth."""

from collections.abc import Iterator
from datetime import date, datetime, timedelta

import numpy as np
import pytest

from station.practice.progress.overview import WeekMeasure, cell_words, week_table
from station.store.rows import FigureRow, Part, TimedFigure

_MONDAY = datetime(2026, 6, 1, 12)
_TODAY = date(2026, 6, 12)


def _figure(day: float, name: str = "left hand", strokes: int = 20, **others: object) -> TimedFigure:
    values: dict[str, object] = {"part": Part.LIMB, "notes": strokes, "matched": strokes, "misses": 0}
    values |= {"wrong_piece": 0, "mean_ms": 0.0, "sd_ms": 10.0, "lesson": "rock-1"} | others
    lesson = str(values.pop("lesson"))
    figure = FigureRow(name=name, strokes=strokes, **values)  # type: ignore[arg-type]
    return TimedFigure(_MONDAY + timedelta(days=day), 1, lesson, figure)


def test_sessions_of_a_day_are_weighted_by_strokes_and_days_are_not() -> None:
    figures = [
        _figure(0.0, mean_ms=10.0, strokes=10),
        _figure(0.1, mean_ms=40.0, strokes=30),
        _figure(1.0, mean_ms=0.5, strokes=10),
    ]
    ((name, (cell, later)),) = week_table(figures, Part.LIMB, WeekMeasure.LEAN, _TODAY, 2).rows
    assert (name, later) == ("left hand", None)
    assert cell is not None
    assert cell.value == pytest.approx((32.5 + 0.5) / 2)
    assert (cell.half, cell.days, cell.sessions, cell.strokes) == (None, 2, 3, 50)


def test_spread_is_pooled_as_variances() -> None:
    figures = [_figure(0.0, sd_ms=30.0), _figure(0.1, sd_ms=40.0)]
    ((_, (cell, _)),) = week_table(figures, Part.LIMB, WeekMeasure.SPREAD, _TODAY, 2).rows
    assert cell is not None
    assert cell.value == pytest.approx(1250.0**0.5)


def test_share_is_of_all_notes_also_without_a_stroke() -> None:
    figures = [_figure(0.0, strokes=0, notes=10, matched=0, mean_ms=None, sd_ms=None)]
    assert week_table(figures, Part.LIMB, WeekMeasure.LEAN, _TODAY, 2).rows == ()
    ((_, (cell, _)),) = week_table(figures, Part.LIMB, WeekMeasure.HIT, _TODAY, 2).rows
    assert cell is not None
    assert cell_words(WeekMeasure.HIT, cell) == "0 % of 10 notes hit (no interval yet), 1 day"


def test_interval_is_students_by_hand() -> None:
    """Days −1 and 1 ms in one week, 9 and 11 in the next: pooled SD √2, two degrees of freedom, t = 4.302653."""
    figures = [_figure(n, mean_ms=ms) for n, ms in ((0, -1.0), (1, 1.0), (7, 9.0), (8, 11.0))]
    ((_, (one, two)),) = week_table(figures, Part.LIMB, WeekMeasure.LEAN, _TODAY, 2).rows
    assert one is not None
    assert two is not None
    assert (one.value, two.value) == (0.0, 10.0)
    assert one.half == two.half == pytest.approx(4.302653, rel=1e-5)
    assert cell_words(WeekMeasure.LEAN, one) == "on the beat (± 4), 2 days, 40 strokes"
    assert cell_words(WeekMeasure.LEAN, two) == "10 ms late (± 4), 2 days, 40 strokes"


def test_rows_are_of_the_part_the_lesson_and_the_weeks_the_busiest_first() -> None:
    figures = [
        _figure(7.0, "right hand", 16),
        _figure(7.0, "left hand", 12),
        _figure(7.0, "right foot", 12, lesson="other"),
        _figure(7.0, "snare", 12, part=Part.PIECE),
        _figure(-1.0, "left foot"),
    ]
    table = week_table(figures, Part.LIMB, WeekMeasure.LEAN, _TODAY, 2, lesson="rock-1")
    assert [name for name, _ in table.rows] == ["right hand", "left hand"]
    assert [monday.day for monday in table.weeks] == [1, 8]
    assert [name for name, _ in week_table(figures, Part.PIECE, WeekMeasure.LEAN, _TODAY, 2).rows] == ["snare"]


def _student(random: np.random.Generator, day_sd: float, weeks: int) -> Iterator[TimedFigure]:
    """Three or so days a week, a session or some on each, forty strokes a session; the truth is a lean of −6 ms."""
    for day in range(7 * weeks):
        if random.random() < 0.45:
            form = random.normal(-6.0, day_sd)
            for session in range(1 + random.poisson(0.7)):
                of_session = form + random.normal(0.0, 3.0) + random.normal(0.0, 20.0 / 40**0.5)
                yield _figure(day + session / 50 - 7 * (weeks - 2), strokes=40, mean_ms=of_session)


@pytest.mark.parametrize("day_sd", [0.5, 5.0, 15.0])
@pytest.mark.parametrize("weeks", [3, 12])
def test_intervals_hold_the_truth(day_sd: float, weeks: int) -> None:
    random = np.random.default_rng(7)
    held = told = 0
    for _ in range(300):
        table = week_table(_student(random, day_sd, weeks), Part.LIMB, WeekMeasure.LEAN, _TODAY, weeks)
        for cell in (cell for _, cells in table.rows for cell in cells if cell is not None and cell.half is not None):
            told += 1
            held += abs(cell.value + 6.0) <= (cell.half or 0.0)
    assert told > 500
    assert 0.92 <= held / told <= 0.98
