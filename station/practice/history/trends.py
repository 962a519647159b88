"""What may be said of a lesson over time: its score, spread, lean and tempo, each with a 95 % interval or not at all.

Only like is compared with like: one lesson, one device, one level, one tempo band (`trend_fit`). What changed is given
over the whole time that is looked at, from the first day of practice to the last. A tempo is chosen, by the student or
by the ladder: its own trend says how fast the lesson is played, not how well.

An interval is its trend's own. Who looks at many trends finds some in which it lies on one side by chance: what is said
without a "perhaps" is so sure that of all that are looked at one in twenty times any would be (Bonferroni).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, timedelta
from enum import StrEnum

import numpy as np

from station.practice.history.trend_fit import Indices, Line, Observations, fit_line
from station.store.rows import SessionKind, SessionRow

LEAST_STROKES = 16
"""A session with fewer says little of a lesson (our choice: two bars of eighth notes)."""
BAND = 1.10
"""Tempi within such a ratio are one band (our choice: two rungs of the ladder, TEACHING: 5 % each)."""
LEAST_DAYS = 5
"""Fewer days never bear an interval (`trend_fit.LEAST_FREEDOM` beyond a height and a slope)."""


FALSE_ANY = 0.05
"""Where nothing changed in any lesson so often something is said of any (our choice, as of any interval here)."""


class Measure(StrEnum):
    """What is looked at."""

    SCORE = "score"
    SPREAD = "spread"
    LEAN = "lean"
    TEMPO = "tempo"


class Verdict(StrEnum):
    """What may be said."""

    TOO_FEW = "too few days"
    TANGLED = "tempo and time went together"
    UNCLEAR = "cannot be told"
    STEADY = "steady"
    BETTER = "better"
    WORSE = "worse"
    CHANGED = "changed"
    """In a measure that has no better and no worse."""


@dataclass(frozen=True, slots=True)
class MeasureWords:
    """How a measure is told: its `label`, `unit`, and by how little a change is none (`small`)."""

    label: str
    unit: str
    small: float


WORDS = {
    Measure.SCORE: MeasureWords("Score", "points", 5.0),
    Measure.SPREAD: MeasureWords("Spread", "ms", 3.0),
    Measure.LEAN: MeasureWords("Lean", "ms", 5.0),
    Measure.TEMPO: MeasureWords("Tempo", "bpm", 3.0),
}
"""What is small: a point of a report's five grades, and what no ear tells apart (our choice)."""


@dataclass(frozen=True, slots=True)
class TrendPoint:
    """A session: its id and when it was, as `day` of the trend, and its value."""

    session: int
    day: float
    value: float


@dataclass(frozen=True, slots=True, eq=False)
class Trend:
    """A measure of a lesson over the days from `first` (day 0) to `last`.

    `points` are its sessions, in order. `line` is what was fitted (None: it cannot be), `change` from the first day to
    the last with its 95 % interval. `strata` is of how many devices, levels and tempo bands like was compared with
    like; `near` the tempo at which the line stands (None where the tempo is measured). The verdict is what the interval
    says by itself; it `is_sure` where it holds among all trends that are `looked_at`.
    """

    measure: Measure
    verdict: Verdict
    first: date | None = None
    last: date | None = None
    points: tuple[TrendPoint, ...] = ()
    line: Line | None = None
    change: tuple[float, float, float] | None = None
    days: int = 0
    strata: int = 0
    near: float | None = None
    looked_at: int = 1
    is_sure: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class LessonTrends:
    """A lesson: its name and title, how many sessions and seconds, its last day, and the trend of each measure."""

    lesson: str
    title: str
    sessions: int
    played_s: float
    last: date
    trends: tuple[Trend, ...]


def lessons_practised(sessions: Iterable[SessionRow]) -> dict[str, list[SessionRow]]:
    """The sessions of each lesson, who was practised last first."""
    found: dict[str, list[SessionRow]] = {}
    for row in sorted(sessions, key=lambda row: row.started):
        if row.kind is SessionKind.LESSON and row.lesson:
            found[row.lesson] = [*found.pop(row.lesson, []), row]
    return dict(reversed(found.items()))


def trends_to_look_at(lessons: Mapping[str, Sequence[SessionRow]]) -> int:
    """How many trends there are to look at: the measures of each lesson with days enough to bear an answer."""
    days = ({row.started.date() for row in rows} for rows in lessons.values())
    return len(Measure) * max(sum(len(each) >= LEAST_DAYS for each in days), 1)


def trends_of(lesson: str, sessions: Sequence[SessionRow], looked_at: int = len(Measure)) -> LessonTrends:
    """The trends of a lesson from its `sessions`, at least one, in any order, of all that are `looked_at`."""
    rows = sorted(sessions, key=lambda row: row.started)
    last = rows[-1]
    return LessonTrends(
        lesson,
        last.title or lesson,
        len(rows),
        sum(row.played_s for row in rows),
        last.started.date(),
        tuple(trend_of(measure, rows, looked_at) for measure in Measure),
    )


def value_of(measure: Measure, row: SessionRow) -> float | None:
    """A session's value; None where it has none, or too few strokes to have one."""
    if measure is Measure.SCORE:
        return row.score if row.notes >= LEAST_STROKES else None
    if measure is Measure.TEMPO:
        return row.beats_a_minute if row.notes >= LEAST_STROKES else None
    if row.strokes < LEAST_STROKES:
        return None
    return row.sd_ms if measure is Measure.SPREAD else row.mean_ms


def trend_of(measure: Measure, sessions: Sequence[SessionRow], looked_at: int = 1) -> Trend:
    """The trend of a measure over `sessions` of one lesson, in the order in which they began, one of `looked_at`."""
    with_value = [(row, value_of(measure, row)) for row in sessions if row.beats_a_minute]
    rows = [row for row, value in with_value if value is not None]
    values = np.array([value for _, value in with_value if value is not None], np.float64)
    if not rows:
        return Trend(measure, Verdict.TOO_FEW)
    first, last = rows[0].started.date(), rows[-1].started.date()
    day = np.array([(row.started.date() - first).days for row in rows], np.float64)
    log_tempo = np.log([row.beats_a_minute or 1.0 for row in rows])
    is_tempo = measure is Measure.TEMPO
    stratum = np.zeros(len(rows), np.int64) if is_tempo else _strata(rows, log_tempo)
    seen = Observations(day, values, np.zeros(len(rows)) if is_tempo else log_tempo, stratum)
    found = Trend(
        measure,
        Verdict.TOO_FEW,
        first,
        last,
        tuple(
            TrendPoint(row.id, at, value) for row, at, value in zip(rows, day.tolist(), values.tolist(), strict=True)
        ),
        days=len(np.unique(day)),
        strata=len(np.unique(stratum)),
        looked_at=looked_at,
        near=None if is_tempo else float(np.exp(np.mean(log_tempo[stratum == np.bincount(stratum).argmax()]))),
    )
    return _told(found, fit_line(seen))


def _strata(rows: Sequence[SessionRow], log_tempo: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Indices:
    """Which sessions are alike, numbers from 0: device, level, and a tempo band about the lesson's median tempo."""
    band = np.round((log_tempo - np.median(log_tempo)) / np.log(BAND)).astype(int).tolist()
    numbers: dict[tuple[str, str, int], int] = {}
    alike = [(row.device, row.level, at) for row, at in zip(rows, band, strict=True)]
    return np.array([numbers.setdefault(each, len(numbers)) for each in alike], np.int64)


_OF_SESSIONS = ("first", "last", "points", "days", "strata", "near", "looked_at")


def _told(found: Trend, line: Line | None) -> Trend:
    """The trend with what the line says of it."""
    values = {name: getattr(found, name) for name in _OF_SESSIONS}
    if line is None:
        verdict = Verdict.TOO_FEW if found.days < LEAST_DAYS or found.strata == 1 else Verdict.TANGLED
        return Trend(found.measure, verdict, **values)
    span = float(line.days[-1] - line.days[0])
    change, half = line.slope * span, line.half * line.slope_error * span
    told = change, change - half, change + half
    is_sure = line.is_surely_sloped(FALSE_ANY / found.looked_at)
    return Trend(found.measure, _verdict(found.measure, line, told), **values, line=line, change=told, is_sure=is_sure)


def _verdict(measure: Measure, line: Line, change: tuple[float, float, float]) -> Verdict:
    _, low, high = change
    small = WORDS[measure].small
    if low <= 0.0 <= high:
        return Verdict.STEADY if -small <= low and high <= small else Verdict.UNCLEAR
    if measure is Measure.TEMPO:
        return Verdict.CHANGED
    if measure is Measure.LEAN:
        first, last = line.at(line.days[[0, -1]])
        return Verdict.BETTER if abs(last) < abs(first) else Verdict.WORSE
    return Verdict.BETTER if (low > 0.0) == (measure is Measure.SCORE) else Verdict.WORSE


def trend_words(trend: Trend) -> str:
    """What may be said of a trend, in a sentence or two."""
    words = WORDS[trend.measure]
    if trend.verdict is Verdict.TOO_FEW:
        return f"{words.label}: cannot be told from {_days(trend.days)}; five and more bear an answer"
    if trend.verdict is Verdict.TANGLED:
        return (
            f"{words.label}: cannot be told, for tempo, level or kit changed along with time; play one again as before"
        )
    assert trend.change is not None, "every other verdict has a line"
    change, low, high = trend.change
    of = f"over {_days(trend.days)} of practice"
    told, lowest, highest = map(_signed, (change, low, high))
    within = f"{told} {words.unit}, 95 % interval {lowest} to {highest}"
    if trend.verdict is Verdict.UNCLEAR:
        return f"{words.label}: cannot be told {of} ({within})"
    if trend.verdict is Verdict.STEADY:
        return f"{words.label}: as it was {of} ({within})"
    direction = _direction(trend.measure, trend.verdict, change)
    if not trend.is_sure:
        return (
            f"{words.label}: perhaps {direction} {of} ({within}); you look at {trend.looked_at} trends,"
            " and chance makes one in twenty look so"
        )
    return f"{words.label}: {direction} {of} ({within})"


def _signed(value: float) -> str:
    whole = round(value)
    return f"{whole:+d}".replace("-", "−") if whole else "0"


def _direction(measure: Measure, verdict: Verdict, change: float) -> str:
    if measure is Measure.SCORE:
        return "higher" if verdict is Verdict.BETTER else "lower"
    if measure is Measure.SPREAD:
        return "steadier" if verdict is Verdict.BETTER else "less steady"
    if measure is Measure.TEMPO:
        return "faster" if change > 0 else "slower"
    way = "later" if change > 0 else "earlier"
    return f"{way}, {'closer to the beat' if verdict is Verdict.BETTER else 'further from the beat'}"


def _days(count: int) -> str:
    return "1 day" if count == 1 else f"{count} days"


def day_at(trend: Trend, day: float) -> date:
    """The date of a `day` of the trend; raises `ValueError` where it has none."""
    if trend.first is None:
        raise ValueError
    return trend.first + timedelta(days=int(day))
