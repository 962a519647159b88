"""Weeks by limb and by piece: lean, spread and the share of notes that were hit, each with a 95 % interval.

A week's value is the mean of its days, and a day's that of its sessions, weighted by strokes: a thousand strokes of one
evening are one evening. How far days of a week scatter is pooled over all weeks of a limb or piece, for a week has two
days or three; the interval is Student's t about the week's mean. A day's lean or spread rests on at least
`LEAST_STROKES`. What is compared here is what was played in those weeks: another lesson or tempo moves it as well.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import date
from enum import StrEnum

from station.core.student_t import t_quantile_95
from station.practice.progress.calendar_days import WEEK, monday_of
from station.store.rows import FigureRow, Part, TimedFigure

LEAST_STROKES = 8
"""A day with fewer strokes of a limb says nothing of its timing (our choice: a bar of eighth notes)."""
LEAST_FREEDOM = 2
"""So many days beyond the weeks' means are needed for an interval (our choice: with one Student's t is 13)."""


class WeekMeasure(StrEnum):
    """What a cell tells."""

    LEAN = "lean"
    SPREAD = "spread"
    HIT = "hit"


@dataclass(frozen=True, slots=True)
class Cell:
    """A week of a limb or piece: its mean over `days` days, half its 95 % interval (None: it cannot be told)."""

    value: float
    half: float | None
    days: int
    sessions: int
    strokes: int


@dataclass(frozen=True, slots=True)
class WeekTable:
    """`rows` of limbs or pieces by name, the busiest first; each has a cell for each of the `weeks` (Mondays) in order.

    None: nothing was played.
    """

    part: Part
    measure: WeekMeasure
    weeks: tuple[date, ...] = ()
    rows: tuple[tuple[str, tuple[Cell | None, ...]], ...] = ()


@dataclass(frozen=True, slots=True)
class _Day:
    value: float
    sessions: int
    strokes: int


def week_table(
    figures: Iterable[TimedFigure], part: Part, measure: WeekMeasure, today: date, weeks: int, lesson: str = ""
) -> WeekTable:
    """The table of the last `weeks` weeks up to that of `today`; of one `lesson`, or of all that was played."""
    last = monday_of(today)
    mondays = tuple(last - n * WEEK for n in reversed(range(weeks)))
    of_part: defaultdict[str, list[TimedFigure]] = defaultdict(list)
    for each in figures:
        is_wanted = each.figure.part is part and (not lesson or each.lesson == lesson)
        if is_wanted and mondays[0] <= each.started.date() < last + WEEK:
            of_part[each.figure.name].append(each)
    busiest = sorted(of_part, key=lambda name: (-sum(each.figure.notes for each in of_part[name]), name))
    rows = ((name, _cells(of_part[name], measure, mondays)) for name in busiest)
    return WeekTable(part, measure, mondays, tuple((name, cells) for name, cells in rows if any(cells)))


def _cells(figures: Sequence[TimedFigure], measure: WeekMeasure, mondays: Sequence[date]) -> tuple[Cell | None, ...]:
    of_day: defaultdict[date, list[FigureRow]] = defaultdict(list)
    for each in figures:
        of_day[each.started.date()].append(each.figure)
    of_week: defaultdict[date, list[_Day]] = defaultdict(list)
    for day, rows in of_day.items():
        found = _VALUES[measure](rows)
        if found is not None:
            of_week[monday_of(day)].append(found)
    freedom = sum(len(days) - 1 for days in of_week.values())
    square = sum((day.value - _mean(days)) ** 2 for days in of_week.values() for day in days)
    half_of_one = t_quantile_95(freedom) * (square / freedom) ** 0.5 if freedom >= LEAST_FREEDOM else None
    return tuple(_cell(of_week[monday], half_of_one) if monday in of_week else None for monday in mondays)


def _cell(days: Sequence[_Day], half_of_one: float | None) -> Cell:
    half = None if half_of_one is None else half_of_one / len(days) ** 0.5
    return Cell(_mean(days), half, len(days), sum(day.sessions for day in days), sum(day.strokes for day in days))


def _mean(days: Sequence[_Day]) -> float:
    return sum(day.value for day in days) / len(days)


def _lean(rows: Sequence[FigureRow]) -> _Day | None:
    """Milliseconds, early is negative."""
    return _timed(rows, lambda row: row.mean_ms, lambda mean: mean)


def _spread(rows: Sequence[FigureRow]) -> _Day | None:
    """Milliseconds: the pooled SD within the sessions."""
    return _timed(rows, lambda row: None if row.sd_ms is None else row.sd_ms**2, lambda variance: variance**0.5)


def _timed(
    rows: Sequence[FigureRow], of: Callable[[FigureRow], float | None], back: Callable[[float], float]
) -> _Day | None:
    known = [(value, row.strokes) for row in rows if (value := of(row)) is not None]
    strokes = sum(count for _, count in known)
    if strokes < LEAST_STROKES:
        return None
    return _Day(back(sum(value * count for value, count in known) / strokes), len(known), strokes)


def _hit(rows: Sequence[FigureRow]) -> _Day | None:
    """Per cent of the notes."""
    notes = sum(row.notes for row in rows)
    return _Day(100.0 * sum(row.matched for row in rows) / notes, len(rows), notes) if notes else None


_VALUES: dict[WeekMeasure, Callable[[Sequence[FigureRow]], _Day | None]] = {
    WeekMeasure.LEAN: _lean,
    WeekMeasure.SPREAD: _spread,
    WeekMeasure.HIT: _hit,
}


def cell_words(measure: WeekMeasure, cell: Cell) -> str:
    """A cell in a line."""
    within = "no interval yet" if cell.half is None else f"± {cell.half:.0f}"
    days = "1 day" if cell.days == 1 else f"{cell.days} days"
    if measure is WeekMeasure.HIT:
        return f"{cell.value:.0f} % of {cell.strokes} notes hit ({within}), {days}"
    if measure is WeekMeasure.SPREAD:
        return f"spread {cell.value:.0f} ms ({within}), {days}, {cell.strokes} strokes"
    way = (
        "on the beat" if abs(cell.value) < 0.5 else f"{abs(cell.value):.0f} ms {'late' if cell.value > 0 else 'early'}"
    )
    return f"{way} ({within}), {days}, {cell.strokes} strokes"
