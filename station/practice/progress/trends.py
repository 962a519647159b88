"""What may be said of a lesson over time: its score, spread, lean and tempo, each with a 95 % interval or not at all.

Only like is compared with like: one lesson, the same bars, one device and what it is late by, one level, one click and
one tempo band (`practised_alike`). The last days are held against the first (`trend_fit`). Where tempo or stratum went
along with time, the sessions that were most often alike are compared by themselves. A tempo is chosen, by the student
or by the ladder: its own trend says how fast the lesson is played, not how well.

An interval is its trend's own. Who looks at many trends finds some in which it lies on one side by chance: what is said
without a "perhaps" is so sure that of all that are looked at one in twenty times any would be (Bonferroni).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from enum import StrEnum

import numpy as np

from station.practice.progress.practised_alike import strata_of, tempo_of
from station.practice.progress.trend_fit import Compared, Observations, compare_days
from station.store.rows import SessionKind, SessionRow

LEAST_STROKES = 16
"""A session with fewer says little of a lesson (our choice: two bars of eighth notes)."""
LEAST_DAYS = 6
"""Fewer days never bear an interval (`trend_fit`: three means of two days)."""


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
    """How a measure is told: `label`, `unit`, how little a change is none (`small`), and its `scale`."""

    label: str
    unit: str
    small: float
    scale: tuple[float, float]


WORDS = {
    Measure.SCORE: MeasureWords("Score", "points", 5.0, (0.0, 100.0)),
    Measure.SPREAD: MeasureWords("Spread", "ms", 3.0, (0.0, np.inf)),
    Measure.LEAN: MeasureWords("Lean", "ms", 5.0, (-np.inf, np.inf)),
    Measure.TEMPO: MeasureWords("Tempo", "bpm", 3.0, (0.0, np.inf)),
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

    `points` are its sessions, in order. `compared` are its first days and its last (None: they cannot be), `change` is
    by how much the last differ, with its 95 % interval as far as the scale allows; `is_cut` where it allows less. They
    rest on so many `days`. `strata` is of how many kinds like was compared with like; `near` the tempo at which the
    means stand (None where the tempo is measured). The verdict is what the interval says by itself; it `is_sure` where
    it holds among all trends that are `looked_at`.
    """

    measure: Measure
    verdict: Verdict
    first: date | None = None
    last: date | None = None
    points: tuple[TrendPoint, ...] = ()
    compared: Compared | None = None
    change: tuple[float, float, float] | None = None
    is_cut: bool = False
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
        return tempo_of(row) if row.notes >= LEAST_STROKES else None
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
    log_tempo = np.log([tempo_of(row) for row in rows])
    is_tempo = measure is Measure.TEMPO
    stratum = np.zeros(len(rows), np.int64) if is_tempo else strata_of(rows, measure is not Measure.SPREAD)
    seen = Observations(day, values, np.zeros(len(rows)) if is_tempo else log_tempo, stratum)
    usual = stratum == np.bincount(stratum).argmax()
    points = zip(rows, day.tolist(), values.tolist(), strict=True)
    found = Trend(
        measure,
        Verdict.TOO_FEW,
        first,
        last,
        tuple(TrendPoint(row.id, at, value) for row, at, value in points),
        days=len(np.unique(day)),
        strata=len(np.unique(stratum)),
        looked_at=looked_at,
        near=None if is_tempo else float(np.exp(np.mean(log_tempo[usual]))),
    )
    compared = _compared(measure, seen)
    if compared is None and not usual.all():
        compared = _compared(measure, Observations(day[usual], values[usual], log_tempo[usual], stratum[usual]))
    return _told(found, compared)


def _compared(measure: Measure, seen: Observations) -> Compared | None:
    """The comparison; None also where it would tell of values that nobody ever had, for then it was extrapolated."""
    found = compare_days(seen)
    if found is None:
        return None
    slack = WORDS[measure].small / 2
    low, high = float(seen.value.min()) - slack, float(seen.value.max()) + slack
    return found if low <= min(found.early, found.late) and max(found.early, found.late) <= high else None


def _told(found: Trend, compared: Compared | None) -> Trend:
    """The trend with what the comparison says of it."""
    if compared is None:
        verdict = Verdict.TOO_FEW if found.days < LEAST_DAYS or found.strata == 1 else Verdict.TANGLED
        return replace(found, verdict=verdict)
    low, high = compared.interval
    bottom, top = WORDS[found.measure].scale
    least, most = bottom - max(compared.early, compared.late), top - min(compared.early, compared.late)
    change = compared.change, max(low, least), min(high, most)
    is_cut = low < least or high > most
    verdict = _verdict(found.measure, compared, change)
    return replace(
        found,
        verdict=verdict,
        compared=compared,
        change=change,
        is_cut=is_cut,
        days=len(np.unique(compared.days)),
        is_sure=compared.is_surely_changed(FALSE_ANY / found.looked_at),
    )


def _verdict(measure: Measure, compared: Compared, change: tuple[float, float, float]) -> Verdict:
    _, low, high = change
    small = WORDS[measure].small
    if -small <= low and high <= small:
        return Verdict.STEADY
    if low <= 0.0 <= high:
        return Verdict.UNCLEAR
    if measure is Measure.TEMPO:
        return Verdict.CHANGED
    if measure is Measure.LEAN:
        return Verdict.BETTER if abs(compared.late) < abs(compared.early) else Verdict.WORSE
    return Verdict.BETTER if (low > 0.0) == (measure is Measure.SCORE) else Verdict.WORSE


def chance_of_no_gain(trend: Trend) -> float:
    """How likely a measure got better by no more than what is small; 1 where it cannot be told, or is a tempo."""
    compared, small = trend.compared, WORDS[trend.measure].small
    if compared is None or trend.measure is Measure.TEMPO:
        return 1.0
    if trend.measure is Measure.SCORE:
        return compared.chance_below(small)
    if trend.measure is Measure.SPREAD:
        return 1.0 - compared.chance_below(-small)
    gain = abs(compared.early) - abs(compared.late)
    return compared.chance_below(compared.change - gain + small)


def trend_words(trend: Trend) -> str:
    """What may be said of a trend, in a sentence or two."""
    words = WORDS[trend.measure]
    if trend.verdict is Verdict.TOO_FEW:
        return f"{words.label}: cannot be told from {_days(trend.days)}; six and more bear an answer"
    if trend.verdict is Verdict.TANGLED:
        return (
            f"{words.label}: cannot be told, for tempo, bars, level or kit changed along with time; play one again as"
            " before"
        )
    compared = trend.compared
    assert compared is not None, "every other verdict has a comparison"
    assert trend.change is not None, "every other verdict has a comparison"
    change, low, high = trend.change
    of = f"over {_days(trend.days)} of practice"
    if trend.verdict is Verdict.UNCLEAR and trend.is_cut:
        return f"{words.label}: cannot be told {of}, for it differs too much from day to day"
    told, lowest, highest = map(_signed, (change, low, high))
    within = f"{told} {words.unit}, 95 % interval {lowest} to {highest}"
    if trend.verdict in (Verdict.UNCLEAR, Verdict.STEADY):
        how = "as it was" if trend.verdict is Verdict.STEADY else "cannot be told"
        return f"{words.label}: {how} {of} ({within})"
    sides = f"{_plain(compared.early)} in the first {compared.a_side}, {_plain(compared.late)} in the last"
    direction = _direction(trend.measure, trend.verdict, change)
    if not trend.is_sure:
        return (
            f"{words.label}: perhaps {direction} {of}: {sides} ({within}); you look at {trend.looked_at} trends,"
            " and chance makes one in twenty look so"
        )
    return f"{words.label}: {direction} {of}: {sides} ({within})"


def _plain(value: float) -> str:
    return f"{round(value)}".replace("-", "−")


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
