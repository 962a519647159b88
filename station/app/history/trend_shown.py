"""How a trend is shown: how high its axis is, what stands above it, and what a dot is of."""

from collections.abc import Mapping
from datetime import date, timedelta

import numpy as np
from numpy.typing import NDArray

from station.practice.book.book_words import day_in_words
from station.practice.progress.trends import WORDS, Measure, Trend, trend_words
from station.store.rows import SessionRow

LEAST_SPAN: Mapping[Measure, float] = {
    Measure.SCORE: 10.0,
    Measure.SPREAD: 6.0,
    Measure.LEAN: 10.0,
    Measure.TEMPO: 10.0,
}
"""An axis spans as much at least, in the measure's unit (our choice): what is smaller is no change to be looked at."""
_ENDS: Mapping[Measure, tuple[float, float]] = {
    Measure.SCORE: (0.0, 100.0),
    Measure.SPREAD: (0.0, np.inf),
    Measure.LEAN: (-np.inf, np.inf),
    Measure.TEMPO: (0.0, np.inf),
}
"""No value lies beyond."""
_NAMED = 4
"""So many sessions of a day are named (our choice)."""


def dots_of(trend: Trend) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Day and value of each dot (n,): a day of the comparison, or a session where there is none."""
    if trend.compared is not None:
        return trend.compared.days, trend.compared.values
    return np.array([point.day for point in trend.points]), np.array([point.value for point in trend.points])


def axis_of(measure: Measure, values: NDArray[np.float64]) -> tuple[float, float]:
    """The least and the greatest value (n > 0) that an axis goes to, at least `LEAST_SPAN` apart; with 0 for a lean."""
    low, high = float(values.min()), float(values.max())
    if measure is Measure.LEAN:
        low, high = min(low, 0.0), max(high, 0.0)
    more = max(LEAST_SPAN[measure] - (high - low), 0.0) / 2
    low, high = low - more, high + more
    least, greatest = _ENDS[measure]
    shift = max(least - low, 0.0) - max(high - greatest, 0.0)
    return low + shift, high + shift


def told(trend: Trend) -> str:
    """What may be said of it: of what never changed, its one value."""
    values = [point.value for point in trend.points]
    if trend.days < 2 or max(values) != min(values):
        return trend_words(trend)
    words = WORDS[trend.measure]
    return f"{words.label}: {values[0]:g} {words.unit} each time, on {trend.days} days of practice"


def dot_words(trend: Trend, at: int, rows: Mapping[int, SessionRow]) -> str:
    """A dot in lines: its day and value, and tempo and score of the day's sessions, which `rows` has by their id."""
    days, values = dots_of(trend)
    whole = int(np.floor(days[at]))
    day = (trend.first or date.min) + timedelta(days=whole)
    words = WORDS[trend.measure]
    near = "" if trend.compared is None or trend.near is None else f", as at {trend.near:.0f} bpm"
    own = [rows[point.session] for point in trend.points if int(point.day) == whole and point.session in rows]
    lines = [f"{day_in_words(day)} {day.year}: {words.label.lower()} {_number(values[at])} {words.unit}{near}"]
    lines += [_played(row) for row in own[:_NAMED]]
    return "\n".join([*lines, *([f"and {len(own) - _NAMED} more"] if len(own) > _NAMED else [])])


def _played(row: SessionRow) -> str:
    tempo = [] if row.beats_a_minute is None else [f"{row.beats_a_minute:g} bpm"]
    score = [] if row.score is None else [f"{row.score:.0f} of 100"]
    return ", ".join([f"{row.started:%H:%M}", *tempo, *score])


def _number(value: float) -> str:
    return f"{round(float(value), 1):g}".replace("-", "−")
