"""A week of practice told to people who play no drums: what was played how long, and what has surely got better."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime, timedelta

from station.core.counts import whole_minutes
from station.core.disk.utf8 import one_line
from station.practice.history.calendar_days import WEEK
from station.practice.history.trend_fit import Line
from station.practice.history.trends import WORDS, Measure, Trend, Verdict, lessons_practised, trend_of
from station.store.rows import SessionKind, SessionRow

LOOKS_BACK = 5 * WEEK
"""So long before the week a change is looked for (our choice: what got better in spring is no news in autumn)."""
FALSE_A_WEEK = 0.05
"""Of weeks in which nothing got better so many say that something did (our choice, as of any interval here)."""
_FREE = "Free playing"
_NAMELESS = "A lesson"
_FEWEST_SAID = 3.0


@dataclass(frozen=True, slots=True)
class Practised:
    """What was played under one `title`: in whole `minutes` (0: less than half of one), and how many `times`."""

    title: str
    minutes: int
    times: int


def practised(rows: Iterable[SessionRow]) -> tuple[Practised, ...]:
    """What was played, the longest first."""
    played: defaultdict[str, list[float]] = defaultdict(list)
    for row in rows:
        played[title_of(row)].append(row.played_s)
    longest = sorted(played.items(), key=lambda item: (-sum(item[1]), item[0]))
    return tuple(Practised(title, whole_minutes(sum(times)), len(times)) for title, times in longest)


def title_of(row: SessionRow) -> str:
    """What a session is called, in one line."""
    named = _FREE if row.kind is SessionKind.TAKE else one_line(row.title or row.lesson) or _NAMELESS
    exam = one_line(row.exam)
    return f"{named} (exam: {exam})" if exam else named


def begin_of(day: date) -> datetime:
    """Its first moment, by the clock on the wall."""
    return datetime.combine(day, datetime.min.time())


def end_of(day: date) -> datetime | None:
    """The first moment after it; None after the last day that there is."""
    return None if day == date.max else begin_of(day + timedelta(days=1))


# --- what got better --------------------------------------------------------------------------------------------------


def got_better(rows: Sequence[SessionRow], monday: date) -> tuple[str, ...]:
    """A sentence for each lesson of the week from `monday` that surely got better.

    `rows` are the sessions of that week and of `LOOKS_BACK` before it. Of a lesson the first of score, spread, lean and
    tempo is told that changed by more than what counts as small, and so surely that in a week in which nothing did
    anything at all is told `FALSE_A_WEEK` times: the more trends there are to look at, the surer each has to be
    (Bonferroni).
    """
    of_week = lessons_practised(row for row in rows if row.started.date() >= monday)
    of_lesson = lessons_practised(rows)
    trends = [(title_of(mine[-1]), _trends(of_lesson[lesson])) for lesson, mine in of_week.items()]
    looked_at = sum(len(each) for _, each in trends)
    found = ((title, _first_better(each, looked_at)) for title, each in trends)
    return tuple(_sentence(title, *better) for title, better in found if better is not None)


def _trends(rows: Sequence[SessionRow]) -> list[tuple[Trend, Line]]:
    """Those of a lesson that bear an answer."""
    found = (trend_of(measure, rows) for measure in Measure)
    return [(trend, trend.line) for trend in found if trend.line is not None]


def _first_better(trends: Iterable[tuple[Trend, Line]], looked_at: int) -> tuple[Trend, Line] | None:
    return next(((trend, line) for trend, line in trends if _is_better(trend, line, looked_at)), None)


def _is_better(trend: Trend, line: Line, looked_at: int) -> bool:
    rises = trend.verdict is Verdict.CHANGED and line.slope > 0
    span = float(line.days[-1] - line.days[0])
    is_sure = line.is_surely_sloped(2 * FALSE_A_WEEK / looked_at)  # of steps back nothing is told
    is_large = abs(line.slope) * span >= WORDS[trend.measure].small
    return (rises or trend.verdict is Verdict.BETTER) and is_large and is_sure


def _sentence(title: str, trend: Trend, line: Line) -> str:
    """What got better by this measure."""
    first, last = (float(each) for each in line.at(line.days[[0, -1]]))
    match trend.measure:
        case Measure.SCORE:
            first, last = (min(max(each, 0.0), 100.0) for each in (first, last))
            words = (
                f"more of it comes out as it is written. Of 100 points it had {first:.0f}, and has about {last:.0f} now"
            )
        case Measure.SPREAD:
            words = f"the strokes come more evenly. They strayed by about {_thousandths(first)}, and by {last:.0f} now"
        case Measure.LEAN:
            words = f"it is closer to the beat. It was {_beside(first)}, and is {_beside(last)} now"
        case Measure.TEMPO:
            words = f"it is played faster. It was at about {first:.0f} beats a minute, and is at {last:.0f} now"
    return f"{title}: {words} (over {trend.days} days of practice)."


def _thousandths(ms: float) -> str:
    return f"{ms:.0f} thousandths of a second"


def _beside(ms: float) -> str:
    if abs(ms) < _FEWEST_SAID:
        return "on it"
    return f"about {_thousandths(abs(ms))} {'late' if ms > 0 else 'early'}"
